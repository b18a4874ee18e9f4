#include "ways_on.hpp"

#include <algorithm>

#include "springfold/continuation/diagram.hpp"
#include "springfold/continuation/newton.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using continuation::Direction;

/// Between the start of a curve and the next point or special point.
std::optional<CurvePoint> halfway_to_next(const PathProblem& problem,
                                          const continuation::Curve& curve) {
  if (curve.points.size() < 2) return std::nullopt;
  const CurvePoint& start = curve.points.front();
  const CurvePoint* next = &curve.points[1];
  for (const continuation::Hit& hit : curve.hits)
    if (hit.point.s > 0 && hit.point.s < next->s) next = &hit.point;
  const Direction chord{next->x - start.x, next->lambda - start.lambda};
  const auto found =
      continuation::correct(problem, problem.metric(), start.x + 0.5 * chord.dx,
                            start.lambda + 0.5 * chord.dlambda, next->piece, chord, {});
  continuation::Linearisation at;
  if (!continuation::converged(found) ||
      !continuation::linearise_densely(problem, found.x, found.lambda, next->piece, at))
    return std::nullopt;
  const auto tangent = continuation::tangent_at(at, problem.metric(), chord);
  if (!tangent) return std::nullopt;
  CurvePoint point{.s = 0.5 * next->s,
                   .x = found.x,
                   .lambda = found.lambda,
                   .tangent = *tangent,
                   .piece = next->piece};
  count_negative(problem, point);
  return point;
}

}  // namespace

std::optional<std::vector<WayOn>> ways_from(const PathProblem& problem, const CurvePoint& at,
                                            const continuation::TraceOptions& options) {
  using continuation::DoubtKind;
  const auto first_point_only = [](const CurvePoint& point) { return !(point.s > 0); };
  const continuation::Diagram diagram =
      continuation::trace_diagram(problem, {{at.x, at.lambda, at.piece}}, {},
                                  {.trace = options, .maximum_depth = 0}, first_point_only);
  const bool misses = std::ranges::any_of(diagram.doubts, [](const continuation::Doubt& doubt) {
    return doubt.kind == DoubtKind::ways_missing || doubt.kind == DoubtKind::not_attached;
  });
  if (misses || diagram.junctions.size() != 1 || !diagram.junctions.front().complete)
    return std::nullopt;
  std::vector<WayOn> ways;
  for (const continuation::Branch& branch : diagram.branches) {
    auto beside = halfway_to_next(problem, branch.curve);
    if (!beside) return std::nullopt;
    const CurvePoint& from = branch.curve.points.front();
    ways.push_back({from, {.piece = from.piece, .tangent = from.tangent, .start = beside}});
  }
  return ways;
}

}  // namespace springfold::analysis
