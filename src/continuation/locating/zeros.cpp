#include "continuation/locating/zeros.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "continuation/locating/features.hpp"
#include "continuation/points/chebyshev.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

class ZeroFinder {
 public:
  ZeroFinder(const SampledFunction& f, double a, double b, double noise, double apart,
             NoiseIs noise_is, double smooth_error)
      : f_{f},
        low_{a},
        high_{b},
        noise_{std::max(noise, sure * smooth_error)},
        resolution_{apart},
        noise_is_{noise_is},
        smooth_error_{sure * smooth_error} {}

  ZeroSearch result{};

  void examine(double a, double b, int depth) { examine(fit_on(a, b), a, b, depth); }

 private:
  /// Zeros are located to this arc length where the function is smooth enough.
  static constexpr double location = small_share * promised_place;
  /// A parabola that touches zero between two points of the grid is less than this off at them.
  static constexpr double touching = told_apart;
  /// Shares of an interval: features that lie closer are one, so much around them is examined, and more is no smaller
  /// interval.
  static constexpr double crowded = 0.15, margin = 0.07, most_of_it = 0.6;
  /// Values this many times the noise that was seen are hardly noise; so many times, they have a sign beyond doubt.
  static constexpr double sure = 4, clear = 10;
  /// A function that needs more is noise.
  static constexpr int most_intervals = 200;

  struct Fit {
    std::optional<Interpolant> polynomial{};
    double error = 0;              ///< largest one at two points between the samples
    mutable double measured = -1;  ///< noise from more of them; negative: not yet known
  };

  void examine(const Fit& fit, double a, double b, int depth) {
    if (!result.resolved) return;  // nothing that follows would be believed
    if (!fit.polynomial || ++examined_ > most_intervals) return give_up();
    const Interpolant& p = *fit.polynomial;
    if (!p.values.allFinite() || !std::isfinite(fit.error)) return give_up();
    const double scale = p.values.cwiseAbs().maxCoeff(), least = p.values.cwiseAbs().minCoeff();
    // Zero all along: a family, not a point; or a point too flat to be resolved.
    if (scale <= noise_) return depth > 0 ? give_up() : void();
    const bool last = b - a < resolution_ || depth > 24;
    const bool crosses = p.values.minCoeff() < 0 && p.values.maxCoeff() > 0;
    if (!last && fit.error > std::max(touching * scale, noise_)) {
      if (crosses || least < 0.5 * scale) split(a, b, depth);
      return;
    }
    const std::vector<double> places = features_of(p, level_of(fit.error, scale));
    const bool accurate = fit.error * (b - a) <= location * scale || fit.error <= noise_;
    const auto one_feature = [&](double left, double right) {
      return accurate ? lost_between(fit, left, right) : right - left < crowded * (b - a);
    };
    for (std::size_t i = 0; i < places.size();) {
      std::size_t end = i;
      while (end + 1 < places.size() && one_feature(places[end], places[end + 1])) ++end;
      if (!look(fit, places[i], places[end], last, depth)) return split(a, b, depth);
      i = end + 1;
    }
  }

  /// Features between two places: located on the polynomial, or examined on a smaller interval.
  /// @returns false when they fill the interval
  bool look(const Fit& fit, double first, double end, bool last, int depth) {
    const Interpolant& p = *fit.polynomial;
    const double length = p.b - p.a, scale = p.values.cwiseAbs().maxCoeff();
    const bool accurate = fit.error * length <= location * scale || fit.error <= noise_;
    if (accurate && locate(fit, first, end, false)) return true;
    const double from = std::max(p.a, first - margin * length),
                 to = std::min(p.b, end + margin * length);
    if (last) {
      if (comes_from_zero(p) || bracketed(p)) return true;
      if (first != end || fit.error > together * scale || !locate(fit, first, end, true)) give_up();
      return true;
    }
    if (to - from > most_of_it * length) return false;
    const Fit closer = fit_on(from, to);
    const bool better = closer.polynomial && closer.error < near_share * fit.error;
    if (!better && first == end && fit.error * length <= poor * scale)
      locate(fit, first, end, true);
    else
      examine(closer, from, to, depth + 1);
    return true;
  }

