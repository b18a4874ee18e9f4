// Newton's method for equilibria with long chains. Private to statics.
#pragma once

#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/stage_jacobians.hpp"

namespace springfold::statics {

/// Damped Newton steps in stages from one guess, to the last digits; springs in the segments of the state
/// itself. The pose of one body may be given (StartUnknowns::wrench), commands are.
class StageNewton {
 public:
  /// @pre prefers_stages(system), problem.unknowns is not commands
  StageNewton(const System& system, const StartProblem& problem);

  /// @returns the largest entry of the residual that is left; infinity where it cannot be evaluated
  double solve(Vector& z, const Inputs& inputs, int& iterations);

 private:
  bool residual(const Vector& z, const Inputs& inputs, Vector& r);
  Vector spread(const Matrix& step) const;  ///< over all unknowns of the statics
  double way(const Vector& dz) const;       ///< largest change of a coordinate or pose

  const System& system_;
  Matrix basis_{};
  StageJacobians stages_;
};

}  // namespace springfold::statics
