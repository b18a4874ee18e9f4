#include "springfold/statics/sparse_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/inertia.hpp"

namespace springfold::statics {
namespace {

/// As in stage_stiffness.cpp: beside the largest entries of A a stiffness like this is that of a rigid body.
constexpr double rigidity = 1e12;

constexpr Index wanted = 3;   ///< eigenvalues
constexpr Index width = 4;    ///< of the blocks: so many equal ones are found
constexpr Index blocks = 50;  ///< at most

/// Residual of an eigenvalue theta, in theta: its error is the square of it over the gap to the next.
constexpr double settled = 1e-10;

/// First shift, in largest entries of A, by what it grows, and how often.
constexpr double first_shift = 0x1p-10, growth = 16;
constexpr int shifts = 6;

Matrix symmetric_part(const Matrix& K) { return 0.5 * (K + K.transpose()); }

FrontalBorders no_borders(Index n) { return {Matrix(n, 0), Matrix(n, 0), Matrix(0, 0)}; }

/// Sum over the chains of the negative eigenvalues of their own blocks; nothing if one is singular.
std::optional<Index> negative_of_chains(const System& system, const Matrix& A) {
  Index negative = 0;
  for (const ChainSlice& slice : system.chain_slices) {
    std::vector<Index> own;
    for (Index k = 0; k < slice.x_count; ++k) own.push_back(slice.x + k);
    for (Index k = 0; k < slice.F_count; ++k) own.push_back(slice.F + k);
    const auto inertia = inertia_of(Matrix(A(own, own)));
    if (!inertia || inertia->zero > 0) return std::nullopt;
    negative += inertia->negative;
  }
  return negative;
}

/// Entries that no mechanism has any symmetry with, always the same ones.
Matrix first_block(Index rows) {
  Matrix V(rows, width);
  for (Index c = 0; c < width; ++c)
    for (Index i = 0; i < rows; ++i)
      V(i, c) = std::sin(static_cast<double>((c + 1) * (i + 1)) + 0.5 * static_cast<double>(c));
  return V;
}

/// The largest eigenvalues of a positive definite matrix that is known by its products.
class BlockKrylov {
 public:
  BlockKrylov(Index size, Index count) : count_{count} {
    basis_.resize(size, std::min(size, blocks * width));
    images_.resize(size, basis_.cols());
  }

  /// @param apply  replaces a block by the matrix times it; false: it cannot
  template <class Apply>
  std::optional<Vector> run(const Apply& apply) {
    Matrix V = first_block(basis_.rows());
    while (used_ < basis_.cols()) {
      const Index first = used_;
      append(V);
      if (used_ == first) break;  // the space is closed
      V = basis_.middleCols(first, used_ - first);
      if (!apply(V)) return std::nullopt;
      images_.middleCols(first, used_ - first) = V;
      if (has_settled()) break;
    }
    return values_.size() < count_ ? std::nullopt : std::optional<Vector>(values_);
  }

 private:
  /// Orthonormal against all that is there, twice; what is nothing new is left out.
  void append(const Matrix& V) {
    constexpr double nothing = 1e-10;
    for (Index c = 0; c < V.cols() && used_ < basis_.cols(); ++c) {
      Vector v = V.col(c);
      const double before = v.norm();
      for (int pass = 0; pass < 2; ++pass) {
        const auto known = basis_.leftCols(used_);
        v -= known * (known.transpose() * v);
      }
      if (v.norm() > nothing * before) basis_.col(used_++) = v.normalized();
    }
  }

  bool has_settled() {
    const auto Q = basis_.leftCols(used_);
    const auto BQ = images_.leftCols(used_);
    if (used_ < count_) return false;
    const SymmetricEigen ritz = symmetric_eigen(symmetric_part(Q.transpose() * BQ));
    values_ = ritz.values.tail(count_).reverse();
    for (Index k = 0; k < count_; ++k) {
      const Vector y = ritz.vectors.col(used_ - 1 - k);
      if ((BQ * y - values_[k] * (Q * y)).norm() > settled * values_[k]) return false;
    }
    return true;
  }

  Index count_, used_ = 0;
  Matrix basis_{}, images_{};
  Vector values_{};
};

/// The lowest eigenvalues of K_Sigma, ascending; empty where they are not found.
/// @param in_chains  negative eigenvalues that the chains have by themselves
Vector lowest_eigenvalues(const System& system, SparseMatrices& matrices, Matrix& A, double largest,
                          Index in_chains) {
  const Index n = system.size, t = system.first_pose, nt = system.load_size;
  const Vector diagonal = A.diagonal();
  StructuredMatrix shifted;
  double shift = first_shift * largest;
  bool positive = false;
  for (int i = 0; i < shifts && !positive; ++i, shift *= growth) {
    A.diagonal().tail(nt) = diagonal.tail(nt).array() + shift;
    matrices.take(A, shifted);
    const auto inertia = shifted.inertia();
    positive = inertia && inertia->zero == 0 && inertia->negative == in_chains;
    if (positive) break;
  }
  A.diagonal() = diagonal;
  if (!positive) return {};
  const FrontalBorders none = no_borders(n);
  Matrix X;
  const auto inverse = [&](Matrix& V) {
    X.setZero(n, V.cols());
    X.middleRows(t, nt) = V;
    if (!shifted.solve(none, X, false)) return false;
    V = X.middleRows(t, nt);
    return true;
  };
  const auto theta = BlockKrylov(nt, std::min(wanted, nt)).run(inverse);
  if (!theta) return {};
  return (theta->cwiseInverse().array() - shift).matrix();
}

/// With the body held at unit displacements, all others free: w = -K t in the rows of the border.
void put_body(const System& system, const StructuredMatrix& A, Index body, bool regular,
              StagedStiffness& result) {
  const Index n = system.size;
  const BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
  FrontalBorders held{Matrix::Zero(n, b.count), {}, Matrix::Zero(b.count, b.count)};
  held.B.middleRows(b.t, b.count).setIdentity();
  held.C = held.B;
  Matrix X = Matrix::Zero(n + b.count, b.count);
  X.bottomRows(b.count).setIdentity();
  const bool solved = A.solve(held, X, false);
  if (solved && X.bottomRows(b.count).cwiseAbs().maxCoeff() < rigidity * A.largest) {
    result.body = symmetric_part(-X.bottomRows(b.count));
    return;
  }
  if (!regular) return;
  X = held.B;
  if (A.solve(no_borders(n), X, false))
    result.compliance = symmetric_part(X.middleRows(b.t, b.count));
}

}  // namespace

StagedStiffness sparse_stiffness(const System& system, SparseMatrices& matrices, Matrix& A,
                                 Index body) {
  StagedStiffness result;
  StructuredMatrix J;
  matrices.take(A, J);
  const auto inertia = J.inertia();
  if (inertia) result.zero_modes = inertia->zero;
  const bool regular = inertia && inertia->zero == 0;
  put_body(system, J, body, regular, result);
  const auto in_chains = negative_of_chains(system, A);
  if (in_chains) result.condensed.stability.pose_controlled = *in_chains - system.closure_count();
  if (regular)
    result.condensed.stability.force_controlled = inertia->negative - system.closure_count();
  if (in_chains)
    result.condensed.platform.eigenvalues =
        lowest_eigenvalues(system, matrices, A, J.largest, *in_chains);
  return result;
}

}  // namespace springfold::statics
