// Lyapunov-Schmidt reduction at a singular point, see exits.hpp. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "continuation/points/step.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {

/// [dF/dx dF/dlambda] in unknowns U = (sqrt(w) x, lambda), for which the metric is Euclidean. Unknowns without weight
/// get a small one.
/// @param root     n + 1 square roots of the weights, the last is 1
/// @param densely  with its entries in any case
std::optional<ExtendedMatrix> jacobian_at(const Walker& walker, const Vector& U, const Vector& root,
                                          const Piece& piece, bool densely = false);

Vector metric_roots(const Vector& weights);
Vector scaled_point(const CurvePoint& at, const Vector& root);

/// What the rank of the extended Jacobian is must not depend on units: D_r [dF/dx dF/dlambda] D_c at a point, n x (n +
/// 1); entries that vanish there only count as large as they are a little away.
struct EquilibratedJacobian {
  Matrix J{};
  Vector columns{};  ///< D_c: J y = 0 for (dx, dlambda) = D_c y
  Vector rows{};     ///< D_r: J = D_r [dF/dx dF/dlambda] D_c
};

/// @returns nothing where derivatives are not defined
std::optional<EquilibratedJacobian> equilibrated_jacobian(const Walker& walker,
                                                          const CurvePoint& at);

struct ReducedEquation {
  const Walker* walker = nullptr;
  Piece piece{};
  Vector root{};         ///< n + 1
  Vector U0{};           ///< n + 1
  Index k = 0;           ///< corank
  Matrix N{}, L{};       ///< right and left kernels: n + 1 x k + 1, n x k
  double scale = 1;      ///< max(1, |U0|)
  bool follows = false;  ///< the last column of N is the only one along which lambda moves
  Matrix B{};            ///< left borders, n x k, L^T B = I: J y + B g = right has no y within N
  BorderedMatrix bordered{};        ///< J at U0 with B and N
  std::vector<Matrix> quadratic{};  ///< k matrices (k + 1 x k + 1): g_m(c) = c^T Q_m c / 2 + ...
  std::vector<Vector> bend{};       ///< w(c) = sum_ij c_i c_j bend_(i (k + 1) + j) + ...
  double curvature = 0;  ///< largest |bend|: 1/length on which the kernel is a good chart
};

/// @returns nothing where F or its derivatives are not defined, or too close to such a place
std::optional<ReducedEquation> reduce(const Walker& walker, const CurvePoint& at, int corank);

/// F at U; false where it is not defined.
bool residual_at(const ReducedEquation& e, const Vector& U, Vector& F);

/// w(c) to second order.
Vector bend_along(const ReducedEquation& e, const Vector& c);

struct ReducedValue {
  Vector U{};  ///< u0 + N c + w(c)
  Vector g{};  ///< k
};

/// @returns nothing where w(c) is not found or not small against c
std::optional<ReducedValue> reduced_value(const ReducedEquation& equation, const Vector& c);

/// A point of a branch at the distance rho, measured in the kernel.
struct RayPoint {
  Vector U{};
  Vector c{};        ///< N^T (U - U0), of length rho
  Vector rate{};     ///< dU along the branch for as much of rho; empty: not known
  double noise = 0;  ///< of the direction c / rho, by rounding
  int sign = 0;      ///< of the determinant of |J; c^T N^T|: +1 and -1 balance on a sphere
};

/// Newton's method from U on F = 0, |N^T (U - U0)| = rho.
std::optional<RayPoint> ray_point(const ReducedEquation& equation, const Vector& U, double rho);

/// Direction of the kernel within `reach` of c, |c| = 1, for which all quadratic terms vanish.
/// @returns nothing where they do not determine it
std::optional<Vector> quadratic_direction(const ReducedEquation& equation, const Vector& c,
                                          double reach);

/// The branches at one radius, in a fixed order, none twice.
struct RaySet {
  std::vector<RayPoint> rays{};
  double rho = 0;
  std::string doubt{};  ///< set: the search was not possible everywhere, or found a double zero
};

/// Adds what Newton's method reaches from U, unless it is known.
/// @returns false where it does not converge
bool add_ray(const ReducedEquation& equation, const Vector& U, RaySet& set);

/// Searches the sphere |c| = rho; corank 0, 1 or 2.
/// @param samples  on the circle of corank 1
RaySet rays_on_sphere(const ReducedEquation& equation, double rho, int samples);

/// Directions of the kernel that the quadratic terms alone determine: a branch leaves along each.
/// Corank 1 and 2; empty for others.
std::vector<Vector> quadratic_rays(const ReducedEquation& equation);

}  // namespace springfold::continuation
