#include "switching_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "freed_body.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalKind;
using continuation::CriticalStart;
using continuation::CurvePoint;
using continuation::Hit;

/// Springs that switch at once move on together with a parameter where their rates differ by no more.
constexpr double same_rate = 1e-8;

/// Members so far beside, in steps of the family, show whether springs go on to rest: farther ones tell small changes
/// from rounding, nearer ones lie on one side of what else happens beside.
constexpr std::array<double, 3> steps_beside{1, 0x1p-3, 0x1p-6};

/// Switches that are no larger are zero, as the engine tells them.
constexpr double zero_switch_there = continuation::TraceOptions{}.simultaneous;

bool are_zero(const PathProblem& problem, const std::vector<Index>& switches, const Vector& x,
              double lambda, double zero) {
  Vector g;
  return problem.switches(x, lambda, g) &&
         std::all_of(switches.begin(), switches.end(),
                     [&](Index j) { return std::abs(g[j]) <= zero; });
}

/// The point of the curve of its piece at this distance along the tangent.
continuation::NewtonResult point_beside(const PathProblem& problem, const CurvePoint& at,
                                        double ds) {
  return continuation::correct(problem, problem.metric(), at.x + ds * at.tangent.dx,
                               at.lambda + ds * at.tangent.dlambda, at.piece, at.tangent, {});
}

/// Are the switches zero at a point, and on the curve of its piece on both sides of it? Some way off: a curve that only
/// touches a surface has left it there.
bool rest_along(const PathProblem& problem, const std::vector<Index>& switches,
                const CurvePoint& at, double zero = zero_switch_there) {
  if (!are_zero(problem, switches, at.x, at.lambda, zero)) return false;
  bool seen = false;
  for (const double ds : {continuation::level_reach, -continuation::level_reach}) {
    const auto there = point_beside(problem, at, ds);
    if (!converged(there)) continue;
    if (!are_zero(problem, switches, there.x, there.lambda, zero)) return false;
    seen = true;
  }
  return seen;
}

/// Does the parameter keep the point, with its springs at rest, on either side of its value on which there are members?
/// @param path  the point on the path, in its own piece
bool keeps_rest(const CaseCurves& curves, const CriticalStart& start, const CurvePoint& path) {
  const continuation::Family family = curves.family();
  const auto rests_at = [&](double mu, double zero) {
    CriticalStart beside = start;
    beside.mu = mu;
    const auto point = polish_critical(family, beside);
    const Member* member = curves.equations_at(mu);
    if (!point || member == nullptr) return false;
    CurvePoint at = path;
    at.x = point->x;
    at.lambda = point->lambda;
    return rest_along(*member->problem, start.resting, at, zero);
  };
  return std::any_of(steps_beside.begin(), steps_beside.end(), [&](double steps) {
    // What grows with the square of the step, or faster, is not zero at any of them.
    const double zero = zero_switch_there * steps * steps;
    int seen = 0;
    for (const double side : {-1.0, 1.0}) {
      const double mu = start.mu + side * steps * family.step;
      if (curves.equations_at(mu) == nullptr) continue;
      if (!rests_at(mu, zero)) return false;
      ++seen;
    }
    return seen > 0;
  });
}

/// Singular values of a piece's equations, falling; nothing where these are not defined.
std::optional<Vector> singular_values(const PathProblem& problem, const Vector& x, double lambda,
                                      const Piece& piece) {
  continuation::Linearisation linear;
  if (!continuation::linearise_densely(problem, x, lambda, piece, linear)) return std::nullopt;
  return jacobi_svd(linear.dF_dx).values;
}

/// How many eigenvalues of a piece vanish at a located point of the path? Beside stiff members all soft modes are
/// small: those that vanish are small beside what they are some way off.
int corank_of(const PathProblem& problem, const CurvePoint& at, const Piece& piece) {
  const auto here = singular_values(problem, at.x, at.lambda, piece);
  for (const double ds : {continuation::level_reach, -continuation::level_reach}) {
    const auto there = point_beside(problem, at, ds);
    const auto values = converged(there) ? singular_values(problem, there.x, there.lambda, piece)
                                         : std::optional<Vector>{};
    if (!here || !values) continue;
    const double rounding = continuation::between_samples * rounding_unit * (*here)[0];
    int count = 0;
    for (Index i = here->size() - 1; i >= 0; --i, ++count) {
      const double own = (*here)[i], beside = (*values)[i];
      if (own > continuation::small_share * beside ||
          own > std::max(continuation::poor * beside, rounding))
        break;
    }
    return count;
  }
  return 0;
}

}  // namespace

continuation::RateFunction force_turns(const CaseCurves& curves) {
  return [&curves](const CurvePoint& point, double mu) -> std::optional<double> {
    const auto followed = curves.followed_at(mu);
    if (!followed) return std::nullopt;
    return followed->evaluator->force_rate(point).value;
  };
}

