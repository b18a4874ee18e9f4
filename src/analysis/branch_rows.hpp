// From the engine's curves to the branch table. Private to analysis.
#pragma once

#include "quantities.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Name of the engine's event for an extremum of the force under displacement control.
inline constexpr const char* force_limit = "limit point of the force";

/// Joins the two directions of a trace into one branch: rows from the backward end through the
/// start to the forward end, special points as rows of their own, labels counted from the first row.
Branch join(const continuation::Curve& backward, const continuation::Curve& forward,
            const Evaluator& evaluator, const std::vector<QuantityDefinition>& quantities,
            const PathProblem& problem);

/// The start point alone.
Branch single_point(const continuation::CurvePoint& start, const Evaluator& evaluator,
                    const std::vector<QuantityDefinition>& quantities, const PathProblem& problem);

/// Segment numbers of all springs with breakpoints: "0.1".
std::string piece_text(const statics::System& system, const Piece& piece);

}  // namespace springfold::analysis
