#include "start_hits.hpp"

#include <algorithm>
#include <cmath>

#include "grow_diagram.hpp"
#include "merged_hits.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;

/// Special points are located to 1e-10: one so near to the start, in the metric, is the start.
constexpr double same_as_start = 1e-9;
/// What is so small beside its values at the next points may be zero at the start.
constexpr double perhaps_zero = 1e-6;

bool is_plain(const continuation::Event& event) {
  return event.action == continuation::EventAction::stop || event.tag == plain_event ||
         event.tag == whole_turn;
}

std::vector<continuation::Event> events_through(const Following& t) {
  auto events = events_of(t.study, t.evaluator, t.quantities);
  std::erase_if(events, is_plain);
  return events;
}

/// Could the start be a special point? Where lambda stands still, springs rest, or an event may be zero.
bool may_be_special(const Following& t, const Curve& backward, const Curve& forward,
                    const std::vector<continuation::Event>& events) {
  const CurvePoint& start = forward.points.front();
  if (std::abs(start.tangent.dlambda) <= perhaps_zero ||
      std::abs(backward.points.front().tangent.dlambda) <= perhaps_zero)
    return true;
  Vector g;
  if (t.problem.switches(start.x, start.lambda, g) && g.size() > 0 &&
      g.cwiseAbs().minCoeff() <= same_as_start)
    return true;
  return std::any_of(events.begin(), events.end(), [&](const continuation::Event& event) {
    const double beside = std::max(std::abs(event.value(backward.points[1])),
                                   std::abs(event.value(forward.points[1])));
    return !(std::abs(event.value(start)) > perhaps_zero * beside);
  });
}

/// How far the short curve may begin from the start: half of the way to the first special point of the curve.
double free_way(const Curve& curve) {
  const double first = curve.points[1].s;
  return curve.hits.empty() ? first : std::min(first, 0.5 * curve.hits.front().point.s);
}

CurvePoint turned_round(CurvePoint point) {
  point.tangent = {-point.tangent.dx, -point.tangent.dlambda};
  return point;
}

/// The point of the backward curve at which the short curve begins, looking forward; nothing where it cannot be computed.
std::optional<CurvePoint> point_before(const Following& t, const Curve& backward,
                                       continuation::TraceOptions options) {
  const CurvePoint& start = backward.points.front();
  if (options.step.maximum == backward.points[1].s) return turned_round(backward.points[1]);
  options.maximum_points = 2;
  const Curve way =
      trace(t.problem, start.x, start.lambda, {start.piece, start.tangent}, {}, options);
  if (way.points.size() < 2) return std::nullopt;
  return turned_round(way.points[1]);
}

bool lies_at(const CurvePoint& start, const Hit& hit) {
  return std::hypot((hit.point.x - start.x).norm(), hit.point.lambda - start.lambda) <=
         same_as_start;
}

/// The curves may have it already, a little behind the start.
bool is_met_by(const Curve& curve, const Hit& hit) {
  return !curve.hits.empty() && curve.hits.front().kind == hit.kind &&
         curve.hits.front().tag == hit.tag && curve.hits.front().point.s <= 2 * same_as_start;
}

/// Nothing but a spring that begins or ends to act.
bool only_switches(const Hit& hit, const Evaluator& evaluator) {
  if (hit.kind != HitKind::kink || hit.leaving.size() != 1) return hit.kind == HitKind::kink;
  const RoundedRate before = evaluator.force_rate(hit.point),
                    after = evaluator.force_rate(hit.leaving.front());
  return !(before.told() * after.told() < 0);
}

}  // namespace

std::vector<Hit> hits_at_start(const Following& t, const BranchSource& source) {
  const Curve &backward = source.backward, &forward = source.forward;
  if (t.study.path == Path::davidenko || forward.stop == continuation::StopReason::closed)
    return {};
  if (backward.points.size() < 2 || forward.points.size() < 2) return {};
  const auto events = events_through(t);
  if (!may_be_special(t, backward, forward, events)) return {};
  const double way = std::min(free_way(backward), free_way(forward));
  if (!(way > same_as_start))
    return {};  // special points of the curves lie at the start: they tell it
  continuation::TraceOptions options = options_of(t.study.trace);
  options.verify_arcs = false;
  options.step.initial = options.step.maximum = way;
  options.step.minimum = std::min(options.step.minimum, perhaps_zero * way);
  const auto before = point_before(t, backward, options);
  if (!before) return {};
  constexpr double beyond = 1.5;  // of the way: behind the start
  const auto observe = [&](const CurvePoint& point) { return point.s < beyond * way; };
  Curve through = trace(t.problem, before->x, before->lambda, {before->piece, before->tangent},
                        events, options, observe);
  through = with_hits_merged(std::move(through), t.evaluator);
  std::vector<Hit> hits;
  for (Hit& hit : through.hits) {
    if (hit.kind == HitKind::unresolved || !lies_at(forward.points.front(), hit)) continue;
    if (is_met_by(backward, hit) || is_met_by(forward, hit)) continue;
    if (only_switches(hit, t.evaluator)) continue;
    hit.s_before -= hit.point.s;
    hit.s_after -= hit.point.s;
    hit.point.s = 0;
    for (CurvePoint& leaving : hit.leaving) leaving.s = 0;
    hits.push_back(std::move(hit));
  }
  return hits;
}

}  // namespace springfold::analysis