  /// At an end that is zero itself the function may rise like any power, also one that no polynomial follows: a power
  /// law at the surface where it begins to act. Without a change of sign beside it nothing lies there but that end.
  bool comes_from_zero(const Interpolant& p) const {
    const auto is_zero = [&](double t) {
      const auto value = f_(t);
      return value && *value == 0;
    };
    const bool at_end = (p.a == low_ && is_zero(low_)) || (p.b == high_ && is_zero(high_));
    return at_end && (p.values.minCoeff() >= 0 || p.values.maxCoeff() <= 0);
  }

  /// Are signs beyond doubt at both places, and is a change between them a zero where no polynomial is accurate?
  /// Functions of the caller may be steeper than anything that is resolved, or jump; lambda's rate has a corner at its
  /// zero where a spring law with a kink in its slope has its extremum just there. A determinant beside its zero is
  /// noise.
  bool may_bracket(double at_left, double at_right) const {
    if (noise_is_ == NoiseIs::doubt) return false;
    return noise_is_ == NoiseIs::threshold ||
           std::min(std::abs(at_left), std::abs(at_right)) > clear * noise_;
  }

  bool bracketed(const Interpolant& p) {
    if (!may_bracket(p.first(p.a), p.first(p.b))) return false;
    const auto signs = (p.values.row(0).array() < 0).eval();
    if ((signs.head(signs.size() - 1) != signs.tail(signs.size() - 1)).count() != 1) return false;
    const auto zero = bracket(p.a, p.b);
    if (zero) add(*zero);
    return zero.has_value();
  }

  /// By the function's own values, to rounding; nothing at a pole, beside which they grow.
  /// @pre its signs at both places differ
  std::optional<ZeroOf> bracket(double left, double right) const {
    constexpr double grows = 2;
    auto at_left = f_(left), at_right = f_(right);
    if (!at_left || !at_right) return std::nullopt;
    const double most = grows * std::max(std::abs(*at_left), std::abs(*at_right));
    while (right - left > few_roundings * (high_ - low_)) {
      const double middle = 0.5 * (left + right);
      if (!(left < middle && middle < right)) break;
      const auto value = f_(middle);
      if (!value || std::isnan(*value)) break;  // as near as points can be had
      const bool is_left = (*value < 0) == (*at_left < 0);
      (is_left ? left : right) = middle;
      (is_left ? at_left : at_right) = value;
    }
    if (std::max(std::abs(*at_left), std::abs(*at_right)) > most) return std::nullopt;
    return ZeroOf{.at = right, .before = left, .after = right, .off = right - left};
  }

  /// A zero at which the function is not smooth enough for a polynomial.
  std::optional<ZeroOf> placed(const ZeroOf& zero) const {
    if (zero.touches || zero.several || zero.off <= promised_place) return zero;
    const auto before = f_(zero.before), after = f_(zero.after);
    if (!before || !after || !(*before * *after < 0) || !may_bracket(*before, *after)) return zero;
    const auto narrow = bracket(zero.before, zero.after);
    if (noise_is_ == NoiseIs::threshold) return narrow;
    // Beside a branch point the noise is more than its bound, and a change of sign may be one of noise.
    const bool agrees = narrow && std::abs(narrow->at - zero.at) <= sure * zero.off;
    return agrees ? ZeroOf{narrow->at, zero.before, zero.after, zero.off} : zero;
  }

  void give_up() { result.resolved = false; }

  Fit fit_on(double a, double b) const {
    // A sample that falls on a singular point cannot be computed; beside it, it can.
    for (int nudge = 0; nudge < 3; ++nudge) {
      const double shift = 2 * negligible_share * nudge * (b - a);
      Fit fit{interpolate_value(f_, std::max(low_, a - shift), std::min(high_, b + shift))};
      if (!fit.polynomial) continue;
      bool complete = true;
      for (const double t : fit.polynomial->checks()) {
        const auto value = f_(t);
        complete = complete && value;
        if (value) fit.error = std::max(fit.error, std::abs(*value - fit.polynomial->first(t)));
      }
      if (complete) return fit;
    }
    return {};
  }

