#include "equimomental.hpp"

#include <cmath>

#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {

std::vector<PointOfMass> equimomental_points(double mass, const model::Mat3<double>& inertia) {
  const Matrix second = inertia.trace() / 2 * Matrix::Identity(3, 3) - inertia;
  const double total = second.trace();
  std::vector<PointOfMass> list;
  if (!(total > 0)) {
    if (mass != 0) list.push_back({.mass = mass});
    return list;
  }
  const double distance = mass > 0 ? std::sqrt(total / mass) : 1;
  const SymmetricEigen axes = symmetric_eigen(second);
  double sum = 0;
  for (Index i = 0; i < 3; ++i) {
    const double pair = axes.values[i] / (distance * distance);
    if (pair == 0) continue;
    sum += pair;
    for (const double side : {distance, -distance})
      list.push_back({.mass = pair / 2, .at = side * axes.vectors.col(i)});
  }
  if (!(mass > 0)) list.push_back({.mass = mass - sum});
  return list;
}

}  // namespace springfold::analysis
