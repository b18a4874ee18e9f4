// Whether the number of unstable modes of a state is one of rounding. Private to analysis.
#pragma once

#include "quantities.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Is the state a limit or branch point as far as rounding lets it be told? A state is found to a residual of rounding;
/// where the load is a limit load it may lie a root of rounding beside the limit point, on either side. It is
/// degenerate if states beside it in its weakest direction, whose residual is one of rounding too, have another number
/// of unstable modes.
/// @param point  in equilibrium, with its count of negative eigenvalues; without one it is degenerate
bool is_degenerate(const PathProblem& problem, const continuation::CurvePoint& point);

/// Likewise, but where springs rest at their thresholds all pieces together tell the number.
bool is_index_untold(const Evaluator& evaluator, const continuation::CurvePoint& point);

/// What is said of such a state.
inline constexpr const char* degenerate_note =
    "a limit or branch point within rounding: its stability is not told";

}  // namespace springfold::analysis
