#include "critical_starts.hpp"

#include <algorithm>
#include <cmath>

#include "branch_rows.hpp"
#include "freed_body.hpp"
#include "limits.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/core/decompositions.hpp"
#include "switching_starts.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalKind;
using continuation::CriticalStart;
using continuation::CurvePoint;
using continuation::Direction;
using continuation::Hit;

/// A rate along the curve through a state, whose tangent has the sense of one at the special point.
using RateAt = std::function<double(const CaseCurves::Followed&, const CurvePoint&)>;
continuation::StateFunction rate_of(const CaseCurves& curves, Piece piece, Direction sense,
                                    RateAt rate) {
  return [&curves, piece = std::move(piece), sense = std::move(sense), rate = std::move(rate)](
             const Vector& x, double lambda, double mu) -> std::optional<double> {
    const auto followed = curves.followed_at(mu);
    if (!followed) return std::nullopt;
    continuation::Linearisation at;
    const PathProblem& problem = *followed->problem;
    if (!continuation::linearise_densely(problem, x, lambda, piece, at)) return std::nullopt;
    const auto tangent = continuation::tangent_at(at, problem.metric(), sense);
    if (!tangent) return std::nullopt;
    return rate(*followed, {.x = x, .lambda = lambda, .tangent = *tangent, .piece = piece});
  };
}

/// The rate of the column whose extremum the point is. Its curve may turn back in lambda: the tangent's sense is the
/// one there.
continuation::StateFunction column_rate_of(const CaseCurves& curves, const CurvePoint& at,
                                           const std::string& column) {
  return rate_of(curves, at.piece, at.tangent,
                 [column](const CaseCurves::Followed& at_point, const CurvePoint& point) {
                   const QuantityDefinition& quantity = *at_point.member->quantity(column);
                   return at_point.evaluator->rate(quantity, point).value;
                 });
}

/// One that is counted with lambda, the other way round where that falls.
continuation::StateFunction rate_by(const CaseCurves& curves, const CurvePoint& at,
                                    RoundedRate (Evaluator::*rate)(const CurvePoint&) const) {
  return rate_of(curves, at.piece, {Vector::Zero(at.x.size()), 1},
                 [rate](const CaseCurves::Followed& at_point, const CurvePoint& point) {
                   return (*at_point.evaluator.*rate)(point).value;
                 });
}

/// Zero where under the same loads, with no body held, another number of modes is unstable: the least singular value of
/// the matrix of all motions, with a sign.
continuation::StateFunction dead_load_value_of(const CaseCurves& curves, const Piece& piece) {
  return [&curves, piece](const Vector& x, double lambda, double mu) -> std::optional<double> {
    const auto followed = curves.followed_at(mu);
    if (!followed) return std::nullopt;
    const PathProblem& problem = *followed->problem;
    statics::Workspace work;
    Vector z, r;
    Matrix A;
    const statics::System& system = problem.turned_to_pose(x, lambda, z);
    if (!equilibrium_matrix(system, piece, z, problem.inputs(lambda), work, r, A))
      return std::nullopt;
    return signed_least(A);
  };
}

/// What is zero at a change of stability, along its curve. Nothing where it is not known.
continuation::StateFunction stability_value_of(const CaseCurves& curves, const SpecialPoint& point,
                                               const CurvePoint& at) {
  if (point.hit.tag == driven_change) return rate_by(curves, at, &Evaluator::displacement_rate);
  if (point.hit.tag == dead_load_change) return dead_load_value_of(curves, at.piece);
  return {};
}

/// Which of the study's extrema is this?
std::string column_of_extremum(const Study& study, const Hit& hit) {
  for (const std::string& name : study.extrema)
    if (hit.name == extremum_name(name)) return name;
  return {};
}

/// The study's marks of a quantity whose value is this one, by their numbers.
std::vector<std::size_t> marks_at(const Study& study, const QuantityDefinition& quantity,
                                  double value) {
  constexpr double same = 1e-9;  // marks are located far better
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < study.marks.size(); ++k)
    if (study.marks[k].quantity == quantity.name &&
        std::abs(study.marks[k].value - value) < same * quantity.scale)
      found.push_back(k);
  return found;
}

/// Marks may be formulas of the parameter: do these have one value beside the member, too?
bool stay_together(const CaseCurves& curves, const Member& member,
                   const std::vector<std::size_t>& marks) {
  if (marks.size() < 2) return true;
  const double value = member.study.marks[marks.front()].value;
  const Member* beside = curves.equations_at(member.mu + step_of_family);
  return beside == nullptr || std::all_of(marks.begin(), marks.end(), [&](std::size_t k) {
           return member.study.marks[k].value == value &&
                  beside->study.marks[k].value == beside->study.marks[marks.front()].value;
         });
}

/// A column less the mark that the special point is, or less its value there. @param piece  on which states are taken
continuation::StateFunction column_of(const CaseCurves& curves, const Member& member,
                                      const SpecialPoint& point, const Piece& piece) {
  const QuantityDefinition* quantity = member.quantity(point.hit.name);
  if (quantity == nullptr) return {};
  const auto value_at = [name = point.hit.name](const Member& at, const Vector& x, double lambda,
                                                const Piece& on) {
    return at.evaluator().value(*at.quantity(name), {.x = x, .lambda = lambda, .piece = on});
  };
  const CurvePoint& here = point.hit.point;
  const double located = value_at(member, here.x, here.lambda, here.piece);
  const std::vector<std::size_t> marks = marks_at(member.study, *quantity, located);
  // The mark itself, as the member has it, not what was located; that of an earlier study is a number.
  const bool is_own = member.study.name == curves.base().study.name;
  if (is_own && !stay_together(curves, member, marks)) return {};
  const auto wanted = [is_own, marks,
                       value = marks.empty() ? located : member.study.marks[marks.front()].value](
                          const Member& at) {
    return is_own && !marks.empty() ? at.study.marks[marks.front()].value : value;
  };
  return [&curves, value_at, wanted, piece, scale = quantity->scale](
             const Vector& x, double lambda, double mu) -> std::optional<double> {
    const Member* at = curves.equations_at(mu);
    if (at == nullptr) return std::nullopt;
    return (value_at(*at, x, lambda, piece) - wanted(*at)) / scale;
  };
}

