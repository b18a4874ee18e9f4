#include "continuation/following/one_step.hpp"

#include <algorithm>
#include <array>

#include "continuation/following/keep_hits.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/locating/evidence.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/words.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Newton's method is drawn to the branch that is nearest. Where the matrix hardly changes within the length of its
/// first correction, that is where it came from; elsewhere nothing says which branch a step along the tangent has
/// found. To be asked right after the correction, whose lengths the workspace holds.
/// @param ds       length of the step
/// @param refusal  why, if so
bool may_be_another(const Walker& walker, const CurvePoint& to, double ds, std::string& refusal) {
  const NewtonResult& newton = walker.memory->newton;
  const double moved = newton.corrections.empty() ? 0 : newton.corrections.front();
  // Branches that are nearer than such points are to each other are looked for at narrow places.
  if (moved <= same_point * (1 + to.x.norm())) return false;
  if (stays_within(TestedStep(walker, to, ds), to, moved, small_share)) return false;
  refusal = "another branch may be as near as the corrected point is to the predicted one";
  return true;
}

/// The curve through the step's middle as well, which was found by itself, must lead nearer to the step's end than the
/// one from behind the step alone: on a smooth curve its error is smaller by an order of magnitude, while another
/// branch is as far from the one as from the other. In a cluster, where rounding moves points by more than places are
/// wide, nothing is asked.
/// @param behind  the model of the curve up to the step
/// @param before  the last point before `here` that it knows
bool leads_on(const Walker& walker, const ArcModel& behind, const CurvePoint& before,
              const CurvePoint& here, const CurvePoint& middle, const CurvePoint& to) {
  ArcModel& nearer = walker.memory->ahead;
  if (!nearer.go_through(walker.weights, here, StepSamples(before, &here, middle))) return true;
  const double off = distance_of(walker, nearer, here, to);
  // Rounding of exact points and tangents is magnified where a model leads on beyond its nodes by their own length.
  if (off <= one_place * (1 + to.x.norm()) || off <= 0.5 * distance_of(walker, behind, here, to))
    return true;
  // In a cluster, where rounding moves points by more than one place is wide, nothing is told apart anyway.
  return std::ranges::any_of(std::array{&here, &middle, &to}, [&](const CurvePoint* p) {
    const auto other = separation_at(TestedStep(walker, *p, to.s - here.s), *p);
    return other && other->blur > one_place && off <= between_samples * other->blur &&
           (p != &here || off <= small_share * other->distance);
  });
}

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

/// Does the step still lie beside the junction that the curve left where its piece is singular? There the curve is that
/// of the junction's reduced equation: special points nearer to it than `told_apart` belong to it, and eigenvalues that
/// vanish in it are lost in their rounding. A spring that switches soon leaves no longer steps.
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

/// Predicts, corrects and looks inside: does the step stay on its curve? Its end and, if there is evidence, its middle
/// stand in the workspace.
bool take_step(const Walker& walker, const Progress& progress, const Curve& curve,
               StepReport& report, Refusal& refused) {
  CurvePoint &next = walker.memory->next, &half_way = walker.memory->middle;
  const CurvePoint& here = progress.here;
  const ArcModel *const behind = model_behind(walker, progress, curve), *model = behind;
  if (model && !try_step(walker, here, progress.ds, model, next, report)) model = nullptr;
  if (!model && (!try_step(walker, here, progress.ds, nullptr, next, report) ||
                 may_be_another(walker, next, progress.ds, report.refusal)))
    return false;
  if (!walker.options.verify) return true;
  examine(walker, model, here, next, half_way, report.refusal);
  if (!report.refusal.empty()) return false;
  const CurvePoint* known = middle_behind(progress);
  refused.astray =
      behind && !leads_on(walker, *behind, known ? *known : progress.before, here, half_way, next);
  if (refused.astray)
    report.refusal = "the end is not where the curve leads: another branch may be near";
  return !refused.astray;
}

