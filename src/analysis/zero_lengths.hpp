// Springs that are led through the length 0, where their force has no direction. Private to analysis.
#pragma once

#include "branch_rows.hpp"
#include "grow_diagram.hpp"

namespace springfold::analysis {

/// A body that is guided along the line of a spring can be driven through the place at which the spring has the length 0.
/// Its force turns round there at once, which no unknown of the path shows. The curve ends at the last point before, with
/// the spring's name as its reason. Springs without force at the length 0 pass.
void end_at_zero_lengths(const Tracing& tracing, BranchSource& source);

}  // namespace springfold::analysis
