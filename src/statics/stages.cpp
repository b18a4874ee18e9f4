#include "springfold/statics/stages.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "springfold/core/scaling.hpp"
#include "stage_chain.hpp"

namespace springfold::statics {
namespace {

/// Present numbers of a dense part: frames, laws, loads may change from call to call.
void refresh(const DensePart& part, const System& system, Index chain, System& out) {
  if (out.body_slices.size() != part.system.body_slices.size()) out = part.system;
  if (chain >= 0) out.chains.front() = system.chains[static_cast<std::size_t>(chain)];
  for (std::size_t k = 0; k < part.points.size(); ++k)
    out.points[k].point = system.points[part.points[k]].point;
  for (std::size_t b = 0; b < out.body_slices.size(); ++b)
    out.body_slices[b].turn = system.body_slices[b].turn;
  for (std::size_t k = 0; k < part.springs.size(); ++k)
    out.springs[k].law = system.springs[part.springs[k]].law;
  for (std::size_t k = 0; k < part.loads.size(); ++k) {
    const PointLoad& load = system.loads[part.loads[k]];
    out.loads[k].vector = load.vector;
    out.loads[k].follows = load.follows;
    out.loads[k].about_one_axis = load.about_one_axis;
  }
  for (std::size_t k = 0; k < part.line_springs.size(); ++k) {
    out.line_springs[k].stiffness = system.line_springs[part.line_springs[k]].stiffness;
    out.line_springs[k].free = system.line_springs[part.line_springs[k]].free;
  }
  for (std::size_t k = 0; k < part.groups.size(); ++k) {
    out.coupled[k].stiffness = system.coupled[part.groups[k]].stiffness;
    out.coupled[k].free = system.coupled[part.groups[k]].free;
  }
}

void cut_piece(const DensePart& part, const System& system, const Piece& piece, Piece& own) {
  own.clear();
  for (const std::size_t i : part.springs) {
    const CoordinateSpring& spring = system.springs[i];
    const auto first = piece.begin() + spring.first_switch;
    own.insert(own.end(), first,
               first + static_cast<std::ptrdiff_t>(spring.law.breakpoints.size()));
  }
}

/// Adds a dense part's residual; keeps its matrix and derivatives by commands.
bool add_part(const StagePlan& plan, std::size_t p, const System& system, const Piece& piece,
              const Vector& z, const Inputs& inputs, Vector& residual, StageMatrix& matrix,
              bool with_matrix) {
  const bool bodies = p == plan.chains.size();
  const DensePart& part = plan.dense[p];
  const Index chain = bodies ? -1 : static_cast<Index>(p);
  StageMatrix::Part& own = matrix.parts[p];
  refresh(part, system, chain, own.system);
  own.inputs = inputs;
  if (!bodies) own.inputs.W.setZero();
  cut_piece(part, system, piece, own.piece);
  const auto n = static_cast<Index>(part.places.size());
  own.z.resize(n);
  for (Index k = 0; k < n; ++k) own.z[k] = z[part.places[static_cast<std::size_t>(k)]];
  const bool finite =
      with_matrix
          ? equilibrium_matrix(own.system, own.piece, own.z, own.inputs, own.work, own.residual,
                               matrix.blocks[p], &matrix.block_rates[p])
          : equilibrium_residual(own.system, own.piece, own.z, own.inputs, own.work, own.residual);
  for (Index k = 0; k < n; ++k)
    residual[part.places[static_cast<std::size_t>(k)]] += own.residual[k];
  return finite;
}

void add_springs(const StagePlan& plan, const System& system, const Piece& piece, const Vector& z,
                 Vector& residual, StageMatrix& matrix) {
  matrix.stiffness.setZero(plan.chain_unknowns);
  for (const CoordinateSpring& spring : system.springs) {
    const std::size_t segment = segment_of(spring, piece);
    residual[spring.coordinate] += spring.law.torque(segment, z[spring.coordinate]);
    matrix.stiffness[spring.coordinate] += spring.law.stiffness(segment, z[spring.coordinate]);
  }
  for (const CoordinateGroup& group : system.coupled) {
    const auto n = static_cast<Index>(group.coordinates.size());
    for (Index i = 0; i < n; ++i) {
      double torque = 0;
      for (Index j = 0; j < n; ++j)
        torque += group.stiffness(i, j) *
                  (z[group.coordinates[static_cast<std::size_t>(j)]] - group.free[j]);
      residual[group.coordinates[static_cast<std::size_t>(i)]] += torque;
    }
  }
  // Dense parts add the springs of their chains themselves.
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    if (plan.chains[i].staged) continue;
    const ChainSlice& slice = system.chain_slices[i];
    residual.segment(slice.x, slice.x_count).setZero();
    matrix.stiffness.segment(slice.x, slice.x_count).setZero();
  }
}

/// Unit size for the couplings of a pose with the wrenches.
void scale_root(const StagePlan& plan, const System& system, StageMatrix& matrix) {
  auto sizes = matrix.scale.segment(plan.chain_unknowns, plan.root_unknowns);
  sizes.setZero();
  const auto see = [&](const auto& J, const Matrix& basis, const std::vector<Index>& root,
                       Index F) {
    for (std::size_t c = 0; c < root.size(); ++c)
      for (Index r = 0; r < J.rows(); ++r) {
        double entry = 0;
        for (Index k = 0; k < J.cols(); ++k) entry += J(r, k) * basis(k, static_cast<Index>(c));
        double& size = matrix.scale[root[c]];
        size = std::max(size, std::abs(entry) * matrix.scale[F + r]);
      }
  };
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    const ChainStages& chain = plan.chains[i];
    if (!chain.staged) continue;
    const ChainSums& sums = matrix.sums[i];
    const Index F = system.chain_slices[i].F;
    see(sums.J.leftCols(system.chains[i].first_joint()), matrix.from_basis[i], chain.from_root, F);
    see(sums.J_to, matrix.to_basis[i], chain.to_root, F);
  }
  for (double& size : sizes) size = size > 0 ? power_of_two_near(1 / size) : 1.0;
}

