#include "springfold/statics/redundancy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "minimum_norm.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/statics/stage_jacobians.hpp"

namespace springfold::statics {
namespace {

constexpr double dependent = 1e-9;  // singular values relative to the largest

/// The closure equations alone as functions of all coordinates and poses.
class ClosureEquations {
 public:
  ClosureEquations(const System& system, const Vector& rho) : system_{system} {
    inputs_.rho = rho;
    inputs_.W = Vector::Zero(system.load_size);
    inputs_.loads = Vector::Zero(static_cast<Index>(system.mechanism.loads.size()));
    for (Index i = 0; i < system.size; ++i)
      (system.is_wrench[static_cast<std::size_t>(i)] ? rows_ : columns_).push_back(i);
    if (prefers_stages(system)) stages_.emplace(system);
  }

  bool evaluate(const Vector& z, Vector& e, Matrix& J) {
    Vector unloaded = z;
    unloaded(rows_).setZero();
    if (stages_) return evaluate_in_stages(unloaded, e, J);
    if (!equilibrium_matrix(system_, piece_at(system_, unloaded), unloaded, inputs_, work_, r_, A_))
      return false;
    e = r_(rows_);
    J = A_(rows_, columns_);
    return true;
  }

  /// Minimum-norm Newton steps until the closures are zero to rounding.
  bool close(Vector& z) {
    Vector e;
    Matrix J;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 60; ++i) {
      if (!evaluate(z, e, J)) return false;
      const double gap = e.lpNorm<Eigen::Infinity>();
      if (gap < 1e-15 || (gap < 1e-12 && gap > 0.5 * before)) return true;
      before = gap;
      Vector step = -minimum_norm_solution(J, e, dependent);
      const double length = step.lpNorm<Eigen::Infinity>();
      if (!std::isfinite(length)) return false;
      if (length > 0.3) step *= 0.3 / length;
      z(columns_) += step;
    }
    return before < 1e-12;
  }

  void perturb(Vector& z, double size, std::mt19937_64& random) const {
    for (const Index i : columns_) {
      const double uniform = static_cast<double>(random() >> 11) * 0x1p-53;  // any platform
      z[i] += size * (2 * uniform - 1);
    }
  }

  const std::vector<Index>& rows() const { return rows_; }

 private:
  /// Rows of closures are columns of wrenches: one by one.
  bool evaluate_in_stages(const Vector& z, Vector& e, Matrix& J) {
    StructuredMatrix A;
    if (!stages_->matrix(system_, piece_at(system_, z), z, inputs_, {}, {}, r_, A)) return false;
    e = r_(rows_);
    J.resize(static_cast<Index>(rows_.size()), static_cast<Index>(columns_.size()));
    for (Index k = 0; k < J.rows(); ++k) {
      const Vector row = product(A, Vector::Unit(system_.size, rows_[static_cast<std::size_t>(k)]));
      J.row(k) = row(columns_);
    }
    return true;
  }

  const System& system_;
  std::optional<StageJacobians> stages_{};  ///< of long chains
  Inputs inputs_{};
  std::vector<Index> rows_{}, columns_{};
  Workspace work_{};
  Vector r_{};
  Matrix A_{};
};

/// What the closures' singular values say in one state.
struct Ranks {
  Index dropped = 0;
  double smallest_kept = 1, largest_dropped = 0;
  Matrix null{};  ///< rows x dropped
};

Ranks ranks_of(const Matrix& J) {
  Ranks ranks;
  const Svd svd = jacobi_svd(J, SingularVectors::full);
  const Vector& values = svd.values;
  const double largest = values.size() > 0 ? values[0] : 0;
  Index kept = 0;
  for (const double value : values) {
    if (value <= dependent * largest) break;
    ranks.smallest_kept = value / largest;
    ++kept;
  }
  if (kept < values.size()) ranks.largest_dropped = values[kept] / largest;
  ranks.dropped = J.rows() - kept;
  ranks.null = svd.U.rightCols(ranks.dropped);
  return ranks;
}

}  // namespace

Redundancy redundant_closures(const System& system, const Vector& z, const Vector& rho,
                              std::uint64_t seed) {
  Redundancy result;
  System plain = system;
  plain.redundant = 0;
  ClosureEquations closures(plain, rho);
  std::mt19937_64 random(seed);
  Vector e, here = z;
  Matrix J;
  bool closed = closures.close(here);
  for (int attempt = 1; attempt < 16 && !closed; ++attempt) {
    here = z;
    closures.perturb(here, std::min(1.5, 0.02 * std::pow(1.6, attempt)), random);
    closed = closures.close(here);
  }
  if (!closed || !closures.evaluate(here, e, J)) return result;
  result.assembled = true;
  Ranks best = ranks_of(J);
  for (int sample = 0; sample < 4 && best.dropped > 0; ++sample) {
    Vector near = here;
    closures.perturb(near, 0.05, random);
    if (!closures.close(near) || !closures.evaluate(near, e, J)) continue;
    const Ranks ranks = ranks_of(J);
    if (ranks.dropped < best.dropped) best = ranks;
  }
  result.count = best.dropped;
  result.smallest_kept = best.smallest_kept;
  result.largest_dropped = best.largest_dropped;
  if (best.dropped == 0) return result;
  Index row = 0;
  for (std::size_t c = 0; c < system.chain_slices.size(); ++c) {
    const Index d = system.chain_slices[c].F_count;
    if (best.null.middleRows(row, d).norm() > 1e-6) result.chains.push_back(c);
    row += d;
  }
  return result;
}

}  // namespace springfold::statics
