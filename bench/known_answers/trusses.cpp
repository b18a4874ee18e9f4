// Springs to one point: the n-pod dome and the von Mises truss that can sway; and the trammel.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "families.hpp"
#include "one_unknown.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::known_answers {
namespace {

using Complex = std::complex<double>;

/// Springs of stiffness k and free length L0 from the anchors to the point z.
Base springs_to_point(std::vector<Vector> anchors, double k, double L0, Vector load) {
  const Index n = load.size();
  return {
      n, [=](const Vector& z, double lambda, const Piece&, Vector& F, Matrix& H, Vector& F_lambda) {
        F = lambda * load;
        H = Matrix::Zero(n, n);
        F_lambda = load;
        for (const Vector& anchor : anchors) {
          const Vector d = z - anchor;
          const double l = d.norm();
          if (!(l > 0)) return false;
          F += k * (1 - L0 / l) * d;
          H += k * (1 - L0 / l) * Matrix::Identity(n, n) + k * L0 / (l * l * l) * d * d.transpose();
        }
        return true;
      }};
}

/// The cubic L^3 - L0 L^2 + L0 q = 0 of the bifurcation lengths: L0 from one root, and the other
/// positive one; no cancellation however close they are.
struct Lengths {
  double L0 = 1;
  std::vector<double> roots{};
  std::optional<Complex>
      missed{};  ///< where the roots are only just not there: one of the pair of complex ones
};

Lengths with_root(double L, double q) {
  const double p = L * q / (L * L - q);  // L0 - L
  return {L + p, {L, 0.5 * (p + std::sqrt(p * p + 4 * p * L))}};
}

/// A free length; half of the time one at which special points come close. They meet at the root
/// sqrt(3 q), where the two roots are one, and at sqrt(meets_fold), where one is at the fold.
Lengths random_lengths(Random& random, double q, double meets_fold, double z_low, double z_high) {
  const double double_root = std::sqrt(3 * q), smallest = 1.5 * double_root;
  switch (choice(random, 6)) {
    case 0:
      return with_root(double_root * (1 + sign(random) * closeness(random)), q);
    case 1:
      return with_root(std::sqrt(meets_fold) * (1 + sign(random) * closeness(random)), q);
    case 2: {  // the roots are just not there: an eigenvalue comes near zero
      const double deficit = log_uniform(random, 1e-8, 1e-1);
      return {smallest * (1 - deficit), {}, double_root * Complex(1, std::sqrt(deficit / 1.5))};
    }
    default:
      break;
  }
  const double L0 = std::hypot(1, uniform(random, z_low, z_high));
  if (L0 < smallest) return {L0, {}};
  double low = double_root, high = 2 * L0;  // the larger root
  low = std::max(low, 2 * L0 / 3);
  for (int i = 0; i < 200; ++i) {
    const double L = 0.5 * (low + high);
    (L * L * (L - L0) + L0 * q < 0 ? low : high) = L;
  }
  Lengths lengths = with_root(high, q);
  lengths.L0 = L0;
  return lengths;
}

/// Answers on the axis, where the springs have length L at height sqrt(L^2 - 1).
void add_axis(Draw& draw, Index axis, double stiffness, const Lengths& lengths, int corank) {
  const double L0 = lengths.L0;
  const double top = std::sqrt(L0 * L0 - 1), end = 1.2 * top;
  const auto load = [=](double z) { return stiffness * z * (L0 / std::hypot(1, z) - 1); };
  const auto add = [&](AnswerKind kind, double L, int multiplicity) {
    if (!(L > 1)) return;
    for (const double s : {1.0, -1.0}) {
      Vector z = Vector::Zero(axis + 1);
      z[axis] = s * std::sqrt((L - 1) * (L + 1));
      draw.answers.push_back({kind, load(z[axis]), z, multiplicity});
    }
  };
  add(AnswerKind::fold, std::cbrt(L0), 1);
  for (const double L : lengths.roots) add(AnswerKind::branch_point, L, corank);
  const auto height = [](Complex L) { return std::sqrt((L - 1.0) * (L + 1.0)); };
  draw.z_start = Vector::Zero(axis + 1);
  draw.z_start[axis] = top;
  limit_unknown(draw, axis, -end, end);
  const double L_fold = std::cbrt(L0);
  draw.size = 2 * std::max({end, std::abs(load(std::sqrt(L_fold * L_fold - 1))), -load(end)});
  // Beside points that nearly coincide rounding alone moves a point off the axis, by some 1e-7 and more: as far as the
  // point of the axis satisfies the equations under its load as well as a traced one has to.
  draw.on_curve = [=](const Vector& z, double lambda) {
    return z.head(axis).norm() < 1e-6 ||
           std::abs(load(z[axis]) - lambda) <= continuation::residual_level;
  };
  draw.parameter = [=](const Vector& z, double) { return z[axis]; };
  complete(draw);
  // A pair of complex singular points, to first order in their distance, is as near to its neighbours as real ones are.
  if (lengths.missed && std::abs(*lengths.missed) > 1)
    for (Answer& a : draw.answers) {
      const Complex missed = height(*lengths.missed);
      const double distance = std::abs(missed - std::abs(a.z[axis])) / draw.size;
      a.separation = std::min(a.separation, distance);
      draw.gap = std::min(draw.gap, distance);
    }
}

}  // namespace

