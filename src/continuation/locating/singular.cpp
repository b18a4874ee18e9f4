#include "continuation/locating/singular.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/locating/evidence.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

bool is_clear(const CurvePoint& p, double level) { return std::abs(p.tangent.dlambda) > level; }

/// Regular steps along the tangent until lambda's rate is above a level.
std::optional<CurvePoint> until_clear(const Walker& walker, CurvePoint p, double step,
                                      double level) {
  constexpr double farthest = 0.5, shortest = poor, growth = 2;
  for (double gone = 0; !is_clear(p, level);) {
    StepResult next = try_step(walker, p, step);
    if (next.point) {
      gone += step;
      if (gone > farthest) return std::nullopt;
      p = std::move(*next.point);
      step *= growth;
    } else {
      step *= 0.5;
      if (step < shortest) return std::nullopt;
    }
  }
  return p;
}

/// The widened step on which the rate rises above a level.
std::optional<WideStep> widened_to(const Walker& walker, const CurvePoint& from,
                                   const CurvePoint& to, double level) {
  const double step = std::max(to.s - from.s, together);
  CurvePoint back = from;
  back.tangent = opposite(from.tangent);
  auto left = until_clear(walker, back, step, level);
  const auto right = left ? until_clear(walker, to, step, level) : std::nullopt;
  if (!right) return std::nullopt;
  left->tangent = opposite(left->tangent);
  left->s = from.s - way_to(walker.weights, *left, from);
  const double length = way_to(walker.weights, *left, *right);
  if (!(length > 0)) return std::nullopt;
  const StepResult whole = try_step(walker, *left, length);
  if (!whole.point) return std::nullopt;
  if (length_of(walker, difference(*whole.point, *right)) > same_point) return std::nullopt;
  if (!examine(walker, *left, *whole.point).doubt.empty()) return std::nullopt;
  return WideStep{*left, *whole.point};
}

/// Rounding scatters the places of touches over a share of the stretch on which they are lost in it: one that lies
/// just before the step, as far as the step can tell, may have lain beyond the end of the one before. It is then the
/// tracer's matter whether it has been reported.
double settled_on_step(const ZeroOf& touch) {
  constexpr double share = 0.25, just_inside = 10 * one_place;
  const bool before = touch.at <= 0 && touch.at > -share * (touch.after - touch.before);
  return before && touch.after > just_inside ? just_inside : touch.at;
}

/// Are the rates of lambda at the samples, and on average from the first one to them, so much alike that the polynomial
/// of may_turn() stays close to them? With a middle sample at a share of 0.3 to 0.7 of the step it deviates at most 11
/// times as much from a constant as they do (its Lebesgue constant).
bool is_even(const TestedStep& arc, Samples samples) {
  constexpr double alike = 0.04;
  const CurvePoint &from = *samples.front(), &second = *samples[1];
  const double first = from.tangent.dlambda, share = (second.s - from.s) / arc.length();
  if (samples.size() > 2 && !(share > near_share && share < 1 - near_share)) return false;
  return std::all_of(samples.begin() + 1, samples.end(), [&](const CurvePoint* p) {
    const double rate =
        p->tangent.dlambda / metric_product(arc.walker().weights, p->tangent, from.tangent);
    const double mean = (p->lambda - from.lambda) / (p->s - from.s);
    return std::abs(rate - first) <= alike * std::abs(first) &&
           std::abs(mean - first) <= alike * std::abs(first);
  });
}

/// Could lambda turn, or almost turn, between the samples? Its rate along the step is that of the polynomial through
/// them.
bool may_turn(const TestedStep& arc, Samples samples) {
  if (is_even(arc, samples)) return false;
  constexpr int parts = 24;
  constexpr double far = near_share;  // from zero, compared with the largest rate
  double low = infinity, high = -low;
  for (int i = 0; i <= parts; ++i) {
    const auto rate = arc.rate_of_model(arc.length() * i / parts);
    if (!rate) return true;  // samples that coincide: nothing is known
    low = std::min(low, *rate);
    high = std::max(high, *rate);
  }
  return !(low > far * high && high > 0) && !(high < far * low && low < 0);
}

