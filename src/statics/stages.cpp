#include "springfold/statics/stages.hpp"

#include <cassert>

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
  for (std::size_t k = 0; k < part.springs.size(); ++k)
    out.springs[k].law = system.springs[part.springs[k]].law;
  for (std::size_t k = 0; k < part.loads.size(); ++k)
    out.loads[k].vector = system.loads[part.loads[k]].vector;
  for (std::size_t k = 0; k < part.line_springs.size(); ++k) {
    out.line_springs[k].stiffness = system.line_springs[part.line_springs[k]].stiffness;
    out.line_springs[k].free = system.line_springs[part.line_springs[k]].free;
  }
  for (std::size_t k = 0; k < part.groups.size(); ++k) {
    out.coupled[k].stiffness = system.coupled[part.groups[k]].stiffness;
    out.coupled[k].free = system.coupled[part.groups[k]].free;
  }
}

Piece part_of(const DensePart& part, const System& system, const Piece& piece) {
  Piece own;
  for (const std::size_t i : part.springs) {
    const CoordinateSpring& spring = system.springs[i];
    const auto first = piece.begin() + spring.first_switch;
    own.insert(own.end(), first,
               first + static_cast<std::ptrdiff_t>(spring.law.breakpoints.size()));
  }
  return own;
}

/// Where the unknowns of a part stand in z.
std::vector<Index> places_of(const System& system, Index chain) {
  std::vector<Index> places;
  if (chain >= 0) {
    const ChainSlice& slice = system.chain_slices[static_cast<std::size_t>(chain)];
    for (Index k = 0; k < slice.x_count + slice.F_count; ++k) places.push_back(slice.x + k);
  }
  for (Index k = system.first_pose; k < system.size; ++k) places.push_back(k);
  return places;
}

/// Adds a dense part's residual; keeps its matrix and derivatives by commands.
bool add_part(const StagePlan& plan, std::size_t p, const System& system, const Piece& piece,
              const Vector& z, const Inputs& inputs, Vector& residual, StageMatrix& matrix,
              bool with_matrix) {
  const bool bodies = p == plan.chains.size();
  const DensePart& part = plan.dense[p];
  const Index chain = bodies ? -1 : static_cast<Index>(p);
  System& own = matrix.parts[p];
  refresh(part, system, chain, own);
  const std::vector<Index> places = places_of(system, chain);
  Inputs own_inputs = inputs;
  if (!bodies) own_inputs.W.setZero();
  const Piece own_piece = part_of(part, system, piece);
  const Vector own_z = z(places);
  Vector own_residual;
  const bool finite =
      with_matrix
          ? equilibrium_matrix(own, own_piece, own_z, own_inputs, matrix.dense, own_residual,
                               matrix.blocks[p], &matrix.block_rates[p])
          : equilibrium_residual(own, own_piece, own_z, own_inputs, matrix.dense, own_residual);
  residual(places) += own_residual;
  return finite;
}

void add_springs(const StagePlan& plan, const System& system, const Piece& piece, const Vector& z,
                 Vector& residual, StageMatrix& matrix) {
  matrix.stiffness.setZero(plan.chain_unknowns);
  for (const CoordinateSpring& spring : system.springs) {
    const std::size_t segment = segment_of(spring, piece);
    residual[spring.coordinate] += spring.law.torque(segment, z[spring.coordinate]);
    matrix.stiffness[spring.coordinate] += spring.law.segments[segment].stiffness;
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
  Vector largest = Vector::Zero(plan.root_unknowns);
  const auto see = [&](const Matrix& J, Index t, const ChainSlice& slice) {
    const Matrix rows = J * matrix.basis.middleRows(t - plan.chain_unknowns, J.cols());
    const Vector scale = matrix.scale.segment(slice.F, slice.F_count);
    largest =
        largest.cwiseMax((scale.asDiagonal() * rows).cwiseAbs().colwise().maxCoeff().transpose());
  };
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    if (!plan.chains[i].staged) continue;
    const ChainSlice& slice = system.chain_slices[i];
    if (slice.from >= 0)
      see(matrix.sums[i].J.leftCols(system.chains[i].first_joint()), slice.from, slice);
    if (slice.to >= 0) see(matrix.sums[i].J_to, slice.to, slice);
  }
  for (Index c = 0; c < plan.root_unknowns; ++c)
    matrix.scale[plan.chain_unknowns + c] =
        largest[c] > 0 ? power_of_two_near(1 / largest[c]) : 1.0;
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
  Matrix values = Matrix::Zero(m, m);
  values.topLeftCorner(own, own) = A.topLeftCorner(own, own);
  for (Index c = own; c < m; ++c)
    values.row(c).head(own) =
        matrix.basis.col(ids[c] - plan.chain_unknowns).transpose() * A.block(own, 0, poses, own);
  for (Index c = 0; c < m; ++c)
    for (Index r = c; r < m; ++r) values(r, c) *= matrix.scale[ids[r]] * matrix.scale[ids[c]];
  std::copy(values.data(), values.data() + m * m,
            matrix.values.data() + plan.pattern.first_value[f]);
}

