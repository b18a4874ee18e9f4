#include "continuation/locating/flat_turns.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/locating/evidence.hpp"
#include "continuation/locating/watched_step.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

bool is_clear(const CurvePoint& p, double level) { return std::abs(p.tangent.dlambda) > level; }

/// Regular steps along the tangent until lambda's rate is above a level.
std::optional<CurvePoint> until_clear(const Walker& walker, CurvePoint p, double step,
                                      double level) {
  constexpr double farthest = 0.5, shortest = poor, growth = 2;
  for (double gone = 0; !is_clear(p, level);) {
    StepResult next = try_step(walker, p, step);
    if (next.point) {
      gone += step;
      if (gone > farthest) return std::nullopt;
      p = std::move(*next.point);
      step *= growth;
    } else {
      step *= 0.5;
      if (step < shortest) return std::nullopt;
    }
  }
  return p;
}

/// The widened step on which the rate rises above a level.
std::optional<WideStep> widened_to(const Walker& walker, const CurvePoint& from,
                                   const CurvePoint& to, double level) {
  const double step = std::max(to.s - from.s, together);
  CurvePoint back = from;
  back.tangent = opposite(from.tangent);
  auto left = until_clear(walker, back, step, level);
  const auto right = left ? until_clear(walker, to, step, level) : std::nullopt;
  if (!right) return std::nullopt;
  left->tangent = opposite(left->tangent);
  left->s = from.s - way_along(walker, *left, from);
  const double length = way_along(walker, *left, *right);
  if (!(length > 0)) return std::nullopt;
  const StepResult whole = try_step(walker, *left, length);
  if (!whole.point) return std::nullopt;
  if (length_of(walker, difference(*whole.point, *right)) > same_point) return std::nullopt;
  if (!examine(walker, *left, *whole.point).doubt.empty()) return std::nullopt;
  return WideStep{*left, *whole.point};
}

/// Rounding scatters the places of touches over a share of the stretch on which they are lost in it: one that lies
/// just before the step, as far as the step can tell, may have lain beyond the end of the one before. It is then the
/// tracer's matter whether it has been reported.
double settled_on_step(const ZeroOf& touch) {
  constexpr double share = 0.25, just_inside = 10 * one_place;
  const bool before = touch.at <= 0 && touch.at > -share * (touch.after - touch.before);
  return before && touch.after > just_inside ? just_inside : touch.at;
}

}  // namespace

std::optional<WideStep> widened(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                                double noise) {
  for (const double times : {clear_of_rounding, near_share * clear_of_rounding})
    if (auto wide = widened_to(walker, from, to, times * noise)) return wide;
  return std::nullopt;
}

std::optional<std::vector<ZeroOf>> turns_on_widened(const Walker& walker, const CurvePoint& from,
                                                    const CurvePoint& to, double high,
                                                    double noise) {
  const auto wide = widened(walker, from, to, noise);
  if (!wide) return std::nullopt;
  const double length = wide->to.s - wide->from.s;
  const WatchedStep arc(walker, wide->from, length);
  const ZeroSearch found = find_zeros([&](double ds) { return arc.rate(ds); }, 0, length, noise,
                                      same_point, NoiseIs::bound);
  if (!found.resolved) return std::nullopt;
  std::vector<ZeroOf> turns;
  for (ZeroOf turn : found.zeros) {
    const auto& point = arc.point(turn.at);
    if (!point) return std::nullopt;
    const double moved = way_along(walker, from, *point) - turn.at;
    turn.at += moved;
    turn.before += moved;
    turn.after += moved;
    if (turn.touches) turn.at = settled_on_step(turn);
    if (turn.at > 0 && turn.at <= high) turns.push_back(turn);
  }
  return turns;
}

}  // namespace springfold::continuation