/// Are these two turns so badly placed that they may be in the other order, or one?
bool too_close(const ZeroOf& one, const ZeroOf& next) {
  return next.at - one.at < 30 * (next.off + one.off);
}

/// Rounding of lambda's rate on the step.
double noise_of_rate(const TestedStep& arc, Samples samples) {
  double scale = 0;
  for (const CurvePoint* p : samples) scale = std::max(scale, std::abs(p->tangent.dlambda));
  const auto E = arc.matrix(*samples[samples.size() / 2]);
  return std::max(function_noise * scale, E ? rate_noise(*E) : scale);
}

/// Are all turns well placed and apart, and each of them no more than one turn or one touch?
bool stand_alone(const std::vector<ZeroOf>& turns) {
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (turns[i].several || turns[i].off > small_share * poor ||
        (i > 0 && too_close(turns[i - 1], turns[i])))
      return false;
  return true;
}

/// Zeros of lambda's rate. What they are must depend on the curve, not on the step: where the rate is lost in its
/// rounding at an end of the step, they are looked for on a wider one.
TestedZeros turns_on(const TestedStep& arc, Samples samples) {
  const double first = std::abs(samples.front()->tangent.dlambda),
               last = std::abs(samples.back()->tangent.dlambda);
  if (!arc.walker().options.limit_points) return {};
  if (std::min(first, last) > flat_rate && !may_turn(arc, samples)) return {};
  const double noise = noise_of_rate(arc, samples);
  const bool clear = std::min(first, last) > clear_of_rounding * noise;
  if (clear && !may_turn(arc, samples)) return {};
  ZeroSearch found{.resolved = false};
  if (std::max(first, last) > noise)
    found = find_zeros([&](double ds) { return arc.rate(ds); }, 0, arc.high(), noise, same_point,
                       NoiseIs::bound, arc.error_of_rate());
  if (clear && found.resolved && stand_alone(found.zeros)) return {found.zeros, true};
  if (auto turns = turns_on_widened(arc.walker(), arc.from(), *samples.back(), arc.high(), noise))
    return {std::move(*turns), true};
  const bool flat = std::max(first, last) <= clear_of_rounding * noise;
  return {.zeros = found.zeros, .resolved = found.resolved && !flat, .flat = flat};
}

/// Turns of lambda that rounding places worse than `poor`, though not far apart: one cluster with
/// their number.
Candidate cluster_of(const std::vector<ZeroOf>& turns, const CurvePoint& point) {
  Candidate cluster{.at = turns.front().at,
                    .before = turns.front().before,
                    .after = turns.back().after,
                    .point = point,
                    .kind = HitKind::unresolved,
                    .multiplicity = 0};
  for (const ZeroOf& turn : turns) {
    cluster.multiplicity += turn.several ? 3 : turn.touches ? 2 : 1;
    cluster.odd = cluster.odd != !turn.touches;
  }
  return cluster;
}

/// A turn of lambda that stands alone.
bool add_turn(const TestedStep& arc, const ZeroOf& turn, const CurvePoint& point,
              std::vector<Candidate>& found) {
  bool regular = true;
  if (turn.off > told_apart || !examine_turn(arc, turn, regular, found)) return false;
  if (regular)
    found.push_back({.at = turn.at,
                     .before = turn.before,
                     .after = turn.after,
                     .point = point,
                     .kind = turn.touches ? HitKind::touch : HitKind::limit_point,
                     .multiplicity = turn.touches ? 2 : 1,
                     .odd = !turn.touches});
  return true;
}

bool add_limit_points(const TestedStep& arc, const std::vector<ZeroOf>& turns,
                      std::vector<Candidate>& found) {
  for (std::size_t i = 0; i < turns.size();) {
    const ZeroOf& turn = turns[i];
    const auto& point = arc.point(turn.at);
    if (!point) return false;
    std::size_t last = i;
    while (last + 1 < turns.size() && too_close(turns[last], turns[last + 1])) ++last;
    if (last > i || turn.several) {
      const std::vector<ZeroOf> group(turns.begin() + static_cast<std::ptrdiff_t>(i),
                                      turns.begin() + static_cast<std::ptrdiff_t>(last) + 1);
      found.push_back(cluster_of(group, *point));
    } else if (!add_turn(arc, turn, *point, found)) {
      return false;
    }
    i = last + 1;
  }
  return true;
}

