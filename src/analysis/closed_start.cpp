#include "closed_start.hpp"

#include <algorithm>
#include <cmath>

#include "merged_hits.hpp"
#include "start_hits.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;

CurvePoint turned(CurvePoint point, double end) {
  point.s = end - point.s;
  point.tangent = {-point.tangent.dx, -point.tangent.dlambda};
  return point;
}

Hit turned(Hit hit, double end) {
  hit.point = turned(std::move(hit.point), end);
  for (CurvePoint& leaving : hit.leaving) leaving = turned(std::move(leaving), end);
  if (hit.leaving.size() == 1) std::swap(hit.point, hit.leaving.front());
  std::swap(hit.s_before, hit.s_after);
  hit.s_before = end - hit.s_before;
  hit.s_after = end - hit.s_after;
  std::swap(hit.way_back, hit.way_on);
  return hit;
}

/// Is the end the start itself, not another copy of it some turns farther?
bool comes_back(const Curve& loop) {
  constexpr double same_place = 1e-6;
  const CurvePoint &first = loop.points.front(), &last = loop.points.back();
  return (last.x - first.x).norm() <= same_place * std::max(1.0, first.x.norm());
}

/// Takes what lies at both ends from a loop, each kind once.
std::vector<Hit> taken_from_ends(Curve& loop, const Evaluator& evaluator) {
  constexpr double closing = 1e-7;  // the engine closes curves to this
  const double end = loop.points.back().s;
  std::vector<Hit> taken;
  std::erase_if(loop.hits, [&](const Hit& hit) {
    const bool lies_there = hit.point.s <= closing || hit.point.s >= end - closing;
    const bool is_other = hit.kind == HitKind::unresolved || only_switches(hit, evaluator) ||
                          (hit.kind == HitKind::user && hit.tag == plain_event);
    if (!lies_there || is_other) return false;
    const auto is_known = [&](const Hit& other) { return is_same_kind(other, hit); };
    if (std::none_of(taken.begin(), taken.end(), is_known)) taken.push_back(moved_to_start(hit));
    return true;
  });
  return taken;
}

/// The part of a loop behind a point of it, from the start back to there.
Curve part_behind(const Curve& loop, std::size_t seam, const CurvePoint& arriving) {
  const double end = loop.points.back().s, s = loop.points[seam].s;
  Curve part;
  part.stop = loop.stop;
  part.stop_detail = loop.stop_detail;
  part.points.push_back(turned(arriving, arriving.s));
  for (std::size_t i = loop.points.size() - 1; i-- > seam;)
    part.points.push_back(turned(loop.points[i], end));
  for (std::size_t i = loop.hits.size(); i-- > 0;)
    if (loop.hits[i].point.s > s) part.hits.push_back(turned(loop.hits[i], end));
  for (std::size_t i = loop.arcs.size(); i-- > 0;)
    if (loop.arcs[i].s_begin >= s) {
      part.arcs.push_back(loop.arcs[i]);
      part.arcs.back().s_begin = end - loop.arcs[i].s_end;
      part.arcs.back().s_end = end - loop.arcs[i].s_begin;
    }
  return part;
}

void cut_behind(Curve& loop, std::size_t seam) {
  const double s = loop.points[seam].s;
  loop.points.resize(seam + 1);
  std::erase_if(loop.hits, [s](const Hit& hit) { return hit.point.s > s; });
  std::erase_if(loop.arcs, [s](const continuation::Arc& arc) { return arc.s_begin >= s; });
}

}  // namespace

std::vector<Hit> opened_at_start(BranchSource& source, const Evaluator& evaluator) {
  constexpr std::size_t fewest = 4;  // an inner point on either side of the seam
  Curve& loop = source.forward;
  if (loop.points.size() < fewest || !comes_back(loop)) return {};
  loop = with_hits_merged(std::move(loop), evaluator);
  std::vector<Hit> at_start = taken_from_ends(loop, evaluator);
  if (at_start.empty()) return {};
  // At a corner the curve arrives on the piece before it.
  const auto corner = std::find_if(at_start.begin(), at_start.end(),
                                   [](const Hit& hit) { return hit.leaving.size() == 1; });
  CurvePoint arriving = corner != at_start.end() ? corner->point : loop.points.front();
  arriving.s = 0;
  const std::size_t seam = loop.points.size() / 2;
  source.backward = part_behind(loop, seam, arriving);
  source.backward_stop = source.forward_stop;
  cut_behind(loop, seam);
  return at_start;
}

}  // namespace springfold::analysis
