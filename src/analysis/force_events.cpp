#include "force_events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::analysis {
namespace {

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

/// Does the force stand still on a side of a switching? It then has no extremum there: where a contact with a power
/// above 1 that carries alone lets go, the force's rate falls to zero and stays there. A point beside it may be too
/// near to tell, two are not.
bool stands_still_beside(const Hit& place, const continuation::Curve& curve,
                         const Evaluator& evaluator) {
  const auto is_still = [&](const auto& first, const auto& last) {
    constexpr std::ptrdiff_t looked_at = 2;
    return last - first >= looked_at &&
           std::all_of(first, first + looked_at, [&](const continuation::CurvePoint& point) {
             return evaluator.force_rate(point).is_zero();
           });
  };
  const auto& points = curve.points;
  const auto behind = std::find_if(points.begin(), points.end(), [&](const auto& point) {
    return point.s > place.point.s + same_hit;
  });
  const auto before = std::find_if(points.rbegin(), points.rend(), [&](const auto& point) {
    return point.s < place.point.s - same_hit;
  });
  return is_still(behind, points.end()) || is_still(before, points.rend());
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
  const std::vector<Hit> all = curve.hits;
  std::erase_if(curve.hits, [&](const Hit& hit) {
    if (is_force_limit(hit))
      return is_met_at(hit, all, [](const Hit& h) { return h.kind == HitKind::branch_point; });
    return (has_tag(hit, dead_load_change) || has_tag(hit, driven_change)) &&
           is_met_at(hit, all,
                     [&](const Hit& h) { return h.kind != HitKind::user || is_force_limit(h); });
  });
  return curve;
}

}  // namespace springfold::analysis
