// Zeros of the switching functions on one step.
#include <algorithm>
#include <cmath>

#include "continuation/kinks/kink.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/branch_point.hpp"
#include "continuation/locating/zeros.hpp"
#include "continuation/points/chebyshev.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// One switching function on one step, positive on the side of the step's piece.
struct SwitchOnStep {
  const Walker& walker;
  const CurvePoint& from;
  double h = 0;
  Index j = 0;
  double side = 1;
  double noise = 0;  ///< values below this are rounding of the corrected points

  std::optional<double> value(double ds) const {
    CurvePoint& point = walker.memory->trial;
    return find_point_at(walker, from, ds, point) ? value(point) : std::nullopt;
  }
  std::optional<double> value(const CurvePoint& p) const {
    Vector& g = walker.memory->g;
    if (!walker.problem.switches(p.x, p.lambda, g)) return std::nullopt;
    return side * g[j];
  }
};

double rate_at(const SwitchOnStep& f, const CurvePoint& p) {
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!f.walker.problem.switch_gradients(p.x, p.lambda, dg_dx, dg_dlambda)) return not_a_number;
  const double along = metric_product(f.walker.weights, p.tangent, f.from.tangent);
  // Step lengths are measured along from.tangent: rates by the arc are smaller by this.
  return f.side * switch_rate(dg_dx, dg_dlambda, f.j, p.tangent) / along;
}

/// What was found of one switching function.
struct Crossing {
  bool clear = true;                 ///< false: could not be told
  bool touches = false;              ///< touches zero before it crosses, or without
  std::optional<Located> located{};  ///< its first crossing
};

/// A crossing at which the piece's own extended Jacobian loses rank (its branch point lies on the
/// surface): no point can be corrected there, so the place is taken from the points around it and
/// refined by the augmented system of the branch point.
/// @pre f has opposite signs at a and b
Crossing crossing_at_branch_point(const SwitchOnStep& f, double a, double b) {
  const double reach = told_apart * (b - a);
  double place = 0.5 * (a + b);
  while (b - a > reach) {
    place = 0.5 * (a + b);
    const auto value = f.value(place);
    if (!value || *value == 0) break;
    (*value > 0 ? a : b) = place;
  }
  const auto before = point_at(f.walker, f.from, place - reach);
  const auto after = point_at(f.walker, f.from, place + reach);
  if (!before || !after || !f.walker.problem.symmetric()) return {.clear = false};
  CurvePoint near = *before;
  near.x = 0.5 * (before->x + after->x);
  near.lambda = 0.5 * (before->lambda + after->lambda);
  near.tangent =
      unit_direction(f.walker, Direction{before->tangent.dx + after->tangent.dx,
                                         before->tangent.dlambda + after->tangent.dlambda});
  auto point = refine_branch_point(f.walker, near);
  const auto value = point ? f.value(*point) : std::nullopt;
  if (!value || std::abs(*value) > f.walker.options.simultaneous) return {.clear = false};
  const double at = way_to(f.walker.weights, f.from, *point);
  if (!(std::abs(at - place) <= 2 * reach)) return {.clear = false};
  point->tangent = near.tangent;
  point->piece = f.from.piece;
  point->s = f.from.s + at;
  point->negative.reset();
  return {.located = Located{std::move(*point), place - reach, place + reach}};
}

Crossing crossing_in(const SwitchOnStep& f, double a, double b) {
  const auto value = [&f](const CurvePoint& p) { return f.value(p).value_or(not_a_number); };
  Crossing result{.located = locate(f.walker, f.from, a, b, value)};
  return result.located ? result : crossing_at_branch_point(f, a, b);
}

/// All zeros between step lengths a and b are looked for; the first crossing counts.
Crossing first_of_all(const SwitchOnStep& f, double a, double b) {
  const auto value = [&f](double ds) { return f.value(ds); };
  const ZeroSearch search = find_zeros(value, a, b, f.noise, one_place * f.h);
  Crossing result{.clear = search.resolved};
  double start = a;
  for (const ZeroOf& zero : search.zeros) {
    if (zero.touches) {
      result.touches = true;
      continue;
    }
    // Bracket it by values beyond rounding; it can lie very near to the next one.
    for (const double share : decades<-6, -1>()) {
      const double reach = share * f.h;
      const double low = std::max(start, zero.at - reach), high = std::min(b, zero.at + reach);
      const auto f0 = f.value(low), f1 = f.value(high);
      if (f0 && f1 && *f0 > 0 && *f1 < 0) {
        Crossing crossing = crossing_in(f, low, high);
        crossing.touches = result.touches;
        return crossing;
      }
    }
    result.located = {{}, zero.before, zero.after};
    auto point = point_at(f.walker, f.from, zero.at);
    if (!point || !(zero.at > 0)) return {.clear = false};
    result.located->point = std::move(*point);
    return result;
  }
  return result;
}

