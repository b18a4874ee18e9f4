#include "springfold/statics/stage_jacobians.hpp"

#include <cassert>
#include <utility>

#include "stage_chain.hpp"

namespace springfold::statics {

struct StageJacobians::Layout {
  System system;
  StagePlan plan;
};

/// One matrix, and its factorisation once it is asked for.
struct StageJacobians::Slot {
  explicit Slot(std::shared_ptr<const Layout> of) : layout{std::move(of)}, solver{layout->plan} {}

  std::shared_ptr<const Layout> layout;
  StageMatrix matrix{};
  Matrix added{};
  StageSolver solver;
  FrontalBorders borders{};  ///< that the solver has now
  bool factorised = false;
  StageMatrix sizes{};  ///< once they are asked for
  bool sized = false;
  Matrix basis_sizes{}, added_sizes{};
  StageScratch scratch{};
  Vector absolute{}, dz{}, dr{}, root{};

  bool factorise(const FrontalBorders& wanted);
  bool take(const FrontalBorders& wanted);
  bool solve(const FrontalBorders& wanted, Matrix& X, bool transposed);
  std::optional<Inertia> inertia();
  void multiply(const StageMatrix& A, const Matrix& basis, const Matrix& own, const Vector& v,
                Vector& result);
  void product(const Vector& v, Vector& result);
  void magnitudes(const Vector& v, Vector& result);
};

namespace {

/// Borders that grow more in the elimination take part in it themselves.
constexpr double largest_growth = 1e4;

template <class Entries>
double most(const Entries& m) {
  return m.size() > 0 ? m.cwiseAbs().maxCoeff() : 0;
}

double largest_entry(const StageMatrix& matrix) {
  double largest = most(matrix.stiffness);
  for (const Matrix& group : matrix.groups) largest = std::max(largest, most(group));
  for (const Matrix& block : matrix.blocks) largest = std::max(largest, most(block));
  for (const ChainSums& sums : matrix.sums)
    largest = std::max({largest, most(sums.J), most(sums.J_to), most(sums.H_from), most(sums.H_to),
                        most(sums.turn) * most(sums.moment)});
  return largest;
}

bool same(const FrontalBorders& a, const FrontalBorders& b) {
  return a.B.cols() == b.B.cols() && a.B == b.B && a.C == b.C && a.D == b.D;
}

}  // namespace

bool StageJacobians::Slot::factorise(const FrontalBorders& wanted) {
  factorised = solver.factorise(matrix, wanted);
  borders = wanted;
  return factorised;
}

bool StageJacobians::Slot::take(const FrontalBorders& wanted) {
  if (!factorised) return factorise(wanted);
  if (same(borders, wanted)) return true;
  borders = wanted;
  if (!solver.set_borders(wanted)) return factorised = false;
  return solver.frontal().border_growth() <= largest_growth || factorise(wanted);
}

bool StageJacobians::Slot::solve(const FrontalBorders& wanted, Matrix& X, bool transposed) {
  if (!take(wanted)) return false;
  return transposed ? solver.solve_transposed(X) : solver.solve(X);
}

std::optional<Inertia> StageJacobians::Slot::inertia() {
  const Index n = layout->plan.size();
  if (!factorised && !factorise({Matrix(n, 0), Matrix(n, 0), Matrix(0, 0)})) return std::nullopt;
  return solver.inertia();
}

/// (basis^T A basis + own) v
void StageJacobians::Slot::multiply(const StageMatrix& A, const Matrix& basis, const Matrix& own,
                                    const Vector& v, Vector& result) {
  const StagePlan& plan = layout->plan;
  const Index first = plan.chain_unknowns, count = plan.root_unknowns, poses = basis.rows();
  dz.resize(first + poses);
  dz.head(first) = v.head(first);
  dz.tail(poses).noalias() = basis * v.tail(count);
  stage_product(plan, layout->system, A, dz, {}, scratch, dr);
  result.resize(plan.size());
  result.head(first) = dr.head(first);
  result.tail(count).noalias() = basis.transpose() * dr.tail(poses);
  if (own.size() == 0) return;
  root.noalias() = own * v.tail(count);
  result.tail(count) += root;
}

void StageJacobians::Slot::product(const Vector& v, Vector& result) {
  multiply(matrix, matrix.basis, added, v, result);
}

/// The sizes of what is summed up in A_y v.
void StageJacobians::Slot::magnitudes(const Vector& v, Vector& result) {
  if (!sized) {
    put_sizes(matrix, sizes);
    basis_sizes = matrix.basis.cwiseAbs();
    added_sizes = -added.cwiseAbs();
    sized = true;
  }
  absolute = v.cwiseAbs();
  multiply(sizes, basis_sizes, added_sizes, absolute, result);
  result = -result;
}

bool prefers_stages(const System& system, Index unknowns) {
  if (!has_stage_form(system)) return false;
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    const ChainSlice& slice = system.chain_slices[i];
    if (slice.x_count + slice.F_count >= unknowns && has_stage_form(system, i)) return true;
  }
  return false;
}

