#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "branch_rows.hpp"
#include "closure_rank.hpp"
#include "infinite_force.hpp"
#include "lambda_crawl.hpp"
#include "neutral_motions.hpp"
#include "vanishing_lengths.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::StopReason;

Stop explained(Stop stop, const EndOfCurve& at, const Curve& curve, const PathProblem& problem) {
  const CurvePoint& end = at.end;
  if (stop.complete) return stop;
  if (const auto length = vanishing_length(problem, curve, end)) {
    const bool is_stuck = curve.stop == StopReason::step_too_small;
    return {(is_stuck ? std::string(to_string(curve.stop)) : stop.reason) + "; " + *length, false};
  }
  if (const auto angle = angle_near_jump(problem, end)) return {*angle, false};
  const bool is_said = curve.stop == StopReason::observer && !curve.stop_detail.empty();
  if (is_said) return stop;
  if (const auto why = nears_kinematic_singularity(problem, at))
    stop.reason += "; " + *why;
  else if (const auto legs = stretched_chains(problem, at))
    stop = legs->is_end_of_reach || curve.stop == StopReason::unbounded
               ? Stop{end_of_reach(*legs), !legs->moves_on}
               : Stop{stop.reason + "; " + legs->text, false};
  else if (const auto names = neutral_motion(problem, end))
    stop.reason += "; nothing resists a motion of " + *names + " there";
  return stop;
}

namespace {

struct EndOfReach {
  std::optional<CurvePoint> point{};  ///< none: the last one that is known
  std::string text{};
  bool moves_on = false;  ///< StretchedChains::moves_on
};

/// The end of the reach behind the first `count` points, where these lead to one.
/// @param within      arc length in which the pole lies that makes itself felt: one farther on has nothing to do with
///                    it
/// @param unresolved  the point that could not be told, or nullptr
std::optional<EndOfReach> reach_behind(const PathProblem& problem, const Curve& curve,
                                       std::size_t count, double within,
                                       const CurvePoint* unresolved) {
  if (count < 2) return std::nullopt;
  const CurvePoint &before = curve.points[count - 2], &near = curve.points[count - 1];
  auto last = beside_infinite_force(problem, before, near);
  if (last && last->s > near.s + within) last.reset();
  if (!last && unresolved != nullptr && is_solved_on_side_of(problem, *unresolved, near))
    last = *unresolved;
  // Forces may be so large already that rounding leaves no nearer point.
  EndOfCurve at{last ? *last : near, last ? near : before, {}};
  for (const std::size_t quarter : {0u, 1u, 2u, 3u})
    at.far.push_back(&curve.points[quarter * count / 4]);
  const auto legs = stretched_chains(problem, at);
  if (!legs || !(last ? legs->is_end_of_reach : legs->has_grown)) return std::nullopt;
  return EndOfReach{std::move(last), end_of_reach(*legs), legs->moves_on};
}

}  // namespace

void end_at_reach(Curve& curve, std::vector<CurvePoint>& between, Stop& stop,
                  const PathProblem& problem) {
  const auto end_at = [&](EndOfReach reach, auto first_hit, std::size_t count) {
    stop = {std::move(reach.text), !reach.moves_on};
    const double known = curve.points[count - 1].s;
    curve.hits.erase(first_hit, curve.hits.end());
    curve.points.resize(count);
    if (reach.point) curve.points.push_back(*std::move(reach.point));
    std::erase_if(curve.hits,
                  [&](const continuation::Hit& h) { return h.point.s > curve.points.back().s; });
    std::erase_if(between, [&](const CurvePoint& p) { return p.s >= known; });
    curve.stop = reach.moves_on ? StopReason::observer : StopReason::pole;
    if (reach.moves_on) curve.stop_detail = stop.reason;
  };
  for (auto hit = curve.hits.begin(); hit != curve.hits.end(); ++hit) {
    const auto has_junction = [](const continuation::Hit& h) { return h.junction >= 0; };
    if (std::any_of(hit, curve.hits.end(), has_junction)) continue;
    // Where forces are very large rounding makes touches, too.
    const bool is_unresolved = hit->kind == continuation::HitKind::unresolved;
    if (!is_unresolved && hit->kind != continuation::HitKind::touch) continue;
    const auto behind = std::find_if(curve.points.begin(), curve.points.end(),
                                     [&](const CurvePoint& p) { return p.s >= hit->point.s; });
    const auto count = static_cast<std::size_t>(std::distance(curve.points.begin(), behind));
    const double step =
        std::max(hit->s_after, hit->point.s) - (count > 0 ? curve.points[count - 1].s : 0);
    if (auto reach =
            reach_behind(problem, curve, count, 2 * step, is_unresolved ? &hit->point : nullptr))
      return end_at(*std::move(reach), hit, count);
  }
  if (curve.stop != StopReason::step_too_small) return;
  const std::size_t count = curve.points.size();
  double one_step = 0;
  for (std::size_t i = 1; i < count; ++i)
    one_step = std::max(one_step, curve.points[i].s - curve.points[i - 1].s);
  if (auto reach = reach_behind(problem, curve, count, one_step, nullptr))
    end_at(*std::move(reach), curve.hits.end(), count);
}

Stop stop_of(const Curve& curve, bool follows_branches) {
  if (curve.stop == StopReason::event && !curve.hits.empty() && curve.hits.back().tag == whole_turn)
    return {curve.stop_detail, false};
  if (was_ended(curve) && !curve.stop_detail.empty())
    return {curve.stop_detail, curve.stop == StopReason::pole};
  Stop stop;
  stop.reason = std::string(to_string(curve.stop));
  const bool is_refused =
      curve.stop == StopReason::bad_start;  // by a limit: what it says is all there is to say
  if (!curve.stop_detail.empty())
    stop.reason = is_refused ? curve.stop_detail : stop.reason + ": " + curve.stop_detail;
  stop.complete = ended_as_asked(curve.stop);
  const bool parts = !curve.hits.empty() && curve.hits.back().leaving.size() > 1;
  if (!stop.complete && parts && !follows_branches)
    stop.reason += "; each is a branch: branches.depth = 1 follows them";
  return stop;
}

}  // namespace springfold::analysis