std::vector<CriticalStart> starts_on_surfaces(const CaseCurves& curves,
                                              const std::vector<Index>& switches,
                                              CriticalStart start) {
  if (switches.empty()) return {};
  start.switching = switches.front();
  if (switches.size() == 1) return {start};
  std::vector<CriticalStart> starts;
  std::optional<continuation::CriticalPoint> first;
  bool together = true;
  for (const Index j : switches) {
    CriticalStart one = start;
    one.switching = j;
    one.behind = one.piece;
    auto& behind = one.behind[static_cast<std::size_t>(j)];
    behind = static_cast<std::int8_t>(-behind);
    const auto rate = critical_rate(curves.family(), one);
    if (!rate) return {};
    if (!first) first = rate;
    const double size =
        std::max({1.0, first->dx.lpNorm<Eigen::Infinity>(), std::abs(first->dlambda)});
    together = together && std::abs(rate->dlambda - first->dlambda) <= same_rate * size &&
               (rate->dx - first->dx).lpNorm<Eigen::Infinity>() <= same_rate * size;
    starts.push_back(std::move(one));
  }
  if (together) return {start};
  return starts;
}

std::vector<CriticalStart> starts_at_switching(const CaseCurves& curves, const SpecialPoint& point,
                                               CriticalStart start) {
  const Hit& hit = point.hit;
  if (hit.leaving.empty()) return {};
  start.kind = CriticalKind::surface;
  start.behind = hit.leaving.front().piece;
  if (point.kind == EventKind::corner_limit_point && hit.kind != continuation::HitKind::corner)
    start.turns = force_turns(curves);
  return starts_on_surfaces(curves, hit.switches, std::move(start));
}

std::string several_switch(const SpecialPoint& point) {
  return "several springs switch at " + point.label + " at once";
}

std::optional<CurvePoint> way_at_rest(const Member& member, const SpecialPoint& point) {
  const Hit& hit = point.hit;
  if (!is_at_switching(point.kind) || hit.switches.empty() || hit.leaving.empty())
    return std::nullopt;
  const auto rests = [&](const CurvePoint& way) {
    return rest_along(*member.problem, hit.switches, way);
  };
  if (hit.leaving.front().piece == hit.point.piece && rests(hit.point)) return hit.point;
  if (point.kind != EventKind::branching_kink) return std::nullopt;
  const auto found = std::find_if(hit.leaving.begin(), hit.leaving.end(), rests);
  if (found == hit.leaving.end()) return std::nullopt;
  return *found;
}

std::vector<Index> switches_at_rest(const Member& member, const SpecialPoint& point) {
  std::vector<Index> found;
  const CurvePoint& at = point.hit.point;
  Vector g;
  if (!member.problem->switches(at.x, at.lambda, g)) return found;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= zero_switch_there && rest_along(*member.problem, {j}, at))
      found.push_back(j);
  return found;
}

std::vector<Piece> pieces_at_rest(const Member& member, const SpecialPoint& point) {
  const Hit& hit = point.hit;
  std::vector<Piece> pieces;
  const auto add = [&](const CurvePoint& way) {
    if (!rest_along(*member.problem, hit.switches, way) &&
        std::find(pieces.begin(), pieces.end(), way.piece) == pieces.end())
      pieces.push_back(way.piece);
  };
  add(hit.point);
  for (const CurvePoint& way : hit.leaving) add(way);
  if (pieces.empty()) pieces.push_back(hit.point.piece);
  return pieces;
}

std::optional<CriticalStart> start_at_rest(const CaseCurves& curves, const Member& member,
                                           const SpecialPoint& point, const CurvePoint& at,
                                           std::string& why) {
  std::optional<CriticalStart> first;
  std::optional<continuation::CriticalPoint> rate_of_first;
  for (const Piece& piece : pieces_at_rest(member, point)) {
    CriticalStart start{.kind = CriticalKind::branch_point,
                        .x = at.x,
                        .lambda = at.lambda,
                        .mu = member.mu,
                        .piece = piece,
                        .corank = corank_of(*member.problem, at, piece),
                        .resting = point.hit.switches,
                        .freed = freed_of(curves)};
    if (start.corank == 0) {
      why = "half-branches leave " + point.label + ", and it is not known which modes vanish there";
      return std::nullopt;
    }
    if (!keeps_rest(curves, start, at)) {
      why = "springs rest at " + point.label + ", and not where " + curves.name() + " is another";
      return std::nullopt;
    }
    const auto rate = critical_rate(curves.family(), start);
    if (!first) {
      first = std::move(start);
      rate_of_first = rate;
    } else if (!rate || !rate_of_first ||
               std::abs(rate->dlambda - rate_of_first->dlambda) >
                   same_rate * std::max(1.0, std::abs(rate->dlambda))) {
      why = "half-branches leave " + point.label + " to several sides, and " + curves.name() +
            " parts them";
      return std::nullopt;
    }
  }
  return first;
}

}  // namespace springfold::analysis
