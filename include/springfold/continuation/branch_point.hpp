// Branch points: where the extended Jacobian [dF/dx dF/dlambda] loses rank; and the zeros of the
// eigenvalues of dF/dx that lead to them.
#pragma once

#include <vector>

#include "springfold/continuation/step.hpp"

namespace springfold::continuation {

/// Eigenvalues of dF/dx at a point, ascending; nothing outside the domain.
/// @pre the problem is symmetric
std::optional<Vector> spectrum_at(const Walker& walker, const CurvePoint& point);

/// A point of the curve at which an eigenvalue of dF/dx is zero.
struct EigenvalueZero {
  CurvePoint point{};
  double before = 0, after = 0;  ///< step lengths from `from` that bracket it
};

/// Zero of the eigenvalue with number `sorted` between the step lengths a and b from `from`.
/// Where a trial point cannot be corrected because the matrix is singular to rounding, that is the
/// zero, and the nearest good point is given.
/// @pre the eigenvalue has opposite signs at a and b
/// @returns nothing when it jumps instead of passing zero: the curve was lost
std::optional<EigenvalueZero> eigenvalue_zero(const Walker& walker, const CurvePoint& from,
                                              double a, double b, Index sorted);

/// Number of eigenvalues of dF/dx that are zero at a point, seen against the largest one.
int corank_at(const Walker& walker, const CurvePoint& point, double tolerance = 1e-6);

/// Newton's method on the augmented system of a simple branch point in (x, lambda, b, v),
///
///     F + b v = 0,   (dF/dx)^T v = 0,   (dF/dlambda) . v = 0,   v . v = 1,
///
/// regular at the branch point where the branch's own equations are not (Allgower and Georg 1990).
/// Residuals are exact; the matrix takes second derivatives of F from central differences.
/// @returns nothing when it does not converge nearby
std::optional<CurvePoint> refine_branch_point(const Walker& walker, const CurvePoint& near);

/// Gauss-Newton on F = 0 and Sigma = 0, where Sigma (m x m, symmetric) comes from
///
///     | dF/dx  V | | *     |   | 0 |
///     |          | |       | = |   |,     V: eigenvectors of the m eigenvalues nearest to zero,
///     | V^T    0 | | Sigma |   | I |
///
/// and vanishes where all m are zero. For points of higher multiplicity on symmetric branches.
/// @returns nothing when no point nearby has m zero eigenvalues
std::optional<CurvePoint> refine_multiple_point(const Walker& walker, const CurvePoint& near,
                                                int m);

}  // namespace springfold::continuation
