#include "springfold/statics/stage_jacobians.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "springfold/core/sparse_matrices.hpp"
#include "springfold/statics/couplings.hpp"
#include "stage_chain.hpp"

namespace springfold::statics {
namespace {

/// Is a chain so long that it is cut into stages?
bool has_long_chain(const System& system, Index unknowns) {
  if (!has_stage_form(system)) return false;
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    const ChainSlice& slice = system.chain_slices[i];
    if (slice.x_count + slice.F_count >= unknowns && has_stage_form(system, i)) return true;
  }
  return false;
}

/// Couplings with the root unknowns instead of the poses.
std::vector<std::vector<Index>> root_couplings(const System& system,
                                               const std::vector<std::vector<Index>>& columns) {
  std::vector<std::vector<Index>> lists = couplings(system);
  if (columns.empty()) return lists;
  for (auto& list : lists) {
    std::vector<Index> own;
    for (const Index z : list)
      if (z < system.first_pose) own.push_back(z);
    for (std::size_t b = 0; b < columns.size(); ++b)
      if (std::find(list.begin(), list.end(), system.body_slices[b].t) != list.end())
        for (const Index column : columns[b]) own.push_back(system.first_pose + column);
    list = std::move(own);
  }
  std::erase_if(lists, [](const auto& list) { return list.empty(); });
  return lists;
}

Index root_count(const System& system, const std::vector<std::vector<Index>>& columns) {
  if (columns.empty()) return system.size - system.first_pose;
  Index count = 0;
  for (const auto& list : columns) count += std::ssize(list);
  return count;
}

}  // namespace

/// Either in stages, or, of many members, with entries.
struct StageJacobians::Layout {
  System system;
  std::vector<std::vector<Index>> root_columns;
  StagePlan plan{};
  std::optional<SparseLayout> sparse{};
};

/// One matrix, and its factorisation once it is asked for.
struct StageJacobians::Slot {
  explicit Slot(std::shared_ptr<const Layout> of) : layout{std::move(of)}, solver{layout->plan} {
    if (layout->sparse) entries.emplace(*layout->sparse);
  }

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

  /// Of many members: the matrix by poses and by commands, and that of the root unknowns.
  struct Entries {
    explicit Entries(const SparseLayout& of) : matrices{of} {}
    Matrix A{}, by_commands{}, reduced{};
    Workspace work{};
    SparseMatrices matrices;
    StructuredMatrix J{};
  };
  std::optional<Entries> entries{};

