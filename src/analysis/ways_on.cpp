#include "ways_on.hpp"

#include <algorithm>
#include <cmath>

#include "curve_chord.hpp"
#include "springfold/continuation/newton.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Direction;

double cosine(const Vector& metric, const Direction& a, const Direction& b) {
  const auto product = [&](const Direction& x, const Direction& y) {
    return continuation::metric_product(metric, x, y);
  };
  const double sizes = std::sqrt(product(a, a) * product(b, b));
  return sizes > 0 ? product(a, b) / sizes : 0;
}

/// Between the start of a curve and the next point or special point.
std::optional<CurvePoint> halfway_to_next(const PathProblem& problem, const Curve& curve) {
  if (curve.points.size() < 2) return std::nullopt;
  const CurvePoint& start = curve.points.front();
  const CurvePoint* next = &curve.points[1];
  for (const continuation::Hit& hit : curve.hits)
    if (hit.point.s > 0 && hit.point.s < next->s) next = &hit.point;
  const CurveChord chord(problem, {start.x, start.lambda}, {next->x, next->lambda});
  const auto found = chord.at(0.5, next->piece);
  if (!found) return std::nullopt;
  CurvePoint point{.s = 0.5 * next->s,
                   .x = found->x,
                   .lambda = found->lambda,
                   .tangent = chord.chord,
                   .piece = next->piece};
  count_negative(problem, point);
  return point;
}

/// All ways out of a point at which branches meet, that of arrival among them. Nothing: not all are known.
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
    ways.push_back({branch.curve.points.front(), std::move(*beside)});
  }
  return ways;
}

}  // namespace

std::optional<WayOn> taken_over_at(const PathProblem& problem, const CurvePoint& at,
                                   const LoadedState& state,
                                   const continuation::TraceOptions& options) {
  auto ways = ways_from(problem, at, options);
  if (!ways || ways->empty()) return std::nullopt;
  const Vector metric = problem.metric();
  const WayOn& back = *std::ranges::min_element(
      *ways, {}, [&](const WayOn& way) { return cosine(metric, way.from.tangent, at.tangent); });
  const double load = state.load(at), sense = load - state.load(back.beside);
  if (!(sense != 0) || state.unstable(back.beside) != Index{0}) return std::nullopt;
  const auto leads_on = [&](const WayOn& way) {
    return sense * (state.load(way.beside) - load) > 0;
  };
  if (std::ranges::count_if(*ways, leads_on) != 1) return std::nullopt;
  WayOn& on = *std::ranges::find_if(*ways, leads_on);
  if (state.unstable(on.beside) != Index{0}) return std::nullopt;
  return std::move(on);
}

Curve curve_along(const PathProblem& problem, const WayOn& way,
                  const std::vector<continuation::Event>& events,
                  continuation::DiagramOptions options,
                  const continuation::StepObserver& observer) {
  constexpr double same_way = 0.7;  // ways of one point are farther apart
  const Vector metric = problem.metric();
  const CurvePoint& from = way.from;
  const auto is_own = [&](const CurvePoint& begin) {
    return begin.piece == from.piece && cosine(metric, begin.tangent, from.tangent) > same_way;
  };
  options.maximum_depth = 0;
  options.ends_at = [&is_own, asked = std::move(options.ends_at)](const CurvePoint& begin) {
    if (!is_own(begin)) return std::string("another way");
    return asked ? asked(begin) : std::string();
  };
  continuation::Diagram diagram = continuation::trace_diagram(
      problem, {{from.x, from.lambda, from.piece}}, events, options, observer);
  const auto own = std::ranges::find_if(diagram.branches, [&](const continuation::Branch& branch) {
    return !branch.curve.points.empty() && is_own(branch.curve.points.front());
  });
  if (own == diagram.branches.end()) return {};
  Curve curve = std::move(own->curve);
  for (continuation::Hit& hit : curve.hits) hit.junction = hit.way_back = hit.way_on = -1;
  return curve;
}

}  // namespace springfold::analysis