/// Cubic by values and slopes at both ends of an interval.
struct Cubic {
  double f0 = 0, d0 = 0, f1 = 0, d1 = 0, h = 1;

  double quadratic() const { return (3 * (f1 - f0) / h - 2 * d0 - d1) / h; }
  double cubic() const { return (d0 + d1 - 2 * (f1 - f0) / h) / (h * h); }
  double operator()(double t) const { return f0 + t * (d0 + t * (quadratic() + t * cubic())); }
  /// The ends and, in order between them, where the slope d0 + 2 a t + 3 b t^2 is zero.
  std::vector<double> turns() const {
    const double a = quadratic(), b = cubic(), discriminant = a * a - 3 * b * d0;
    std::vector<double> at{0, h};
    if (discriminant >= 0) {
      const double q = -(a + std::copysign(std::sqrt(discriminant), a));
      for (const double t : {b != 0 ? q / (3 * b) : -1.0, q != 0 ? d0 / q : -1.0})
        if (t > 0 && t < h) at.push_back(t);
    }
    std::sort(at.begin(), at.end());
    return at;
  }
  double least() const {
    double low = f0;
    for (const double t : turns()) low = std::min(low, t == h ? f1 : (*this)(t));
    return low;
  }
  int zeros() const {
    int count = 0;
    bool positive = f0 >= 0;
    for (const double t : turns()) {
      const bool next = (t == 0 ? f0 : t == h ? f1 : (*this)(t)) >= 0;
      count += next != positive;
      positive = next;
    }
    return count;
  }
};

/// Judges by ends and middle; looks closer only where that leaves a doubt.
Crossing judge(const SwitchOnStep& f, double a, const Cubic& cubic) {
  const double change = std::max(
      {std::abs(cubic.f1 - cubic.f0), cubic.h * std::abs(cubic.d0), cubic.h * std::abs(cubic.d1)});
  if (cubic.f1 >= 0 && std::min(cubic.f0, cubic.f1) > 2 * change) return {};  // out of reach
  const auto middle = f.value(a + 0.5 * cubic.h);
  if (!middle) return {.clear = false};
  const double share = 2 * negligible_share * change;
  const bool fits = std::abs(*middle - cubic(0.5 * cubic.h)) <= share + f.noise;
  const double least = cubic.least();
  if (fits && cubic.f1 >= 0 && (least > share || least >= std::min(cubic.f0, cubic.f1))) return {};
  if (fits && cubic.f1 < 0 && cubic.d0 <= 0 && cubic.d1 <= 0 && cubic.zeros() == 1) {
    // Crossed steeply it is the only zero; nearly flat there may be two more beside it.
    Crossing only = crossing_in(f, a, a + cubic.h);
    if (only.clear && rate_at(f, only.located->point) < -share / cubic.h) return only;
  }
  return first_of_all(f, a, a + cubic.h);
}

/// A switch that is being left starts at zero, or within `slack` if it only acted together with
/// others there: the step length at which it is clearly positive.
std::optional<double> departure(const SwitchOnStep& f, double slack) {
  for (const double share : decades<-6, 0>()) {
    const auto value = f.value(share * f.h);
    if (!value || *value < -slack) return std::nullopt;
    if (*value > f.noise) return share * f.h;
  }
  return std::nullopt;
}

constexpr double steep = told_apart;

/// The curve ends its step on a surface, to rounding on either side, or just before: take the surface into this step,
/// or, where it is nearly tangential, let the step end elsewhere.
Crossing at_the_end(const SwitchOnStep& f, double f1, double d1) {
  if (!(d1 < -steep)) return {.clear = false};
  return crossing_in(f, 0.5 * f.h, f.h + 4 * std::abs(f1) / -d1 + residual_level * f.h);
}

