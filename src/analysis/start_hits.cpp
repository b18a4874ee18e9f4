#include "start_hits.hpp"

#include <algorithm>
#include <cmath>

#include "closed_start.hpp"
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
/// Rates of lambda along a unit tangent that are larger are no rounding.
constexpr double has_a_sign = 1e-11;

}  // namespace

bool is_same_kind(const Hit& a, const Hit& b) { return a.kind == b.kind && a.tag == b.tag; }

Hit moved_to_start(Hit hit) {
  hit.s_before -= hit.point.s;
  hit.s_after -= hit.point.s;
  hit.point.s = 0;
  for (CurvePoint& leaving : hit.leaving) leaving.s = 0;
  return hit;
}

bool only_switches(const Hit& hit, const Evaluator& evaluator) {
  if (hit.kind != HitKind::kink || hit.leaving.size() != 1) return hit.kind == HitKind::kink;
  const RoundedRate before = evaluator.force_rate(hit.point),
                    after = evaluator.force_rate(hit.leaving.front());
  return !(before.told() * after.told() < 0);
}

namespace {

bool is_plain(const continuation::Event& event) {
  return event.action == continuation::EventAction::stop || event.tag == plain_event ||
         event.tag == whole_turn;
}

std::vector<continuation::Event> events_through(const Following& t) {
  auto events = events_of(t.study, t.evaluator, t.quantities);
  std::erase_if(events, is_plain);
  return events;
}

/// The next point of a curve: an ordinary one, or where the curve ends before the first of them; nullptr: it ends at
/// the start.
const CurvePoint* next_point(const Curve& curve) {
  if (curve.points.size() > 1) return &curve.points[1];
  return !curve.hits.empty() && curve.hits.back().point.s > 0 ? &curve.hits.back().point : nullptr;
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
    const double beside = std::max(std::abs(event.value(*next_point(backward))),
                                   std::abs(event.value(*next_point(forward))));
    return !(std::abs(event.value(start)) > perhaps_zero * beside);
  });
}

/// How far the short curve may begin from the start: half of the way to the first special point of the curve.
double free_way(const Curve& curve) {
  const double first = next_point(curve)->s;
  return curve.hits.empty() ? first : std::min(first, 0.5 * curve.hits.front().point.s);
}

CurvePoint turned_round(CurvePoint point) {
  point.tangent = {-point.tangent.dx, -point.tangent.dlambda};
  return point;
}

/// The point of the backward curve at which the short curve begins, looking forward; nothing where it cannot be
/// computed.
std::optional<CurvePoint> point_before(const Following& t, const Curve& backward,
                                       continuation::TraceOptions options) {
  const CurvePoint& start = backward.points.front();
  const CurvePoint& next = *next_point(backward);
  if (options.step.maximum == next.s) return turned_round(next);
  options.maximum_points = 2;
  const Curve way =
      trace(t.problem, start.x, start.lambda, {start.piece, start.tangent}, {}, options);
  if (way.points.size() < 2) return std::nullopt;
  return turned_round(way.points[1]);
}

/// How far from where it was located a special point that no curve meets may lie: rounding places flat ones no better
/// than their interval.
double reach_of(const Hit& hit) {
  return std::max(same_as_start, std::min(hit.point.s - hit.s_before, hit.s_after - hit.point.s));
}

double distance(const CurvePoint& start, const Hit& hit) {
  return std::hypot((hit.point.x - start.x).norm(), hit.point.lambda - start.lambda);
}

bool lies_at(const CurvePoint& start, const Hit& hit) {
  return distance(start, hit) <= reach_of(hit);
}

/// The special point at the start, at the start's own place where it could not be told from that.
Hit placed_at(const CurvePoint& start, Hit hit) {
  if (distance(start, hit) > same_as_start) {
    hit.point.x = start.x;
    hit.point.lambda = start.lambda;
  }
  return moved_to_start(std::move(hit));
}

/// The curves may have it already, a little behind the start; what they tell there is not unresolved.
bool is_met_by(const Curve& curve, const Hit& hit) {
  if (curve.hits.empty()) return false;
  const Hit& first = curve.hits.front();
  const bool is_near = first.point.s <= 2 * reach_of(hit), holds_start = first.s_before <= 0;
  if (hit.kind == HitKind::unresolved)
    return first.kind != HitKind::user && (is_near || holds_start);
  return is_same_kind(first, hit) && is_near;
}

