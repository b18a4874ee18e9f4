#include "stable_stretch.hpp"

#include <utility>

#include "limits.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::analysis {

using continuation::CurvePoint;

std::optional<StableStretch> trace_stable(const Tracing& t,
                                          const continuation::DiagramStart& from) {
  const continuation::TraceOptions options = options_of(t.study.trace);
  continuation::Rays rays = rays_from(t.problem, from.x, from.lambda, from.piece, options);
  if (rays.rays.size() != 2 || !rays.complete) return std::nullopt;
  if (rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda)
    std::swap(rays.rays[0], rays.rays[1]);
  const auto events = events_of(t.study, t.evaluator, t.quantities);
  const auto goes_on = [&t](double sign) {
    return [&t, sign](const CurvePoint& point) {
      const bool stable = !point.negative || *point.negative == t.problem.closures();
      return stable && sign * point.tangent.dlambda > 0;
    };
  };
  CurvePoint start;
  start.x = from.x;
  start.lambda = from.lambda;
  start.piece = from.piece;
  const auto follow = [&](const continuation::Ray& ray, double sign) {
    auto ended = ended_at_start(t.study, t.evaluator, t.quantities, start, ray);
    return ended ? *ended
                 : trace(t.problem, from.x, from.lambda, ray, events, options, goes_on(sign));
  };
  StableStretch stretch;
  BranchSource source;
  source.forward = follow(rays.rays[0], 1);
  source.backward = follow(rays.rays[1], -1);
  source.forward_stop = stop_of(source.forward);
  source.backward_stop = stop_of(source.backward);
  const Stop ends{"a stable stretch ends: it is followed no further", true};
  if (source.forward.stop == continuation::StopReason::observer) {
    source.forward_stop = ends;
    stretch.ends_high = true;
  }
  if (source.backward.stop == continuation::StopReason::observer) {
    source.backward_stop = ends;
    stretch.ends_low = true;
  }
  stretch.rows = join(std::move(source), t.evaluator, t.quantities, t.problem);
  return stretch;
}

}  // namespace springfold::analysis
