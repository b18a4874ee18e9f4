#include "springfold/core/linearisation.hpp"

#include "springfold/core/inertia.hpp"

namespace springfold {

Vector product(const Linearisation& at, const Vector& v) {
  return at.structured ? product(*at.structured, v) : Vector(at.dF_dx * v);
}

Vector magnitudes(const Linearisation& at, const Vector& v) {
  return at.structured ? magnitudes(*at.structured, v) : Vector(at.dF_dx.cwiseAbs() * v.cwiseAbs());
}

std::optional<Index> negative_eigenvalues(const Linearisation& at) {
  const auto inertia = at.structured ? at.structured->inertia() : inertia_of(at.dF_dx);
  if (!inertia || inertia->zero > 0) return std::nullopt;
  return inertia->negative;
}

}  // namespace springfold
