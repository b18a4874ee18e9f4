// The equilibrium's linearisation in stages, in the form in which the engine asks for large matrices.
#pragma once

#include <memory>
#include <vector>

#include "springfold/core/structured_matrix.hpp"
#include "springfold/statics/stages.hpp"

namespace springfold::statics {

/// Should equilibria of this system be evaluated by StageJacobians? They can be, and a chain is so long that it
/// pays off: `unknowns` or more, beside those of the bodies' poses. Or there are many members, see
/// prefers_sparse() in couplings.hpp.
bool prefers_stages(const System& system, Index unknowns = 48);

/// Evaluates equilibria in stages and hands out their matrices. Where has_entries() of couplings.hpp holds, the
/// matrices have entries instead, and sparse factorisations; there is no plan() and no chain_stiffness() then. Each
/// matrix lives as long as its StructuredMatrix; storage is used again afterwards. One object serves one thread.
class StageJacobians {
 public:
  /// @param root_columns  as in plan_stages()
  /// @pre has_stage_form(layout) or has_entries(layout)
  explicit StageJacobians(const System& layout,
                          const std::vector<std::vector<Index>>& root_columns = {});
  StageJacobians(StageJacobians&&) noexcept = default;
  StageJacobians& operator=(StageJacobians&&) noexcept = default;

  /// As equilibrium_stages(); `system` has the structure of the layout.
  bool residual(const System& system, const Piece& piece, const Vector& z, const Inputs& inputs,
                Vector& r);

  /// The matrix A_y of equilibrium_stages() as well, for the unknowns y = (z up to the poses, root
  /// unknowns).
  bool matrix(const System& system, const Piece& piece, const Vector& z, const Inputs& inputs,
              const Matrix& basis, const Matrix& added, Vector& r, StructuredMatrix& A_y);
  /// The same in two calls, for an `added` that depends on r, both with the same system. What stands below may be asked
  /// after the second one.
  bool begin_matrix(const System& system, const Piece& piece, const Vector& z, const Inputs& inputs,
                    Vector& r);
  bool end_matrix(const System& system, const Matrix& basis, const Matrix& added,
                  StructuredMatrix& A_y);

  /// A dz + (d residual/d rho) drho at the place of the last matrix(); see stage_product().
  void product(const Vector& dz, const Vector& drho, Vector& result) const;
  Vector product(const Vector& dz, const Vector& drho) const;

  /// Stiffness of one chain at the place of the last matrix(), paper eq. (12), all bodies held.
  /// @param held  per column: z for a unit displacement of one pose coordinate of one body, all other
  ///              ones zero, of the last system's size
  /// @returns d x d in the coordinates of the chain's moving end body, its front body if that is the
  ///          base's; see chain_stiffness()
  Matrix chain_stiffness(std::size_t chain, const Matrix& held) const;

  const StagePlan& plan() const;

 private:
  struct Layout;
  struct Slot;
  std::shared_ptr<Slot> free_slot();

  std::shared_ptr<const Layout> layout_;
  std::vector<std::shared_ptr<Slot>> slots_{};
  std::shared_ptr<Slot> last_{};
  StageMatrix scratch_{};
};

}  // namespace springfold::statics
