// Does a law fall somewhere? Private to model.
#pragma once

#include <optional>

#include "springfold/model/spring_law.hpp"

namespace springfold::model {

/// A deformation within its range at which the polynomial falls: exact, also for an endless range.
std::optional<double> falls_at(const PolynomialSpring& law);

/// A deformation within its range at which the formula falls. Looked for at many places and at the least
/// stiffness between them: what is found is sure, a narrow dip may be missed.
std::optional<double> falls_at(const FormulaSpring& law);

}  // namespace springfold::model
