#include "continuation/locating/equilibrated.hpp"

#include "continuation/locating/reduced_equation.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::continuation {

std::optional<EquilibratedJacobian> equilibrated_jacobian(const Walker& walker,
                                                          const CurvePoint& at) {
  const Vector root = metric_roots(walker.weights), U = scaled_point(at, root);
  const auto J = scaled_jacobian(walker, U, root, at.piece);
  if (!J) return std::nullopt;
  // How far away, and how much of what changes there counts.
  constexpr double aside = small_share, counts = negligible_share;
  Matrix sizes = J->cwiseAbs();
  const Vector direction = Vector::LinSpaced(U.size(), 1, 2).normalized();
  for (const double h : {-aside, aside})
    if (const auto other = scaled_jacobian(walker, U + h * direction, root, at.piece))
      sizes = sizes.cwiseMax(counts * (*other - *J).cwiseAbs());
  const Equilibration scale = equilibrate(sizes);
  return EquilibratedJacobian{scale.rows.asDiagonal() * *J * scale.columns.asDiagonal(),
                              scale.columns.cwiseQuotient(root)};
}

}  // namespace springfold::continuation
