// Named quantities of a study and their values on a path. Private to analysis.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "path_problem.hpp"
#include "resting.hpp"
#include "scales.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/analysis/study.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/statics/stage_stiffness.hpp"

namespace springfold::analysis {

/// Rounding of tangents, relative to what a rate is made of.
inline constexpr double tangent_rounding = 64 * std::numeric_limits<double>::epsilon();

/// Points lie off the curve by as much as the residual's tolerance lets them: forces are not told to less, nor their
/// rates per unit of the arc length, where the mechanism's own size and stiffness are the units.
inline constexpr double off_curve_rate = continuation::NewtonOptions{}.residual_tolerance;

/// A rate along a curve, and what rounding may do to it.
struct RoundedRate {
  double value = 0, noise = 0;
  bool is_zero() const { return std::abs(value) <= noise; }  ///< not told from it
  double told() const { return is_zero() ? 0 : value; }
};

struct QuantityDefinition {
  enum class Kind {
    arc_length,
    lambda,
    deflection,  ///< displacement along the study's direction from the start
    force,       ///< along the study's direction, on top of the constant load
    stiffness,   ///< d^T K_Sigma d; where the body is rigid in some directions 1/(d^T C d)
    unknown,     ///< entry of z
    command,     ///< entry of rho
    eigenvalue,  ///< of K_Sigma, dimensionless
    index_pose,
    index_force,
    index,         ///< of the study's control mode
    index_driven,  ///< load control: if the displacement along the load were driven
    energy,
    point,                ///< entry / 3: which of the system's points; entry % 3: its x, y or z
    spring_length,        ///< of a line spring
    spring_force,         ///< with which a line spring pulls
    shape_value,          ///< of a spring of a shape: its length, angle, area, ...
    shape_own,            ///< the part of it that the last of springs in series has
    shape_force,          ///< energy per that, or the pressure
    tangent_eigenvalue,   ///< of the reduced tangent stiffness, loads without potential: real part
    tangent_imaginary,    ///< imaginary part
    tangent_determinant,  ///< zero at critical states
  };
  Kind kind = Kind::lambda;
  Index entry = 0;  ///< unknown, command, eigenvalue: which one
  std::string name{};
  Unit unit = Unit::none;
  double scale = 1;  ///< physical value = scale * dimensionless value
};

/// Can `until` and `mark` use it: it varies continuously and is known at every point.
bool is_continuous(const QuantityDefinition& quantity);

/// All quantities of a study in the order of the branch table.
std::vector<QuantityDefinition> quantities_of(const Study& study, const statics::System& system,
                                              const Scales& scales, double lambda_scale,
                                              Unit lambda_unit);

/// The quantity of that name; nullptr if there is none.
const QuantityDefinition* find_quantity(const std::vector<QuantityDefinition>& quantities,
                                        const std::string& name);

/// Places of study.prescribed among the pose coordinates, increasing; unknown names are left out.
std::vector<Index> prescribed_coordinates(const Study& study, model::TaskSpace space);

Unit lambda_unit_of(const Study& study, const statics::System& system);

/// The part of the direction along which deflection and stiffness are measured: its translation,
/// or, if that is zero, its rotation; the rest set to zero.
Vector measured_direction(const Study& study, model::TaskSpace space);

/// Evaluates quantities at points of one path. Dimensionless inside, physical values out.
class Evaluator {
 public:
  Evaluator(const PathProblem& problem, const Study& study, const Scales& scales);
  /// The same anew, in its memory, after the problem has been renewed.
  void renew(const Study& study, const Scales& scales);

  const PathProblem& problem() const { return problem_; }

  /// One quantity; cheap ones do not assemble the matrix.
  /// @param turns  rotation vectors of this point, for rotations beyond a whole turn
  double value(const QuantityDefinition& quantity, const continuation::CurvePoint& point,
               const Turns* turns = nullptr) const;

  /// All quantities; assembles the matrix once.
  /// @param known  what the rest of the curve says of its switches
  std::vector<double> values(const std::vector<QuantityDefinition>& quantities,
                             const continuation::CurvePoint& point, const Turns* turns = nullptr,
                             const KnownSwitches& known = {}) const;

  /// d(value)/ds along the tangent for linear quantities, NaN for the others.
  std::vector<double> rates(const std::vector<QuantityDefinition>& quantities,
                            const continuation::CurvePoint& point,
                            const Turns* turns = nullptr) const;

  /// Of one column, in the units of the computation: from the tangent where the column is linear in it, otherwise by
  /// differences along the tangent, which tell how far they can be trusted.
  RoundedRate rate(const QuantityDefinition& quantity, const continuation::CurvePoint& point) const;
  /// d(force)/ds along the branch, dimensionless.
  RoundedRate force_rate(const continuation::CurvePoint& point) const;
  /// Does the force turn only where lambda does, which the engine has judged?
  bool force_is_lambda() const { return control_ == ControlMode::load; }

  /// d(displacement along the load)/ds under load control, dimensionless: what the rate of the load does
  /// work on.
  RoundedRate displacement_rate(const continuation::CurvePoint& point) const;