/// A kink is located by points that are corrected on their own. It must lie where the step's ends and middle lead,
/// nearer than these are known without the middle: just behind a branch point Newton's method is drawn to the branch
/// that crosses there.
bool is_on_step(const Walker& walker, const CurvePoint& here, const KinkSearch& kink) {
  const CurvePoint &middle = walker.memory->middle, &next = walker.memory->next;
  ArcModel &model = walker.memory->ahead, &chord = walker.memory->chord;
  if (kink.singular || !model.go_through(walker.weights, here, StepSamples(here, &middle, next)) ||
      !chord.go_through(walker.weights, here, StepSamples(here, nullptr, next)))
    return true;
  const double off = distance_of(walker, model, here, kink.point);
  if (off <= one_place * (1 + kink.point.x.norm()) ||
      off <= small_share * distance_of(walker, chord, here, kink.point))
    return true;
  // Rounding moves a point across what is soft, with no other branch near.
  const TestedStep step(walker, kink.point, next.s - here.s);
  const auto other = separation_at(step, kink.point);
  return other && off <= between_samples * other->blur && off <= small_share * other->distance;
}

/// May the curve go on past special points that are not told apart? They are then one unresolved point.
bool passes_by(bool report, CurvePoint& end, StepEvents& found, Progress& progress, Curve& curve,
               Refusal& refused) {
  if (!found.doubt.empty() && !found.of_caller && beside_junction(progress, end))
    accept_beside_junction(progress.ds, found, progress, curve);
  if (progress.blurred && beside_junction(progress, end)) end.negative.reset();
  if (found.doubt.empty()) return true;
  refused = {.reason = found.doubt, .special = true, .passing = found.passing};
  const bool shortest = progress.ds <= unresolved_length && report && !found.passing;
  if (shortest || found.flat) add_unresolved(progress.here, end, found, curve);
  return shortest || found.flat;
}

/// Does the curve of a piece, which is the same up to here, lead on within it? Signs of the switches at its point
/// ahead, on the sides of the piece, told by their rates where rounding hides them; 0 where it hides these too, nothing
/// where one is on the other side.
std::optional<std::vector<int>> signs_ahead(const Walker& walker, const CurvePoint& here, double ds,
                                            const std::vector<Index>& switches) {
  const auto ahead = point_at(walker, here, ds);
  Vector g, dg_dlambda;
  Matrix dg_dx;
  if (!ahead || !walker.problem.switches(ahead->x, ahead->lambda, g) ||
      !walker.problem.switch_gradients(ahead->x, ahead->lambda, dg_dx, dg_dlambda))
    return std::nullopt;
  std::vector<int> signs;
  for (const Index j : switches) {
    const int side = here.piece[static_cast<std::size_t>(j)];
    const bool hidden = std::abs(g[j]) <= error_of_value(walker, *ahead, dg_dx, dg_dlambda, j);
    const double told = hidden ? sure_rate(walker, *ahead, dg_dx, dg_dlambda, j) : g[j];
    if (side * told < 0) return std::nullopt;
    signs.push_back(told == 0 ? 0 : side);
  }
  return signs;
}

/// Where switches have rested up to here, and leave their surfaces now, too slowly to be seen to cross, the curve
/// belonged to all pieces beside them: it goes on in that within which it leads on, if that is one. Nothing switches
/// here, but where the switches came to rest.
/// @param suspect  could not be told on a step of this length
bool goes_on_from_rest(const Walker& walker, Index suspect, Progress& progress, Curve& curve) {
  constexpr std::size_t most = 6;
  const CurvePoint& before = progress.before;
  CurvePoint& here = progress.here;
  if (!(before.s < here.s) || before.piece != here.piece || contains(progress.left, suspect))
    return false;
  const std::vector<Index> rested = resting_switches(walker, before, here);
  if (!contains(rested, suspect) || rested.size() > most) return false;
  std::vector<Piece> within;
  std::vector<int> signs;
  for (unsigned pattern = 0; pattern < (1u << rested.size()); ++pattern) {
    CurvePoint other = here;
    for (std::size_t k = 0; k < rested.size(); ++k)
      other.piece[static_cast<std::size_t>(rested[k])] = (pattern >> k) & 1u ? 1 : -1;
    const auto ahead = signs_ahead(walker, other, progress.ds, rested);
    if (!ahead) continue;
    if (!within.empty() && *ahead != signs) return false;
    signs = *ahead;
    if (within.empty() || other.piece == here.piece) within.assign(1, other.piece);
  }
  if (within.empty() || within.front() == here.piece) return false;
  here = point_on_ray(walker, here, {within.front(), here.tangent});
  progress.left = rested;
  curve.points.back() = here;
  curve.log.push_back({here.s, 0, names_of(walker.problem, rested) + " leave their surfaces"});
  return true;
}

