// Limit points, branch points and touches on one step. Private to the engine.
#pragma once

#include <string>
#include <vector>

#include "continuation/locating/watched_step.hpp"
#include "continuation/points/arc.hpp"
#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// All smooth special points on a step between two points of one piece, in order.
struct StepEvents {
  std::vector<Hit> hits{};
  std::string doubt{};   ///< set: something happens here that these hits do not explain;
                         ///< a shorter step may separate it
  int unexplained = 0;   ///< with a doubt: how many eigenvalues change sign unexplained
  bool passing = false;  ///< with a doubt: branches pass each other closely; the curve turns aside
  bool flat = false;  ///< with a doubt: lambda stands still to rounding; shorter steps do not help
  bool of_caller = false;  ///< with a doubt: it is about an event of the caller
};

/// Finds every zero of the tangent's lambda-component and of the eigenvalues of dF/dx between the
/// samples of one step and puts them together: an eigenvalue and the tangent vanish at a limit
/// point, an eigenvalue alone at a branch point, the tangent with an eigenvalue that does not change
/// sign where the branch itself turns at a branch point; a zero without change of sign is a touch.
/// @param arc      the step
/// @param samples  its ends and points between them, in order; all on one piece
StepEvents singular_points(const WatchedStep& arc, Samples samples);

}  // namespace springfold::continuation
