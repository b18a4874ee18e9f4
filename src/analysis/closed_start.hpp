// Closed curves that begin on a special point. Private to analysis.
#pragma once

#include "branch_rows.hpp"

namespace springfold::analysis {

/// A closed curve that begins on a special point meets it when it leaves, when it comes back, or both times. Takes it
/// from the curve and lays the seam of the rows elsewhere: the second half of the curve becomes `backward`, so that the
/// point has a row on either side. A curve that comes back whole turns farther stays as it is.
/// @param source  its forward curve is closed
/// @returns the special points at the start, s = 0; plain switchings are left where they are
std::vector<continuation::Hit> opened_at_start(BranchSource& source, const Evaluator& evaluator);

}  // namespace springfold::analysis
