// The study kind `critical_curve`.
#include <algorithm>
#include <cmath>
#include <functional>

#include "critical_kinks.hpp"
#include "critical_rows.hpp"
#include "critical_runs.hpp"
#include "critical_starts.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/parameters/imperfection.hpp"
#include "switching_starts.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::Degeneracy;

std::string list_of(const BasePath& path) {
  std::string names;
  for (const SpecialPoint& point : path.points) names += (names.empty() ? "" : ", ") + point.label;
  return names.empty() ? "none" : names;
}

/// Does the parameter keep the branch point, to first and to second order?
bool is_kept(const continuation::Family& family, const continuation::CriticalStart& start) {
  if (!critical_rate(family, start)) return false;
  const auto force = second_order_force(family, start);
  return !force || force->lpNorm<Eigen::Infinity>() == 0;
}

/// A parameter that breaks the branch makes limit points of its branch point: their curve leads through it.
FollowedCurve limit_points_through(const CaseCurves& curves, const Study& study,
                                   continuation::CriticalStart start, const Observer& observer) {
  if (const auto exact = polish_critical(curves.family(), start)) {
    start.x = exact->x;
    start.lambda = exact->lambda;
  }
  start.kind = continuation::CriticalKind::limit_point;
  start.freed = {};
  return follow_both_ways(curves, base_study(study), {start}, EventKind::limit_point, observer);
}

/// Pieces of a critical curve beyond each of its ends.
constexpr int most_pieces_beyond = 40;
/// They begin this far, of the parameter, behind the place where two of them meet, which is located to a thousandth of
/// it.
constexpr double share_beside = 1e-6;
/// As degeneracies are located.
constexpr double same_meeting = share_beside / 1000;

/// Which switch is zero where the curve ends? Nothing where several are.
std::optional<Index> switch_at(const Member& member, const CriticalHit& hit) {
  Vector g;
  if (!member.problem->switches(hit.point.x, hit.point.lambda, g)) return std::nullopt;
  std::optional<Index> found;
  for (Index j = 0; j < g.size(); ++j) {
    if (std::abs(g[j]) > same_meeting) continue;
    if (found) return std::nullopt;
    found = j;
  }
  return found;
}

/// How far lambda, or the force where that turns back, rises where the switch does, on one piece: its sign, positive or
/// negative.
double slope_across(const Member& member, const continuation::CriticalStart& p,
                    const Piece& piece) {
  continuation::Linearisation at;
  Matrix dg_dx;
  Vector dg_dlambda;
  const PathProblem& problem = *member.problem;
  if (!continuation::linearise_densely(problem, p.x, p.lambda, piece, at) ||
      !problem.switch_gradients(p.x, p.lambda, dg_dx, dg_dlambda))
    return std::nan("");
  const Index n = p.x.size();
  Matrix J(n, n + 1);
  J << at.dF_dx, at.dF_dlambda;
  const Vector t = jacobi_svd(J, SingularVectors::none, SingularVectors::full).V.col(n);
  const Index j = p.switching;
  std::optional<double> rate = t[n];
  if (p.turns)
    rate = p.turns({.x = p.x, .lambda = p.lambda, .tangent = {t.head(n), t[n]}, .piece = piece},
                   member.mu);
  return rate.value_or(std::nan("")) * (dg_dx.row(j).dot(t.head(n)) + dg_dlambda[j] * t[n]);
}

bool ends_limit_corner(const CriticalHit& hit) {
  return hit.kind == Degeneracy::fold_meets_activation ||
         hit.kind == Degeneracy::corner_loses_reversal || hit.kind == Degeneracy::touches_surface;
}

/// A corner is a limit point only as far as lambda turns back there.
void end_at_last_reversal(CriticalCurve& curve) {
  const auto end = std::find_if(curve.hits.begin(), curve.hits.end(), ends_limit_corner);
  if (end == curve.hits.end()) return;
  const double s = end->point.s;
  curve.stop = continuation::StopReason::event;
  curve.stop_detail = std::string{to_string(end->kind)};
  curve.hits.erase(end + 1, curve.hits.end());
  std::erase_if(curve.points, [&](const CriticalPoint& p) { return p.s > s; });
}

