#include "stable_stretch.hpp"

#include <utility>

#include "limits.hpp"
#include "resting.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/continuation/verification.hpp"
#include "within_limits.hpp"

namespace springfold::analysis {

using continuation::CurvePoint;
using continuation::StopReason;

namespace {

/// No limit of the study is met.
bool ends(const continuation::Curve& curve) { return curve.stop != StopReason::event; }

/// At a kink the curve goes on in several ways or in none, or it is no curve of its own beyond: what happens there is a
/// matter of jumps and of handing over.
bool ends_at_a_kink(const continuation::Curve& curve) {
  return was_ended(curve) || curve.stop == StopReason::several_ways ||
         curve.stop == StopReason::no_way_out || curve.stop == StopReason::turns_upon_itself;
}

}  // namespace

bool is_stable(const Tracing& t, const CurvePoint& point) {
  if (const auto decided = t.evaluator.resting_index_of(QuantityDefinition::Kind::index, point))
    return decided->verdict == Definiteness::positive;
  return !point.negative || *point.negative == t.problem.closures();
}

std::optional<StableStretch> trace_stable(const Tracing& t,
                                          const continuation::DiagramStart& from) {
  const continuation::TraceOptions options = options_of(t.study.trace);
  continuation::Rays rays = rays_from(t.problem, from.x, from.lambda, from.piece, options);
  if (rays.rays.size() != 2 || !rays.complete) return std::nullopt;
  if (rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda)
    std::swap(rays.rays[0], rays.rays[1]);
  const auto events = events_of(t.study, t.evaluator, t.quantities);
  bool given_up = false;
  Crawl crawl = Crawl::none;
  const auto goes_on = [&t, &given_up, &crawl](double sign) {
    return [&t, &given_up, &crawl, sign](const CurvePoint& point) {
      crawl = t.crawl.sees(point);
      given_up = crawl == Crawl::unit_too_small || (t.observer && !t.observer(0, sign * point.s));
      return !given_up && crawl == Crawl::none && is_stable(t, point) &&
             sign * point.tangent.dlambda > 0;
    };
  };
  CurvePoint start;
  start.x = from.x;
  start.lambda = from.lambda;
  start.piece = from.piece;
  const Following with{t.problem, t.study, t.evaluator, t.quantities};
  const auto follow = [&](const continuation::Ray& ray, double sign) {
    continuation::Curve curve =
        trace_within_limits(with, start, ray, events, options, goes_on(sign));
    if (crawl == Crawl::without_bound) end_without_bound(curve);
    if (options.verify_arcs && !given_up && was_ended(curve))
      curve.arcs = verified_arcs(t.problem, curve, options);
    return curve;
  };
  StableStretch stretch;
  BranchSource source;
  source.forward = follow(rays.rays[0], 1);
  source.backward = follow(rays.rays[1], -1);
  source.forward_stop = stop_of(source.forward);
  source.backward_stop = stop_of(source.backward);
  const Stop over{"a stable stretch ends: it is followed no further", true};
  stretch.ends_high = ends(source.forward);
  stretch.ends_low = ends(source.backward);
  if (ends_at_a_kink(source.forward)) source.forward_stop = over;
  if (ends_at_a_kink(source.backward)) source.backward_stop = over;
  stretch.rows = join(std::move(source), t.evaluator, t.quantities, t.problem, &t.asking);
  return stretch;
}

}  // namespace springfold::analysis
