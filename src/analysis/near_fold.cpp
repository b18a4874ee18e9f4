#include "near_fold.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Only what is so soft beside the stiffest mode, or one unit of a problem without dimensions, can be near to a fold:
/// the root of what loads are known to, times a hundred.
constexpr double nearly_soft = 1e-3;
/// Way along the mode over which the rate of its stiffness is taken.
constexpr double way_of_rate = 1e-3;

}  // namespace

bool is_at_own_fold(const Landscape& landscape, const Ground& at) {
  if (at.hessian.size() == 0) return false;
  const SymmetricEigen modes = symmetric_eigen(at.hessian);
  const double k = modes.values[0];
  if (std::abs(k) > nearly_soft * std::max(1.0, modes.values.cwiseAbs().maxCoeff())) return false;
  const Vector mode = modes.vectors.col(0);
  const auto softest_at = [&](double way) -> std::optional<double> {
    const auto x = landscape.moved(at, way * mode);
    const auto there = x ? landscape.ground_on(*x, at.piece) : std::nullopt;
    if (!there) return std::nullopt;
    return symmetric_eigenvalues(there->hessian)[0];
  };
  const auto above = softest_at(way_of_rate), below = softest_at(-way_of_rate);
  if (!above || !below) return false;
  const double rate = (*above - *below) / (2 * way_of_rate);
  return k * k < 2 * std::abs(rate) * continuation::promised_place;
}

}  // namespace springfold::analysis