/// @param cubic  values and rates at the ends of the step
Crossing crossing_of(const SwitchOnStep& f, Cubic cubic, bool leaves) {
  double a = 0;
  if (!std::isfinite(cubic.d0) || !std::isfinite(cubic.d1)) return {.clear = false};
  const double within = cubic.d1 < -steep ? f.walker.options.simultaneous : f.noise;
  const bool near_end = cubic.f1 >= -f.noise && cubic.f1 <= within;
  if (leaves || cubic.f0 <= f.noise) {
    const auto start = departure(f, leaves ? f.walker.options.simultaneous : f.noise);
    if (!start) return {.clear = false};
    if (*start < f.h) {
      const auto point = point_at(f.walker, f.from, *start);
      if (!point) return {.clear = false};
      a = *start;
      cubic = {*f.value(*point), rate_at(f, *point), cubic.f1, cubic.d1, f.h - a};
    } else if (!near_end) {
      return {};
    }
  }
  if (near_end) return at_the_end(f, cubic.f1, cubic.d1);
  return judge(f, a, cubic);
}

/// A surface that the curve surely meets, nearer ahead than values on the step tell: its own equations have the place.
Crossing crossing_right_ahead(const SwitchOnStep& f, const Workspace::Switches& first) {
  const double rate = f.side * sure_rate(f.walker, first, f.j, f.from),
               value = f.side * first.g[f.j];
  const bool is_ahead = rate < 0 && value > 0 && value <= f.noise && value < -rate * f.h;
  if (!is_ahead || f.walker.problem.structured()) return {.clear = false};
  const auto near = point_at(f.walker, f.from, -value / rate);
  auto place = near ? place_on_surface(f.walker, f.from, *near, f.j) : std::nullopt;
  const double length = place ? place->s - f.from.s : 0;
  if (!(length > 0 && length < f.h)) return {.clear = false};
  return {.located = Located{std::move(*place), 0, length}};
}

/// A surface that the curve leaves where the step begins, and to which its rates surely bring it back before any value
/// is more than rounding: rates change evenly so near. They have the place, and the surface's own equations tell it.
Crossing crossing_on_return(
    const SwitchOnStep& f, double value, const CurvePoint& to,
    const std::pair<const Workspace::Switches&, const Workspace::Switches&>& at) {
  constexpr int rounds = 4;       // each takes the rates of nearer points
  constexpr double alike = 0.25;  // what a cubic term may make of them
  if (f.walker.problem.structured()) return {.clear = false};
  const double rate = f.side * sure_rate(f.walker, at.first, f.j, f.from);
  double length = f.h, back = f.side * sure_rate(f.walker, at.second, f.j, to);
  for (int k = 0; k < rounds && rate > 0 && back < 0; ++k) {
    length *= 2 * rate / (rate - back);
    const double height = rate * length / 4;
    if (!(length < f.h && height <= f.noise && std::abs(value) <= small_share * height)) break;
    const auto near = point_at(f.walker, f.from, length);
    Workspace::Switches there;
    if (!near || !read_switches(f.walker, *near, there)) break;
    back = f.side * sure_rate(f.walker, there, f.j, *near);
    if (!(back < 0) || std::abs(back + rate) > alike * rate) continue;
    auto place = place_on_surface(f.walker, f.from, *near, f.j);
    if (!place || std::abs(place->s - f.from.s - length) > alike * length) break;
    const double after = std::min((1 + alike) * length, f.h);
    return {.located = Located{std::move(*place), (1 - alike) * length, after}};
  }
  return {.clear = false};
}

/// The tangent with which a curve arrives at step length `ds`, from its points before: at a branch point the equations
/// have two directions and do not say which is that of this curve.
std::optional<Direction> arriving_tangent(const Walker& walker, const CurvePoint& from, double ds) {
  constexpr double nearest =
      1 - small_share;  // of the way: nearer points may belong to the other branch
  if (!(ds > 0)) return std::nullopt;
  const auto curve =
      interpolated_curve([&](double t) { return point_at(walker, from, t); }, 0, nearest * ds);
  return curve ? std::optional<Direction>(unit_direction(walker, curve->slope(ds))) : std::nullopt;
}

/// Where a branch point of the piece lies on the surface, corrected points beside it are uncertain, and so is the
/// kink: it is the branch point itself, if that is on the surface too.
void settle_on_branch_point(const Walker& walker, const CurvePoint& from, KinkSearch& kink) {
  CurvePoint& point = kink.point;
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return;
  if (!is_singular(extended_matrix(at, walker.weights, point.tangent), told_apart)) return;
  const auto place = refine_branch_point(walker, point);
  if (!place) return;
  Vector g;
  if (!walker.problem.switches(place->x, place->lambda, g)) return;
  for (const Index j : active_or_met(walker, kink))
    if (std::abs(g[j]) > walker.options.simultaneous) return;
  if (!(length_of(walker, difference(*place, point)) <= told_apart)) return;
  point.x = place->x;
  point.lambda = place->lambda;
  point.s = from.s + std::max(0.0, way_to(walker.weights, from, point));
  point.negative.reset();
  if (auto tangent = arriving_tangent(walker, from, point.s - from.s))
    point.tangent = std::move(*tangent);
  kink.singular = true;
  kink.before = std::min(kink.before, point.s - from.s);
  kink.after = std::max(kink.after, point.s - from.s);
}

