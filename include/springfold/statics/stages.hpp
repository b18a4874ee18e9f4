// The equilibrium's matrix stage by stage: linear in the number of joints, where the matrix A of
// statics/system.hpp is quadratic and its factorisation cubic. docs/theory.md derives the form.
#pragma once

#include <vector>

#include "springfold/core/frontal.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

struct StageOptions {
  Index coordinates = 4;  ///< per stage; more where a coupled spring holds them together
  Index largest = 24;     ///< a chain that needs larger stages is one dense front
};

/// Can the chain be cut into stages? Not with line springs at its points, not where coupled springs
/// hold more than `largest` coordinates together, not under loads without potential at its points, nor under moments
/// whose potential is that of the body where it begins.
bool has_stage_form(const System& system, std::size_t chain, const StageOptions& options = {});

/// Can the equilibrium be written as strings of fronts? Chains without stage form are then one dense
/// front each. Not with redundant closures, not where line springs join two chains, not under loads
/// without potential at points of chains (at bodies they may stand).
bool has_stage_form(const System& system);

/// A load or weight at a point of a chain.
struct StageLoad {
  std::size_t load = 0;  ///< number in System::loads
  Index joints = 0;      ///< how many joints of the chain carry the point
};

/// A coupled spring within a stage.
struct StageGroup {
  Index stage = 0;
  std::size_t group = 0;  ///< number in System::coupled
};

/// How one chain is cut. Its joints with a coordinate are numbered 0, 1, ...
struct ChainStages {
  bool staged = false;
  Index rank = 3;                    ///< of a turn: 1 where all axes are along z, otherwise 3
  std::vector<Index> joints{};       ///< per coordinate: its joint
  std::vector<Index> first{0};       ///< per stage its first coordinate, and where the last ends
  std::size_t first_front = 0;       ///< in StagePlan::pattern
  Index auxiliary = 0;               ///< first auxiliary variable in the pattern
  std::vector<StageGroup> groups{};  ///< stage by stage
  std::vector<StageLoad> loads{};    ///< the outermost first
  std::vector<Index> from_root{}, to_root{};  ///< root unknowns of the end bodies' poses

  Index stage_count() const { return static_cast<Index>(first.size()) - 1; }
};

/// A part of a system that is evaluated densely: one chain, or the bodies without chains.
struct DensePart {
  System system{};
  std::vector<std::size_t> springs{}, groups{}, points{}, loads{},
      line_springs{};           ///< in the whole
  std::vector<Index> places{};  ///< its unknowns in z
};

/// Who stands where. Made once for a mechanism; systems of the same structure (other numbers, turned
/// frames) may share it.
struct StagePlan {
  /// Variables: the chains' part of z, the root unknowns, auxiliary ones.
  FrontalPattern pattern{};
  Index chain_unknowns = 0;  ///< System::first_pose
  Index root_unknowns = 0;
  Index auxiliary_pairs = 0;  ///< each adds one positive and one negative eigenvalue
  std::vector<ChainStages> chains{};
  std::vector<DensePart> dense{};  ///< per chain, empty where staged; last: bodies

  Index size() const { return chain_unknowns + root_unknowns; }
};

/// @param root_columns  per body: the root unknowns that its pose depends on. A root unknown belongs
///                      to one body; chains of bodies with more than 8 are one dense front. Empty:
///                      the root unknowns are the poses.
/// @pre has_stage_form(system)
StagePlan plan_stages(const System& system,
                      const std::vector<std::vector<Index>>& root_columns = {},
                      const StageOptions& options = {});

/// Joint k of a chain, or pose coordinate of its front body, in the sums that make up the Hessian of
/// the loads: for j before k and j = k the entry is turn_j . moment_k.
struct ChainSums {
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  Columns turn{};           ///< 3 x n: axis of rotation, zero for translations [world]
  Columns moment{};         ///< 3 x n: rate of the transmitted load's moment
  Matrix J{};               ///< d x n: of the closure
  Vector force{};           ///< n: generalised force of the loads along the chain
  Columns to_moment{};      ///< 3 x to_count: the same of the end body's pose coordinates
  Matrix J_to{};            ///< d x to_count
  Vector e{};               ///< d: closure
  Matrix H_from{}, H_to{};  ///< second derivatives by the pose of one end body
  Vector force_from{};      ///< of the loads, on the front body's pose

  Columns dp{};                               ///< scratch: motion of the chain's end
  std::vector<model::Pose<double>> frames{};  ///< scratch: before every joint turns or slides
  model::Closure<double> ends{};              ///< scratch
  Vector end_poses{}, wrench{};               ///< scratch
};