/// The place of a special point, to be followed.
CriticalStart start_at(const Member& member, const SpecialPoint& point) {
  const CurvePoint& p = point.hit.point;
  return {.x = p.x, .lambda = p.lambda, .mu = member.mu, .piece = p.piece};
}

}  // namespace

void make_limit_of_force(const CaseCurves& curves, const CurvePoint& at, CriticalStart& start) {
  start.kind = CriticalKind::zero;
  start.value = rate_by(curves, at, &Evaluator::force_rate);
  start.freed = freed_of(curves);
}

continuation::StateFunction marked_value_on(const CaseCurves& curves, const Member& member,
                                            const SpecialPoint& point, const Piece& piece) {
  const Hit& hit = point.hit;
  if (hit.tag != column_extremum) return column_of(curves, member, point, piece);
  CurvePoint there = hit.point;
  there.piece = piece;
  return column_rate_of(curves, there, column_of_extremum(member.study, hit));
}

namespace {

/// Makes a start that of a special point that no matrix of the path tells: kind, what is zero there, and its equations.
/// What is zero is empty where it is not known.
/// @param here  a state, with the piece on which others are taken
void make_zero(const CaseCurves& curves, const Member& member, const SpecialPoint& point,
               const CurvePoint& here, CriticalStart& start) {
  start.kind = CriticalKind::zero;
  switch (point.kind) {
    case EventKind::limit_point:
      return make_limit_of_force(curves, here, start);
    case EventKind::stability_change:
      start.value = stability_value_of(curves, point, here);
      return;
    default:
      start.value = marked_value_on(curves, member, point, here.piece);
  }
}

}  // namespace

std::optional<CriticalStart> critical_start(const CaseCurves& curves, const Member& member,
                                            const SpecialPoint& point, std::string& why) {
  const Hit& hit = point.hit;
  CriticalStart start = start_at(member, point);
  if (!is_at_switching(point.kind)) start.resting = switches_at_rest(member, point);
  switch (point.kind) {
    case EventKind::limit_point:
      if (hit.kind == continuation::HitKind::limit_point) return start;
      make_zero(curves, member, point, hit.point, start);
      return start;
    case EventKind::branch_point:
      start.kind = CriticalKind::branch_point;
      start.corank = hit.multiplicity;
      if (auto turn = hilltop_start(curves.family(), start, hit.point.tangent)) return turn;
      start.freed = freed_of(curves);
      return start;
    case EventKind::switching:
    case EventKind::corner_limit_point:
    case EventKind::branching_kink:
      if (const auto way = way_at_rest(member, point))
        return start_at_rest(curves, member, point, *way, why);
      if (auto starts = starts_at_switching(curves, point, start); starts.size() == 1)
        return std::move(starts.front());
      why = several_switch(point);
      return std::nullopt;
    case EventKind::user_value:
      make_zero(curves, member, point, hit.point, start);
      if (start.value) return start;
      if (member.quantity(hit.name) == nullptr) break;
      why = point.label + ": several marks of " + hit.name +
            " have one value in the case, and the parameter parts them";
      return std::nullopt;
    case EventKind::stability_change:
      make_zero(curves, member, point, hit.point, start);
      if (start.value) return start;
      break;
    default:
      break;
  }
  why = point.label +
        " is of a kind that is not followed: need a limit point, branch point, corner, " +
        "activation, change of stability, marked value or extremum";
  return std::nullopt;
}

std::vector<CriticalStart> critical_starts(const CaseCurves& curves, const Member& member,
                                           const SpecialPoint& point, std::string& why) {
  const bool switches = is_at_switching(point.kind);
  const auto way = switches ? way_at_rest(member, point) : std::nullopt;
  if (switches && !way) {
    auto starts = starts_at_switching(curves, point, start_at(member, point));
    if (starts.empty()) why = several_switch(point);
    return starts;
  }
  auto start = way ? start_at_rest(curves, member, point, *way, why)
                   : critical_start(curves, member, point, why);
  if (!start) return {};
  return {std::move(*start)};
}

std::vector<CriticalStart> critical_starts_again(const CaseCurves& curves, const Member& member,
                                                 const SpecialPoint& point, CriticalStart same) {
  if (same.kind == CriticalKind::zero) {
    const CurvePoint here{.x = same.x, .lambda = same.lambda, .piece = same.piece};
    make_zero(curves, member, point, here, same);
  }
  if (same.kind == CriticalKind::branch_point) same.freed = freed_of(curves);
  if (same.kind != CriticalKind::surface) return {std::move(same)};
  if (same.turns) same.turns = force_turns(curves);
  std::vector<Index> switches;
  for (std::size_t j = 0; j < same.piece.size(); ++j)
    if (same.piece[j] != same.behind[j]) switches.push_back(static_cast<Index>(j));
  return starts_on_surfaces(curves, switches, std::move(same));
}

}  // namespace springfold::analysis
