// Lyapunov-Schmidt reduction at a singular point, see exits.hpp. Private to the engine.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "continuation/points/step.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::continuation {

/// J = [dF/dx dF/dlambda] in unknowns U = (sqrt(w) x, lambda), for which the metric is Euclidean.
/// Unknowns without weight get a small one.
struct ScaledJacobian {
  Matrix dense{};                                        ///< n x n + 1; empty where structured
  std::shared_ptr<const StructuredMatrix> structured{};  ///< then this is dF/dx / root
  Vector dF_dlambda{};
};

/// @param root  n + 1 square roots of the weights, the last is 1
std::optional<ScaledJacobian> jacobian_at(const Walker& walker, const Vector& U, const Vector& root,
                                          const Piece& piece);
/// The same with its entries in any case.
std::optional<Matrix> scaled_jacobian(const Walker& walker, const Vector& U, const Vector& root,
                                      const Piece& piece);

Matrix product(const ScaledJacobian& J, const Matrix& X);     ///< J X
Matrix magnitudes(const ScaledJacobian& J, const Matrix& X);  ///< |J| |X|
double size_of(const ScaledJacobian& J);  ///< Frobenius norm; structured: estimated

/// | J   L |
/// | N^T 0 |, ready to be solved with.
class KernelSystem {
 public:
  void compute(const ScaledJacobian& J, const Matrix& N, const Matrix& L);
  /// Not finite where the matrix is singular.
  Matrix solve(const Matrix& right, bool transposed = false) const;

 private:
  Lu lu_{};
  std::shared_ptr<const StructuredMatrix> structured_{};
  FrontalBorders borders_{};
};

Vector metric_roots(const Vector& weights);
Vector scaled_point(const CurvePoint& at, const Vector& root);

struct ReducedEquation {
  const Walker* walker = nullptr;
  Piece piece{};
  Vector root{};            ///< n + 1
  Vector U0{};              ///< n + 1
  Index k = 0;              ///< corank
  Matrix N{}, L{};          ///< right and left kernels: n + 1 x k + 1, n x k
  double scale = 1;         ///< max(1, |U0|)
  bool follows = false;     ///< the last column of N is the only one along which lambda moves
  KernelSystem bordered{};  ///< with J at U0
  std::vector<Matrix> quadratic{};  ///< k matrices (k + 1 x k + 1): g_m(c) = c^T Q_m c / 2 + ...
  std::vector<Vector> bend{};       ///< w(c) = sum_ij c_i c_j bend_(i (k + 1) + j) + ...
  double curvature = 0;  ///< largest |bend|: 1/length on which the kernel is a good chart
};

/// @returns nothing where F or its derivatives are not defined, or too close to such a place
std::optional<ReducedEquation> reduce(const Walker& walker, const CurvePoint& at, int corank);

/// F at U; false where it is not defined.
bool residual_at(const ReducedEquation& e, const Vector& U, Vector& F);

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
  double noise = 0;  ///< of the direction c / rho, by rounding
  int sign = 0;      ///< of the determinant of |J; c^T N^T|: +1 and -1 balance on a sphere
};

/// Newton's method from U on F = 0, |N^T (U - U0)| = rho.
std::optional<RayPoint> ray_point(const ReducedEquation& equation, const Vector& U, double rho);

/// Direction of the kernel within `reach` of c, |c| = 1, for which all quadratic terms vanish.
/// @returns nothing where they do not determine it
std::optional<Vector> quadratic_direction(const ReducedEquation& equation, const Vector& c,
                                          double reach);

}  // namespace springfold::continuation