/// The matrix by fronts, as Frontal::factorise takes it: scale A scale, with auxiliary variables.
/// Storage is reused.
struct StageMatrix {
  std::vector<double> values{};
  Matrix root{};
  Vector scale{};  ///< powers of two, per variable of the pattern
  std::vector<ChainSums> sums{};
  Vector stiffness{};            ///< of the springs on single coordinates, chain_unknowns entries
  std::vector<Matrix> groups{};  ///< of the coupled springs
  /// Per dense part (chains with stages: empty): matrix and derivatives by the commands.
  std::vector<Matrix> blocks{}, block_rates{};
  Matrix basis{};  ///< poses by root unknowns

  /// A dense part with present numbers and in its own unknowns.
  struct Part {
    System system{};
    Inputs inputs{};
    Piece piece{};
    Vector z{}, residual{};
    Workspace work{};
  };
  std::vector<Part> parts{};                     ///< scratch
  std::vector<Matrix> from_basis{}, to_basis{};  ///< scratch: basis of each chain's ends
  Matrix poses{}, half{};                        ///< scratch
  std::vector<double> diagonal{}, sorted{};      ///< scratch
};

/// Residual as equilibrium_residual() gives it, in time linear in the number of joints, loads along
/// the chains included; and, if `with_matrix`, the matrix of the same state in stages.
///
/// The unknowns are y = (z up to the poses, root unknowns) with d(poses) = basis d(root unknowns);
/// the matrix is A_y = Q^T A Q with Q = diag(1, basis). Eliminating the auxiliary variables from it
/// leaves A_y exactly.
/// @param basis  poses x root unknowns; empty: they are the same
/// @param added  root unknowns squared, added to A_y, may be unsymmetric; empty: nothing
/// @returns false when the result is not finite
bool equilibrium_stages(const StagePlan& plan, const System& system, const Piece& piece,
                        const Vector& z, const Inputs& inputs, const Matrix& basis,
                        const Matrix& added, Vector& residual, StageMatrix& matrix,
                        bool with_matrix = true);

/// The two halves of it, for an `added` that depends on the residual: everything that depends on the state, and, after
/// it with `for_matrix`, the matrix.
bool evaluate_stages(const StagePlan& plan, const System& system, const Piece& piece,
                     const Vector& z, const Inputs& inputs, Vector& residual, StageMatrix& matrix,
                     bool for_matrix);
bool put_stage_matrix(const StagePlan& plan, const System& system, const Matrix& basis,
                      const Matrix& added, StageMatrix& matrix);

/// Scratch of products, used again.
struct StageScratch {
  Vector motion{}, turned{}, closure{}, wrench{}, in{}, out{};
};

/// A dz + (d residual/d rho) drho without poses' basis, for any change of unknowns and commands.
/// @param dz    size of z
/// @param drho  commands; empty: zero
void stage_product(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                   const Vector& dz, const Vector& drho, StageScratch& scratch, Vector& product);
Vector stage_product(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                     const Vector& dz, const Vector& drho);

/// The matrix whose product with -|dz| is |A| |dz| or more: the sizes of what is summed up in A dz, for estimates of
/// its rounding. Entries of A that are sums themselves count with the sizes of their terms.
/// @param sizes  good for products only
void put_sizes(const StageMatrix& matrix, StageMatrix& sizes);
Vector stage_magnitudes(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                        const Vector& dz);

/// Solves with M = | A_y B; C^T D | and counts the eigenvalues of A_y.
class StageSolver {
 public:
  explicit StageSolver(const StagePlan& plan, FrontalOptions options = {});

  /// @param borders  B, C: plan.size() x k, D: k x k; empty: none
  /// @returns false when a number is not finite
  bool factorise(const StageMatrix& matrix, const FrontalBorders& borders = {});
  /// Other borders, same matrix; see Frontal::set_borders.
  bool set_borders(const FrontalBorders& borders);

  /// Replaces X (plan.size() + k rows) by M^-1 X or M^-T X. false: M is singular.
  bool solve(Matrix& X);
  bool solve_transposed(Matrix& X);

  /// Of A_y; see Frontal::inertia.
  Inertia inertia(double zero_tolerance = 1e-13);

  const Frontal& frontal() const { return frontal_; }

 private:
  const FrontalBorders& expanded(const FrontalBorders& borders);
  bool solve_with(Matrix& X, bool transposed);

  Index size_ = 0, pairs_ = 0;
  Frontal frontal_;
  Vector scale_{};
  FrontalBorders borders_{};  ///< with rows for the auxiliary variables
  Matrix all_{};              ///< the same of right-hand sides
};

}  // namespace springfold::statics