/// Everything between poses.
Matrix root_of(const StagePlan& plan, const System& system, const StageMatrix& matrix,
               const Matrix& added) {
  Matrix poses = matrix.blocks.back();
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
  Matrix root = matrix.basis.transpose() * poses * matrix.basis;
  if (added.size() > 0) root += added;
  const auto scale = matrix.scale.segment(first, plan.root_unknowns).asDiagonal();
  return scale * root * scale;
}

}  // namespace

bool equilibrium_stages(const StagePlan& plan, const System& system, const Piece& piece,
                        const Vector& z, const Inputs& inputs, const Matrix& basis,
                        const Matrix& added, Vector& residual, StageMatrix& matrix,
                        bool with_matrix) {
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
      finite &= add_part(plan, i, system, piece, z, inputs, residual, matrix, with_matrix);
      continue;
    }
    evaluate_chain(plan.chains[i], system, i, z, inputs, matrix.sums[i]);
    add_chain_residual(system, i, z, matrix.sums[i], residual);
  }
  finite &= add_part(plan, chains, system, piece, z, inputs, residual, matrix, with_matrix);
  finite &= residual.allFinite();
  if (!with_matrix || !finite) return finite;

  matrix.basis = basis;
  if (basis.size() == 0) matrix.basis.setIdentity(plan.root_unknowns, plan.root_unknowns);
  matrix.scale.setOnes(plan.pattern.size);
  matrix.values.resize(plan.pattern.first_value.back());
  for (std::size_t i = 0; i < chains; ++i)
    if (plan.chains[i].staged) scale_chain(plan, system, i, matrix, matrix.scale);
  scale_root(plan, system, matrix);
  for (std::size_t i = 0; i < chains; ++i)
    if (plan.chains[i].staged)
      fill_chain(plan, system, i, matrix);
    else
      fill_dense(plan, system, i, matrix);
  matrix.root = root_of(plan, system, matrix, added);
  return matrix.root.allFinite();
}

Vector stage_product(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                     const Vector& dz, const Vector& drho) {
  Vector product = Vector::Zero(system.size);
  product.head(plan.chain_unknowns) = matrix.stiffness.cwiseProduct(dz.head(plan.chain_unknowns));
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    if (!plan.chains[i].staged) continue;
    add_chain_product(system, i, matrix.sums[i], dz, drho, product);
    for (const StageGroup& entry : plan.chains[i].groups) {
      const CoordinateGroup& group = system.coupled[entry.group];
      product(group.coordinates) += group.stiffness * Vector(dz(group.coordinates));
    }
  }
  for (std::size_t p = 0; p < matrix.blocks.size(); ++p) {
    const bool bodies = p == plan.chains.size();
    if (!bodies && plan.chains[p].staged) continue;
    const std::vector<Index> places = places_of(system, bodies ? -1 : static_cast<Index>(p));
    product(places) += matrix.blocks[p] * Vector(dz(places));
    if (drho.size() > 0) product(places) += matrix.block_rates[p] * drho;
  }
  return product;
}

StageSolver::StageSolver(const StagePlan& plan, FrontalOptions options)
    : size_{plan.size()}, pairs_{plan.auxiliary_pairs}, frontal_{plan.pattern, options} {}

FrontalBorders StageSolver::expanded(const FrontalBorders& borders) const {
  FrontalBorders all = borders;
  const Index k = borders.B.cols(), n = scale_.size();
  if (k == 0) return all;
  assert(borders.B.rows() == size_ && borders.C.rows() == size_ && borders.C.cols() == k);
  for (Matrix* side : {&all.B, &all.C}) {
    side->conservativeResize(n, k);
    side->bottomRows(n - size_).setZero();
    side->topRows(size_) = scale_.head(size_).asDiagonal() * side->topRows(size_);
  }
  return all;
}

bool StageSolver::factorise(const StageMatrix& matrix, const FrontalBorders& borders) {
  scale_ = matrix.scale;
  return frontal_.factorise(matrix.values, matrix.root, expanded(borders));
}

bool StageSolver::set_borders(const FrontalBorders& borders) {
  return frontal_.set_borders(expanded(borders));
}

bool StageSolver::solve_with(Matrix& X, bool transposed) const {
  const Index n = scale_.size(), k = X.rows() - size_;
  Matrix all = Matrix::Zero(n + k, X.cols());
  all.topRows(size_) = scale_.head(size_).asDiagonal() * X.topRows(size_);
  all.bottomRows(k) = X.bottomRows(k);
  if (!(transposed ? frontal_.solve_transposed(all) : frontal_.solve(all))) return false;
  X.topRows(size_) = scale_.head(size_).asDiagonal() * all.topRows(size_);
  X.bottomRows(k) = all.bottomRows(k);
  return X.allFinite();
}

bool StageSolver::solve(Matrix& X) const { return solve_with(X, false); }
bool StageSolver::solve_transposed(Matrix& X) const { return solve_with(X, true); }

std::optional<Inertia> StageSolver::inertia(double zero_tolerance) const {
  auto inertia = frontal_.inertia(zero_tolerance);
  if (!inertia) return inertia;
  inertia->negative -= pairs_;
  inertia->positive -= pairs_;
  return inertia;
}

}  // namespace springfold::statics
