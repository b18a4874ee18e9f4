// What is asked of a mechanism: one study is one equilibrium, one curve traced both ways, or a whole
// bifurcation diagram.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "springfold/analysis/control.hpp"
#include "springfold/analysis/critical.hpp"
#include "springfold/analysis/design.hpp"
#include "springfold/analysis/map.hpp"
#include "springfold/analysis/situation.hpp"
#include "springfold/analysis/snap_settings.hpp"
#include "springfold/analysis/workspace.hpp"
#include "springfold/core/types.hpp"
#include "springfold/model/mechanism.hpp"

namespace springfold::analysis {

enum class StudyKind {
  equilibrium,       ///< the start point only: position, stiffness, indices
  force_deflection,  ///< the whole branch through the start point
  equilibria,        ///< all equilibria under the constant load that a search finds
  control,           ///< commands along a path of targets
  map,               ///< quantities over a grid of poses or parameters
  workspace,         ///< the largest region within bounds of the transmission factors
  critical_curve,    ///< a special point of the branch, followed in a second parameter
  threshold,         ///< the value of a parameter from which on nothing unwanted happens
  sensitivity,       ///< how special points move with the parameters of the case
  critical_load,     ///< the first critical load of the path, for every value of a parameter
  design,            ///< the least changes of parameters with which requirements are met
};

/// Is it a study of commands and poses, not a curve or a point of one? These have settings and
/// columns of their own.
constexpr bool is_of_commands(StudyKind kind) {
  return kind == StudyKind::control || kind == StudyKind::map || kind == StudyKind::workspace;
}

/// Does it look at the special points of a branch in further parameters?
constexpr bool is_of_critical_points(StudyKind kind) {
  return kind == StudyKind::critical_curve || kind == StudyKind::threshold ||
         kind == StudyKind::sensitivity || kind == StudyKind::critical_load ||
         kind == StudyKind::design;
}

/// What lambda is.
enum class ControlMode {
  load,       ///< W = W0 + lambda * direction on the body, pose free
  pose,       ///< pose = start + lambda * direction, the wrench is the result
  mixed,      ///< displacement lambda along direction driven, all other pose coordinates force-free
  actuator,   ///< rho = start + lambda * rate for the named actuators
  parameter,  ///< lambda is a named parameter of the case
};

/// How the start point is found.
enum class StartSolve {
  pose,       ///< actuators and loads given, the pose is found near its guess
  actuators,  ///< pose and loads given, the actuator commands that balance them are found
  wrench,     ///< pose and actuators given, the wrench that holds the body is the result
};

/// Which iteration finds the equilibrium of the chains.
enum class StartSolver {
  newton,       ///< KINSOL's globalised Newton method, exact matrix
  fixed_point,  ///< the paper's iteration, eq. (6) with its sign corrected; needs a given pose
};

/// As case files call them: "force_deflection", "mixed", "actuators", "newton".
std::string_view to_string(StudyKind kind);
std::string_view to_string(ControlMode control);
std::string_view to_string(StartSolve solve);
std::string_view to_string(StartSolver solver);

struct StartOptions {
  StartSolve solve = StartSolve::pose;
  StartSolver solver = StartSolver::newton;
  Vector pose{};           ///< of the study's body; empty: the body's own pose
  int attempts = 16;       ///< seeded multi-start, the unperturbed guess first
  std::uint64_t seed = 1;  ///< of the perturbations
  /// The equilibrium is refused if a coordinate or pose lies farther from its guess [-]: 1 is one
  /// radian or about one size of the mechanism.
  double maximum_move = std::numeric_limits<double>::infinity();
  bool is_state = false;  ///< the guess is a state of an earlier study
};

/// The branch ends where the named quantity leaves [low, high].
struct Limit {
  std::string quantity{};
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// A point is wanted where the named quantity has this value.
struct Mark {
  std::string quantity{};
  double value = 0;
};

/// One actuator that moves with lambda in control mode `actuator`.
struct ActuatorRate {
  std::string actuator{};  ///< "chain.joint"
  double rate = 1;
};

/// How the branch is followed.
enum class Path {
  arc_length,  ///< predictor and corrector, all special points
  davidenko,   ///< the flow of the tangent field, to check the other: no branch points, no touches
};

/// Step lengths are scaled arc lengths [-]: 1 is one radian or about one size of the mechanism.
struct TraceSettings {
  double initial_step = 0.01;
  double minimum_step = 1e-8;
  double maximum_step = 0.05;
  int maximum_points = 5000;  ///< in each direction
  double spacing = 0;         ///< > 0: rows also at the multiples of this arc length
  bool verify_arcs =
      false;  ///< test every arc of the finished curve (continuation/verification.hpp)
};

/// Branches beside the one through the start point.
struct BranchSettings {
  int depth = 0;      ///< special points between a branch and a start; 0: no branching
  int maximum = 100;  ///< number of branches
  std::vector<double> search_at{};  ///< values of lambda at which other equilibria are searched for
  int starts = 64;                  ///< of each search
  std::uint64_t seed = 1;           ///< of the searches' random starts
};

/// Search of a study of kind `equilibria`.
struct SearchSettings {
  int starts = 200;          ///< first states: the start, then random ones
  std::uint64_t seed = 1;    ///< of the random ones
  int maximum = 200;         ///< the search ends when it has found as many
  std::vector<Limit> box{};  ///< where random states are drawn; others: docs/case-file.md
};

struct Study {
  std::string name{};
  StudyKind kind = StudyKind::force_deflection;
  ControlMode control = ControlMode::load;
  Index body = 1;  ///< body number, 1 is the first moving one
  /// Control mode mixed: pose coordinates ("x", "rz", ...) that follow start + lambda direction; all
  /// others are free. Empty: the displacement along the direction alone is prescribed.
  std::vector<std::string> prescribed{};
  Vector direction{};                     ///< d entries; unit length, see docs/case-file.md
  Vector constant_load{};                 ///< W0 on the body, d entries; empty: none
  std::vector<ActuatorRate> actuators{};  ///< control mode actuator
  std::string parameter{};                ///< control mode parameter: its name
  StartOptions start{};
  std::vector<Limit> until{};
  std::vector<Mark> marks{};
  std::vector<std::string>
      extrema{};  ///< quantities; where the curve is smooth and one is stationary, a point UZ
  Path path = Path::arc_length;
  TraceSettings trace{};
  BranchSettings branches{};
  SearchSettings search{};
  std::optional<SnapSettings>
      snap{};                        ///< traced studies: jumps from losses of stability are wanted
  CommandSettings command{};         ///< kinds control and map
  ControlPath targets{};             ///< kind control
  MapSettings map{};                 ///< kind map
  WorkspaceSettings workspace{};     ///< kind workspace
  CriticalPointSettings critical{};  ///< kinds of critical points
  DesignSettings design{};           ///< kind design
};

/// A mechanism with a study, as a case gives them for some values of its parameters.
struct Variant {
  model::Mechanism mechanism{};
  Study study{};
  std::vector<double> parameters{};  ///< values of all parameters of the case
  /// The mechanism is drawn in the state in which an earlier study left it, and starts there.
  bool is_in_state = false;
  /// What the earlier studies passed on their way: of two values of a parameter with another one the
  /// starts do not belong to each other.
  std::string way{};
  std::string
      problem{};  ///< why there is no such state, in words; empty: there is one, or none is needed
};

/// The case as a function of one parameter; `value` is where the study starts.
struct ParameterFamily {
  std::function<Situation(double)> at{};
  double value = 0;
};

/// Every rule that the study breaks for this mechanism, as sentences; empty when usable.
std::vector<std::string> problems_in(const Study& study, const model::Mechanism& mechanism);

/// Names that `until`, `marks`, plots and expected values may use with this study, in the order of
/// the columns of the branch table (see docs/results.md).
std::vector<std::string> quantity_names(const Study& study, const model::Mechanism& mechanism);

}  // namespace springfold::analysis