/// Rows of the basis that belong to one body, columns as in `root`.
void cut_basis(const StagePlan& plan, const Matrix& basis, Index t, Index count,
               const std::vector<Index>& root, Matrix& out) {
  out.resize(count, static_cast<Index>(root.size()));
  for (Index c = 0; c < out.cols(); ++c)
    out.col(c) = basis.block(t - plan.chain_unknowns,
                             root[static_cast<std::size_t>(c)] - plan.chain_unknowns, count, 1);
}

void cut_bases(const StagePlan& plan, const System& system, StageMatrix& matrix) {
  matrix.from_basis.resize(plan.chains.size());
  matrix.to_basis.resize(plan.chains.size());
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    const ChainSlice& slice = system.chain_slices[i];
    const model::CompiledChain& chain = system.chains[i];
    if (chain.from_moves)
      cut_basis(plan, matrix.basis, slice.from, chain.first_joint(), plan.chains[i].from_root,
                matrix.from_basis[i]);
    if (chain.to_moves)
      cut_basis(plan, matrix.basis, slice.to, chain.to_count(), plan.chains[i].to_root,
                matrix.to_basis[i]);
  }
}

/// One dense chain as one front.
void fill_dense(const StagePlan& plan, const System& system, std::size_t i, StageMatrix& matrix) {
  const ChainSlice& slice = system.chain_slices[i];
  const std::size_t f = plan.chains[i].first_front;
  const Index* ids = plan.pattern.variables.data() + plan.pattern.first_variable[f];
  const auto m =
      static_cast<Index>(plan.pattern.first_variable[f + 1] - plan.pattern.first_variable[f]);
  const Index own = slice.x_count + slice.F_count;
  const Matrix& A = matrix.blocks[i];
  const Index poses = A.rows() - own;
  Eigen::Map<Matrix> values(matrix.values.data() + plan.pattern.first_value[f], m, m);
  values.setZero();
  values.topLeftCorner(own, own) = A.topLeftCorner(own, own);
  for (Index c = own; c < m; ++c)
    values.row(c).head(own).noalias() =
        matrix.basis.col(ids[c] - plan.chain_unknowns).transpose() * A.block(own, 0, poses, own);
  for (Index c = 0; c < m; ++c)
    for (Index r = c; r < m; ++r) values(r, c) *= matrix.scale[ids[r]] * matrix.scale[ids[c]];
}

/// Everything between poses.
void fill_root(const StagePlan& plan, const System& system, const Matrix& added,
               StageMatrix& matrix) {
  Matrix& poses = matrix.poses;
  poses = matrix.blocks.back();
  const Index first = plan.chain_unknowns, count = poses.rows();
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    const ChainSlice& slice = system.chain_slices[i];
    if (!plan.chains[i].staged) {
      poses += matrix.blocks[i].bottomRightCorner(count, count);
      continue;
    }
    const ChainSums& sums = matrix.sums[i];
    const Index from = sums.H_from.rows(), to = sums.H_to.rows();
    if (from > 0) poses.block(slice.from - first, slice.from - first, from, from) -= sums.H_from;
    if (to > 0) poses.block(slice.to - first, slice.to - first, to, to) -= sums.H_to;
  }
  matrix.half.noalias() = poses * matrix.basis;
  matrix.root.noalias() = matrix.basis.transpose() * matrix.half;
  if (added.size() > 0) matrix.root += added;
  for (Index c = 0; c < plan.root_unknowns; ++c)
    for (Index r = 0; r < plan.root_unknowns; ++r)
      matrix.root(r, c) *= matrix.scale[first + r] * matrix.scale[first + c];
}

}  // namespace