/// Number of negative eigenvalues on the arc, counted away from special points.
std::optional<Index> negative_at(const TestedStep& arc, double ds) {
  const auto& p = arc.point(ds);
  return p ? p->negative : std::nullopt;
}

/// What special points explain together, where the count between them cannot be told.
struct Explained {
  int most = 0;      ///< eigenvalues that may change sign
  bool odd = false;  ///< an odd number of them does
};

/// Between any two neighbouring special points the count of negative eigenvalues must not change, and
/// at each one only as much as it explains.
std::string accounting(const TestedStep& arc, const std::vector<Candidate>& found,
                       const CurvePoint& to) {
  std::optional<Index> before = arc.from().negative;
  Explained since{};
  const auto fits = [&](std::optional<Index> here) {
    const auto change = before && here ? static_cast<int>(std::abs(*here - *before)) : 0;
    const bool explained =
        !before || !here || (change <= since.most && (change % 2 == 1) == since.odd);
    if (here) {
      before = here;
      since = {};
    }
    return explained;
  };
  // Just beside a special point rounding may have put the point where an eigenvalue has another sign: nothing is told
  // there.
  const auto fits_at = [&](double ds) {
    const std::optional<Index> counted = before;
    const Explained changes = since;
    if (fits(negative_at(arc, ds))) return true;
    const auto& point = arc.point(ds);
    if (point && is_determined(arc, *point)) return false;
    before = counted;
    since = changes;
    return true;
  };
  for (std::size_t i = 0; i <= found.size(); ++i) {
    const bool last = i == found.size();
    const double left = i > 0 ? found[i - 1].at : 0, right = last ? arc.length() : found[i].at;
    bool explained = true;
    if (!found.empty())
      for (const double share : shares_towards_ends<6>())
        explained = explained && fits_at(left + share * (right - left));
    if (!explained || (last && !fits(to.negative)))
      return "number of negative eigenvalues and special points do not fit together";
    if (last) break;
    if (found[i].kind != HitKind::touch) since.most += found[i].multiplicity + 1;
    since.odd = since.odd != found[i].odd;
  }
  return {};
}

Hit hit_of(const TestedStep& arc, Candidate candidate) {
  const char* name = candidate.kind == HitKind::limit_point    ? "limit point"
                     : candidate.kind == HitKind::branch_point ? "branch point"
                     : candidate.kind == HitKind::touch
                         ? "touch"
                         : "unresolved: lambda turns several times too close together to tell";
  Hit hit{.kind = candidate.kind, .name = name};
  hit.point = std::move(candidate.point);
  hit.point.negative.reset();
  hit.point.s = arc.from().s + candidate.at;
  hit.multiplicity = candidate.multiplicity;
  hit.s_before = std::min(arc.from().s + candidate.before, hit.point.s);
  hit.s_after = std::max(arc.from().s + candidate.after, hit.point.s);
  return hit;
}

/// Is one mode weak there, and the next one far from it, and from zero? (The entries of E are of order one.)
bool is_of_one_mode(const ExtendedMatrix& E) {
  const Vector least = least_singular_values(E, 2);
  return least.size() < 2 || (least[1] > told_apart && least[0] <= negligible_share * least[1]);
}

/// The curve at a zero, from points beside it: corrected right there a point may have moved along the mode that
/// vanishes.
std::optional<CurvePoint> point_on_curve(const TestedStep& arc, const ZeroOf& zero) {
  const auto curve = curve_near(arc, zero.at, aside_share * arc.length());
  if (!curve) return std::nullopt;
  const Vector u = (*curve)(zero.at);
  CurvePoint point = arc.from();
  point.x = u.head(u.size() - 1);
  point.lambda = u[u.size() - 1];
  point.tangent = unit_direction(arc.walker(), curve->slope(zero.at));
  return point;
}

