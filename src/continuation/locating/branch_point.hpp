// Branch points: where the extended Jacobian [dF/dx dF/dlambda] loses rank. Private to the engine.
#pragma once

#include "continuation/points/step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// Eigenvalues of dF/dx at a point, ascending; nothing outside the domain.
/// @pre the problem is symmetric
std::optional<Vector> spectrum_at(const Walker& walker, const CurvePoint& point);

/// Smallest magnitude of an eigenvalue of dF/dx; infinity outside the domain. Where dF/dx is structured it
/// is estimated to about a hundredth.
/// @pre the problem is symmetric
double least_eigenvalue(const Walker& walker, const CurvePoint& point);

/// `BranchPlace::left` above which curves pass each other and do not meet.
inline constexpr double branches_apart = 200;

/// Farther off a branch point is another one.
inline constexpr double branch_point_reach = 10 * told_apart;

/// Where branches meet, to rounding.
struct BranchPlace {
  CurvePoint point{};  ///< tangent as it was given
  double off = 0;      ///< estimated error of the place by rounding, in the metric
  double misfit =
      0;  ///< distance, in the metric, by which the k (k + 1) equations contradict each other
  /// What is left of F in the directions that the extended Jacobian does not see, over its rounding.
  /// Curves that cross leave about one, curves that pass each other closely leave their distance.
  double left = 0;
};

/// Gauss and Newton's method for a branch point of any corank k. With the kernels N (n + 1 x k + 1) and
/// L (n x k) of J = [dF/dx dF/dlambda], the well seen part of F and all that J has in the kernels vanish,
///
///     (I - L L^T) F = 0,     L^T J N = 0     (k (k + 1) equations for k + 1 unknowns c along N):
///
/// regular at the point, where the branch's own equations are not, whenever no direction is in the kernel
/// of all second derivatives L_q^T D^2F [N, N]. Those are differences of sixth order of the exact J.
/// @returns nothing when it does not converge within `reach`, or where second derivatives leave the
///          place open (degenerate branch points)
std::optional<BranchPlace> place_branch_point(const Walker& walker, const CurvePoint& near,
                                              int corank, double reach = branch_point_reach);

/// BranchPlace::left at any point that is singular to rounding; infinity where it cannot be told.
double left_of_residual(const Walker& walker, const CurvePoint& point, int corank);

/// A simple branch point through which the curve goes, to rounding.
/// @returns nothing when there is none nearby
std::optional<CurvePoint> refine_branch_point(const Walker& walker, const CurvePoint& near);

}  // namespace springfold::continuation
