#include "springfold/statics/sparse_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/inertia.hpp"
#include "statics/symmetric_part.hpp"

namespace springfold::statics {
namespace {

constexpr Index wanted_eigenvalues = 3;
constexpr Index width = 4;    ///< of the blocks: so many equal ones are found
constexpr Index blocks = 60;  ///< at most
constexpr Index look = 4;     ///< after so many blocks eigenvalues are looked at

/// Residual of an eigenvalue of K^-1, in itself: its error is the square of that over the gap to the next.
constexpr double settled = 1e-9;

FrontalBorders no_borders(Index n) { return {Matrix(n, 0), Matrix(n, 0), Matrix(0, 0)}; }

/// The unknowns before the poses in groups that do not meet: those of a chain, and those of springs in series.
std::vector<std::vector<Index>> inner_groups(const System& system) {
  std::vector<std::vector<Index>> groups;
  const auto add = [&groups](Index first, Index count) {
    for (Index k = 0; k < count; ++k) groups.back().push_back(first + k);
  };
  for (const ChainSlice& slice : system.chain_slices) {
    groups.emplace_back();
    add(slice.x, slice.x_count);
    add(slice.F, slice.F_count);
  }
  for (const PointShape& shape : system.shapes) {
    if (shape.inner_count == 0) continue;
    groups.emplace_back();
    add(shape.inner, shape.inner_count);
  }
  return groups;
}

/// Sum over these groups of the eigenvalues of their own blocks. Zeros belong to wrenches of rigid chains, as those
/// of nodes that slide along a guide.
std::optional<Inertia> inertia_of_chains(const System& system, const StructuredMatrix& A) {
  Inertia sum;
  for (const std::vector<Index>& own : inner_groups(system)) {
    Matrix block(std::ssize(own), std::ssize(own));
    for (std::size_t k = 0; k < own.size(); ++k)
      block.col(static_cast<Index>(k)) = product(A, Vector::Unit(system.size, own[k]))(own);
    const auto inertia = inertia_of(block);
    if (!inertia) return std::nullopt;
    sum.negative += inertia->negative;
    sum.zero += inertia->zero;
  }
  return sum;
}

/// Entries that no mechanism has any symmetry with, always the same ones.
Matrix first_block(Index rows) {
  Matrix V(rows, width);
  for (Index c = 0; c < width; ++c)
    for (Index i = 0; i < rows; ++i)
      V(i, c) = std::sin(static_cast<double>((c + 1) * (i + 1)) + 0.5 * static_cast<double>(c));
  return V;
}

/// Eigenvalues of a symmetric matrix that is known by its products: all negative ones, whose number is known,
/// and the largest ones.
class BlockKrylov {
 public:
  BlockKrylov(Index size, Index negative, Index positive)
      : negative_{negative}, positive_{positive} {
    basis_.resize(size, std::min(size, blocks * width));
    images_.resize(size, basis_.cols());
  }

  /// @param apply  replaces a block by the matrix times it; false: it cannot
  template <class Apply>
  std::optional<Vector> run(const Apply& apply) {
    Matrix V = first_block(basis_.rows());
    for (Index round = 1; used_ < basis_.cols(); ++round) {
      const Index first = used_;
      append(V);
      if (used_ == first) break;  // the space is closed
      V = basis_.middleCols(first, used_ - first);
      if (!apply(V)) return std::nullopt;
      images_.middleCols(first, used_ - first) = V;
      if (round % look == 0 && have_settled()) return values_;
    }
    return have_settled() ? std::optional<Vector>(values_) : std::nullopt;
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

  bool have_settled() {
    if (used_ < negative_ + positive_) return false;
    const auto Q = basis_.leftCols(used_);
    const auto BQ = images_.leftCols(used_);
    const SymmetricEigen ritz = symmetric_eigen(symmetric_part(Q.transpose() * BQ));
    if ((ritz.values.array() < 0).count() != negative_) return false;
    values_.resize(negative_ + positive_);
    for (Index k = 0; k < values_.size(); ++k) {
      const Index i = k < negative_ ? k : used_ - 1 - (k - negative_);
      const double theta = values_[k] = ritz.values[i];
      const Vector y = ritz.vectors.col(i);
      if (!((BQ * y - theta * (Q * y)).norm() <= settled * std::abs(theta))) return false;
    }
    return true;
  }

  Index negative_, positive_, used_ = 0;
  Matrix basis_{}, images_{};
  Vector values_{};
};

/// The lowest eigenvalues of K_Sigma, ascending; empty where they are not found.
/// @param negative  how many negative ones it has
Vector lowest_eigenvalues(const System& system, const StructuredMatrix& A, Index negative) {
  const Index n = system.size, t = system.first_pose, nt = system.load_size;
  const FrontalBorders none = no_borders(n);
  Matrix X;
  const auto inverse = [&](Matrix& V) {
    X.setZero(n, V.cols());
    X.middleRows(t, nt) = V;
    if (!A.solve(none, X, false)) return false;
    V = X.middleRows(t, nt);
    return true;
  };
  const Index count = std::min(wanted_eigenvalues, nt);
  const auto c = BlockKrylov(nt, negative, std::max<Index>(count - negative, 0)).run(inverse);
  if (!c) return {};
  Vector values = c->cwiseInverse();
  std::sort(values.begin(), values.end());
  return values.head(count);
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

StagedStiffness sparse_stiffness(const System& system, const StructuredMatrix& A, Index body) {
  StagedStiffness result;
  const auto inertia = A.inertia();
  if (inertia) result.zero_modes = inertia->zero;
  const bool regular = inertia && inertia->zero == 0;
  put_body(system, A, body, regular, result);
  const auto in_chains = inertia_of_chains(system, A);
  if (in_chains && in_chains->zero == 0)
    result.condensed.stability.pose_controlled = in_chains->negative - system.closure_count();
  if (!regular) return result;
  result.condensed.stability.force_controlled = inertia->negative - system.closure_count();
  if (in_chains)
    result.condensed.platform.eigenvalues =
        lowest_eigenvalues(system, A, inertia->negative - in_chains->negative - in_chains->zero);
  return result;
}

}  // namespace springfold::statics
