// Special points at a given second parameter. Private to the layer.
#pragma once

#include <optional>

#include "parameters/augmented.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// Unfolding coefficients above this: the parameter does not keep the branch [-].
inline constexpr double kept_within = root_of_rounding;

/// The minimally augmented system whose borders suit the start; nothing outside of the family's domain.
std::optional<Augmented> system_at(const Family& family, const CriticalStart& start);

/// Newton's method for X at a fixed mu.
std::optional<Vector> solve_at(const Augmented& system, Vector X, double mu);

}  // namespace springfold::continuation
