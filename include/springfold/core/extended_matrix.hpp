// The matrix of the curve's own equations, dense or with a structured dF/dx.
#pragma once

#include <optional>
#include <vector>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/linearisation.hpp"

namespace springfold {

/// The matrix of the curve's own equations with the step's direction as last row,
///
///     E = | dF/dx            dF/dlambda |
///         | (w tau.dx)^T     tau.dl     |,     (n + 1) x (n + 1):
///
/// regular at limit points, singular exactly at branch points; its corank is theirs. Without its last row it is the
/// curve's extended Jacobian.
struct ExtendedMatrix {
  Matrix dense{};        ///< empty where dF/dx is structured
  Linearisation at{};    ///< then this and the last row
  Vector row{};          ///< w tau.dx
  double corner = 0;     ///< tau.dl
  bool has_last = true;  ///< false: n x (n + 1)

  Index rows() const {
    return at.structured ? at.dF_dlambda.size() + (has_last ? 1 : 0) : dense.rows();
  }
  Index columns() const { return at.structured ? at.dF_dlambda.size() + 1 : dense.cols(); }
};

ExtendedMatrix extended_matrix(const Linearisation& at, const Vector& weights,
                               const Direction& tau);

/// Fixed borders and the m x m function that they define (Govaerts 2000, chapter 3),
///
///     | E    B | | *     |   | 0 |
///     |        | |       | = |   |,      Sigma singular <=> E singular, with equal corank.
///     | C^T  0 | | Sigma |   | I |
struct Borders {
  Matrix B{}, C{};  ///< (n + 1) x m; without the last row B: n x m, C: (n + 1) x (m + 1)
};

/// E X, and |E| |X| entry by entry.
Matrix product(const ExtendedMatrix& E, const Matrix& X);
Matrix magnitudes(const ExtendedMatrix& E, const Matrix& X);

/// | A B; C^T 0 | of any A.
Matrix bordered(const Matrix& A, const Borders& borders);

/// The bordered matrix, ready to be solved with.
class BorderedMatrix {
 public:
  BorderedMatrix() = default;
  BorderedMatrix(const ExtendedMatrix& E, const Borders& borders);

  /// Solves with it or with its transpose. @returns nothing when it is singular
  std::optional<Matrix> solve(const Matrix& right, bool transposed = false) const;

 private:
  Lu lu_{};
  std::shared_ptr<const StructuredMatrix> structured_{};
  FrontalBorders borders_{};
};

/// The same once.
std::optional<Matrix> solve_with(const ExtendedMatrix& E, const Borders& borders,
                                 const Matrix& right, bool transposed = false);

/// Orthonormal borders that span the kernels of E of corank m, or what is nearest to them, by inverse iteration: with
/// M = | E B; C^T 0 |, which is regular also where E is not, M^-1 | 0; I | holds better right vectors than C, and
/// M^-T | 0; I | better left ones than B.
/// @returns false where it leaves off, M being singular; `borders` are then as good as they were
bool kernel_borders(const ExtendedMatrix& E, Index m, Borders& borders);

/// Left and right singular vectors of the m smallest singular values, m = 1...
/// A structured E has them by inverse iteration with bordered matrices.
Borders borders_of(const ExtendedMatrix& E, Index m);

/// borders_of(E, 1) to some digits, as rates of the smallest singular value need them: by inverse iteration, at a
/// fraction of the cost.
Borders weakest_borders(const ExtendedMatrix& E);

/// Of any matrix of entries, in descending order.
Vector singular_values(const Matrix& M);

/// The m smallest ones of E, ascending.
Vector least_singular_values(const ExtendedMatrix& E, Index m);

/// Magnitudes of the largest eigenvalues of E^-1 (E1 - E0), descending: all of them, or those that some
/// steps of Arnoldi's method show where E is structured. Infinity where E is singular.
std::vector<double> relative_motion(const ExtendedMatrix& E, const ExtendedMatrix& E0,
                                    const ExtendedMatrix& E1);

/// Matrices of more rows are not formed with their entries where they are structured.
inline constexpr Index most_entries = 4000;

/// | 0; I | of so many rows.
Matrix unit_rows_below(Index rows, Index columns);

/// Orthonormal columns of a fixed, irregular kind to start iterations from.
Matrix irregular_columns(Index rows, Index columns);
Matrix orthonormal(const Matrix& columns);

}  // namespace springfold
