// Smooth special points on a step that may begin or end at a kink.
#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/singular.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/words.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {

Hit* open_family(const CurvePoint& from, Curve& curve) {
  for (auto hit = curve.hits.rbegin(); hit != curve.hits.rend(); ++hit)
    if (hit->kind == HitKind::family && hit->s_after >= from.s) return &*hit;
  return nullptr;
}

namespace {

/// What an error of size 1 in the equations' rates along the tangent makes of lambda's.
double freedom_of_rate(const Walker& walker, const CurvePoint& p) {
  const LinearisedPoint* at = linearised_at(walker.problem, *walker.memory, p.x, p.lambda, p.piece);
  return at ? rate_error(extended_matrix(at->at, walker.weights, p.tangent), 1) : 0;
}

/// Is lambda's rate zero, and lost in what the equations are solved to?
bool is_flat(const Walker& walker, const CurvePoint& p) {
  const double error =
      residual_bound(walker.problem, p.piece, walker.options.newton, std::max(1.0, size_of(p)));
  return std::abs(p.tangent.dlambda) <=
         std::min(flat_rate, clear_of_rounding * error * freedom_of_rate(walker, p));
}

/// Do values at equal distances jump about, so that they are nothing but rounding? Fourth differences of a smooth
/// function are small, however flat it is; those of noise are several times as large as itself.
bool are_nothing_but_rounding(std::vector<double> values) {
  const auto largest = [&values] {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  };
  const double most = largest();
  for (int order = 0; order < 4; ++order) {
    for (std::size_t i = 0; i + 1 < values.size(); ++i) values[i] = values[i + 1] - values[i];
    values.pop_back();
  }
  return largest() > most;
}

/// What Newton's method leaves at its tolerance moves rates, too: solved to rounding, where that can be.
std::optional<CurvePoint> finest_point_at(const Walker& walker, const CurvePoint& from, double ds) {
  Walker finest = walker;
  finest.options.newton.residual_tolerance = few_roundings;
  auto point = point_at(finest, from, ds);
  return point ? point : point_at(walker, from, ds);
}

/// Does lambda stand still along `level_reach` from here, to one side?
bool rests_along(const Walker& walker, const CurvePoint& here, int direction) {
  constexpr int intervals = 12;
  std::vector<CurvePoint> points;
  std::vector<double> rates;
  for (int i = 1; i <= intervals; ++i) {
    const auto next = finest_point_at(walker, here, direction * i * level_reach / intervals);
    if (!next || !is_flat(walker, *next)) return false;
    points.push_back(*next);
    rates.push_back(next->tangent.dlambda);
  }
  std::vector<const CurvePoint*> all{&here};
  for (const CurvePoint& p : points) all.push_back(&p);
  return are_nothing_but_rounding(std::move(rates)) && same_level(walker, all);
}

/// Do the equations know lambda worse here than a little away? Beside stiff members they know it badly all along a
/// curve.
bool is_beside_singular(const Walker& walker, const CurvePoint& here) {
  const double freedom = freedom_of_rate(walker, here);
  if (!(negligible_share * freedom > 1)) return false;
  for (const int side : {-1, 1})
    if (const auto away = point_at(walker, here, side * level_reach);
        away && freedom_of_rate(walker, *away) < near_share * freedom)
      return true;
  return false;
}

/// Does lambda stand still beside a singular point on a longer way than any inflection stays flat? The equations hardly
/// know it there, and where terms cancel in them rounding leaves rates that steps cannot tell from turns. A curve that
/// rests on one side of a point does so on the other: the singular point itself, where its tangent is not defined, may
/// lie on either.
bool rests_beside_singular(const Walker& walker, const CurvePoint& here, const CurvePoint& end) {
  const double rate = std::max(std::abs(here.tangent.dlambda), std::abs(end.tangent.dlambda));
  return rate <= flat_rate && is_flat(walker, here) && is_flat(walker, end) &&
         is_beside_singular(walker, here) &&
         (rests_along(walker, here, 1) || rests_along(walker, here, -1));
}

/// Has lambda been seen to stand still?
bool seen_standing_still(const Walker& walker, const Progress& progress, const CurvePoint& end,
                         Curve& curve) {
  return progress.flat || open_family(progress.here, curve) != nullptr ||
         rests_beside_singular(walker, progress.here, end);
}

/// Does lambda stand still along the step? On a short one its rate must vanish to rounding, or an
/// inflection would do; not so where it has been seen to stand still. Where its rate rises clear of its rounding
/// on both sides of a step, it does not stand still, but turns, or almost does.
bool stands_still(const Walker& walker, const CurvePoint& from, const CurvePoint* middle,
                  const CurvePoint& to, bool seen) {
  if (seen) {
    const auto inside =
        middle ? std::nullopt : point_at(walker, from, uneven_share(4) * (to.s - from.s));
    if (!middle && inside) middle = &*inside;
    return middle && same_level(walker, {&from, middle, &to});
  }
  double rate = std::max(std::abs(from.tangent.dlambda), std::abs(to.tangent.dlambda));
  if (middle) rate = std::max(rate, std::abs(middle->tangent.dlambda));
  if (rate > (to.s - from.s >= level_reach ? residual_level : small_share * residual_level))
    return false;
  const LinearisedPoint* at =
      linearised_at(walker.problem, *walker.memory, from.x, from.lambda, from.piece);
  if (!at) return true;
  const double noise = rate_noise(extended_matrix(at->at, walker.weights, from.tangent));
  return rate <= clear_of_rounding * noise && !widened(walker, from, to, noise);
}

/// Negative eigenvalues of dF/dx + tau tau^T: within a family tau is in the kernel of dF/dx, and this
/// counts the others.
std::optional<Index> other_negatives(const Walker& walker, const CurvePoint& p) {
  Linearisation at;
  if (!walker.problem.symmetric() || !linearise_densely(walker.problem, p.x, p.lambda, p.piece, at))
    return std::nullopt;
  const double scale = std::max(smallest_number, at.dF_dx.cwiseAbs().maxCoeff());
  const auto inertia = inertia_of(at.dF_dx + scale * p.tangent.dx * p.tangent.dx.transpose());
  return inertia && inertia->zero == 0 ? std::optional<Index>(inertia->negative) : std::nullopt;
}

/// Where the trace leaves off on this step: at its end, or at a stopping event.
double last_s(const CurvePoint& to, const StepEvents& found) {
  const auto stop = std::ranges::find(found.hits, true, &Hit::stops);
  return stop == found.hits.end() ? to.s : stop->point.s;
}

/// Extends the family that ends at `from`, or begins one there.
void note_family(const CurvePoint& from, const CurvePoint& to, StepEvents& found, Curve& curve) {
  const double end = last_s(to, found);
  if (Hit* family = open_family(from, curve)) {
    family->s_after = end;
    return;
  }
  Hit hit{.kind = HitKind::family,
          .name = "family at one lambda",
          .point = from,
          .s_before = from.s,
          .s_after = end};
  hit.point.negative.reset();
  found.hits.insert(found.hits.begin(), std::move(hit));
}

Walker without_limit_points(const Walker& walker) {
  Walker plain = walker;
  plain.options.limit_points = false;
  return plain;
}

/// Adds special points in their order.
void add_special(const StepEvents& special, StepEvents& found) {
  found.hits.insert(found.hits.end(), special.hits.begin(), special.hits.end());
  sort_by_place(found.hits);
  if (special.doubt.empty()) return;
  if (found.doubt.empty()) found.doubt = special.doubt;
  found.unexplained = special.unexplained;
}

/// A stretch on which the rate of lambda is lost in rounding: a fold there belongs to the kink, branches that cross do
/// not.
void add_crossings(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                   StepEvents& found) {
  if (!(to.s > from.s)) return;
  add_special(events_on_step(without_limit_points(walker), from, to, nullptr, {}), found);
}

/// Events of the caller on a step that ends at a singular point: those of places all along; those of tangents up to
/// just before it, since there the equations do not say which tangent is that of the curve.
/// @param last  just before the end
StepEvents events_to_singular(const Walker& walker, const CurvePoint& from, const CurvePoint& last,
                              const CurvePoint& to, const std::vector<Event>& events) {
  std::vector<Event> places, tangents;
  for (const Event& event : events) (event.of_place ? places : tangents).push_back(event);
  const Walker plain = without_special_points(walker);
  StepEvents found = events_on_step(plain, from, to, nullptr, places);
  const StepEvents before = events_on_step(plain, from, last, nullptr, tangents);
  walker.memory->at_end.events = nullptr;  // those lists end here
  found.hits.insert(found.hits.end(), before.hits.begin(), before.hits.end());
  sort_by_place(found.hits);
  if (found.doubt.empty()) found.doubt = before.doubt;
  found.of_caller = !found.doubt.empty();
  return found;
}

/// On a family lambda turns nowhere, and dF/dx is singular all along; the matrix of the curve is so where another
/// branch crosses. Where one does so at the kink behind the step, it belongs to the kink, as on any curve.
StepEvents family_events(const Walker& walker, const CurvePoint& from, CurvePoint& to,
                         const CurvePoint* middle, const std::vector<Event>& events,
                         bool ends_singular, Curve& curve) {
  to.negative.reset();
  const Walker level = without_limit_points(walker);
  CurvePoint last = to;
  StepEvents found;
  if (ends_singular) {
    last = before_singular(walker, to, to.s - from.s).point;
    found = events_to_singular(walker, from, last, to, events);
    if (last.s < to.s) add_crossings(level, from, last, found);
  } else {
    found = events_on_step(level, from, to, middle, events);
  }
  const auto before = other_negatives(walker, from), after = other_negatives(walker, last);
  int explained = 0;
  for (const Hit& hit : found.hits)
    if (hit.kind == HitKind::branch_point) explained += hit.multiplicity;
  const int sign_changes = before && after ? static_cast<int>(std::abs(*after - *before)) : 0;
  if (sign_changes > explained) {
    found.doubt = "an eigenvalue changes its sign within a family";
    found.unexplained = sign_changes - explained;
  }
  note_family(from, to, found, curve);
  return found;
}

/// Special points between `from` and `to`, just before a kink at kink_s that may itself be special.
/// A search also sees what lies just beyond its own end: each one stops at a twentieth of what is left.
StepEvents special_points(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          double kink_s, const CurvePoint* middle) {
  if (to.s >= kink_s) return events_on_step(walker, from, to, middle, {});
  StepEvents all;
  CurvePoint start = from;
  while (start.s < to.s) {
    const double left = (kink_s - start.s) / 20;
    auto next = left > kink_s - to.s ? point_at(walker, start, kink_s - left - start.s) : to;
    if (!next) {
      all.doubt = "the curve could not be followed up to a kink";
      return all;
    }
    StepEvents part = events_on_step(walker, start, *next, nullptr, {});
    all.hits.insert(all.hits.end(), part.hits.begin(), part.hits.end());
    if (all.doubt.empty() && !part.doubt.empty()) {
      all.doubt = part.doubt;
      all.unexplained = part.unexplained;
      all.passing = part.passing;
    }
    start = std::move(*next);
  }
  return all;
}

/// Special points between the bounds, branches that cross also beside them, events of the caller on the whole step.
StepEvents events_between(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const CurvePoint& end, const CurvePoint& begin, const CurvePoint* middle,
                          const std::vector<Event>& events, bool ends_singular) {
  StepEvents found = events_on_step(without_special_points(walker), begin, end, middle, events);
  const CurvePoint& last = ends_singular ? to : end;
  if (!(to.s > from.s)) {
    add_crossings(walker, begin, last, found);
    return found;
  }
  add_crossings(walker, begin, from, found);
  const bool inside = middle && middle->s > from.s && middle->s < to.s;
  add_special(special_points(walker, from, to, end.s, inside ? middle : nullptr), found);
  add_crossings(walker, to, last, found);
  return found;
}

/// Once where the curve begins to rest: what the pieces beside it say of stability.
void note_resting(const Walker& walker, const CurvePoint& at, const std::vector<Index>& resting,
                  std::vector<StepNote>& log) {
  StepNote note{at.s, 0, "stays on the surface of " + names_of(walker.problem, resting)};
  CurvePoint p = at;
  std::string counts;
  for (const Index j : resting) {
    auto& side = p.piece[static_cast<std::size_t>(j)];
    side = side > 0 ? -1 : 1;
    const CurvePoint other = point_on_ray(walker, p, {p.piece, p.tangent});
    if (at.negative && other.negative && *at.negative != *other.negative)
      counts += ", " + std::to_string(*other.negative) + " beyond " + walker.problem.switch_name(j);
    side = side > 0 ? -1 : 1;
  }
  if (!counts.empty())
    note.reason += "; negative eigenvalues: " + std::to_string(*at.negative) + counts;
  const bool known = std::any_of(log.begin(), log.end(),
                                 [&](const StepNote& n) { return n.reason == note.reason; });
  if (!known) log.push_back(std::move(note));
}

}  // namespace

