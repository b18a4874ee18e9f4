// Two buckling modes that interact: V = 1/2 (m1 - l) x^2 + 1/2 (m2 - l) y^2
//                                       + 1/4 (a x^4 + 2 b x^2 y^2 + c y^4).
#include <algorithm>
#include <cmath>

#include "families.hpp"

namespace springfold::known_answers {
namespace {

/// On the mixed branch x^2 = p (l - l_Y), y^2 = r (l - l_X).
struct Modes {
  double m1 = 0, m2 = 0, a = 1, b = 0, c = 1;
  double p() const { return (c - b) / (a * c - b * b); }
  double r() const { return (a - b) / (a * c - b * b); }
  double l_X() const { return (a * m2 - b * m1) / (a - b); }
  double l_Y() const { return (c * m1 - b * m2) / (c - b); }
};

Modes random_modes(Random& random) {
  Modes m;
  m.m1 = uniform(random, -0.5, 0.5);
  const int spread = choice(random, 3);
  m.m2 = spread == 0   ? m.m1
         : spread == 1 ? m.m1 + 3 * closeness(random) * sign(random)
                       : uniform(random, -0.5, 0.5);
  do {
    m.a = uniform(random, 0.5, 2) * (choice(random, 5) == 0 ? -1 : 1);
    m.b = uniform(random, -2, 3);
    m.c = uniform(random, 0.5, 2) * (choice(random, 5) == 0 ? -1 : 1);
  } while (std::min({std::abs(m.a - m.b), std::abs(m.c - m.b), std::abs(m.a * m.c - m.b * m.b)}) <
           0.3);
  return m;
}

Base base_of(const Modes& m) {
  return {2, [=](const Vector& z, double l, const Piece&, Vector& F, Matrix& H, Vector& F_lambda) {
            const double x = z[0], y = z[1];
            F = Vector{{(m.m1 - l) * x + m.a * x * x * x + m.b * x * y * y,
                        (m.m2 - l) * y + m.c * y * y * y + m.b * x * x * y}};
            H = Matrix{{m.m1 - l + 3 * m.a * x * x + m.b * y * y, 2 * m.b * x * y},
                       {2 * m.b * x * y, m.m2 - l + 3 * m.c * y * y + m.b * x * x}};
            F_lambda = -z;
            return true;
          }};
}

void trivial_branch(Draw& draw, const Modes& m) {
  draw.z_start = Vector::Zero(2);
  draw.lambda_start = -1.2;
  draw.on_curve = [](const Vector& z, double) { return z.norm() < 1e-7; };
  draw.parameter = [](const Vector&, double lambda) { return lambda; };
  if (m.m1 == m.m2)
    draw.answers.push_back({AnswerKind::branch_point, m.m1, Vector::Zero(2), 2});
  else
    for (const double l : {m.m1, m.m2})
      draw.answers.push_back({AnswerKind::branch_point, l, Vector::Zero(2)});
}

/// l = mode + a u^2, u = x (or y), with its vertex on the trivial branch.
void single_mode_branch(Draw& draw, Index u, double mode, double a, double secondary, bool equal) {
  draw.z_start = Vector::Zero(2);
  draw.z_start[u] = std::sqrt(0.6 / std::abs(a));
  draw.lambda_start = mode + a * draw.z_start[u] * draw.z_start[u];
  draw.on_curve = [=](const Vector& z, double lambda) {
    return std::abs(z[1 - u]) < 1e-7 && std::abs(mode + a * z[u] * z[u] - lambda) < 1e-7;
  };
  draw.parameter = [=](const Vector& z, double) { return z[u]; };
  draw.answers.push_back({AnswerKind::branch_point, mode, Vector::Zero(2), equal ? 2 : 1});
  const double square = (secondary - mode) / a;
  if (equal || !(square > 0)) return;
  for (const double s : {1.0, -1.0}) {
    Answer answer{AnswerKind::branch_point, secondary, Vector::Zero(2)};
    answer.z[u] = s * std::sqrt(square);
    draw.answers.push_back(answer);
  }
}

/// m1 = m2: the mixed branch is a parabola through the double point.
bool mixed_parabola(Draw& draw, const Modes& m, double slant) {
  if (!(m.p() * m.r() > 0)) return false;
  const double x = std::sqrt(std::abs(m.p())), y = slant * std::sqrt(std::abs(m.r()));
  const double sense = m.p() > 0 ? 1 : -1;
  draw.z_start = 0.8 * Vector{{x, y}};
  draw.lambda_start = m.m1 + sense * 0.64;
  draw.parameter = [=](const Vector& z, double) { return x * z[0] + y * z[1]; };
  draw.on_curve = [=](const Vector& z, double lambda) {
    const double t = (x * z[0] + y * z[1]) / (x * x + y * y);
    return std::abs(x * z[1] - y * z[0]) < 1e-7 && std::abs(m.m1 + sense * t * t - lambda) < 1e-7;
  };
  draw.answers.push_back({AnswerKind::branch_point, m.m1, Vector::Zero(2), 2});
  return true;
}

/// m1 != m2: an arch over its secondary branch point on the X (or Y) branch, or a quarter and more
/// of a closed curve through both.
bool mixed_branch(Draw& draw, const Modes& m) {
  const double lX = m.l_X(), lY = m.l_Y(), p = m.p(), r = m.r();
  const double xs = std::sqrt(p * (lX - lY)), ys = std::sqrt(r * (lY - lX));  // NaN: none
  if (std::isnan(xs) && std::isnan(ys)) return false;
  const bool closed = !std::isnan(xs) && !std::isnan(ys);
  const double l = closed           ? 0.5 * (lX + lY)
                   : std::isnan(ys) ? lX + std::copysign(0.8, r)
                                    : lY + std::copysign(0.8, p);
  draw.lambda_start = l;
  draw.z_start = Vector{{std::sqrt(p * (l - lY)), std::sqrt(r * (l - lX))}};
  if (!std::isnan(xs)) draw.answers.push_back({AnswerKind::branch_point, lX, Vector{{xs, 0.0}}});
  if (!std::isnan(ys)) draw.answers.push_back({AnswerKind::branch_point, lY, Vector{{0.0, ys}}});
  if (closed) {
    limit_unknown(draw, 0, -0.5 * xs, 10);
    limit_unknown(draw, 1, -0.5 * ys, 10);
  }
  draw.parameter = [=](const Vector& z, double) {
    return closed ? std::atan2(z[1] / ys, z[0] / xs) : std::isnan(ys) ? z[1] : z[0];
  };
  draw.on_curve = [=](const Vector& z, double lambda) {
    return std::abs(z[0] * z[0] - p * (lambda - lY)) < 1e-7 &&
           std::abs(z[1] * z[1] - r * (lambda - lX)) < 1e-7;
  };
  return true;
}

}  // namespace

Draw two_mode(Random& random) {
  const Modes m = random_modes(random);
  Draw draw{.family = "two mode", .base = base_of(m), .size = 3};
  const bool equal = m.m1 == m.m2;
  if (!equal) draw.gap = std::abs(m.m2 - m.m1) / draw.size;
  const int kind = choice(random, 4);
  const double slant = sign(random);
  if (kind == 1)
    single_mode_branch(draw, 0, m.m1, m.a, m.l_X(), equal);
  else if (kind == 2)
    single_mode_branch(draw, 1, m.m2, m.c, m.l_Y(), equal);
  else if (kind == 0 || !(equal ? mixed_parabola(draw, m, slant) : mixed_branch(draw, m)))
    trivial_branch(draw, m);
  // A range of lambda that holds the start whatever the coefficients are.
  const double reach = std::max(2.0, std::abs(draw.lambda_start) + 0.5);
  limit_lambda(draw, -reach, reach);
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