/// Size of what a switching function is made of: multipliers beside it do not count.
double size_of(const Workspace::Switches& at, Index j, const CurvePoint& p) {
  return at.dg_dx.row(j).cwiseAbs().dot(p.x.cwiseAbs()) + std::abs(at.dg_dlambda[j] * p.lambda);
}

/// A switch that is zero where the step begins, and that no value on the step tells from zero, leaves its surface where
/// its rates are sure to: across a stiff member, or at high order, values are rounding for long, and rates are not.
bool moves_away(const SwitchOnStep& f, const CurvePoint& to, const Cubic& ends,
                const std::pair<const Workspace::Switches&, const Workspace::Switches&>& at) {
  const double most = std::max(std::abs(ends.f0), std::abs(ends.f1));
  if (!(most <= f.noise)) return false;
  const auto middle = point_at(f.walker, f.from, uneven_share(0) * f.h);
  Workspace::Switches between;
  const auto rate = [&](const Workspace::Switches& there, const CurvePoint& p) {
    return f.side * sure_rate(f.walker, there, f.j, p);
  };
  return middle && read_switches(f.walker, *middle, between) && rate(at.second, to) > 0 &&
         rate(between, *middle) >= 0 && rate(at.first, f.from) >= 0;
}

}  // namespace

KinkSearch first_kink(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                      const std::vector<Index>& left) {
  KinkSearch result;
  const Index m = walker.problem.switch_count();
  if (m == 0) return result;
  const std::vector<Index> resting = resting_switches(walker, from, to);
  Workspace::Switches &first = walker.memory->at_from, &last = walker.memory->at_to;
  if (!read_switches(walker, from, first) || !read_switches(walker, to, last))
    return {.status = KinkSearch::Status::suspicious};
  // Step lengths are measured along from.tangent: rates by the arc at `to` are smaller by this.
  const double along = metric_product(walker.weights, to.tangent, from.tangent);
  const double h = to.s - from.s;
  for (Index j = 0; j < m; ++j) {
    if (contains(resting, j)) continue;
    const double side = from.piece[static_cast<std::size_t>(j)];
    const double noise =
        residual_level * std::max({1.0, size_of(first, j, from), size_of(last, j, to)});
    SwitchOnStep on_step{walker, from, h, j, side, noise};
    const Cubic ends{side * first.g[j], side * rate_along(first, j, from), side * last.g[j],
                     side * rate_along(last, j, to) / along, h};
    Crossing crossing = crossing_of(on_step, ends, contains(left, j));
    if (!crossing.clear) {
      // Across a stiff member values are known better than residuals are at their tolerance.
      on_step.noise = std::max(error_of_value(walker, from, first.dg_dx, first.dg_dlambda, j),
                               error_of_value(walker, to, last.dg_dx, last.dg_dlambda, j));
      if (on_step.noise < noise) crossing = crossing_of(on_step, ends, contains(left, j));
    }
    if (!crossing.clear && moves_away(on_step, to, ends, {first, last})) continue;
    if (!crossing.clear) crossing = crossing_on_return(on_step, ends.f0, to, {first, last});
    if (!crossing.clear && !contains(left, j)) crossing = crossing_right_ahead(on_step, first);
    if (!crossing.clear) return {.status = KinkSearch::Status::suspicious, .suspect = j};
    if (crossing.touches) result.touched.push_back(j);
    if (!crossing.located ||
        (result.status == KinkSearch::Status::found && crossing.located->point.s >= result.point.s))
      continue;
    result.status = KinkSearch::Status::found;
    result.met = j;
    result.point = std::move(crossing.located->point);
    result.before = crossing.located->before;
    result.after = crossing.located->after;
  }
  if (result.status != KinkSearch::Status::found) return result;
  settle_on_branch_point(walker, from, result);
  result.active = acting_at(walker, from, result, left);
  part_surfaces(walker, from, left, result);
  settle_on_surface(walker, from, result);
  return result;
}

}  // namespace springfold::continuation
