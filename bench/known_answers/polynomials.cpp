// Fold ladder and pitchfork.
#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "one_unknown.hpp"

namespace springfold::known_answers {
namespace {

double polynomial(const std::vector<double>& c, double x) {
  double value = 0;
  for (std::size_t i = c.size(); i-- > 0;) value = value * x + c[i];
  return value;
}

std::vector<double> times_root(const std::vector<double>& c, double root) {
  std::vector<double> product(c.size() + 1, 0.0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    product[i + 1] += c[i];
    product[i] -= root * c[i];
  }
  return product;
}

/// One to four places, often two or three of them close together.
std::vector<double> places_on_ladder(Random& random) {
  std::vector<double> places{uniform(random, -0.9, 0.9)};
  const int count = 1 + choice(random, 4), close = choice(random, 3);
  for (int i = 1; i < count; ++i)
    places.push_back(i <= close ? places.back() + 3 * closeness(random)
                                : uniform(random, -0.9, 0.9));
  std::sort(places.begin(), places.end());
  return places;
}

double largest(const std::vector<double>& c, double low, double high) {
  double value = 0;
  for (int i = 0; i <= 100; ++i)
    value = std::max(value, std::abs(polynomial(c, low + (high - low) * i / 100)));
  return value;
}

/// Can the places be told apart if the slope p' has this error? Near a_i it is C (x - a_i)^m; a place
/// is no longer one if the slope is within the error up to a tenth of the way to its neighbours.
bool blurs(double error, double c, const std::vector<double>& places,
           const std::vector<int>& order) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    double C = std::abs(c), width = 0.1;
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (j == i) continue;
      const double distance = std::abs(places[i] - places[j]);
      C *= std::pow(distance, order[j]);
      width = std::min(width, distance);
    }
    if (std::pow(error / C, 1.0 / order[i]) > 0.1 * width) return true;
  }
  return false;
}

}  // namespace

Draw fold_ladder(Random& random) {
  Draw draw{.family = "fold ladder"};
  const std::vector<double> places = places_on_ladder(random);
  std::vector<double> slope{1};
  std::vector<int> order;
  for (const double a : places) {
    order.push_back(choice(random, 6) == 0 ? 2 : 1);
    for (int m = 0; m < order.back(); ++m) slope = times_root(slope, a);
  }
  const double c = sign(random) * log_uniform(random, 0.5, 10) / largest(slope, -1.5, 1.5);
  std::vector<double> p{0};
  for (std::size_t i = 0; i < slope.size(); ++i) {
    slope[i] *= c;
    p.push_back(slope[i] / static_cast<double>(i + 1));
  }
  // The slope as a product: its roots are exact.
  const auto rate = [places, order, c](double x) {
    double value = c;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (int m = 0; m < order[i]; ++m) value *= x - places[i];
    return value;
  };
  draw.base = one_unknown([p, rate](double x, double lambda, double& F, double& F_x, double& F_l) {
    F = polynomial(p, x) - lambda;
    F_x = rate(x);
    F_l = -1;
  });
  for (std::size_t i = 0; i < places.size(); ++i)
    draw.answers.push_back({order[i] == 1 ? AnswerKind::fold : AnswerKind::touch,
                            polynomial(p, places[i]), scalar(places[i])});
  draw.blurs = [c, places, order](double error) { return blurs(error, c, places, order); };
  limit_unknown(draw, 0, -1.5, 1.5);
  draw.z_start = scalar(uniform(random, -1.4, -1.1));
  draw.lambda_start = polynomial(p, draw.z_start[0]);
  draw.size = std::max(3.0, 2 * largest(p, -1.5, 1.5));
  draw.parameter = [](const Vector& z, double) { return z[0]; };
  complete(draw);
  return draw;
}

Draw pitchfork(Random& random) {
  Draw draw{.family = "pitchfork"};
  enum { trivial, bent, main_branch, detached };
  /// With a smaller imperfection the perfect branches meet F to the tolerance of residuals as well.
  constexpr double taken_for_perfect = 1e-11;
  const double l0 = uniform(random, -0.5, 0.5);
  const int kind = choice(random, 4);
  const double eta =
      kind == trivial || kind == bent ? 0 : log_uniform(random, 1e-12, 1e-1) * sign(random);
  draw.base = one_unknown([=](double x, double lambda, double& F, double& F_x, double& F_l) {
    F = x * x * x - (lambda - l0) * x + eta;
    F_x = 3 * x * x - (lambda - l0);
    F_l = -x;
  });
  draw.size = 2;
  limit_lambda(draw, l0 - 1, l0 + 1.1);  // the detached branch starts at up to l0 + 1.01
  draw.parameter = [](const Vector& z, double) { return z[0]; };
  const auto curve = [=](double x) { return l0 + x * x + (eta == 0 ? 0 : eta / x); };
  // The main branch has x of the sign of -eta, the detached one that of eta.
  const double side = (kind == main_branch) == (eta > 0) ? -1 : 1;
  if (kind == trivial) {
    draw.z_start = scalar(0);
    draw.lambda_start = l0 - uniform(random, 0.5, 0.9);
    draw.on_curve = [](const Vector& z, double) { return std::abs(z[0]) < 1e-7; };
    draw.parameter = [](const Vector&, double lambda) { return lambda; };
  } else {
    draw.z_start = scalar(side * uniform(random, 0.8, 0.95));
    draw.lambda_start = curve(draw.z_start[0]);
    if (kind == bent)
      draw.on_curve = [=](const Vector& z, double lambda) {
        return std::abs(curve(z[0]) - lambda) < 1e-7;
      };
    else if (std::abs(eta) > taken_for_perfect)
      draw.on_curve = [=](const Vector& z, double) { return z[0] * side > 0; };
    else
      draw.blurs = [](double) { return true; };
  }
  const double fold = std::cbrt(eta / 2);
  if (eta == 0)
    draw.answers.push_back({AnswerKind::branch_point, l0, scalar(0)});
  else
    draw.gap = std::abs(fold) / draw.size;
  if (kind == detached)
    draw.answers.push_back({AnswerKind::fold, l0 + 3 * fold * fold, scalar(fold)});
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
