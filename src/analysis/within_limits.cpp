#include "within_limits.hpp"

#include <algorithm>

#include "springfold/continuation/davidenko.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/verification.hpp"

namespace springfold::analysis {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::StopReason;

void cut_to_range(const Study& study, const Evaluator& evaluator,
                  const std::vector<QuantityDefinition>& quantities, Curve& curve) {
  const bool met_outside = curve.stop == StopReason::joined && !curve.hits.empty();
  if (curve.stop != StopReason::observer && !met_outside) return;
  std::optional<std::string> passed;
  if (met_outside) passed = limit_passed(study, evaluator, quantities, curve.hits.back().point);
  while (curve.points.size() > 1) {
    const auto beyond = limit_passed(study, evaluator, quantities, curve.points.back());
    if (!beyond) break;
    passed = beyond;
    curve.points.pop_back();
  }
  if (!passed) return;
  std::erase_if(curve.hits, [&](const Hit& hit) {
    return limit_passed(study, evaluator, quantities, hit.point).has_value();
  });
  const double end =
      std::max(curve.points.back().s, curve.hits.empty() ? 0.0 : curve.hits.back().point.s);
  std::erase_if(curve.arcs, [end](const continuation::Arc& arc) { return arc.s_begin >= end; });
  if (!curve.arcs.empty()) curve.arcs.back().s_end = std::min(curve.arcs.back().s_end, end);
  curve.stop = StopReason::event;
  curve.stop_detail = *passed;
}

namespace {

/// trace(), given up on request also before its first step.
Curve trace_as_asked(const AskedProblem& problem, const CurvePoint& start,
                     const continuation::Ray& ray, const std::vector<continuation::Event>& events,
                     const continuation::TraceOptions& options,
                     const continuation::StepObserver& observer,
                     const continuation::HitObserver& at_hit) {
  try {
    return trace(problem, start.x, start.lambda, ray, events, options, observer, at_hit);
  } catch (const continuation::Interrupted&) {
    CurvePoint begin = start;
    begin.piece = ray.piece;
    begin.tangent = ray.tangent;
    begin.s = 0;
    return {.points = {begin}, .stop = StopReason::observer};
  }
}

}  // namespace

Curve trace_within_limits(const Following& with, const CurvePoint& start,
                          const continuation::Ray& ray,
                          const std::vector<continuation::Event>& events,
                          const continuation::TraceOptions& options,
                          const continuation::StepObserver& observer,
                          const continuation::HitObserver& at_hit) {
  if (auto ended = ended_at_start(with.study, with.evaluator, with.quantities, start, ray))
    return *ended;
  // Elsewhere the limits are events, which no curve passes.
  const bool is_at_edge = is_on_limit(with.study, with.evaluator, with.quantities, start);
  bool passed = false;
  const auto observe = [&](const CurvePoint& point) {
    passed = is_at_edge && limit_passed(with.study, with.evaluator, with.quantities, point);
    return !passed && (!observer || observer(point));
  };
  Curve curve =
      with.study.path == Path::davidenko
          ? davidenko(with.problem, start.x, start.lambda, ray, events, options, observe)
      : with.asked
          ? trace_as_asked(*with.asked, start, ray, events, options, observe, at_hit)
          : trace(with.problem, start.x, start.lambda, ray, events, options, observe, at_hit);
  if (passed && options.verify_arcs && with.study.path != Path::davidenko)
    curve.arcs = verified_arcs(with.problem, curve, options);
  if (is_at_edge) cut_to_range(with.study, with.evaluator, with.quantities, curve);
  return curve;
}

Curve curve_within_limits(const Following& t, const WayOn& way,
                          const std::vector<continuation::Event>& events,
                          const continuation::TraceOptions& options,
                          const continuation::StepObserver& observer) {
  continuation::DiagramOptions within{.trace = options};
  within.ends_at = [&t](const CurvePoint& point) {
    const auto end =
        ended_at_start(t.study, t.evaluator, t.quantities, point, {point.piece, point.tangent});
    return end ? end->stop_detail : "";
  };
  // Limits nearer to the point than the first step are passed by that.
  const auto is_within = [&t](const CurvePoint& point) {
    return !limit_passed(t.study, t.evaluator, t.quantities, point);
  };
  within.outside = [&](const CurvePoint& point) { return !is_within(point); };
  Curve curve = curve_along(
      t.problem, way, events, std::move(within),
      [&](const CurvePoint& point) { return is_within(point) && (!observer || observer(point)); });
  cut_to_range(t.study, t.evaluator, t.quantities, curve);
  return curve;
}

}  // namespace springfold::analysis