/// What is followed beyond thresholds.
enum class FollowedKind { limit_points, limit_points_of_force, marked_values };

FollowedKind followed_kind(const SpecialPoint& point, const continuation::CriticalStart& start) {
  if (point.kind == EventKind::user_value) return FollowedKind::marked_values;
  const bool is_zero = start.kind == continuation::CriticalKind::zero;
  return point.kind == EventKind::limit_point && is_zero ? FollowedKind::limit_points_of_force
                                                         : FollowedKind::limit_points;
}

/// Limit points go on beyond another spring's threshold: as corners at it, as long as lambda turns back there, and from
/// where it no longer does as limit points of the piece behind. Marked values go on as the same on the piece behind.
class Beyond {
 public:
  /// @param pieces  that are followed, one per branch of the result
  Beyond(const CaseCurves& curves, const Study& study, const Observer& observer,
         const CriticalOrigin& origin, StudyResult& result, std::vector<FollowedCurve>& pieces)
      : curves_{curves},
        study_{base_study(study)},
        observer_{observer},
        kind_{followed_kind(origin.point, pieces.front().start)},
        value_on_{[&](const Piece& piece) {
          return marked_value_on(curves, *origin.member, origin.point, piece);
        }},
        result_{result},
        pieces_{pieces} {}

  /// Pieces behind one end of a curve of limit points. @param other  what ends its other side
  /// @returns whether they come round to the other end
  bool follow(const continuation::CriticalStart& start, const CriticalCurve& side,
              const CriticalHit* other) {
    FollowedCurve last{.start = start, .growing = side};
    for (int piece = 0; piece < most_pieces_beyond; ++piece) {
      const auto begins = starts_behind(last);
      if (begins.empty()) return false;
      const std::string end = last.growing.stop_detail;
      if (std::none_of(begins.begin(), begins.end(),
                       [&](const auto& begin) { return take_way(begin, last); })) {
        result_.doubts.push_back("nothing was found to go on behind: " + end);
        return false;
      }
      const auto& hits = last.growing.hits;
      if (other != nullptr && !hits.empty() && is_same(hits.back().point, other->point))
        return true;
    }
    result_.doubts.push_back("the curve has more pieces beyond thresholds than are followed");
    return false;
  }

 private:
  static bool is_same(const CriticalPoint& a, const CriticalPoint& b) {
    return (a.x - b.x).lpNorm<Eigen::Infinity>() <= same_meeting &&
           std::abs(a.lambda - b.lambda) <= same_meeting && std::abs(a.mu - b.mu) <= same_meeting;
  }

  /// What may follow; nothing where the curve ends for another reason. Behind a threshold where the stiffness does not
  /// change the limit point is one of the next piece.
  std::vector<continuation::CriticalStart> starts_behind(const FollowedCurve& last) const {
    const CriticalCurve& curve = last.growing;
    if (curve.stop != continuation::StopReason::event || curve.hits.empty()) return {};
    const CriticalHit& hit = curve.hits.back();
    continuation::CriticalStart next = last.start;
    next.x = hit.point.x;
    next.lambda = hit.point.lambda;
    next.mu = hit.point.mu;
    if (last.start.kind == continuation::CriticalKind::surface) {
      if (!ends_limit_corner(hit) || hit.kind == Degeneracy::touches_surface) return {};
      if (hit.kind == Degeneracy::corner_loses_reversal) next.piece = last.start.behind;
      return {of_piece(next, next.piece)};
    }
    const Member* member = curves_.equations_at(hit.point.mu);
    if (hit.kind != Degeneracy::fold_meets_activation || member == nullptr) return {};
    next.kind = continuation::CriticalKind::surface;
    const auto switching = switch_at(*member, hit);
    if (!switching) return {};
    next.switching = *switching;
    next.behind = next.piece;
    auto& behind = next.behind[static_cast<std::size_t>(next.switching)];
    behind = static_cast<std::int8_t>(-behind);
    const continuation::CriticalStart same = of_piece(next, next.behind);
    if (kind_ == FollowedKind::marked_values) return {same};
    next.value = {};
    if (kind_ == FollowedKind::limit_points_of_force) next.turns = force_turns(curves_);
    return {next, same};
  }

