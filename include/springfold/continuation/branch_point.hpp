// Branch points: where the extended Jacobian [dF/dx dF/dlambda] loses rank.
#pragma once

#include "springfold/continuation/step.hpp"

namespace springfold::continuation {

/// Eigenvalues of dF/dx at a point, ascending; nothing outside the domain.
/// @pre the problem is symmetric
std::optional<Vector> spectrum_at(const Walker& walker, const CurvePoint& point);

/// Newton's method on the augmented system of a simple branch point in (x, lambda, b, v),
///
///     F + b v = 0,   (dF/dx)^T v = 0,   (dF/dlambda) . v = 0,   v . v = 1,
///
/// regular at the branch point where the branch's own equations are not (Allgower and Georg 1990).
/// Residuals are exact; the matrix takes second derivatives of F from central differences.
/// @returns nothing when it does not converge nearby
std::optional<CurvePoint> refine_branch_point(const Walker& walker, const CurvePoint& near);

}  // namespace springfold::continuation
