#include "locked_chains.hpp"

#include <algorithm>

#include "closure_rank.hpp"
#include "morse.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

continuation::CurvePoint point_at(const Vector& z, const Piece& piece) {
  continuation::CurvePoint point;
  point.x = z;
  point.piece = piece;
  return point;
}

/// The equilibrium's matrix, with the wrenches of z.
Matrix matrix_at(const PathProblem& problem, const Vector& z, const Piece& piece) {
  const statics::System& system = problem.system(0);
  statics::Workspace work;
  Vector r;
  Matrix A;
  if (!equilibrium_matrix(system, piece, z, problem.inputs(0), work, r, A)) return {};
  return statics::without_gauge(A, work);
}

/// Motions of the chain's joints that its end and its energy do not feel, to second order.
Index motions_left_free(const PathProblem& problem, const FoundEquilibrium& found,
                        const statics::ChainSlice& slice) {
  const auto own = [&](const Matrix& A) -> Matrix {
    return A.block(slice.x, slice.x, slice.x_count, slice.x_count);
  };
  const Matrix A = matrix_at(problem, found.z, found.piece);
  if (A.size() == 0) return 0;
  const Svd closure = jacobi_svd(A.block(slice.F, slice.x, slice.F_count, slice.x_count),
                                 SingularVectors::full, SingularVectors::full);
  const Index rank =
      (closure.values.array() > same_rank * std::max(1.0, closure.values.norm())).count();
  const Matrix K = closure.V.rightCols(slice.x_count - rank);
  const Matrix lost = closure.U.rightCols(slice.F_count - rank);
  Matrix felt((1 + lost.cols()) * K.cols(), K.cols());
  felt.topRows(K.cols()) = K.transpose() * own(A) * K;
  for (Index i = 0; i < lost.cols(); ++i) {
    Vector z = found.z;
    z.segment(slice.F, slice.F_count) += lost.col(i);
    const Matrix B = matrix_at(problem, z, found.piece);
    if (B.size() == 0) return 0;
    felt.middleRows((1 + i) * K.cols(), K.cols()) = K.transpose() * (own(B) - own(A)) * K;
  }
  return K.cols() - rank_of(felt, same_rank);
}

}  // namespace

std::vector<Index> full_ranks(const Evaluator& evaluator,
                              const std::vector<FoundEquilibrium>& found) {
  std::vector<Index> full;
  const auto add = [&](const Vector& z, const Piece& piece) {
    const auto ranks = evaluator.closure_ranks(point_at(z, piece));
    full.resize(std::max(full.size(), ranks.size()), 0);
    for (std::size_t i = 0; i < ranks.size(); ++i) full[i] = std::max(full[i], ranks[i]);
  };
  for (const FoundEquilibrium& f : found) add(f.z, f.piece);
  if (found.empty()) return full;
  const Vector& z = found.front().z;
  add(z + look_beside * any_direction(z.size()), found.front().piece);
  return full;
}

std::string locked_chains(const PathProblem& problem, const Evaluator& evaluator,
                          const FoundEquilibrium& found, const std::vector<Index>& full) {
  const statics::System& system = problem.system(0);
  if (system.chains.size() == 1 && !is_bar(system, 0)) return "";
  const auto ranks = evaluator.closure_ranks(point_at(found.z, found.piece));
  std::string names;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const statics::ChainSlice& slice = system.chain_slices[i];
    if (ranks[i] >= full[i] || motions_left_free(problem, found, slice) <= slice.x_count - full[i])
      continue;
    names += (names.empty() ? "" : ", ") + system.mechanism.chains[i].name;
  }
  return names;
}

}  // namespace springfold::analysis