/// Takes out the zeros of one mode whose branch does not lead on.
std::size_t pass_over(const TestedStep& arc, const LeadsOn& leads_on, TestedZeros& singular) {
  if (!leads_on) return 0;
  return std::erase_if(singular.zeros, [&](const ZeroOf& zero) {
    const auto point = point_on_curve(arc, zero);
    const auto E = point ? arc.matrix(*point) : std::nullopt;
    if (!E || (singular.order > 1 && !is_of_one_mode(*E))) return false;
    const Vector null = weakest_borders(*E).C.col(0);
    const Index n = null.size() - 1;
    return !leads_on(*point, {null.head(n), null[n]});
  });
}

/// What is said of a branch point beside itself when rounding does not let it be placed to 1e-10.
std::optional<Hit> inexact_place(const Hit& hit, double off) {
  const double scale = std::max(1.0, size_of(hit.point));
  if (hit.kind != HitKind::branch_point || off <= promised_place * scale) return std::nullopt;
  Hit doubt = hit;
  doubt.kind = HitKind::inexact;
  doubt.name = "rounding lets the branch point be placed to " + rounded(off) + " only";
  doubt.multiplicity = 0;
  return doubt;
}

}  // namespace

std::optional<WideStep> widened(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                                double noise) {
  for (const double times : {clear_of_rounding, near_share * clear_of_rounding})
    if (auto wide = widened_to(walker, from, to, times * noise)) return wide;
  return std::nullopt;
}

std::optional<std::vector<ZeroOf>> turns_on_widened(const Walker& walker, const CurvePoint& from,
                                                    const CurvePoint& to, double high,
                                                    double noise) {
  const auto wide = widened(walker, from, to, noise);
  if (!wide) return std::nullopt;
  const double length = wide->to.s - wide->from.s;
  const TestedStep arc(walker, wide->from, length);
  const ZeroSearch found = find_zeros([&](double ds) { return arc.rate(ds); }, 0, length, noise,
                                      same_point, NoiseIs::bound);
  if (!found.resolved) return std::nullopt;
  std::vector<ZeroOf> turns;
  for (ZeroOf turn : found.zeros) {
    const auto& point = arc.point(turn.at);
    if (!point) return std::nullopt;
    const double moved = way_to(walker.weights, from, *point) - turn.at;
    turn.at += moved;
    turn.before += moved;
    turn.after += moved;
    if (turn.touches) turn.at = settled_on_step(turn);
    if (turn.at > 0 && turn.at <= high) turns.push_back(turn);
  }
  return turns;
}

StepEvents singular_points(const TestedStep& arc, Samples samples, const LeadsOn& leads_on) {
  StepEvents result;
  const CurvePoint& to = *samples.back();
  const TraceOptions& options = arc.walker().options;
  TestedZeros turns = turns_on(arc, samples);
  TestedZeros singular = singularities_on(arc, samples);
  if (!turns.resolved || !singular.resolved) {
    result.flat = turns.flat && singular.resolved && singular.zeros.empty();
    result.doubt = result.flat ? "lambda stands still to rounding, it may turn here several times"
                               : "special points too close together";
    return result;
  }
  const std::size_t passed_over = pass_over(arc, leads_on, singular);
  if (passed_over > 0 && singular.zeros.empty() && turns.zeros.empty()) return result;
  std::vector<Candidate> found;
  if (!add_branch_points(arc, singular, turns.zeros, found) ||
      !add_limit_points(arc, turns.zeros, found)) {
    result.doubt = "special point not resolved";
    result.passing = arc.passing();
    result.unexplained = static_cast<int>(std::max<std::size_t>(1, singular.zeros.size()));
    return result;
  }
  std::erase_if(found, [](const Candidate& c) { return !(c.at > one_place); });  // the start itself
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.at < b.at; });
  if (!found.empty() && found.back().at > (1 - beyond) * arc.length()) {
    result.doubt = "step ends at a special point";
    return result;
  }
  if (singular.examined && !is_determined(arc, to)) {
    result.doubt = "rounding does not determine the point at the end of the step";
    return result;
  }
  if (options.limit_points && options.branch_points && passed_over == 0)
    result.doubt = accounting(arc, found, to);
  if (!result.doubt.empty()) return result;
  for (Candidate& candidate : found) {
    const double off = candidate.off;
    result.hits.push_back(hit_of(arc, std::move(candidate)));
    if (auto doubt = inexact_place(result.hits.back(), off)) result.hits.push_back(*doubt);
  }
  return result;
}

}  // namespace springfold::continuation
