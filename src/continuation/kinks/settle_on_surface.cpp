// The place of a kink by equations of its own.
#include <algorithm>
#include <cmath>

#include "continuation/kinks/kink.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::continuation {
namespace {

/// One step of Newton's method at a point of the surface of switch j, in equilibrated unknowns and rows:
///     | dF_dx  dF_dlambda | | dx      |       | F   |
///     | dg_dx  dg_dlambda | | dlambda |  =  - | g_j |
std::optional<Direction> step_to_surface(const Walker& walker, const CurvePoint& p, Index j) {
  const Index n = p.x.size();
  Linearisation at;
  Vector F, g, dg_dlambda;
  Matrix dg_dx, M(n + 1, n + 1);
  if (!walker.problem.residual(p.x, p.lambda, p.piece, F) ||
      !linearise_densely(walker.problem, p.x, p.lambda, p.piece, at) ||
      !walker.problem.switches(p.x, p.lambda, g) ||
      !walker.problem.switch_gradients(p.x, p.lambda, dg_dx, dg_dlambda))
    return std::nullopt;
  M << at.dF_dx, at.dF_dlambda, dg_dx.row(j), dg_dlambda[j];
  Vector right(n + 1);
  right << -F, -g[j];
  const Equilibration scale = equilibrate(M.cwiseAbs());
  const Lu lu(scale.rows.asDiagonal() * M * scale.columns.asDiagonal());
  const Vector step = scale.columns.cwiseProduct(lu.solve(scale.rows.cwiseProduct(right)));
  if (!step.allFinite()) return std::nullopt;
  return Direction{step.head(n), step[n]};
}

}  // namespace

void settle_on_surface(const Walker& walker, const CurvePoint& from, KinkSearch& kink) {
  if (kink.active.size() != 1 || kink.singular || walker.problem.structured()) return;
  CurvePoint point = kink.point;
  double moved = 0;
  const bool settled = settles(4, [&](double) -> std::optional<IterationStep> {
    const auto step = step_to_surface(walker, point, kink.active.front());
    if (!step) return std::nullopt;
    point.x += step->dx;
    point.lambda += step->dlambda;
    const double length = length_of(walker, *step), size = std::max(1.0, size_of(point));
    moved += length;
    if (!(moved <= same_point * size)) return std::nullopt;
    return IterationStep{length, rounding_unit * size, same_point * size};
  });
  LinearisedPoint* place =
      settled ? linearised_at(walker.problem, *walker.memory, point.x, point.lambda, point.piece)
              : nullptr;
  if (place == nullptr ||
      !tangent_at(*walker.memory, *place, walker.weights, kink.point.tangent, point.tangent) ||
      !(cosine(walker, point.tangent, kink.point.tangent) > same_way))
    return;
  point.s = from.s + std::max(0.0, way_to(walker.weights, from, point));
  if (walker.problem.symmetric()) point.negative = place->factors.negative();
  kink.before = std::min(kink.before, point.s - from.s);
  kink.after = std::max(kink.after, point.s - from.s);
  kink.point = std::move(point);
}

}  // namespace springfold::continuation
