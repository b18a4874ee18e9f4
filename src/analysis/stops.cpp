#include <algorithm>
#include <iterator>

#include "branch_rows.hpp"
#include "closure_rank.hpp"
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
  if (const auto why = nears_kinematic_singularity(problem, at))
    stop.reason += "; " + *why;
  else if (const auto legs = stretched_chains(problem, at))
    stop = legs->is_end_of_reach || curve.stop == StopReason::unbounded
               ? Stop{"end of the reach: " + legs->text, true}
               : Stop{stop.reason + "; " + legs->text, false};
  else if (const auto names = neutral_motion(problem, end))
    stop.reason += "; nothing resists a motion of " + *names + " there";
  return stop;
}

void end_at_reach(Curve& curve, std::vector<CurvePoint>& between, Stop& stop,
                  const PathProblem& problem) {
  for (auto hit = curve.hits.begin(); hit != curve.hits.end(); ++hit) {
    const auto has_junction = [](const continuation::Hit& h) { return h.junction >= 0; };
    if (std::any_of(hit, curve.hits.end(), has_junction)) continue;
    if (hit->kind != continuation::HitKind::unresolved) continue;
    const auto behind = std::find_if(curve.points.begin(), curve.points.end(),
                                     [&](const CurvePoint& p) { return p.s >= hit->point.s; });
    const auto before = std::distance(curve.points.begin(), behind);
    if (before < 2 || behind == curve.points.end()) continue;
    EndOfCurve at{hit->point, curve.points[static_cast<std::size_t>(before - 1)], {}};
    for (const int quarter : {0, 1, 2, 3})
      at.far.push_back(&curve.points[static_cast<std::size_t>(quarter * before / 4)]);
    const auto legs = stretched_chains(problem, at);
    if (!legs || !legs->is_end_of_reach) continue;
    stop = {"end of the reach: " + legs->text, true};
    const CurvePoint last = hit->point;
    curve.hits.erase(hit, curve.hits.end());
    curve.points.erase(behind, curve.points.end());
    curve.points.push_back(last);
    std::erase_if(between, [&](const CurvePoint& p) { return p.s >= last.s; });
    curve.stop = StopReason::unbounded;
    return;
  }
}

Stop stop_of(const Curve& curve, bool follows_branches) {
  if (curve.stop == StopReason::event && !curve.hits.empty() && curve.hits.back().tag == whole_turn)
    return {curve.stop_detail, false};
  if (was_ended(curve) && !curve.stop_detail.empty()) return {curve.stop_detail, false};
  Stop stop;
  stop.reason = std::string(to_string(curve.stop));
  const bool is_refused =
      curve.stop == StopReason::bad_start;  // by a limit: what it says is all there is to say
  if (!curve.stop_detail.empty())
    stop.reason = is_refused ? curve.stop_detail : stop.reason + ": " + curve.stop_detail;
  stop.complete = curve.stop == StopReason::event || curve.stop == StopReason::closed;
  const bool parts = !curve.hits.empty() && curve.hits.back().leaving.size() > 1;
  if (!stop.complete && parts && !follows_branches)
    stop.reason += "; each is a branch: branches.depth = 1 follows them";
  return stop;
}

}  // namespace springfold::analysis
