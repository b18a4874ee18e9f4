// A column of n rigid links with torsion springs.
#include <cmath>
#include <numbers>

#include "families.hpp"

namespace springfold::known_answers {
namespace {

Base base_of(Index n, double k, double L) {
  return {n, [=](const Vector& t, double P, const Piece&, Vector& F, Matrix& H, Vector& F_lambda) {
            F = Vector::Zero(n);
            H = Matrix::Zero(n, n);
            F_lambda = Vector::Zero(n);
            for (Index i = 0; i < n; ++i) {
              F[i] += k * (t[i] - (i > 0 ? t[i - 1] : 0.0));
              H(i, i) += k;
              if (i > 0) {
                F[i - 1] -= k * (t[i] - t[i - 1]);
                H(i - 1, i - 1) += k;
                H(i, i - 1) -= k;
                H(i - 1, i) -= k;
              }
              F[i] -= P * L * std::sin(t[i]);
              H(i, i) -= P * L * std::cos(t[i]);
              F_lambda[i] = -L * std::sin(t[i]);
            }
            return true;
          }};
}

}  // namespace

Draw link_column(Random& random) {
  Draw draw{.family = "link column"};
  const int n = 1 + choice(random, 8);
  const double k = log_uniform(random, 0.5, 2), L = 1.0 / n;
  draw.base = base_of(n, k, L);
  draw.z_start = Vector::Zero(n);
  limit_lambda(draw, -0.1 * k / L, 4.2 * k / L);
  draw.size = 4 * k / L;
  draw.on_curve = [](const Vector& z, double) { return z.norm() < 1e-7; };
  draw.parameter = [](const Vector&, double lambda) { return lambda; };
  for (int j = 1; j <= n; ++j) {
    const double s = std::sin((2 * j - 1) * std::numbers::pi / (4 * n + 2));
    draw.answers.push_back({AnswerKind::branch_point, 4 * s * s * k / L, Vector::Zero(n)});
  }
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
