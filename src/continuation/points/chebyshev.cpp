#include "continuation/points/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

namespace {

/// @param value_of  of the sample with this number
/// @param none      zero, as many as there are values
template <class ValueOf, class Value>
Value value_at(const Interpolant& p, double t, const ValueOf& value_of, const Value& none) {
  Value numerator = none;
  double denominator = 0;
  for (int i = 0; i < Interpolant::samples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (t == p.at[k]) return value_of(i);
    const double weight = p.barycentric[k] / (t - p.at[k]);
    numerator += weight * value_of(i);
    denominator += weight;
  }
  return numerator / denominator;
}

template <class ValueOf, class Value>
Value slope_at(const Interpolant& p, double t, const ValueOf& value_of, const Value& none) {
  // At a sample: a neighbour in the last digits is as good.
  if (std::find(p.at.begin(), p.at.end(), t) != p.at.end())
    t += one_place * (t > 0.5 * (p.a + p.b) ? p.a - p.b : p.b - p.a);
  const Value here = value_at(p, t, value_of, none);
  Value numerator = none;
  double denominator = 0;
  for (int i = 0; i < Interpolant::samples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double weight = p.barycentric[k] / (t - p.at[k]);
    numerator += weight / (t - p.at[k]) * (here - value_of(i));
    denominator += weight;
  }
  return numerator / denominator;
}

}  // namespace

Vector Interpolant::operator()(double t) const {
  const auto column = [&](int i) { return values.col(i); };
  return value_at(*this, t, column, Vector(Vector::Zero(values.rows())));
}

Vector Interpolant::slope(double t) const {
  const auto column = [&](int i) { return values.col(i); };
  return slope_at(*this, t, column, Vector(Vector::Zero(values.rows())));
}

double Interpolant::first(double t) const {
  return value_at(
      *this, t, [&](int i) { return values(0, i); }, 0.0);
}

double Interpolant::first_slope(double t) const {
  return slope_at(
      *this, t, [&](int i) { return values(0, i); }, 0.0);
}

namespace {

/// Samples at the Chebyshev points, from b down to a.
/// @param put  puts the value at a place into the column with this number; false where there is none
template <class Put>
std::optional<Interpolant> sampled(double a, double b, const Put& put) {
  constexpr int last = Interpolant::samples - 1;
  std::optional<Interpolant> p(Interpolant{.a = a, .b = b});
  for (int i = 0; i <= last; ++i) {
    const double c = std::cos(std::numbers::pi * i / last);
    const double t = i == 0 ? b : i == last ? a : 0.5 * (a + b) + 0.5 * (b - a) * c;
    if (!put(t, i, p->values)) return std::nullopt;
    const auto k = static_cast<std::size_t>(i);
    p->at[k] = t;
    p->barycentric[k] = (i % 2 ? -1.0 : 1.0) * (i == 0 || i == last ? 0.5 : 1.0);
  }
  return p;
}

}  // namespace

std::optional<Interpolant> interpolate(const std::function<std::optional<Vector>(double)>& f,
                                       double a, double b) {
  return sampled(a, b, [&](double t, int i, Matrix& values) {
    const auto value = f(t);
    if (!value || !value->allFinite()) return false;
    if (i == 0) values.resize(value->size(), Interpolant::samples);
    values.col(i) = *value;
    return true;
  });
}

std::optional<Interpolant> interpolate_value(const std::function<std::optional<double>(double)>& f,
                                             double a, double b) {
  return sampled(a, b, [&](double t, int i, Matrix& values) {
    const auto value = f(t);
    if (!value || !std::isfinite(*value)) return false;
    if (i == 0) values.resize(1, Interpolant::samples);
    values(0, i) = *value;
    return true;
  });
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