bool evaluate_stages(const StagePlan& plan, const System& system, const Piece& piece,
                     const Vector& z, const Inputs& inputs, Vector& residual, StageMatrix& matrix,
                     bool for_matrix) {
  assert(z.size() == system.size && inputs.W.size() == system.load_size);
  assert(piece.size() == system.switches.size());
  const std::size_t chains = plan.chains.size();
  matrix.sums.resize(chains);
  matrix.parts.resize(chains + 1);
  matrix.blocks.resize(chains + 1);
  matrix.block_rates.resize(chains + 1);
  residual.setZero(system.size);
  add_springs(plan, system, piece, z, residual, matrix);
  bool finite = true;
  for (std::size_t i = 0; i < chains; ++i) {
    if (!plan.chains[i].staged) {
      finite &= add_part(plan, i, system, piece, z, inputs, residual, matrix, for_matrix);
      continue;
    }
    evaluate_chain(plan.chains[i], system, i, z, inputs, matrix.sums[i]);
    add_chain_residual(system, i, z, matrix.sums[i], residual);
  }
  finite &= add_part(plan, chains, system, piece, z, inputs, residual, matrix, for_matrix);
  return finite && residual.allFinite();
}

bool put_stage_matrix(const StagePlan& plan, const System& system, const Matrix& basis,
                      const Matrix& added, StageMatrix& matrix) {
  const std::size_t chains = plan.chains.size();
  matrix.groups.resize(system.coupled.size());
  for (std::size_t k = 0; k < system.coupled.size(); ++k)
    matrix.groups[k] = system.coupled[k].stiffness;
  if (basis.rows() > 0)
    matrix.basis = basis;
  else
    matrix.basis.setIdentity(plan.root_unknowns, plan.root_unknowns);
  cut_bases(plan, system, matrix);
  matrix.scale.setOnes(plan.pattern.size);
  matrix.values.resize(plan.pattern.first_value.back());
  for (std::size_t i = 0; i < chains; ++i)
    if (plan.chains[i].staged) scale_chain(plan, system, i, matrix);
  scale_root(plan, system, matrix);
  for (std::size_t i = 0; i < chains; ++i)
    if (plan.chains[i].staged)
      fill_chain(plan, system, i, matrix);
    else
      fill_dense(plan, system, i, matrix);
  fill_root(plan, system, added, matrix);
  return matrix.root.allFinite();
}

bool equilibrium_stages(const StagePlan& plan, const System& system, const Piece& piece,
                        const Vector& z, const Inputs& inputs, const Matrix& basis,
                        const Matrix& added, Vector& residual, StageMatrix& matrix,
                        bool with_matrix) {
  return evaluate_stages(plan, system, piece, z, inputs, residual, matrix, with_matrix) &&
         (!with_matrix || put_stage_matrix(plan, system, basis, added, matrix));
}

StageSolver::StageSolver(const StagePlan& plan, FrontalOptions options)
    : size_{plan.size()}, pairs_{plan.auxiliary_pairs}, frontal_{plan.pattern, options} {}

const FrontalBorders& StageSolver::expanded(const FrontalBorders& borders) {
  const Index k = borders.B.cols(), n = scale_.size();
  assert(k == 0 || (borders.B.rows() == size_ && borders.C.rows() == size_));
  assert(borders.C.cols() == k && borders.D.cols() == k);
  const auto expand = [&](const Matrix& side, Matrix& out) {
    out.setZero(n, k);
    for (Index c = 0; c < k; ++c)
      out.col(c).head(size_) = scale_.head(size_).cwiseProduct(side.col(c));
  };
  expand(borders.B, borders_.B);
  expand(borders.C, borders_.C);
  borders_.D = borders.D;
  return borders_;
}

bool StageSolver::factorise(const StageMatrix& matrix, const FrontalBorders& borders) {
  scale_ = matrix.scale;
  return frontal_.factorise(matrix.values, matrix.root, expanded(borders));
}

bool StageSolver::set_borders(const FrontalBorders& borders) {
  return frontal_.set_borders(expanded(borders));
}

bool StageSolver::solve_with(Matrix& X, bool transposed) {
  const Index n = scale_.size(), k = X.rows() - size_;
  all_.setZero(n + k, X.cols());
  for (Index c = 0; c < X.cols(); ++c) {
    all_.col(c).head(size_) = scale_.head(size_).cwiseProduct(X.col(c).head(size_));
    all_.col(c).tail(k) = X.col(c).tail(k);
  }
  if (!(transposed ? frontal_.solve_transposed(all_) : frontal_.solve(all_))) return false;
  for (Index c = 0; c < X.cols(); ++c) {
    X.col(c).head(size_) = scale_.head(size_).cwiseProduct(all_.col(c).head(size_));
    X.col(c).tail(k) = all_.col(c).tail(k);
  }
  return X.allFinite();
}

bool StageSolver::solve(Matrix& X) { return solve_with(X, false); }
bool StageSolver::solve_transposed(Matrix& X) { return solve_with(X, true); }

Inertia StageSolver::inertia(double zero_tolerance) {
  Inertia inertia = frontal_.inertia(zero_tolerance);
  inertia.negative -= pairs_;
  inertia.positive -= pairs_;
  return inertia;
}

}  // namespace springfold::statics