  bool factorise(const FrontalBorders& wanted);
  bool take(const FrontalBorders& wanted);
  bool solve(const FrontalBorders& wanted, Matrix& X, bool transposed);
  std::optional<Inertia> inertia();
  void multiply(const StageMatrix& A, const Matrix& basis, const Matrix& own, const Vector& v,
                Vector& result);
  const Matrix& reduce(const Matrix& basis, const Matrix& own);
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

/// Are the body's root unknowns its pose coordinates themselves?
bool is_plain(const BodySlice& body, const std::vector<Index>& columns, const Matrix& basis,
              Index first) {
  if (std::ssize(columns) != body.count) return false;
  for (Index k = 0; k < body.count; ++k) {
    const Index column = columns[static_cast<std::size_t>(k)];
    if (column != columns.front() + k) return false;
    for (Index i = 0; i < body.count; ++i)
      if (basis(body.t - first + i, column) != (i == k ? 1 : 0)) return false;
  }
  return true;
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

/// basis^T A basis + own, body by body: each body has root unknowns of its own. Columns one after the other, as they
/// lie in memory; most bodies of structures are points, whose part is that of A.
const Matrix& StageJacobians::Slot::reduce(const Matrix& basis, const Matrix& own) {
  Entries& e = *entries;
  const System& system = layout->system;
  const Index first = system.first_pose, roots = root_count(system, layout->root_columns);
  std::vector<char> plain(system.body_slices.size(), 1);
  if (basis.size() > 0)
    for (std::size_t b = 0; b < plain.size(); ++b)
      plain[b] = is_plain(system.body_slices[b], layout->root_columns[b], basis, first) ? 1 : 0;
  bool unchanged = true;
  for (std::size_t b = 0; basis.size() > 0 && b < plain.size(); ++b)
    unchanged &= plain[b] && layout->root_columns[b].front() == system.body_slices[b].t - first;
  if (unchanged && own.size() == 0) return e.A;
  if (unchanged) {
    e.reduced = e.A;
  } else {
    e.reduced.resize(first + roots, first + roots);
    Vector column(system.size);
    const auto put = [&](Index target) {  // basis^T column
      e.reduced.col(target).head(first) = column.head(first);
      for (std::size_t b = 0; b < plain.size(); ++b) {
        const BodySlice& body = system.body_slices[b];
        const std::vector<Index>& rows = layout->root_columns[b];
        if (plain[b])
          e.reduced.col(target).segment(first + rows.front(), body.count) =
              column.segment(body.t, body.count);
        else
          for (const Index row : rows)
            e.reduced(first + row, target) = basis.col(row)
                                                 .segment(body.t - first, body.count)
                                                 .dot(column.segment(body.t, body.count));
      }
    };
    for (Index i = 0; i < first; ++i) {
      column = e.A.col(i);
      put(i);
    }
    for (std::size_t b = 0; b < plain.size(); ++b) {
      const BodySlice& body = system.body_slices[b];
      for (const Index into : layout->root_columns[b]) {
        column.noalias() = e.A.middleCols(body.t, body.count) *
                           basis.col(into).segment(body.t - first, body.count);
        put(first + into);
      }
    }
  }
  if (own.size() > 0) e.reduced.bottomRightCorner(roots, roots) += own;
  return e.reduced;
}

bool has_entries(const System& system) {
  constexpr Index long_chain = 48;  // as prefers_stages() has it
  return !has_long_chain(system, long_chain) && prefers_sparse(system);
}

bool prefers_stages(const System& system, Index unknowns) {
  return has_long_chain(system, unknowns) || prefers_sparse(system);
}

StageJacobians::StageJacobians(const System& layout,
                               const std::vector<std::vector<Index>>& root_columns) {
  Layout own{layout, root_columns};
  if (has_entries(layout))
    own.sparse.emplace(layout.first_pose + root_count(layout, root_columns),
                       root_couplings(layout, root_columns));
  else
    own.plan = plan_stages(layout, root_columns);
  layout_ = std::make_shared<const Layout>(std::move(own));
}

const StagePlan& StageJacobians::plan() const { return layout_->plan; }

std::shared_ptr<StageJacobians::Slot> StageJacobians::free_slot() {
  last_.reset();
  for (const auto& slot : slots_)
    if (slot.use_count() == 1) return slot;
  return slots_.emplace_back(std::make_shared<Slot>(layout_));
}

bool StageJacobians::residual(const System& system, const Piece& piece, const Vector& z,
                              const Inputs& inputs, Vector& r) {
  if (layout_->sparse) {
    const std::shared_ptr<Slot> slot = last_ ? last_ : free_slot();
    return equilibrium_residual(system, piece, z, inputs, slot->entries->work, r);
  }
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
  if (layout_->sparse) {
    Slot::Entries& e = *slot->entries;
    if (!equilibrium_matrix(system, piece, z, inputs, e.work, r, e.A, &e.by_commands)) return false;
    last_ = slot;
    return true;
  }
  if (!evaluate_stages(layout_->plan, system, piece, z, inputs, r, slot->matrix, true))
    return false;
  last_ = slot;
  return true;
}

bool StageJacobians::end_matrix(const System& system, const Matrix& basis, const Matrix& added,
                                StructuredMatrix& A_y) {
  assert(last_ != nullptr);
  Slot* const slot = last_.get();
  if (layout_->sparse) {
    slot->entries->matrices.take(slot->reduce(basis, added), slot->entries->J);
    A_y = slot->entries->J;
    A_y.owner = last_;
    return true;
  }
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
  if (layout_->sparse) {
    result.setZero(dz.size());
    for (Index k = 0; k < dz.size(); ++k)  // most are zero: columns are asked for
      if (dz[k] != 0) result += dz[k] * last_->entries->A.col(k);
    if (drho.size() > 0) result.noalias() += last_->entries->by_commands * drho;
    return;
  }
  stage_product(layout_->plan, layout_->system, last_->matrix, dz, drho, last_->scratch, result);
}

Vector StageJacobians::product(const Vector& dz, const Vector& drho) const {
  Vector result;
  product(dz, drho, result);
  return result;
}

Matrix StageJacobians::chain_stiffness(std::size_t chain, const Matrix& held) const {
  assert(last_ != nullptr && !layout_->sparse);
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
