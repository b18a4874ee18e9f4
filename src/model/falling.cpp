#include "falling.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace springfold::model {
namespace {

using Coefficients = std::vector<double>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Coefficients derivative_of(const Coefficients& a) {
  Coefficients d;
  for (std::size_t i = 1; i < a.size(); ++i) d.push_back(static_cast<double>(i) * a[i]);
  while (!d.empty() && d.back() == 0) d.pop_back();
  return d;
}

double value_of(const Coefficients& a, double u) {
  double value = 0;
  for (std::size_t i = a.size(); i-- > 0;) value = value * u + a[i];
  return value;
}

/// How far rounding may put value_of off.
double rounding_of(const Coefficients& a, double u) {
  double size = 0;
  for (std::size_t i = a.size(); i-- > 0;) size = size * std::abs(u) + std::abs(a[i]);
  return 4 * epsilon * static_cast<double>(a.size()) * size;
}

/// No zero of the polynomial is further from 0 (Cauchy).
double bound_of(const Coefficients& a) {
  double largest = 0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] / a.back()));
  return 1 + largest;
}

/// Where g changes its sign between low and high, by halving.
template <class G>
double sign_change(const G& g, double low, double high) {
  const bool negative = g(low) < 0;
  for (;;) {
    const double middle = low + 0.5 * (high - low);
    if (!(low < middle && middle < high)) return middle;
    ((g(middle) < 0) == negative ? low : high) = middle;
  }
}

/// Increasing places between low and high, the ends among them, between which the polynomial is
/// monotone; and its zeros.
std::vector<double> turning_places(const Coefficients& a, double low, double high) {
  if (a.size() < 2) return {low, high};
  std::vector<double> places = turning_places(derivative_of(a), low, high), zeros;
  const auto value = [&a](double u) { return value_of(a, u); };
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    if ((value(places[i]) < 0) != (value(places[i + 1]) < 0))
      zeros.push_back(sign_change(value, places[i], places[i + 1]));
  places.insert(places.end(), zeros.begin(), zeros.end());
  std::sort(places.begin(), places.end());
  return places;
}

/// Places at which a formula is asked: even ones, or in an endless range even ones for every power of two.
std::vector<double> sample_places(const DeformationRange& range) {
  std::vector<double> places;
  if (std::isfinite(range.low) && std::isfinite(range.high)) {
    constexpr int count = 1024;
    for (int i = 0; i <= count; ++i)
      places.push_back(range.low + (range.high - range.low) * i / count);
    return places;
  }
  const double start = std::isfinite(range.low)    ? range.low
                       : std::isfinite(range.high) ? range.high
                                                   : 0;
  constexpr int octaves = 30, parts = 32;
  for (int octave = -octaves; octave < octaves; ++octave)
    for (int part = 0; part < parts; ++part) {
      const double away = std::ldexp(1 + part / double{parts}, octave);
      for (const double at : {start - away, start + away})
        if (at > range.low && at < range.high) places.push_back(at);
    }
  places.push_back(start);
  std::sort(places.begin(), places.end());
  return places;
}

/// From `inside`, where the slope is negative, over the places on one side to where it no longer is;
/// `end` where it stays so.
/// Between neighbouring places the slope changes its sign at most once.
template <class Slope, class Places>
double end_of_fall(const Slope& slope, double inside, const Places& places, double end) {
  for (const double place : places) {
    const double there = slope(place);
    if (!std::isfinite(there)) return inside;
    if (there >= 0) {
      const double zero = sign_change(slope, std::min(place, inside), std::max(place, inside));
      return std::abs(zero) <= epsilon * std::abs(inside) ? 0 : zero;
    }
    inside = place;
  }
  return end;
}

/// The stretch around `inside` on which the slope is negative.
template <class Slope>
DeformationRange stretch_around(const Slope& slope, double inside,
                                const std::vector<double>& places, const DeformationRange& range) {
  const auto here = std::lower_bound(places.begin(), places.end(), inside);
  const auto above = std::upper_bound(places.begin(), places.end(), inside);
  return {end_of_fall(slope, inside, std::vector(std::make_reverse_iterator(here), places.rend()),
                      range.low),
          end_of_fall(slope, inside, std::vector(above, places.end()), range.high)};
}

}  // namespace

std::optional<DeformationRange> falling_stretch(const PolynomialSpring& law) {
  const Coefficients slope = derivative_of(law.coefficients), bend = derivative_of(slope);
  if (slope.empty()) return std::nullopt;
  const double far = 2 * bound_of(slope);
  const double low = std::isfinite(law.range.low) ? law.range.low : std::min(-far, law.range.high);
  const double high = std::isfinite(law.range.high) ? law.range.high : std::max(far, low);
  const std::vector<double> places = turning_places(bend, low, high);
  const auto value = [&slope](double u) { return value_of(slope, u); };
  for (const double u : places)
    if (value(u) < -rounding_of(slope, u)) return stretch_around(value, u, places, law.range);
  return std::nullopt;
}

std::optional<DeformationRange> falling_stretch(const FormulaSpring& law) {
  const auto jet = [&law](double u) { return evaluate(law.formula, u); };
  const auto slope = [&jet](double u) { return jet(u).slope; };
  // A stiffness this small against its neighbours is one of rounding.
  constexpr double rounding = 1e-12;
  const auto falls = [&](double u, double near) { return slope(u) < -rounding * near; };
  const std::vector<double> places = sample_places(law.range);
  const auto around = [&](double u) { return stretch_around(slope, u, places, law.range); };
  std::optional<double> nearest;  // to 0, where people look first
  const auto note = [&nearest](double u) {
    if (!nearest || std::abs(u) < std::abs(*nearest)) nearest = u;
  };
  Jet<double> last{};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Jet<double> here = jet(places[i]);
    const double near = i > 0 && std::isfinite(last.slope) ? std::abs(last.slope) : 0;
    if (std::isfinite(here.slope) && falls(places[i], near))
      note(places[i]);
    else if (i > 0 && last.bend < 0 && here.bend > 0) {
      const double least =
          sign_change([&](double u) { return jet(u).bend; }, places[i - 1], places[i]);
      if (falls(least, std::max(near, std::abs(here.slope)))) note(least);
    }
    last = here;
  }
  return nearest ? std::optional(around(*nearest)) : std::nullopt;
}

}  // namespace springfold::model
