// Special points of a branch in the summary. Private to io.
#pragma once

#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"

namespace springfold::io {

/// Empty where the quantity is not defined, as in the tables.
std::string point_number(double value);

/// The special points as a table; only the columns that the run has.
/// @param sizes  of the result's quantities
std::string point_lines(const analysis::StudyResult& result, const analysis::Branch& branch,
                        const std::vector<double>& sizes);

}  // namespace springfold::io