  /// The same kind of point that is not at a threshold.
  continuation::CriticalStart of_piece(continuation::CriticalStart start, Piece piece) const {
    start.piece = std::move(piece);
    start.turns = {};
    start.kind = kind_ == FollowedKind::limit_points ? continuation::CriticalKind::limit_point
                                                     : continuation::CriticalKind::zero;
    if (kind_ == FollowedKind::marked_values) start.value = value_on_(start.piece);
    if (kind_ == FollowedKind::limit_points_of_force)
      make_limit_of_force(
          curves_, {.x = start.x, .lambda = start.lambda, .tangent = {}, .piece = start.piece},
          start);
    return start;
  }

  /// The way on which there are limit points. @returns false where there is none
  bool take_way(const continuation::CriticalStart& start, FollowedCurve& last) {
    const double away = share_beside * std::max(std::abs(start.mu), 1e-3);
    for (const double way : {1.0, -1.0}) {
      continuation::CriticalStart next = start;
      next.mu += way * away;
      if (curves_.equations_at(next.mu) == nullptr) continue;
      const auto point = polish_critical(curves_.family(), next);
      if (!point) continue;
      next.x = point->x;
      next.lambda = point->lambda;
      if (!is_there(next)) continue;
      follow_on(start, next, way > 0, last);
      return true;
    }
    return false;
  }

  /// Does lambda turn back at the corner, or does the point lie where its piece holds?
  bool is_there(const continuation::CriticalStart& at) const {
    const Member& member = *curves_.equations_at(at.mu);
    const Index j = at.switching;
    if (at.kind == continuation::CriticalKind::surface)
      return slope_across(member, at, at.piece) * slope_across(member, at, at.behind) < 0;
    Vector g;
    return member.problem->switches(at.x, at.lambda, g) &&
           g[j] * at.piece[static_cast<std::size_t>(j)] > 0;
  }

  /// From `next`, a little behind `start`.
  void follow_on(const continuation::CriticalStart& start, const continuation::CriticalStart& next,
                 bool growing, FollowedCurve& last) {
    const auto events = critical_events(curves_, study_, start.piece);
    const auto observe = [&](const CriticalPoint& p) { return !observer_ || observer_(0, p.s); };
    const continuation::FurtherPoints further{.spacing = study_.trace.spacing,
                                              .most = most_rows(curves_)};
    FollowedCurve piece{.start = next, .of = last.of};
    if (next.kind != continuation::CriticalKind::surface && kind_ != FollowedKind::marked_values)
      piece.of = EventKind::limit_point;
    CriticalCurve& curve = piece.growing;
    curve = follow_over_kinks(curves_, next, growing, events, critical_options(study_), observe,
                              further);
    say_why_it_stops(curves_, growing, curve);
    if (next.kind == continuation::CriticalKind::surface) {
      piece.of = EventKind::corner_limit_point;
      end_at_last_reversal(curve);
    }
    if (!curve.points.empty()) {
      CriticalPoint first = curve.points.front();
      first.s =
          -std::hypot((next.x - start.x).norm(), next.lambda - start.lambda, next.mu - start.mu);
      first.x = start.x;
      first.lambda = start.lambda;
      first.mu = start.mu;
      curve.points.insert(curve.points.begin(), first);
    }
    piece.falling.points.assign(
        curve.points.begin(), curve.points.empty() ? curve.points.end() : curve.points.begin() + 1);
    piece.falling.stop = continuation::StopReason::event;
    piece.falling.stop_detail = "goes on from: " + (kind_ == FollowedKind::marked_values
                                                        ? std::string{"a spring switches here"}
                                                        : last.growing.stop_detail);
    for (std::string& doubt : doubts_of(curves_, study_, piece))
      result_.doubts.push_back(std::move(doubt));
    result_.branches.push_back(rows_of(curves_, piece));
    pieces_.push_back(piece);
    last = std::move(piece);
  }

  const CaseCurves& curves_;
  Study study_;
  const Observer& observer_;
  const FollowedKind kind_;
  const std::function<continuation::StateFunction(const Piece&)> value_on_;  ///< of marked values
  StudyResult& result_;
  std::vector<FollowedCurve>& pieces_;
};

