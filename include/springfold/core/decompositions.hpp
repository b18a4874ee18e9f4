// Decompositions of dense matrices of any size. Eigen makes the code of each anew in every file that names one, which
// takes the compiler up to half a minute; here each is compiled once. Results are those of Eigen, bit by bit.
#pragma once

#include <Eigen/LU>
#include <complex>
#include <optional>

#include "springfold/core/types.hpp"

namespace springfold {

/// P A = L U of a square matrix, with row pivots. Says nothing of singular matrices but by its pivots.
class Lu {
 public:
  Lu() = default;
  explicit Lu(const Matrix& A) { compute(A); }
  void compute(const Matrix& A);

  /// A^-1 right, as many columns; not finite where A is singular. @pre computed
  template <class Right>
  auto solve(const Eigen::MatrixBase<Right>& right) const {
    if constexpr (Right::ColsAtCompileTime == 1)
      return solve_vector(right);
    else
      return solve_matrix(right);
  }
  /// The same into x, without memory from the heap.
  void solve(const Vector& right, Eigen::Ref<Vector> x) const;
  Matrix solve_transposed(const Matrix& right) const;  ///< A^-T right
  Matrix inverse() const;
  double determinant() const;

  double smallest_pivot() const;  ///< magnitudes; 0 if there are none
  double largest_pivot() const;
  double reciprocal_condition() const;  ///< estimate in the norm of columns; 0 where A is singular
  int sign() const;                     ///< of the determinant, a pivot of zero taken as positive

 private:
  Vector solve_vector(const Vector& right) const;
  Matrix solve_matrix(const Matrix& right) const;

  Eigen::PartialPivLU<Matrix> factors_{};
};

/// The determinant's sign over the norm of the inverse: the least singular value but for a factor of the root of the
/// rows at most, smooth where it changes its sign; 0 for a matrix that is singular, has no rows, or is not finite.
double signed_least(const Matrix& A);

/// P A Q = L U, with row and column pivots: tells whether A is singular to working precision.
class FullPivotLu {
 public:
  explicit FullPivotLu(const Matrix& A);
  bool is_invertible() const;
  Matrix inverse() const;  ///< @pre is_invertible()
  template <class Right>
  auto solve(const Eigen::MatrixBase<Right>& right) const {
    if constexpr (Right::ColsAtCompileTime == 1)
      return solve_vector(right);
    else
      return solve_matrix(right);
  }

 private:
  Vector solve_vector(const Vector& right) const;
  Matrix solve_matrix(const Matrix& right) const;

  Eigen::FullPivLU<Matrix> factors_{};
};

/// A^-1 right for a symmetric matrix with positive or negative eigenvalues only (L D L^T).
Vector solve_definite(const Matrix& A, const Vector& right);
Matrix solve_definite(const Matrix& A, const Matrix& right);

/// Which singular vectors are wanted: as many as A has singular values, or full bases.
enum class SingularVectors { none, thin, full };

/// A = U diag(values) V^T, values descending.
struct Svd {
  Vector values{};
  Matrix U{}, V{};  ///< what was asked for
  Index rank = 0;   ///< values above the rounding of the largest

  /// x of smallest norm among those that make |A x - right| smallest. @pre U and V were asked for
  Vector solve(const Vector& right) const;
};

/// Two-sided Jacobi: the more accurate one, for small matrices.
Svd jacobi_svd(const Matrix& A, SingularVectors left = SingularVectors::none,
               SingularVectors right = SingularVectors::none);
/// Divide and conquer: faster beyond some 30 rows.
Svd divided_svd(const Matrix& A, SingularVectors left = SingularVectors::none,
                SingularVectors right = SingularVectors::none);

/// A = V diag(values) V^T of a symmetric A, of which the lower triangle is read; values ascending.
struct SymmetricEigen {
  Vector values{};
  Matrix vectors{};
};
SymmetricEigen symmetric_eigen(const Matrix& A);
/// Ascending.
Vector symmetric_eigenvalues(const Matrix& A);
/// Of the symmetric part of the matrix of one body: a few rows (SmallMatrix) take no memory from the heap but the
/// result.
Vector body_eigenvalues(const Matrix& A);

/// Ascending lambda with A v = lambda B v for symmetric A and positive definite B, of which the lower triangles are
/// read.
Vector eigenvalues_of_pair(const Matrix& A, const Matrix& B);

/// Of any square matrix, in no particular order.
Eigen::VectorXcd eigenvalues(const Matrix& A);

/// Square matrices of a few rows that live on the stack.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;
/// Largest magnitude of an eigenvalue, without memory from the heap; 0 for no rows.
double spectral_radius(const SmallMatrix& A);

/// Orthonormal bases by Householder's reflections: of the columns' space (m x n, @pre m >= n), and completed to all
/// of R^m (m x m). The first columns are those of the space.
Matrix orthonormal_columns(const Matrix& A);
Matrix orthonormal_basis(const Matrix& A);

/// Householder's reflections with column pivots.
struct PivotedQr {
  Vector pivots{};  ///< magnitudes, descending up to rounding
  Index rank = 0;   ///< pivots above the threshold
  Vector
      last_column{};  ///< of Q, m: for n = m - 1 independent columns what is orthogonal to all of them
};
/// @param threshold  of the largest pivot; if it is not given, rounding
PivotedQr pivoted_qr(const Matrix& A, std::optional<double> threshold = {});
Index rank_of(const Matrix& A, std::optional<double> threshold = {});
/// Orthonormal basis of the x with A x = 0: columns x (columns - rank).
Matrix kernel_of(const Matrix& A, std::optional<double> threshold = {});

/// Of smallest norm among those that make |A X - right| smallest, by a complete orthogonal decomposition.
/// @param threshold  pivots below it, of the largest, count as zero; if it is not given, rounding
Vector least_squares(const Matrix& A, const Vector& right, std::optional<double> threshold = {});
/// The same for each column of `right`.
Matrix least_squares_of_columns(const Matrix& A, const Matrix& right);
/// @returns nothing where the columns of A are dependent
std::optional<Matrix> unique_least_squares(const Matrix& A, const Matrix& right, double threshold);
/// X that makes |A X - right| smallest. @pre more rows than columns, which are independent
Matrix fitted(const Matrix& A, const Matrix& right);

}  // namespace springfold
