// Two branches that cross under a small angle, and two eigenvalues that pass zero in opposite senses.
#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "one_unknown.hpp"

namespace springfold::known_answers {

Draw crossing(Random& random) {
  Draw draw{.family = "crossing"};
  enum { perfect, apart, folded };
  const double d = log_uniform(random, 1e-4, 1e-1), k = uniform(random, -3, 3);
  const double l0 = uniform(random, -0.5, 0.5), l_start = -uniform(random, 0.1, 1);
  int kind = choice(random, 3);
  double e = log_uniform(random, 1e-9, 1e-2);
  const double fold = 2 * std::sqrt(e) / d;  // |l| at which the two branches turn back
  if (kind == folded && fold > -0.5 * l_start) kind = perfect;
  const double side = sign(random);
  e *= kind == perfect ? 0 : kind == apart ? 1 : -1;
  // p (p - d l) = e, p = z - k l^2 / 2, l = lambda - l0
  draw.base = one_unknown([=](double z, double lambda, double& F, double& F_z, double& F_l) {
    const double l = lambda - l0, p = z - k * l * l / 2, q = p - d * l;
    F = p * q - e;
    F_z = p + q;
    F_l = -k * l * q - p * (k * l + d);
  });
  draw.size = 2.4;
  const auto split = [=](double z, double lambda) {  // distance from the line half-way
    const double l = lambda - l0;
    return z - k * l * l / 2 - d * l / 2;
  };
  const double half = side * std::sqrt(d * d * l_start * l_start / 4 + e);
  draw.lambda_start = l0 + l_start;
  draw.z_start = scalar(k * l_start * l_start / 2 + d * l_start / 2 + half);
  limit_lambda(draw, l0 - 1.2, l0 + 1.2);
  draw.parameter = [](const Vector&, double lambda) { return lambda; };
  constexpr double same = 1e-7;
  if (kind == perfect) {
    draw.gap = d;
    draw.answers.push_back({AnswerKind::branch_point, l0, scalar(0)});
    // Rounding moves points by more than `same` where stiffnesses differ much: still nothing beside the other branch.
    constexpr double share = 1e-2;
    draw.on_curve = [=](const Vector& z, double lambda) {
      const double l = lambda - l0;
      return std::abs(split(z[0], lambda) + side * d * l / 2) <
             std::max(same, share * d * std::abs(l));
    };
  } else {
    draw.gap = 2 * std::sqrt(std::abs(e)) / draw.size;
    if (kind == apart)
      draw.on_curve = [=](const Vector& z, double lambda) {
        return side * split(z[0], lambda) > 0;
      };
    else {
      draw.parameter = [=](const Vector& z, double lambda) { return split(z[0], lambda); };
      draw.on_curve = [=](const Vector&, double lambda) { return lambda < l0; };
      draw.answers.push_back(
          {AnswerKind::fold, l0 - fold, scalar(k * fold * fold / 2 - d * fold / 2)});
    }
  }
  complete(draw);
  return draw;
}

Draw opposite(Random& random) {
  Draw draw{.family = "opposite", .size = 2};
  const bool together = choice(random, 5) == 0;
  const double e = together ? 0 : log_uniform(random, 1e-8, 0.3);
  const double a = uniform(random, 0.3, 2), b = uniform(random, 0.3, 2);
  const double A = uniform(random, -1, 1);
  // V = [a (l - e/2) X^2 - b (l + e/2) Y^2] / 2 + (X^4 + Y^4) / 4, X = x - sin(l + 1), Y = y - A cos 2l
  const auto x_of = [](double l) { return std::sin(l + 1); };
  const auto y_of = [A](double l) { return A * std::cos(2 * l); };
  draw.base.size = 2;
  draw.base.at = [=](const Vector& z, double l, const Piece&, Vector& F, Matrix& H, Vector& F_l) {
    const double X = z[0] - x_of(l), Y = z[1] - y_of(l);
    const double ax = a * (l - e / 2), by = -b * (l + e / 2);
    F = Vector{{ax * X + X * X * X, by * Y + Y * Y * Y}};
    H = Matrix{{ax + 3 * X * X, 0}, {0, by + 3 * Y * Y}};
    F_l = Vector{{a * X - H(0, 0) * std::cos(l + 1), -b * Y + H(1, 1) * 2 * A * std::sin(2 * l)}};
    return true;
  };
  draw.lambda_start = -uniform(random, 0.6, 0.9);
  const auto place = [=](double l) { return Vector{{x_of(l), y_of(l)}}; };
  draw.z_start = place(draw.lambda_start);
  if (together) {
    draw.answers.push_back({AnswerKind::branch_point, 0, place(0), 2});
  } else {
    draw.answers.push_back({AnswerKind::branch_point, -e / 2, place(-e / 2)});
    draw.answers.push_back({AnswerKind::branch_point, e / 2, place(e / 2)});
  }
  draw.on_curve = [=](const Vector& z, double l) { return (z - place(l)).norm() < 1e-7; };
  draw.parameter = [](const Vector&, double l) { return l; };
  limit_lambda(draw, -1, 0.8);
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
