// Unstable modes at critical points, besides what happens there. Private to analysis.
#pragma once

#include <vector>

#include "case_curves.hpp"

namespace springfold::analysis {

/// Counts of unstable modes in a row of a critical curve. Where modes vanish the sign of their eigenvalues is
/// rounding: they are not counted. Where a spring switches there is a count on either side: the smaller one are
/// the modes that are unstable whatever the spring does.
/// @param of  what is followed
void count_other_modes(const Member& member, const continuation::CriticalStart& of,
                       const continuation::CurvePoint& point, std::vector<double>& values);

}  // namespace springfold::analysis
