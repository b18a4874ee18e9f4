#include "zeros.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>
#include <utility>

namespace springfold::continuation {
namespace {

constexpr int samples = 9;

/// Polynomial through Chebyshev-Lobatto points of [a, b], in barycentric form.
struct Interpolant {
  double a = 0, b = 1;
  std::array<double, samples> at{}, value{};

  double operator()(double t) const {
    double numerator = 0, denominator = 0;
    for (int i = 0; i < samples; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (t == at[k]) return value[k];
      const double half = i == 0 || i == samples - 1 ? 0.5 : 1.0;
      const double weight = (i % 2 ? -half : half) / (t - at[k]);
      numerator += weight * value[k];
      denominator += weight;
    }
    return numerator / denominator;
  }
};

std::optional<Interpolant> interpolate(const SampledFunction& f, double a, double b) {
  Interpolant p{a, b, {}, {}};
  for (int i = 0; i < samples; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double c = std::cos(std::numbers::pi * i / (samples - 1));
    p.at[k] = i == 0 ? b : i == samples - 1 ? a : 0.5 * (a + b) + 0.5 * (b - a) * c;
    const auto value = f(p.at[k]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    p.value[k] = *value;
  }
  return p;
}

/// Largest error of the interpolant at two points between its samples.
std::optional<double> error_of(const Interpolant& p, const SampledFunction& f) {
  double worst = 0;
  for (const double share : {0.31, 0.78}) {
    const double t = p.a + share * (p.b - p.a);
    const auto value = f(t);
    if (!value) return std::nullopt;
    worst = std::max(worst, std::abs(*value - p(t)));
  }
  return worst;
}

/// Where the interpolant crosses zero, or has an extremum that reaches the level.
std::vector<double> features_of(const Interpolant& p, double level) {
  constexpr int grid = 400;
  std::vector<double> places;
  const auto t = [&](int i) { return p.a + (p.b - p.a) * i / grid; };
  double before = p(t(0)), here = p(t(1));
  if ((before < 0) != (here < 0)) places.push_back(t(0));
  for (int i = 1; i < grid; ++i) {
    const double next = p(t(i + 1));
    const bool crosses = (here < 0) != (next < 0);
    const bool turns = std::abs(here) <= std::abs(before) && std::abs(here) <= std::abs(next) &&
                       (before < 0) == (next < 0);
    if (crosses || (turns && std::abs(here) <= level)) places.push_back(t(i));
    before = here;
    here = next;
  }
  return places;
}

std::optional<ZeroOf> crossing(const SampledFunction& f, double a, double b) {
  bool failed = false;
  const auto g = [&](double t) {
    const auto value = f(t);
    failed = failed || !value;
    return value ? *value : 0.0;
  };
  const double fa = g(a), fb = g(b);
  if (failed) return std::nullopt;
  if (fa == 0 || fb == 0) return ZeroOf{fa == 0 ? a : b, a, b, false};
  if ((fa < 0) == (fb < 0)) return std::nullopt;
  std::uintmax_t most = 100;
  const double tolerance = 1e-14 * std::max(std::abs(a), std::abs(b));
  const auto close = [=](double l, double r) { return std::abs(r - l) <= tolerance; };
  const auto [low, high] = boost::math::tools::toms748_solve(g, a, b, fa, fb, close, most);
  // A value that could not be computed counted as zero: at a branch point the curve's own point is
  // singular to rounding, and that is the place.
  return ZeroOf{0.5 * (low + high), low, high, false};
}

/// Stationary point of f near t by the quartic through five points: error O(h^4).
double stationary(const SampledFunction& f, double t, double h) {
  std::array<double, 5> v{};
  for (int i = 0; i < 5; ++i) {
    const auto value = f(t + (i - 2) * h);
    if (!value) return t;
    v[static_cast<std::size_t>(i)] = *value;
  }
  const double d1 = (v[0] - 8 * v[1] + 8 * v[3] - v[4]) / 12;
  const double d2 = (-v[0] + 16 * v[1] - 30 * v[2] + 16 * v[3] - v[4]) / 12;
  const double d3 = (-v[0] + 2 * v[1] - 2 * v[3] + v[4]) / 2;
  const double d4 = v[0] - 4 * v[1] + 6 * v[2] - 4 * v[3] + v[4];
  double x = 0;
  for (int i = 0; i < 20; ++i)
    x -= (d1 + x * (d2 + x * (d3 / 2 + x * d4 / 6))) / (d2 + x * (d3 + x * d4 / 2));
  return std::abs(x) < 1 ? t + x * h : t;
}

class Search {
 public:
  Search(const SampledFunction& f, double noise, double resolution)
      : f_{f}, noise_{noise}, resolution_{resolution} {}

  ZeroSearch result{};
  std::vector<std::pair<double, double>> suspects{};  ///< rough there, near zero, same signs

  void examine(double a, double b, int depth) {
    const auto p = interpolate(f_, a, b);
    const auto error = p ? error_of(*p, f_) : std::nullopt;
    if (!p || !error) return give_up();
    double scale = 0, least = std::abs(p->value[0]);
    for (const double v : p->value) {
      scale = std::max(scale, std::abs(v));
      least = std::min(least, std::abs(v));
    }
    if (scale <= noise_) return;  // zero all along: a family, not a point
    const double level = std::max({4 * *error, 1e-6 * scale, 2 * noise_});
    if (*error > 1e-4 * scale && least < 0.5 * scale) return split(a, b, depth);
    const std::vector<double> places = features_of(*p, level);
    for (std::size_t i = 0; i < places.size();) {
      std::size_t last = i;
      while (last + 1 < places.size() && places[last + 1] - places[last] < 0.1 * (b - a)) ++last;
      const double reach = 0.03 * (b - a);
      const double from = std::max(a, places[i] - reach), to = std::min(b, places[last] + reach);
      if (last > i)
        (to - from < 0.7 * (b - a)) ? examine_again(from, to, depth) : split(a, b, depth);
      else
        settle(from, to);
      if (last > i && to - from >= 0.7 * (b - a)) return;
      i = last + 1;
    }
  }

 private:
  void give_up() { result.resolved = false; }

  /// An interval too small to divide: a change of sign on it is one crossing (sorted eigenvalues
  /// have kinks where several vanish together); without one, values near zero stay unexplained.
  void last_resort(double a, double b) {
    const auto fa = f_(a), fb = f_(b);
    if (!fa || !fb) return give_up();
    if ((*fa < 0) != (*fb < 0)) return add_crossing(a, b);
    suspects.emplace_back(a, b);
  }

  void examine_again(double a, double b, int depth) {
    if (b - a < resolution_ || depth > 24) return last_resort(a, b);
    examine(a, b, depth + 1);
  }

  void split(double a, double b, int depth) {
    if (b - a < resolution_ || depth > 24) return last_resort(a, b);
    // Uneven, so that a feature in the middle does not fall on the seam.
    const double middle = a + 0.4871 * (b - a);
    examine(a, middle, depth + 1);
    examine(middle, b, depth + 1);
  }

  /// One feature of the interpolant on [a, b]: a crossing, a touch, a near miss or a close pair.
  void settle(double a, double b) {
    const auto fa = f_(a), fb = f_(b);
    if (!fa || !fb) return give_up();
    if ((*fa < 0) != (*fb < 0)) return add_crossing(a, b);
    const double sign = *fa < 0 ? -1 : 1;
    const auto size = [&](double t) {
      const auto value = f_(t);
      return value ? sign * *value : 0.0;
    };
    std::uintmax_t most = 60;
    const auto [place, minimum] = boost::math::tools::brent_find_minima(size, a, b, 40, most);
    if (minimum < -noise_) {
      add_crossing(a, place);
      add_crossing(place, b);
    } else if (minimum <= noise_) {
      result.zeros.push_back({stationary(f_, place, std::min(2e-3, 0.2 * (b - a))), a, b, true});
    }
  }

  void add_crossing(double a, double b) {
    if (const auto zero = crossing(f_, a, b))
      result.zeros.push_back(*zero);
    else
      give_up();
  }

  const SampledFunction& f_;
  double noise_, resolution_;
};

}  // namespace

bool within_reach(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if ((*low < 0) != (*high < 0) || *low == 0 || *high == 0) return true;
  return std::min(std::abs(*low), std::abs(*high)) < *high - *low;
}

ZeroSearch find_zeros(const SampledFunction& f, double a, double b, double noise,
                      double resolution) {
  Search search(f, noise, resolution);
  search.examine(a, b, 0);
  auto& zeros = search.result.zeros;
  std::sort(zeros.begin(), zeros.end(), [](const auto& l, const auto& r) { return l.at < r.at; });
  // Roughness beside a crossing is that crossing's kink; elsewhere it may hide a zero.
  for (const auto& [left, right] : search.suspects) {
    const bool beside = std::any_of(zeros.begin(), zeros.end(), [&](const ZeroOf& zero) {
      return zero.at > left - 4 * resolution && zero.at < right + 4 * resolution;
    });
    search.result.resolved = search.result.resolved && beside;
  }
  return search.result;
}

}  // namespace springfold::continuation