/// Behind both ends; a closed chain of pieces is followed once.
/// @param pieces  the one that is followed; those beyond it are added
void go_on_beyond(const CaseCurves& curves, const Study& study, const CriticalOrigin& origin,
                  const Observer& observer, StudyResult& result,
                  std::vector<FollowedCurve>& pieces) {
  const FollowedCurve followed = pieces.front();
  const bool is_followed =
      origin.point.kind == EventKind::user_value || origin.point.kind == EventKind::limit_point;
  if (followed.start.kind != continuation::CriticalKind::limit_point &&
      !(followed.start.kind == continuation::CriticalKind::zero && is_followed))
    return;
  Beyond beyond(curves, study, observer, origin, result, pieces);
  const auto& other = followed.falling.hits;
  if (!beyond.follow(followed.start, followed.growing, other.empty() ? nullptr : &other.back()))
    beyond.follow(followed.start, followed.falling, nullptr);
}

void mark_branch_point(const SpecialPoint& point, Branch& branch) {
  const std::size_t columns = branch.samples.front().values.size();
  Event event{
      .kind = EventKind::branch_point,
      .detail = point.label + " of the case: limit points of its imperfect versions meet here",
      .row = branch.start_row,
      .rates_before = std::vector<double>(columns, std::nan("")),
      .rates_after = std::vector<double>(columns, std::nan(""))};
  const auto behind = std::find_if(branch.events.begin(), branch.events.end(),
                                   [&](const Event& e) { return e.row > branch.start_row; });
  branch.events.insert(behind, std::move(event));
}

}  // namespace

std::optional<CriticalOrigin> origin_on_path(const CaseCurves& curves, const BasePath& path,
                                             const Study& study, StartReport& report) {
  const Member& base = curves.base();
  const auto point =
      std::find_if(path.points.begin(), path.points.end(),
                   [&](const SpecialPoint& p) { return p.label == study.critical.point; });
  if (!path.problem.empty()) {
    refuse_start(path, report);
    return std::nullopt;
  }
  std::string why;
  if (point == path.points.end())
    why = "the curve has no " + study.critical.point + "; its special points: " + list_of(path) +
          early_ends(path.branch);
  CriticalOrigin origin;
  origin.member = &base;
  if (why.empty()) {
    origin.point = *point;
    origin.of = point->kind;
    origin.starts = critical_starts(curves, base, *point, why);
  }
  if (!origin.starts.empty()) return origin;
  report.found = false;
  report.message = why;
  report.where = std::string{to_string(study.kind)} + ".of";
  return std::nullopt;
}

std::vector<FollowedCurve> run_critical_curve(const CaseCurves& curves,
                                              const CriticalOrigin& origin, const Study& study,
                                              const Observer& observer, StudyResult& result) {
  FollowedCurve followed =
      follow_both_ways(curves, base_study(study), origin.starts, origin.of, observer);
  const continuation::CriticalStart& start = origin.starts.front();
  const bool is_broken = start.kind == continuation::CriticalKind::branch_point &&
                         start.corank == 1 && !(followed.growing.kept && followed.falling.kept) &&
                         !is_kept(curves.family(), start);
  if (is_broken) {
    followed = limit_points_through(curves, study, start, observer);
    followed.passed.clear();  // the branch point itself stands there
  } else if (origin.degeneracy) {
    begin_at_degeneracy(*origin.degeneracy, followed);
  }
  result.doubts = doubts_of(curves, study, followed);
  result.branches.push_back(rows_of(curves, followed));
  std::vector<FollowedCurve> pieces{std::move(followed)};
  go_on_beyond(curves, study, origin, observer, result, pieces);
  if (is_broken && !result.branches.front().samples.empty())
    mark_branch_point(origin.point, result.branches.front());
  label_critical(result.branches);
  if (result.branches.front().samples.empty()) {
    result.branches.clear();
    result.start.found = false;
    result.start.message = origin.point.label + ": " + critical_stop(pieces.front().growing).reason;
  }
  return pieces;
}

}  // namespace springfold::analysis
