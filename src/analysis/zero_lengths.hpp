// Springs that are led through the length 0, where their force has no direction. Private to analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "branch_rows.hpp"
#include "grow_diagram.hpp"

namespace springfold::analysis {

/// The vectors between the points of all springs that have force at the length 0, in one order; those of slack cables
/// are zero.
std::vector<model::Vec3<double>> spring_vectors(const statics::System& system, const Vector& z,
                                                const statics::Inputs& inputs);

/// Why a curve does not lead from the first of these states to the second: a spring is turned round there without being
/// turned aside. Nothing where it does.
std::optional<std::string> led_through_zero(const statics::System& system,
                                            const std::vector<model::Vec3<double>>& before,
                                            const std::vector<model::Vec3<double>>& after);

/// A body that is guided along the line of a spring can be driven through the place at which the spring has the length 0.
/// Its force turns round there at once, which no unknown of the path shows. The curve ends at the last point before, with
/// the spring's name as its reason. Springs without force at the length 0 pass.
/// @returns the new end of the curve; nothing where it stays
std::optional<Stop> end_at_zero_length(const PathProblem& problem, continuation::Curve& curve);

/// The same for both ways of a branch.
void end_at_zero_lengths(const Tracing& tracing, BranchSource& source);

}  // namespace springfold::analysis