/// What both curves meet right behind the start, each within an interval that reaches back to it, is one special point:
/// the start. It is taken from the curves.
std::vector<Hit> taken_from_both(BranchSource& source) {
  std::vector<Hit> taken;
  Curve &backward = source.backward, &forward = source.forward;
  const auto reaches_back = [](const Curve& curve) {
    return !curve.hits.empty() && curve.hits.front().s_before <= 0 &&
           curve.hits.front().kind != HitKind::unresolved && !curve.hits.front().stops;
  };
  while (reaches_back(backward) && reaches_back(forward) &&
         is_same_kind(backward.hits.front(), forward.hits.front())) {
    taken.push_back(placed_at(forward.points.front(), std::move(forward.hits.front())));
    backward.hits.erase(backward.hits.begin());
    forward.hits.erase(forward.hits.begin());
  }
  return taken;
}

/// The first point of a curve at which the rate of lambda has a sign, if no special point lies before it.
const CurvePoint* first_with_sign(const Curve& curve) {
  const double room = curve.hits.empty() ? curve.points.back().s : curve.hits.front().point.s;
  for (const CurvePoint& point : curve.points)
    if (point.s < room && std::abs(point.tangent.dlambda) > has_a_sign) return &point;
  return nullptr;
}

/// Turns of lambda at the start too close together to tell: whether it turns altogether is told by its rates where they
/// have a sign again. Nothing where they have none, or where the eigenvalues are not told beside the start or say
/// something else.
std::optional<Hit> settled(Hit hit, const PathProblem& problem, const BranchSource& source) {
  const CurvePoint *const before = first_with_sign(source.backward), *const after = first_with_sign(
                                                                         source.forward);
  if (before == nullptr || after == nullptr) return std::nullopt;
  const bool turns = before->tangent.dlambda * after->tangent.dlambda > 0;
  if (problem.symmetric()) {
    const auto &behind = next_point(source.backward)->negative,
               &ahead = next_point(source.forward)->negative;
    if (!behind || !ahead || std::abs(*ahead - *behind) != (turns ? 1 : 0)) return std::nullopt;
  }
  hit.kind = turns ? HitKind::limit_point : HitKind::touch;
  hit.name = turns ? "limit point" : "touch";
  hit.multiplicity = turns ? 1 : 2;
  return hit;
}

/// Is the switching told by a curve already, so near to the start that it is the start's?
bool is_told_beside(const Curve& curve, Index j) {
  return std::ranges::any_of(curve.hits, [j](const Hit& hit) {
    return hit.point.s <= same_as_start && std::ranges::find(hit.switches, j) != hit.switches.end();
  });
}

/// The two ways of an ordinary start that lie in different pieces meet at the switching between them, however slowly
/// its springs leave their thresholds: across a stiff member no step sees it, and values on it are rounding.
std::optional<Hit> switching_between(const Following& t, const Curve& backward,
                                     const Curve& forward) {
  const CurvePoint &before = backward.points.front(), &after = forward.points.front();
  const continuation::Rays ways =
      rays_from(t.problem, after.x, after.lambda, after.piece, options_of(t.study.trace));
  if (ways.rays.size() != 2 || !ways.complete) return std::nullopt;
  const continuation::Ray &one = ways.rays[0], &other = ways.rays[1];
  Hit hit{.kind = HitKind::kink, .point = turned_round(before), .leaving = {after}};
  for (std::size_t k = 0; k < one.piece.size(); ++k) {
    const auto j = static_cast<Index>(k);
    const auto rests_on = [j](const continuation::Ray& ray) {
      return std::ranges::find(ray.resting, j) != ray.resting.end();
    };
    if (one.piece[k] != other.piece[k] && !rests_on(one) && !rests_on(other) &&
        !is_told_beside(backward, j) && !is_told_beside(forward, j))
      hit.switches.push_back(j);
  }
  if (hit.switches.empty()) return std::nullopt;
  for (const Index j : hit.switches)
    hit.name += (hit.name.empty() ? "" : ", ") + t.problem.switch_name(j);
  if (hit.point.tangent.dlambda * after.tangent.dlambda < 0) hit.kind = HitKind::corner;
  Curve both{.points = {hit.point, after}, .hits = {hit}};
  both = with_hits_merged(std::move(both), t.evaluator);
  return both.hits.empty() ? std::nullopt : std::optional<Hit>(moved_to_start(both.hits.front()));
}

