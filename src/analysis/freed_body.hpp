// The body of a study free along the direction in which it is driven. Private to analysis.
#pragma once

#include "case_curves.hpp"

namespace springfold::analysis {

/// The equations of the case's curves in which the displacement along the direction is free, and the force along it
/// given. Nothing where nothing is driven so, and where loads grow with the displacement. Refers to `curves`.
continuation::Freed freed_of(const CaseCurves& curves);

}  // namespace springfold::analysis