  /// Stiffness of the study's body, all others free (K_Sigma where it is the only one), physical
  /// units, world axes; empty if undefined.
  Matrix platform_stiffness(const continuation::CurvePoint& point) const;
  /// Compliance of the study's body where it has no stiffness matrix because it is rigid in some
  /// directions; likewise. Empty where it has one, or is singular.
  Matrix rigid_compliance(const continuation::CurvePoint& point) const;
  /// Eigenvalues of the reduced tangent stiffness, real and imaginary parts [force/length]; none for
  /// mechanisms with long chains of more than 300 unknowns.
  std::vector<std::pair<double, double>> tangent_eigenvalues(
      const continuation::CurvePoint& point) const;
  /// Motions without stiffness.
  Index zero_modes(const continuation::CurvePoint& point) const;
  /// Rank of the closure of every chain in its own coordinates; empty where it is not defined.
  std::vector<Index> closure_ranks(const continuation::CurvePoint& point) const;
  /// K_ci of all chains, paper eq. (12); empty matrices where undefined.
  std::vector<Matrix> chain_stiffnesses(const continuation::CurvePoint& point) const;
  /// The matrix of the path's equations, if the last row was of this place and these are those of the statics; nullptr
  /// otherwise. Valid until the next call.
  const Matrix* known_matrix(const Vector& x, double lambda, const Piece& piece) const;

  /// Where springs rest at their threshold: the number of unstable modes as all pieces together say.
  /// @param kind     index, index_pose or index_force
  /// @param known  what the rest of the curve says of its switches
  std::optional<RestingIndex> resting_index_of(QuantityDefinition::Kind kind,
                                               const continuation::CurvePoint& point,
                                               const KnownSwitches& known = {}) const;
  /// By one of the indices, as rows have it: how many modes are unstable. Where springs rest all pieces decide
  /// together: 0 or at least 1. @returns nothing where that is not known
  std::optional<Index> unstable_modes(const QuantityDefinition& index,
                                      const continuation::CurvePoint& point) const;

 private:
  struct Assembled {
    Vector z{}, r{};
    Matrix A{};
    statics::Inputs inputs{};
    statics::PlatformStiffness platform{};
    Matrix body{};
    std::vector<std::pair<double, double>> tangent{};
    double determinant = 0;
    statics::Stability stability{};
    statics::Workspace work{};
    statics::StagedStiffness staged{};  ///< of long chains; A and work are empty then
    bool is_plain = false;  ///< no frames were turned: z are the unknowns of the path itself
  };
  /// @returns null where F is not defined; otherwise valid until the next call
  const Assembled* assemble(const continuation::CurvePoint& point) const;
  const Assembled* assemble_densely(const continuation::CurvePoint& point) const;
  const Assembled* assemble_in_stages(const continuation::CurvePoint& point) const;
  RoundedRate computed_force_rate(const continuation::CurvePoint& point) const;
  RoundedRate computed_rate(const QuantityDefinition& quantity,
                            const continuation::CurvePoint& point) const;
  RoundedRate rate_by_differences(const QuantityDefinition& quantity,
                                  const continuation::CurvePoint& point) const;
  double force_rate_in_stages(const continuation::CurvePoint& point, double& size) const;
  std::vector<Index> closure_ranks_in_stages() const;
  /// What the quantities of a row have in common.
  struct State {
    Vector z{};  ///< all unknowns, rotations continued by `turns`
    statics::Inputs inputs{};
  };
  void put_state(const continuation::CurvePoint& point, const Turns* turns, State& state) const;
  bool is_index_of_curve(QuantityDefinition::Kind kind,
                         const continuation::CurvePoint& point) const;
  double value_at(const QuantityDefinition& quantity, const continuation::CurvePoint& point,
                  const State& state) const;
  double force(const continuation::CurvePoint& point) const;
  /// 1/(n^T C n) where the body is rigid in some directions, n the study's; NaN: rigid along n too.
  double guided_stiffness(const continuation::CurvePoint& point, const Assembled& at) const;
  /// Where springs rest at their threshold: what all pieces together say.
  void decide_indices(const std::vector<QuantityDefinition>& quantities,
                      const continuation::CurvePoint& point, const KnownSwitches& known,
                      std::vector<double>& values) const;
  /// Switches that rest there.
  Switches resting_at(const continuation::CurvePoint& point, const KnownSwitches& known) const;
  /// Unstable modes if the displacement along the load were driven, from those under the load.
  double driven_index(const continuation::CurvePoint& point, double index,
                      const KnownSwitches& known) const;
  /// Where that is not known: the largest number of unstable modes of all sides.
  double largest_index(const QuantityDefinition& quantity, const continuation::CurvePoint& point,
                       const std::vector<std::size_t>& resting, double own) const;
  double load_rate() const;  ///< of the study's wrench along the direction
  double from_matrix(const QuantityDefinition& quantity, const continuation::CurvePoint& point,
                     const Assembled& at, const State& state) const;

  const PathProblem& problem_;
  mutable std::optional<statics::StageJacobians> stages_{};  ///< long chains, loads with potential
  ControlMode control_ = ControlMode::load;
  Scales scales_{};
  Index first_pose_ = 0;
  Index t_ = 0, d_ = 0;          ///< pose of the study's body in z
  Vector measured_{};            ///< d entries
  Vector conjugate_{};           ///< d entries: direction with which the force is conjugate
  mutable Assembled scratch_{};  ///< of the place that was asked for last
  struct Place {
    Vector x{};
    double lambda = std::numeric_limits<double>::quiet_NaN();
    Piece piece{};
  };
  mutable Place assembled_{};  ///< that place, where no chain is long
  mutable State state_{};      ///< likewise
  struct Equilibrium {
    Vector z{}, r{};
    Matrix A{};
    statics::Inputs inputs{};
    statics::Workspace work{};
  };
  mutable Equilibrium trial_{};  ///< likewise
  /// An event's value and its noise are asked for one after the other.
  struct KnownRate {
    continuation::CurvePoint point{};
    RoundedRate rate{};
  };
  mutable KnownRate force_rate_{};
  mutable KnownRate column_rate_{};  ///< of the column that was asked for last
  mutable std::string rated_column_{};
  struct KnownRest {
    continuation::CurvePoint point{};
    Switches list{};
  };
  mutable std::optional<KnownRest> rest_{};  ///< of the point that was asked for last
};

}  // namespace springfold::analysis
