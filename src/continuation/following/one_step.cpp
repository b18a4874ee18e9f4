#include "continuation/following/one_step.hpp"

#include <algorithm>

#include "continuation/following/keep_hits.hpp"
#include "continuation/following/own_branch.hpp"
#include "continuation/locating/evidence.hpp"
#include "continuation/locating/unexplained.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/samples.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Special points behind the place at which a curve closes were met at its start, one at this place now.
void end_at(const CurvePoint& start, StepEvents& found) {
  constexpr double same_place = same_point;
  std::erase_if(found.hits, [&](const Hit& hit) { return hit.point.s > start.s + same_place; });
}

/// The middle of the last step, where it is known.
const CurvePoint* middle_behind(const Progress& progress) {
  const CurvePoint &inside = progress.middle, &here = progress.here;
  const bool known = inside.s > progress.before.s && inside.s < here.s;
  return known && inside.piece == here.piece ? &inside : nullptr;
}

/// The last accepted step as a model of the curve: the next one must continue it, not just satisfy F.
/// @returns nullptr where the curve begins, or begins again at a kink
const ArcModel* model_behind(const Walker& walker, const Progress& progress, const Curve& curve) {
  const CurvePoint &here = progress.here, &before = progress.before;
  if (curve.points.size() < 2 || curve.points.back().s != here.s) return nullptr;
  if (!(before.s < here.s) || before.piece != here.piece || before.x.size() != here.x.size())
    return nullptr;
  const StepSamples samples(before, middle_behind(progress), here);
  ArcModel& arc = walker.memory->behind;
  return arc.go_through(walker.weights, here, samples) ? &arc : nullptr;
}

/// Does the step still lie beside the junction that the curve left where its piece is singular? There the curve is that of
/// the junction's reduced equation: special points nearer to it than `told_apart` belong to it, and eigenvalues that vanish
/// in it are lost in their rounding. A spring that switches soon leaves no longer steps.
bool beside_junction(const Progress& progress, const CurvePoint& end) {
  return progress.from_singular && end.s <= told_apart;
}

/// Nothing is told of the number of negative eigenvalues on this stretch: the counts may differ from point to point.
void accept_beside_junction(double ds, StepEvents& found, Progress& progress, Curve& curve) {
  curve.log.push_back({curve.points.back().s, ds, "beside the junction: " + found.doubt});
  found.doubt.clear();
  found.unexplained = 0;
  found.flat = found.passing = false;
  progress.blurred = true;
  for (CurvePoint& point : curve.points) point.negative.reset();
}

/// A curve that began on a switching surface comes back to its start with the kink there.
bool closes_behind_kink(const Walker& walker, const CurvePoint& leaving, Curve& curve) {
  const CurvePoint& start = curve.points.front();
  if (!(leaving.s > start.s + told_apart) || leaving.piece != start.piece ||
      !coincide(walker, start, leaving) ||
      cosine(walker, start.tangent, direction_seen_from(walker, start.x, leaving)) < 0)
    return false;
  curve.points.push_back(leaving);
  curve.stop = StopReason::closed;
  return true;
}

}  // namespace

Outcome advance(const Following& following, bool report, Progress& progress, Curve& curve,
                Refusal& refused) {
  const Walker& walker = following.walker;
  std::string& refusal = refused.reason;
  CurvePoint &next = walker.memory->next, &half_way = walker.memory->middle;
  StepMeasures measures;
  const ArcModel *const behind = model_behind(walker, progress, curve), *model = behind;
  if (model && !try_step(walker, progress.here, progress.ds, model, next, measures, refusal))
    model = nullptr;
  if (!model && (!try_step(walker, progress.here, progress.ds, nullptr, next, measures, refusal) ||
                 may_be_another(walker, next, progress.ds, refusal)))
    return Outcome::shorten;
  const CurvePoint* middle = nullptr;
  if (walker.options.verify) {
    examine(walker, model, progress.here, next, half_way, refusal);
    if (!refusal.empty()) return Outcome::shorten;
    middle = &half_way;
    const CurvePoint* known = middle_behind(progress);
    if (behind && !leads_on(walker, *behind, known ? *known : progress.before, progress.here,
                            half_way, next)) {
      refusal = "the end is not where the curve leads: another branch may be near";
      refused.astray = true;
      return Outcome::shorten;
    }
  }
  KinkSearch kink = first_kink(walker, progress.here, next, progress.left);
  if (kink.status == KinkSearch::Status::suspicious) {
    refusal = "close to " + (kink.suspect >= 0 ? walker.problem.switch_name(kink.suspect)
                                               : std::string("a switching surface"));
    return Outcome::shorten;
  }
  const auto start = start_again(walker, curve.points.front(), progress.here, next);
  const bool meets_kink = kink.status == KinkSearch::Status::found;
  const bool closed = start && !(meets_kink && kink.point.s < start->s);
  CurvePoint& end = meets_kink ? kink.point : next;
  if (closed) kink.status = KinkSearch::Status::none;
  const bool cut = meets_kink && !closed;
  StepEvents found = passage_events(walker, progress, kink, end, middle, following.events, curve);
  if (closed) end_at(*start, found);
  if (!found.doubt.empty() && !found.of_caller && beside_junction(progress, end))
    accept_beside_junction(progress.ds, found, progress, curve);
  if (progress.blurred && beside_junction(progress, end)) end.negative.reset();
  if (!found.doubt.empty()) {
    refusal = found.doubt;
    refused.special = true;
    refused.passing = found.passing;
    const bool shortest = progress.ds <= unresolved_length && report && !found.passing;
    if (!shortest && !found.flat) return Outcome::shorten;
    add_unresolved(progress.here, end, found, curve);
  }
  if (keep(walker, StepSamples(progress.here, middle && middle->s < end.s ? middle : nullptr, end),
           following.at_hit, found, curve))
    return Outcome::stop;
  if (cut) {
    curve.log.push_back({progress.here.s, kink.point.s - progress.here.s,
                         "cut: " + names_of(walker.problem, kink.active)});
    const Outcome passed = pass_kink(walker, kink, progress, curve);
    return passed == Outcome::go_on && closes_behind_kink(walker, progress.here, curve)
               ? Outcome::stop
               : passed;
  }
  std::swap(progress.before, progress.here);
  if (closed)
    progress.here = *start;
  else
    std::swap(progress.here, next);
  if (middle) {
    std::swap(progress.middle, half_way);
    if (following.middles) following.middles->push_back(progress.middle);
  }
  progress.left.clear();
  curve.points.push_back(progress.here);
  account_over_gap(curve);
  if (closed) {
    curve.stop = StopReason::closed;
    return Outcome::stop;
  }
  // Past something unresolved the next step gets away from it.
  progress.ds = found.doubt.empty() || found.flat
                    ? next_step_length(progress.ds, measures, walker.options.step)
                    : std::min(100 * unresolved_length, walker.options.step.maximum);
  return Outcome::go_on;
}

}  // namespace springfold::continuation