/// Takes the end of the step, or the start of the curve that it passes, as the place where the curve is.
void move_on(const Following& following, const CurvePoint* start, Progress& progress,
             Curve& curve) {
  Workspace& memory = *following.walker.memory;
  std::swap(progress.before, progress.here);
  if (start)
    progress.here = *start;
  else
    std::swap(progress.here, memory.next);
  if (following.walker.options.verify) {
    std::swap(progress.middle, memory.middle);
    if (following.middles) following.middles->push_back(progress.middle);
  }
  progress.left.clear();
  curve.points.push_back(progress.here);
  account_over_gap(curve);
}

}  // namespace

Outcome advance(const Following& following, bool report, Progress& progress, Curve& curve,
                Refusal& refused) {
  const Walker& walker = following.walker;
  StepReport step;
  if (!take_step(walker, progress, curve, step, refused)) {
    refused.reason = step.refusal;
    return Outcome::shorten;
  }
  const CurvePoint& next = walker.memory->next;
  const CurvePoint* middle = walker.options.verify ? &walker.memory->middle : nullptr;
  KinkSearch kink = first_kink(walker, progress.here, next, progress.left);
  if (kink.status == KinkSearch::Status::suspicious) {
    if (goes_on_from_rest(walker, kink.suspect, progress, curve)) return Outcome::go_on;
    refused.reason = "close to " + (kink.suspect >= 0 ? walker.problem.switch_name(kink.suspect)
                                                      : std::string("a switching surface"));
    return Outcome::shorten;
  }
  if (kink.status == KinkSearch::Status::found && middle &&
      !is_on_step(walker, progress.here, kink)) {
    refused.reason = "the kink is not where the curve leads: another branch may be near";
    return Outcome::shorten;
  }
  const auto start = start_again(walker, curve.points.front(), progress.here, next);
  const bool meets_kink = kink.status == KinkSearch::Status::found;
  const bool closed = start && !(meets_kink && kink.point.s < start->s);
  CurvePoint& end = meets_kink ? kink.point : walker.memory->next;
  if (closed) kink.status = KinkSearch::Status::none;
  const auto half = middle && kink.status == KinkSearch::Status::found
                        ? point_at(walker, progress.here, 0.5 * (end.s - progress.here.s))
                        : std::nullopt;
  if (half) middle = &*half;  // of the part before the kink
  StepEvents found = passage_events(walker, progress, kink, end, middle, following.events, curve);
  if (closed) end_at(*start, found);
  if (!passes_by(report, end, found, progress, curve, refused)) return Outcome::shorten;
  if (keep(walker, StepSamples(progress.here, middle && middle->s < end.s ? middle : nullptr, end),
           meets_kink && !closed, following.at_hit, found, curve))
    return Outcome::stop;
  if (meets_kink && !closed) {
    curve.log.push_back({progress.here.s, kink.point.s - progress.here.s,
                         "cut: " + names_of(walker.problem, kink.active)});
    const Outcome passed = pass_kink(walker, kink, progress, curve);
    return passed == Outcome::go_on && closes_behind_kink(walker, progress.here, curve)
               ? Outcome::stop
               : passed;
  }
  move_on(following, closed ? &*start : nullptr, progress, curve);
  if (closed) {
    curve.stop = StopReason::closed;
    return Outcome::stop;
  }
  // Past something unresolved the next step gets away from it.
  progress.ds = found.doubt.empty() || found.flat
                    ? next_step_length(progress.ds, step.measures, walker.options.step)
                    : std::min(100 * unresolved_length, walker.options.step.maximum);
  return Outcome::go_on;
}

}  // namespace springfold::continuation
