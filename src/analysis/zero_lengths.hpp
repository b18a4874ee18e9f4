// Springs that are led through the length 0, where their force has no direction, and angles that jump. Private to
// analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "branch_rows.hpp"
#include "grow_diagram.hpp"

namespace springfold::analysis {

/// What turns round or jumps at once where a spring is led through an edge of its shape, in one order for all states.
struct SpringEdges {
  /// Between the points of springs that have force at the length 0, and the rays of angles; zero where there is no
  /// force.
  std::vector<model::Vec3<double>> vectors{};
  /// Of every shape: how far its angle is from the middle of the turn in which it is counted; 0 where there is none, or
  /// no moment.
  std::vector<double> angles{};

  bool is_empty() const { return vectors.empty() && angles.empty(); }
};
SpringEdges spring_edges(const statics::System& system, const Vector& z,
                         const statics::Inputs& inputs);

/// Is there a spring with a force whose length is nothing but rounding? What it does to the rest, and so whether the
/// state is an equilibrium, is not known. @returns its name
std::optional<std::string> without_direction(const statics::System& system, const Vector& z,
                                             const statics::Inputs& inputs);

/// Does an angle with a moment stand where it jumps by a whole turn? Its energy jumps there: it is no equilibrium.
bool stands_at_jump(const statics::System& system, const Vector& z, const statics::Inputs& inputs);

/// Why a curve does not lead from the first of these states to the second: a spring is turned round there without being
/// turned aside, or an angle jumps by whole turns. Nothing where it does.
std::optional<std::string> led_over_edge(const statics::System& system, const SpringEdges& before,
                                         const SpringEdges& after);

/// A body that is guided along the line of a spring can be driven through the place at which the spring has the length
/// 0. Its force turns round there at once, which no unknown of the path shows. So it is where a point is led through
/// the vertex of an angle or the edge of a fold, and where an angle jumps, half a turn from `near`. The curve ends at
/// the last point before, with the spring's name as its reason. Springs without force there pass.
/// @returns the new end of the curve; nothing where it stays
std::optional<Stop> end_at_zero_length(const PathProblem& problem, continuation::Curve& curve);

/// The same for both ways of a branch.
void end_at_zero_lengths(const Tracing& tracing, BranchSource& source);

/// Does the curve end where an angle with a sign, or that of a fold, has a moment and is half a turn from `near`,
/// beyond which it would jump?
/// @returns so in words, with the spring's name; nothing where it does not
std::optional<std::string> angle_near_jump(const PathProblem& problem,
                                           const continuation::CurvePoint& end);

}  // namespace springfold::analysis