Draw n_pod_dome(Random& random) {
  Draw draw{.family = "n-pod dome"};
  const int N = 3 + choice(random, 5);
  const double k = log_uniform(random, 0.5, 2);
  const Lengths lengths = random_lengths(random, 0.5, 1.5, 0.5, 3);
  std::vector<Vector> anchors;
  for (int i = 0; i < N; ++i) {
    const double angle = 2 * std::numbers::pi * i / N;
    anchors.push_back(Vector{{std::cos(angle), std::sin(angle), 0.0}});
  }
  draw.base = springs_to_point(anchors, k, lengths.L0, Vector{{0.0, 0.0, 1.0}});
  add_axis(draw, 2, N * k, lengths, 2);
  return draw;
}

Draw von_mises_sway(Random& random) {
  Draw draw{.family = "von Mises with sway"};
  const double k = log_uniform(random, 0.5, 2);
  const Lengths lengths = random_lengths(random, 1, 2, 0.5, 4);
  draw.base = springs_to_point({Vector{{-1.0, 0.0}}, Vector{{1.0, 0.0}}}, k, lengths.L0,
                               Vector{{0.0, 1.0}});
  add_axis(draw, 1, 2 * k, lengths, 1);
  return draw;
}

Draw trammel(Random& random) {
  Draw draw{.family = "trammel"};
  const double k = log_uniform(random, 0.5, 2);
  draw.size = std::max(3.0, 6 * k);
  const double fold = choice(random, 2) ? 0.5 * draw.size * closeness(random)
                                        : std::acos(std::cbrt(uniform(random, 0.05, 0.95)));
  const double c0 = std::pow(std::cos(fold), 3);
  draw.base = one_unknown([=](double t, double P, double& F, double& F_t, double& F_P) {
    F = k * (std::cos(t) - c0) * std::sin(t) - P * std::cos(t);
    F_t = k * (std::cos(2 * t) - c0 * std::cos(t)) + P * std::sin(t);
    F_P = -std::cos(t);
  });
  const auto load = [=](double t) { return k * (std::cos(t) - c0) * std::tan(t); };
  draw.z_start = scalar(choice(random, 2) ? std::acos(c0) : 1.2);
  draw.lambda_start = load(draw.z_start[0]);
  limit_lambda(draw, -3 * k, 3 * k);
  draw.parameter = [](const Vector& z, double) { return z[0]; };
  draw.on_curve = [](const Vector& z, double) { return std::abs(z[0]) < std::numbers::pi / 2; };
  for (const double s : {1.0, -1.0})
    draw.answers.push_back({AnswerKind::fold, load(s * fold), scalar(s * fold)});
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
