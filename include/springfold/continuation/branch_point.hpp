// Branch points: where the extended Jacobian [dF/dx dF/dlambda] loses rank.
#pragma once

#include <vector>

#include "springfold/continuation/step.hpp"

namespace springfold::continuation {

/// Eigenvalues of dF/dx (symmetric) that pass zero between two points of one piece.
struct CrossingPoint {
  CurvePoint point{};
  int multiplicity = 1;
  double before = 0, after = 0;  ///< step lengths from the first point that bracket it
};

/// Follows every sorted eigenvalue of dF/dx that changes sign on the step to its zero; eigenvalues
/// that vanish together are one crossing. Simple ones are refined by refine_branch_point.
/// @pre from.negative and to.negative are set and differ; no limit point in between
/// @returns nothing when a crossing could not be located
std::optional<std::vector<CrossingPoint>> locate_crossings(const Walker& walker,
                                                           const CurvePoint& from,
                                                           const CurvePoint& to);

/// Newton's method on the augmented system of a simple branch point in (x, lambda, b, v),
///
///     F + b v = 0,   (dF/dx)^T v = 0,   (dF/dlambda) . v = 0,   v . v = 1,
///
/// regular at the branch point where the branch's own equations are not (Allgower and Georg 1990).
/// Residuals are exact; the matrix takes second derivatives of F from central differences.
/// @returns nothing when it does not converge nearby
std::optional<CurvePoint> refine_branch_point(const Walker& walker, const CurvePoint& near);

}  // namespace springfold::continuation