  void split(double a, double b, int depth) {
    // Uneven, so that a feature in the middle does not fall on the seam, and where the function is not lost in
    // its noise.
    double middle = 0.5 * (a + b), largest = 0;
    for (const double share : uneven_shares<5>()) {
      const double place = a + (1 + share) / 3 * (b - a);
      const auto value = f_(place);
      if (!value || std::abs(*value) <= largest) continue;
      largest = std::abs(*value);
      middle = place;
      if (largest > clear * noise_) break;
    }
    examine(a, middle, depth + 1);
    examine(middle, b, depth + 1);
  }

  double level_of(double error, double scale) const {
    return std::max({4 * error, touching * scale, 2 * noise_});
  }

  /// Is this value of the polynomial, at this place, lost in noise?
  bool is_lost(const Fit& fit, double t, double value) const {
    return std::abs(value) <= std::max(noise_, 30 * fit.error) &&
           std::abs(value) <= measured_noise(fit, t);
  }

  /// The noise that was given is a bound. Where the polynomial is as good as that, more samples between its own, some
  /// of them beside the place in question, show what noise there is.
  double measured_noise(const Fit& fit, double t) const {
    if (fit.measured >= 0) return fit.measured;
    const Interpolant& p = *fit.polynomial;
    double worst = fit.error;
    const auto look_at = [&](double place) {
      const auto value = place > p.a && place < p.b ? f_(place) : p.first(place);
      worst = value ? std::max(worst, std::abs(*value - p.first(place))) : noise_;
    };
    const bool as_good = fit.error <= noise_ && noise_is_ != NoiseIs::threshold;
    if (as_good) {
      for (const double share : uneven_shares<8>()) look_at(p.a + share * (p.b - p.a));
      for (const int cells : {-2, -1, 1, 2}) look_at(t + cells * (p.b - p.a) / feature_cells);
    }
    const double bound = std::max(noise_, 30 * fit.error);
    fit.measured =
        as_good
            ? std::clamp(sure * worst,
                         std::min(bound, std::max(smooth_error_,
                                                  few_roundings * p.values.cwiseAbs().maxCoeff())),
                         bound)
            : bound;
    return fit.measured;
  }

  /// Does an extremum reach zero? Rounding that is the same at neighbouring places is not seen as noise: one that stays
  /// on its side of zero misses it only where its sign is beyond doubt.
  bool may_touch(const Fit& fit, double t, double value, double before) const {
    const bool within_bound = std::abs(value) <= std::max(noise_, 30 * fit.error);
    if (noise_is_ == NoiseIs::doubt || !within_bound) return within_bound;
    const bool stays = (value < 0) == (before < 0);
    return std::abs(value) <= (stays ? clear / sure : 1) * measured_noise(fit, t);
  }

  /// Between two zeros a function turns, whatever it is: where it is farthest from zero it has no zeros besides those
  /// to which it falls on both sides. It is a touch only if these are one to what noise is seen.
  bool turns_between_zeros(const Fit& fit, const std::vector<double>& knots, std::size_t i) const {
    const auto value = [&](std::size_t k) { return fit.polynomial->first(knots[k]); };
    const double v = value(i), left = value(i - 1), right = value(i + 1);
    const bool farthest = v < 0 ? v < left && v < right : v > left && v > right;
    return farthest && !is_lost(fit, knots[i], v);
  }

  /// Is the polynomial lost in its noise all the way from one place to another?
  bool lost_between(const Fit& fit, double left, double right) const {
    const double cell = (fit.polynomial->b - fit.polynomial->a) / feature_cells;
    for (double t = left + 0.5 * cell; t < right; t += 0.5 * cell)
      if (!is_lost(fit, t, fit.polynomial->first(t))) return false;
    return true;
  }

