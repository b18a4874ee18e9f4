// Stiffness matrices and stability of a loaded mechanism: paper Section 4.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Stiffness of one chain with its end body displaced, all its coordinates in equilibrium:
///
///     K_ci = D - B^T A^-1 B,     A = | K - H^F  -J^T |    B = d(rows x, F)/dt,  D = d(rows t)/dt
///                                    | -J        0   |
///
/// @param A_full, work  as equilibrium_matrix left them at the state
/// @returns d x d in the pose coordinates of the chain's moving end body, at that body's origin
///          [force/length, ...]; nothing when A is singular: a rigid chain, or chain buckling
/// @pre the chain joins the base and one moving body
std::optional<Matrix> chain_stiffness(const System& system, std::size_t chain, const Matrix& A_full,
                                      const Workspace& work);

/// The same at the chain's own end by the paper's elimination, eq. (11) and (12), as a cross-check:
///
///     | J_th k J_th^T          J_q + J_th k H_thq   |^-1      | K_c  * |
///     |                                             |      =  |        |,  k = (K_th - H_thth)^-1
///     | (J_q + J_th k H_thq)^T H_qq + H_qth k H_thq |         |  *   * |
///
/// where theta are the coordinates with a spring in its active segment and q all others.
/// @returns d x d in world axes at the chain's end; nothing when one of the matrices is singular
std::optional<Matrix> chain_stiffness_paper(const System& system, std::size_t chain,
                                            const Piece& piece, const Vector& z,
                                            const Inputs& inputs);

/// The derivative of the equilibrium's gradient alone: what equilibrium_matrix adds for redundant
/// closures is taken away again. @param work  as equilibrium_matrix left it
Matrix without_gauge(const Matrix& A_full, const Workspace& work);

/// K_Sigma - dW/dt of all bodies together.
struct PlatformStiffness {
  Matrix K{};            ///< load_size x load_size, pose coordinates; empty when a chain is rigid
  Vector eigenvalues{};  ///< of K, ascending; +infinity for directions in which chains are rigid;
                         ///< empty when the mechanism itself is singular and K unknown
};

/// @param A_full     matrix of equilibrium_matrix at the state
/// @param symmetric  false: loads without potential act; K is not symmetric then, and the real parts
///                   of its eigenvalues are given
PlatformStiffness platform_stiffness(const System& system, const Matrix& A_full,
                                     bool symmetric = true);

/// Stiffness of one body, all other bodies free: all other unknowns are eliminated while it is held.
/// @param platform  as platform_stiffness gave it for A_full
/// @returns count x count in pose coordinates; empty where it is not defined: rigid in some direction
Matrix body_stiffness(const System& system, const Matrix& A_full, const PlatformStiffness& platform,
                      Index body, bool symmetric = true);

/// Compliance of one body, all others free: its pose per wrench. It exists where A is regular, also where
/// the body is rigid in some directions and has no stiffness matrix; those have none.
/// @returns count x count in pose coordinates; nothing where A is singular
std::optional<Matrix> body_compliance(const System& system, const Matrix& A_full, Index body,
                                      bool symmetric = true);

/// Tangent stiffness of the whole mechanism, reduced to the motions that joints and closures allow:
///
///     T = Z^T H Z,   A = | H  -J^T |,   Z: orthonormal basis of the motions with J Z = 0
///                        | -J   0  |
///
/// Its size is the number of degrees of freedom. It is singular exactly at critical states, with
/// and without a potential.
Matrix tangent_stiffness(const System& system, const Matrix& A_full, const Workspace& work = {});

/// Dimension of the null space of T, counted on A, in which rows and columns can be brought to one size:
/// motions without stiffness. Wrenches that alone balance each other count nothing.
Index zero_modes(const System& system, const Matrix& A_full);

/// Real and imaginary parts of the eigenvalues of T, by real parts, then imaginary parts.
std::vector<std::pair<double, double>> eigenvalues_of(const Matrix& T);

/// det T times the positive factor det(J J^T): zero where T is singular, and of its sign. For a
/// serial chain with free end it is the determinant of the stiffness in joint coordinates.
double tangent_determinant(const System& system, const Matrix& A_full);

/// K in pose coordinates -> K in world axes: rotation vectors' derivatives replaced by twists.
/// Exact where no external moment acts.
/// @param body  K is that of this body alone; 0: of all bodies
Matrix in_world_axes(const System& system, const Vector& z, const Matrix& K, Index body = 0);

/// The same for the compliance of one body.
Matrix compliance_in_world_axes(const System& system, const Vector& z, const Matrix& C, Index body);

/// Numbers of unstable modes. Empty where the closure equations are dependent or the state is
/// critical, so that the count is not defined.
struct Stability {
  std::optional<Index> pose_controlled{};   ///< sum of chain instabilities, all bodies held
  std::optional<Index> force_controlled{};  ///< under dead load, all bodies free
};

/// By Haynsworth's additivity: index = n_minus(KKT matrix) - number of independent closures.
/// @param A_full, work  as equilibrium_matrix left them at the state; work may be left out where no
///                      closures are redundant
Stability stability(const System& system, const Matrix& A_full, const Workspace& work = {});

/// Platform stiffness and stability together, the chains condensed one by one:
///
///     A = | A_1          B_1 |
///         |      A_2     B_2 |      K = D - sum B_i^T A_i^-1 B_i,   n_minus(A) = sum n_minus(A_i) + n_minus(K)
///         | B_1^T B_2^T  D   |
///
/// One factorisation of each A_i serves both. Where that does not go (chains that couple otherwise than
/// through bodies, redundant closures, singular A_i) the two functions above do it.
struct Condensed {
  PlatformStiffness platform{};
  Stability stability{};
};
Condensed condense(const System& system, const Matrix& A_full, const Workspace& work = {});

/// Unstable modes of a reduced KKT matrix with `closures` multipliers among its unknowns; empty if
/// an eigenvalue is zero.
std::optional<Index> unstable_modes(const Matrix& A, Index closures);

}  // namespace springfold::statics
