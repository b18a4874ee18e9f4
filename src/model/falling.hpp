// Does a law fall somewhere? Private to model.
#pragma once

#include <optional>

#include "springfold/model/spring_law.hpp"

namespace springfold::model {

/// A stretch of deformations within its range on which the polynomial falls; endless where it does not end.
/// Exact, also for an endless range.
std::optional<DeformationRange> falling_stretch(const PolynomialSpring& law);

/// The stretch nearest to 0 of deformations within its range on which the formula falls. Looked for at many places and
/// at the least stiffness between them: what is found is sure, a narrow dip may be missed.
std::optional<DeformationRange> falling_stretch(const FormulaSpring& law);

}  // namespace springfold::model