  /// Everything that the polynomial does near two places, between which it is lost in its noise: it
  /// is cut at its extrema, so that each piece crosses zero at most once; extrema that reach zero are
  /// touches, or with a change of sign around them a crossing of higher order.
  /// @param best  it will not become more accurate
  /// @returns false when the polynomial is not accurate enough to tell a touch from others
  bool locate(const Fit& fit, double first, double end, bool best) {
    const Interpolant& p = *fit.polynomial;
    const double cell = 1.001 * (p.b - p.a) / feature_cells, error = fit.error;
    const auto value = [&](double t) { return p.first(t); };
    const double scale = p.values.cwiseAbs().maxCoeff();
    const bool accurate = best || error <= std::max(noise_, one_place * scale);
    // A crossing may lie at the far end of its cell, with an extremum right behind it.
    double low = std::max(p.a, first - cell), high = std::min(p.b, end + 2 * cell);
    while (low > p.a && is_lost(fit, low, value(low))) low = std::max(p.a, low - cell);
    while (high < p.b && is_lost(fit, high, value(high))) high = std::min(p.b, high + cell);
    const std::vector<double> knots = extrema_of(p, low, high, cell / 12);
    double before = knots.front();
    bool touched = false;
    double touch = 0;
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const double here = knots[i], v = value(here);
      const bool extremum = i + 1 < knots.size();
      if (extremum && may_touch(fit, here, v, value(before)) &&
          !turns_between_zeros(fit, knots, i)) {
        if (!accurate) return false;
        if (!touched) touch = here;
        touched = true;
        continue;
      }
      if ((value(before) < 0) != (v < 0))
        add(sharpened(fit, zero_of(fit, touched ? touch : bisect(value, before, here), before, here,
                                   touched)));
      else if (touched)
        add(sharpened(fit, {.at = touch, .before = before, .after = here, .touches = true}));
      before = here;
      touched = false;
    }
    return true;
  }

  static ZeroOf zero_of(const Fit& fit, double at, double before, double after, bool several) {
    const double slope = std::abs(fit.polynomial->first_slope(at));
    const double off = slope > 0 ? fit.error / slope : fit.polynomial->b - fit.polynomial->a;
    return {.at = at, .before = before, .after = after, .off = off, .several = several};
  }

  /// A polynomial whose error is below the bound of noise may be off by more than what noise there is, and its error is
  /// not scattered: a narrower one around the zero shows whether it is. Its place is taken from the narrower one then.
  ZeroOf sharpened(const Fit& fit, const ZeroOf& zero) const {
    const double reach = margin * (fit.polynomial->b - fit.polynomial->a);
    if (noise_is_ != NoiseIs::bound || zero.several) return zero;
    if (!zero.touches && zero.off <= location) return zero;
    const double left = zero.at - std::min(reach, near_share * (zero.at - zero.before)),
                 right = zero.at + std::min(reach, near_share * (zero.after - zero.at));
    const Fit closer = fit_on(left, right);
    if (!closer.polynomial || !(closer.error < near_share * fit.error)) return zero;
    const Interpolant& p = *closer.polynomial;
    const auto crosses = [&](double t) { return zero.touches ? p.first_slope(t) : p.first(t); };
    if ((crosses(left) < 0) == (crosses(right) < 0)) return zero;
    const double at = bisect(crosses, left, right);
    if (!zero.touches) return zero_of(closer, at, zero.before, zero.after, false);
    ZeroOf touch = zero;
    touch.at = at;
    return touch;
  }

  /// Neighbouring cells may see the same zero.
  void add(const ZeroOf& found) {
    const auto zero = placed(found);
    if (!zero) return give_up();
    for (const ZeroOf& other : result.zeros)
      if (std::abs(other.at - zero->at) <= 10 * location) return;
    result.zeros.push_back(*zero);
  }

  const SampledFunction& f_;
  double low_, high_, noise_, resolution_;
  NoiseIs noise_is_;
  double smooth_error_;
  int examined_ = 0;
};

}  // namespace

bool within_reach(std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if ((*low < 0) != (*high < 0) || *low == 0 || *high == 0) return true;
  return std::min(std::abs(*low), std::abs(*high)) < *high - *low;
}

ZeroSearch find_zeros(const SampledFunction& f, double a, double b, double noise, double apart,
                      NoiseIs noise_is, double smooth_error) {
  ZeroFinder search(f, a, b, noise, apart, noise_is, smooth_error);
  search.examine(a, b, 0);
  auto& zeros = search.result.zeros;
  std::sort(zeros.begin(), zeros.end(), [](const auto& l, const auto& r) { return l.at < r.at; });
  return search.result;
}

}  // namespace springfold::continuation
