// Marked values that a branch has at its start already. Private to analysis.
#pragma once

#include "branch_rows.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// Adds a UZ at the start row for every mark whose value the start has to rounding: a curve that only leaves
/// a value does not cross it. Labels are given later.
void add_marks_at_start(const Study& study, const Evaluator& evaluator,
                        const std::vector<QuantityDefinition>& quantities,
                        const continuation::CurvePoint& start, BranchRows& rows);

}  // namespace springfold::analysis