/// What a short curve through the start meets there and the two curves do not.
void add_hits_through(const Following& t, const BranchSource& source, const CurvePoint& before,
                      double way, const continuation::TraceOptions& options,
                      const std::vector<continuation::Event>& events, std::vector<Hit>& hits) {
  constexpr double beyond = 1.5;  // of the way: behind the start
  const auto observe = [&](const CurvePoint& point) { return point.s < beyond * way; };
  Curve through = trace(t.problem, before.x, before.lambda, {before.piece, before.tangent}, events,
                        options, observe);
  through = with_hits_merged(std::move(through), t.evaluator);
  const CurvePoint& start = source.forward.points.front();
  for (Hit& hit : through.hits) {
    if (!lies_at(start, hit) || is_met_by(source.backward, hit) || is_met_by(source.forward, hit))
      continue;
    if (hit.kind == HitKind::unresolved) hit = settled(hit, t.problem, source).value_or(hit);
    const bool is_known = std::any_of(hits.begin(), hits.end(),
                                      [&](const Hit& other) { return is_same_kind(other, hit); });
    if (is_known) continue;
    hits.push_back(placed_at(start, std::move(hit)));
  }
}

/// Which springs switch, and where, is surer from the start itself than from a point that was located beside it.
void take_switches(const Hit& from, Hit& to) {
  const auto take_place = [&from](CurvePoint& point, const Piece& piece) {
    point.x = from.point.x;
    point.lambda = from.point.lambda;
    point.piece = piece;
  };
  to.switches = from.switches;
  to.name = from.name;
  take_place(to.point, from.point.piece);
  take_place(to.leaving.front(), from.leaving.front().piece);
}

/// A switching at the start that no hit tells is added; one that is told is told of all of its springs, and of ways
/// that lead on from the start itself.
void complete_switching(const Following& t, const Curve& backward, const Curve& forward,
                        std::vector<Hit>& hits) {
  const auto is_switching = [](const Hit& hit) {
    return !hit.switches.empty() || hit.kind == HitKind::unresolved;
  };
  const auto told = std::ranges::find_if(hits, is_switching);
  if (told != hits.end() && (std::ranges::any_of(told + 1, hits.end(), is_switching) ||
                             told->kind == HitKind::unresolved))
    return;
  auto hit = switching_between(t, backward, forward);
  if (!hit) return;
  if (told == hits.end())
    hits.push_back(std::move(*hit));
  else if (told->kind == HitKind::branching_kink)
    *told = std::move(*hit);
  else if (told->switches.size() <= hit->switches.size() && told->leaving.size() == 1)
    take_switches(*hit, *told);
}

/// Where a spring switches so near to the start that no short curve leads through it, lambda may turn there though
/// nothing tells.
bool may_turn_unseen(const Curve& backward, const Curve& forward) {
  const auto tells = [](const Curve& curve) {
    return std::ranges::any_of(curve.hits, [](const Hit& hit) {
      return hit.s_before <= same_as_start && hit.kind != HitKind::kink;
    });
  };
  const auto is_flat = [](const Curve& curve) {
    return std::abs(curve.points.front().tangent.dlambda) <= has_a_sign;
  };
  return is_flat(backward) && is_flat(forward) && !tells(backward) && !tells(forward);
}

Hit turn_beside_threshold(const CurvePoint& start) {
  Hit hit{.kind = HitKind::unresolved,
          .name =
              "unresolved: lambda may turn at the start, and a spring switches less than 1e-9 "
              "beside it",
          .point = start,
          .s_before = -same_as_start,
          .s_after = same_as_start};
  hit.point.negative.reset();
  return hit;
}

}  // namespace

std::vector<Hit> hits_at_start(const Following& t, BranchSource& source) {
  const Curve &backward = source.backward, &forward = source.forward;
  if (t.study.path == Path::davidenko) return {};
  if (forward.stop == continuation::StopReason::closed) return opened_at_start(source, t.evaluator);
  std::vector<Hit> hits = taken_from_both(source);
  if (next_point(backward) == nullptr || next_point(forward) == nullptr) return hits;
  const auto events = events_through(t);
  if (!may_be_special(t, backward, forward, events)) return hits;
  const double way = std::min(free_way(backward), free_way(forward));
  if (way > same_as_start) {
    continuation::TraceOptions options = options_of(t.study.trace);
    options.verify_arcs = false;
    options.step.initial = options.step.maximum = way;
    options.step.minimum = std::min(options.step.minimum, perhaps_zero * way);
    if (const auto before = point_before(t, backward, options))
      add_hits_through(t, source, *before, way, options, events, hits);
  } else if (may_turn_unseen(backward, forward)) {
    hits.push_back(turn_beside_threshold(forward.points.front()));
  }
  complete_switching(t, backward, forward, hits);
  return hits;
}

}  // namespace springfold::analysis
