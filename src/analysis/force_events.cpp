#include "force_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;

/// Hits closer than this in arc length are one point.
constexpr double same_hit = 1e-6;

bool has_tag(const Hit& hit, EventTag tag) { return hit.kind == HitKind::user && hit.tag == tag; }

template <class Test>
bool is_met_at(const Hit& place, const std::vector<Hit>& hits, const Test& test) {
  return std::any_of(hits.begin(), hits.end(), [&](const Hit& hit) {
    return std::abs(hit.point.s - place.point.s) <= same_hit && test(hit);
  });
}

/// The points of a curve beside a hit, told apart from it: the next one on each side with all that follow there.
struct Beside {
  std::vector<CurvePoint>::const_iterator behind{};
  std::vector<CurvePoint>::const_reverse_iterator before{};
};
Beside neighbours_of(const Hit& place, const continuation::Curve& curve) {
  const auto& points = curve.points;
  const double s = place.point.s;
  return {std::find_if(points.begin(), points.end(),
                       [&](const auto& point) { return point.s > s + same_hit; }),
          std::find_if(points.rbegin(), points.rend(),
                       [&](const auto& point) { return point.s < s - same_hit; })};
}

/// Does the force stand still on a side of a switching? It then has no extremum there: where a contact with a power
/// above 1 that carries alone lets go, the force's rate falls to zero and stays there. A point beside it may be too
/// near to tell, two are not.
bool stands_still_beside(const Hit& place, const continuation::Curve& curve,
                         const Evaluator& evaluator) {
  const auto is_still = [&](const auto& first, const auto& last) {
    constexpr std::ptrdiff_t looked_at = 2;
    return last - first >= looked_at &&
           std::all_of(first, first + looked_at, [&](const CurvePoint& point) {
             return evaluator.force_rate(point).is_zero();
           });
  };
  const auto [behind, before] = neighbours_of(place, curve);
  return is_still(behind, curve.points.end()) || is_still(before, curve.points.rend());
}

/// What is stable under its load is so if the displacement along the load is driven: between two stable points with
/// nothing else between them that cannot turn back, and a change of its rate's sign is rounding.
bool is_between_stable_points(const Hit& place, const continuation::Curve& curve,
                              const Evaluator& evaluator) {
  const auto beside = neighbours_of(place, curve);
  if (beside.behind == curve.points.end() || beside.before == curve.points.rend()) return false;
  const CurvePoint &before = *beside.before, &behind = *beside.behind;
  const bool is_alone = std::none_of(curve.hits.begin(), curve.hits.end(), [&](const Hit& hit) {
    return hit.kind != HitKind::user && before.s <= hit.point.s && hit.point.s <= behind.s;
  });
  const QuantityDefinition index{QuantityDefinition::Kind::index, 0, "index", Unit::none, 1};
  return is_alone && evaluator.unstable_modes(index, before) == 0 &&
         evaluator.unstable_modes(index, behind) == 0;
}

}  // namespace

continuation::Event dead_load_event(const Evaluator& evaluator) {
  struct Kept {
    // The same all along the curve, so that the determinant is smooth; they keep it within the range of numbers.
    Vector factors{};
    statics::Workspace work{};
    Vector z{}, r{};
    Matrix A{};
    Lu lu{};
  };
  const auto value = [&problem = evaluator.problem(),
                      kept = std::make_shared<Kept>()](const continuation::CurvePoint& point) {
    auto& [factors, work, z, r, A, lu] = *kept;
    const statics::System& system = problem.turned_to_pose(point.x, point.lambda, z);
    if (!equilibrium_matrix(system, point.piece, z, problem.inputs(point.lambda), work, r, A))
      return std::numeric_limits<double>::quiet_NaN();
    if (factors.size() == 0) factors = equilibrate(A).rows;
    // Where nothing holds the body, as on cables that are all slack, it is zero all along.
    constexpr double singular = 1e-14;
    A = factors.asDiagonal() * A * factors.asDiagonal();
    lu.compute(A);
    return lu.reciprocal_condition() > singular ? lu.determinant() : 0.0;
  };
  return {dead_load_change_name, value, continuation::EventAction::record, dead_load_change};
}

continuation::Curve with_merged_force_events(continuation::Curve curve,
                                             const Evaluator& evaluator) {
  const auto is_force_limit = [](const Hit& hit) { return has_tag(hit, force_limit); };
  const auto is_switching = [](const Hit& hit) { return hit.kind == HitKind::kink; };
  const std::vector<Hit> found = curve.hits;
  std::erase_if(curve.hits, [&](const Hit& hit) {
    return is_force_limit(hit) && is_met_at(hit, found, is_switching) &&
           stands_still_beside(hit, curve, evaluator);
  });
  for (Hit& hit : curve.hits)
    if (hit.kind == HitKind::branch_point && is_met_at(hit, curve.hits, is_force_limit)) {
      hit.name += ", the force turns back";
      hit.tag = force_limit;
    }
  std::erase_if(curve.hits, [&](const Hit& hit) {
    return has_tag(hit, driven_change) && is_between_stable_points(hit, curve, evaluator);
  });
  const auto is_more = [&](const Hit& place) {
    return is_met_at(place, curve.hits, [&](const Hit& hit) {
      return is_force_limit(place) ? hit.kind == HitKind::branch_point
                                   : hit.kind != HitKind::user || is_force_limit(hit);
    });
  };
  std::vector<Hit> kept;
  for (const Hit& hit : curve.hits) {
    const bool is_told_by_sign =
        is_force_limit(hit) || has_tag(hit, dead_load_change) || has_tag(hit, driven_change);
    if (!is_told_by_sign ||
        !(is_more(hit) || is_beside_branch_end(curve, hit.point, evaluator.problem())))
      kept.push_back(hit);
  }
  curve.hits = std::move(kept);
  return curve;
}

bool is_beside_branch_end(const continuation::Curve& curve, const continuation::CurvePoint& point,
                          const PathProblem& problem) {
  const auto& points = curve.points;
  if (points.size() < 2) return false;
  const auto singular_values = [&](const continuation::CurvePoint& at) -> Vector {
    continuation::Linearisation linear;
    if (!continuation::linearise_densely(problem, at.x, at.lambda, at.piece, linear)) return {};
    Matrix both(linear.dF_dx.rows(), linear.dF_dx.cols() + 1);
    both << linear.dF_dx, linear.dF_dlambda;
    return jacobi_svd(both).values;
  };
  // All of a small problem may vanish there: what it is measured by is beside it.
  const auto is_branch_point = [&](const continuation::CurvePoint& end,
                                   const continuation::CurvePoint& beside) {
    const Vector here = singular_values(end), there = singular_values(beside);
    return here.size() > 0 && there.size() > 0 &&
           here[here.size() - 1] <= continuation::located_rank * std::max(here[0], there[0]);
  };
  const auto is_near = [&](const continuation::CurvePoint& end) {
    return std::abs(point.s - end.s) < continuation::told_apart;
  };
  // A curve that has joined another one ends at the special point there, behind its last own point.
  const bool ends_at_hit = !curve.hits.empty() && curve.hits.back().point.s > points.back().s;
  const continuation::CurvePoint& last = ends_at_hit ? curve.hits.back().point : points.back();
  return (is_near(points.front()) && is_branch_point(points.front(), points[1])) ||
         (is_near(last) && is_branch_point(last, points[points.size() - 2]));
}

}  // namespace springfold::analysis
