// How large the quantities of a run are, so that rounding can be told from values. Private to io.
#pragma once

#include <vector>

#include "springfold/analysis/result.hpp"

namespace springfold::io {

/// Per quantity what its rounding is measured by: the size that the values of its unit (of a pure number: its own)
/// usually have in the run, without the largest quarter of the rows, which may be singular; and at least that of what
/// it is made of (a moment: force times length; an angle: 1 rad). Against it, shown_against tells what is zero.
std::vector<double> quantity_sizes(const analysis::StudyResult& result);

/// Of one quantity alone: other columns are looked at only where they count for it.
double quantity_size(const analysis::StudyResult& result, std::size_t column);

/// The value against the sizes of a result; the value itself where there are none.
double shown_in(const std::vector<double>& sizes, std::size_t column, double value);

}  // namespace springfold::io