StageJacobians::StageJacobians(const System& layout,
                               const std::vector<std::vector<Index>>& root_columns)
    : layout_{std::make_shared<const Layout>(Layout{layout, plan_stages(layout, root_columns)})} {}

const StagePlan& StageJacobians::plan() const { return layout_->plan; }

std::shared_ptr<StageJacobians::Slot> StageJacobians::free_slot() {
  last_.reset();
  for (const auto& slot : slots_)
    if (slot.use_count() == 1) return slot;
  return slots_.emplace_back(std::make_shared<Slot>(layout_));
}

bool StageJacobians::residual(const System& system, const Piece& piece, const Vector& z,
                              const Inputs& inputs, Vector& r) {
  return equilibrium_stages(layout_->plan, system, piece, z, inputs, {}, {}, r, scratch_, false);
}

bool StageJacobians::matrix(const System& system, const Piece& piece, const Vector& z,
                            const Inputs& inputs, const Matrix& basis, const Matrix& added,
                            Vector& r, StructuredMatrix& A_y) {
  return begin_matrix(system, piece, z, inputs, r) && end_matrix(system, basis, added, A_y);
}

bool StageJacobians::begin_matrix(const System& system, const Piece& piece, const Vector& z,
                                  const Inputs& inputs, Vector& r) {
  const std::shared_ptr<Slot> slot = free_slot();
  slot->factorised = slot->sized = false;
  if (!evaluate_stages(layout_->plan, system, piece, z, inputs, r, slot->matrix, true))
    return false;
  last_ = slot;
  return true;
}

bool StageJacobians::end_matrix(const System& system, const Matrix& basis, const Matrix& added,
                                StructuredMatrix& A_y) {
  assert(last_ != nullptr);
  Slot* const slot = last_.get();
  slot->added = added;
  if (!put_stage_matrix(layout_->plan, system, basis, added, slot->matrix)) {
    last_.reset();
    return false;
  }
  A_y.largest = largest_entry(slot->matrix);
  A_y.product = [slot](const Vector& v, Vector& result) { slot->product(v, result); };
  A_y.magnitudes = [slot](const Vector& v, Vector& result) { slot->magnitudes(v, result); };
  A_y.solve = [slot](const FrontalBorders& borders, Matrix& X, bool transposed) {
    return slot->solve(borders, X, transposed);
  };
  A_y.inertia = [slot] { return slot->inertia(); };
  A_y.owner = last_;
  return true;
}

void StageJacobians::product(const Vector& dz, const Vector& drho, Vector& result) const {
  assert(last_ != nullptr);
  stage_product(layout_->plan, layout_->system, last_->matrix, dz, drho, last_->scratch, result);
}

Vector StageJacobians::product(const Vector& dz, const Vector& drho) const {
  Vector result;
  product(dz, drho, result);
  return result;
}

Matrix StageJacobians::chain_stiffness(std::size_t chain, const Matrix& held) const {
  assert(last_ != nullptr);
  const System& system = layout_->system;
  const ChainSlice& s = system.chain_slices[chain];
  const Index t = s.to >= 0 ? s.to : s.from, first = system.first_pose;
  const Index count =
      s.to >= 0 ? system.chains[chain].to_count() : system.chains[chain].first_joint();
  Matrix K(count, count);
  for (Index c = 0; c < count; ++c) {
    const Vector dz = held.col(t - first + c);
    Vector r = Vector::Zero(system.size);
    if (layout_->plan.chains[chain].staged) {
      add_chain_product(system, chain, last_->matrix.sums[chain], dz, {}, last_->scratch, r);
    } else {
      const std::vector<Index>& places = layout_->plan.dense[chain].places;
      r(places) = last_->matrix.blocks[chain] * Vector(dz(places));
    }
    K.col(c) = r.segment(t, count);
  }
  return K;
}

}  // namespace springfold::statics