StepEvents passage_events(const Walker& walker, const Progress& progress, const KinkSearch& kink,
                          CurvePoint& end, const CurvePoint* middle,
                          const std::vector<Event>& events, Curve& curve) {
  const CurvePoint& begin = progress.here;
  const double length = end.s - begin.s;
  const bool inside = middle && middle->s < end.s;
  for (const Index j : kink.touched)
    curve.log.push_back(
        {begin.s, length, walker.problem.switch_name(j) + " is touched, not crossed"});
  const bool seen = seen_standing_still(walker, progress, end, curve);
  if (stands_still(walker, begin, inside ? middle : nullptr, end, seen))
    return family_events(walker, begin, end, middle, events, kink.singular, curve);
  std::optional<Beside> from, to;  // where they are not the ends of the step
  if (progress.clear_of > begin.s) {
    const auto clear = point_at(walker, begin, std::min(progress.clear_of - begin.s, length));
    from = Beside{clear ? *clear : end, 0, true};
  }
  if (kink.status == KinkSearch::Status::found) {
    to = kink.singular ? before_singular(walker, end, length) : beside(walker, end, -1, length);
    if (to->sense == 0) to = Beside{begin, 0, true};  // too flat and short for anything
  }
  const CurvePoint &first = from ? from->point : begin, &last = to ? to->point : end;
  StepEvents found = from || (to && to->moved) ? events_between(walker, first, last, end, begin,
                                                                middle, events, kink.singular)
                                               : events_on_step(walker, begin, end, middle, events);
  const std::vector<Index> resting = resting_switches(walker, begin, end);
  if (resting.empty()) return found;
  if (!progress.left.empty()) note_resting(walker, begin, resting, curve.log);
  add_half_branches(walker, StepSamples(first, inside ? middle : nullptr, last), resting, found,
                    curve);
  return found;
}

}  // namespace springfold::continuation
