// KINSOL behind one function. Private to statics.
#pragma once

#include <functional>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::statics {

struct SquareSystem {
  Index size = 0;
  std::function<bool(const Vector& y, Vector& residual)> residual{};
  std::function<bool(const Vector& y, Matrix& jacobian)> jacobian{};
  std::vector<Index>
      angles{};  ///< unknowns that may come back to where they were after a whole turn
};

struct KinsolResult {
  bool converged = false;
  Vector y{};  ///< last iterate
  int iterations = 0;
};

/// Newton with line search, a fresh exact Jacobian in every iteration. Long steps may lead angles through whole turns,
/// which are taken back where the equations are the same without them (whole_turns.hpp).
/// @param largest_step  bound on the Euclidean length of one Newton step
KinsolResult solve_by_kinsol(const SquareSystem& system, const Vector& start, double tolerance,
                             double largest_step);

}  // namespace springfold::statics
