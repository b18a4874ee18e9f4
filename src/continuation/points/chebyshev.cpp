#include "continuation/points/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "continuation/numerics/numerics.hpp"

namespace springfold::continuation {

Vector Interpolant::operator()(double t) const {
  Vector numerator = Vector::Zero(values.rows());
  double denominator = 0;
  for (int i = 0; i < samples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (t == at[k]) return values.col(i);
    const double weight = barycentric[k] / (t - at[k]);
    numerator += weight * values.col(i);
    denominator += weight;
  }
  return numerator / denominator;
}

Vector Interpolant::slope(double t) const {
  // At a sample: a neighbour in the last digits is as good.
  if (std::find(at.begin(), at.end(), t) != at.end())
    t += one_place * (t > 0.5 * (a + b) ? a - b : b - a);
  const Vector here = (*this)(t);
  Vector numerator = Vector::Zero(values.rows());
  double denominator = 0;
  for (int i = 0; i < samples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double weight = barycentric[k] / (t - at[k]);
    numerator += weight / (t - at[k]) * (here - values.col(i));
    denominator += weight;
  }
  return numerator / denominator;
}

std::optional<Interpolant> interpolate(const std::function<std::optional<Vector>(double)>& f,
                                       double a, double b) {
  constexpr int last = Interpolant::samples - 1;
  Interpolant p{.a = a, .b = b};
  for (int i = 0; i <= last; ++i) {
    const double c = std::cos(std::numbers::pi * i / last);
    const double t = i == 0 ? b : i == last ? a : 0.5 * (a + b) + 0.5 * (b - a) * c;
    const auto value = f(t);
    if (!value || !value->allFinite()) return std::nullopt;
    if (i == 0) p.values.resize(value->size(), last + 1);
    p.values.col(i) = *value;
    p.at.push_back(t);
    p.barycentric.push_back((i % 2 ? -1.0 : 1.0) * (i == 0 || i == last ? 0.5 : 1.0));
  }
  return p;
}

std::optional<Interpolant> interpolate_value(const std::function<std::optional<double>(double)>& f,
                                             double a, double b) {
  const auto one = [&](double t) -> std::optional<Vector> {
    const auto value = f(t);
    return value ? std::optional<Vector>(Vector::Constant(1, *value)) : std::nullopt;
  };
  return interpolate(one, a, b);
}

std::array<double, 2> Interpolant::checks() const {
  const auto between = [&](int k) {  // the k-th sample and the next one
    return 0.5 * (a + b) + 0.5 * (b - a) * std::cos(std::numbers::pi * (k + 0.5) / (samples - 1));
  };
  return {between(2), between(5)};
}

std::pair<double, double> window_around(double t, double length, double a, double b) {
  length = std::min(length, b - a);
  const double from = std::clamp(t - 0.5 * length, a, std::max(a, b - length));
  return {from, from + length};
}

}  // namespace springfold::continuation
