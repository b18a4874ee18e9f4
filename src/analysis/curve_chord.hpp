// Points of a curve between two neighbouring ones. Private to analysis.
#pragma once

#include "path_work.hpp"
#include "springfold/continuation/newton.hpp"

namespace springfold::analysis {

/// The way from one state to a neighbouring one on a smooth piece, whose points the chord between them determines.
struct CurveChord {
  const PathProblem& problem;
  PathState from;
  Vector weights;
  continuation::Direction chord,
      border{};  ///< border: of unit length; where there is no way it is not defined
  double length = 0;

  CurveChord(const PathProblem& of, PathState begin, const PathState& end);

  bool is_a_way() const;
  /// The curve's point in the plane across the chord at so large a part of the way. Neighbours are nearer to each other
  /// than the curve bends: what Newton's method finds farther from the chord than half its length is a point of another
  /// curve, and there is none.
  std::optional<PathState> at(double part, const Piece& piece) const;
  bool is_beside(const Vector& x, double lambda, double part) const;
};

}  // namespace springfold::analysis
