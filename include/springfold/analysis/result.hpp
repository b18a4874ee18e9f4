// Results as plain data, in the units of the case.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::analysis {

struct SnapReport;    // springfold/analysis/snap.hpp
struct DesignReport;  // springfold/analysis/design.hpp

/// Dimension of a quantity, for labels.
enum class Unit {
  none,
  length,
  angle,
  force,
  moment,
  energy,
  stiffness,              ///< force per length
  rotational_stiffness,   ///< moment per angle
  compliance,             ///< length per force
  rotational_compliance,  ///< angle per moment
  area,                   ///< length^2
  volume,                 ///< length^3
  pressure,               ///< force per area; in the plane a stiffness' unit
  lambda,                 ///< that of the continuation parameter: see StudyResult::lambda_unit
};

/// A column of the branch table.
struct Quantity {
  std::string name{};  ///< "tool.x", "leg_x.knee", "force", "lambda", ...
  Unit unit = Unit::none;
};

enum class EventKind {
  limit_point,            ///< LP: lambda turns back
  branch_point,           ///< BP: branches cross
  switching,              ///< SA: a spring becomes active or is released
  corner_limit_point,     ///< CL: a switching at which lambda turns back
  branching_kink,         ///< KB: a switching with more than one way out
  kinematic_singularity,  ///< KS: closure loses rank
  touch,                  ///< TP: an eigenvalue touches zero without changing sign
  family,                 ///< FM: lambda stands still: a continuum of equilibria begins here
  user_value,             ///< UZ: a marked value, or an extremum that was asked for
  end_of_range,           ///< EP: a limit of the study, or where tracing stopped
  stability_change,       ///< SC: stability under dead load changes while commands or poses hold
  unresolved,             ///< UR: something happens here that could not be resolved
  cusp,                   ///< CP: two limit points merge; the second parameter turns back
  isola_centre,           ///< IC: a closed branch shrinks to a point
  crossing,               ///< CX: two branches cross
  hilltop,                ///< HT: a branch point on a limit point
  branch_points_merge,    ///< BB: a pair of branch points is born
  more_modes,             ///< C2: another mode vanishes at the same load
  fold_meets_activation,  ///< FA: a limit or branch point reaches the threshold of a spring
  corner_loses_reversal,  ///< CR: behind a corner the load no longer turns back
  touches_activation,     ///< TA: the path touches the threshold of a spring
  two_activations,        ///< AA: another spring switches at the same point
  bends_other_way,        ///< SB: a supercritical branch point becomes subcritical
  parameter_turns,        ///< PT: the second parameter turns back on a curve of zeros
  extremum,               ///< EX: lambda is stationary along a critical curve
  threshold,              ///< TH: the value that a threshold study looks for
  jump,                   ///< JP: the first critical load of the path is another one behind
};

/// "LP", "BP", "SA", "CL", "KB", "KS", "TP", "FM", "UZ", "EP", "SC", "UR", "CP", "IC", "CX", "HT", "BB",
/// "C2", "FA", "CR", "TA", "AA", "SB", "PT", "EX", "TH", "JP".
std::string code_of(EventKind kind);

/// What a node of a map, or a target of a control study, is.
enum class NodeState {
  none,            ///< neither
  stable,          ///< held, and stable under dead load
  unstable,        ///< held, with unstable modes under dead load
  critical,        ///< held; the number of its unstable modes is undefined
  load_not_found,  ///< held and stable, but its critical load was not found
  outside,         ///< not held
  not_computed,
  undecided,  ///< no commands were found that hold it, which does not show that there are none
};

/// One row of the branch table: a point of the branch.
struct Sample {
  std::vector<double> values{};  ///< in the order of StudyResult::quantities; NaN: undefined here
  std::string piece{};           ///< segment number of every spring with breakpoints, "0.1.0"
  std::string event{};           ///< label of the event at this point ("LP1"), or empty
  std::string status{};  ///< targets and nodes: "ok", or what is wrong there; otherwise empty
  NodeState state = NodeState::none;
  bool rests = false;  ///< springs rest at their thresholds, and all pieces together decide: a
                       ///< count of unstable modes is 0 (stable) or means "at least one"
};

/// Rows along which springs rest exactly at their thresholds: their state is stable if the quadratic form of
/// the energy is positive on each of the cones in which other springs act (a strictly copositive form).
struct RestingRows {
  std::size_t first = 0, last = 0;  ///< rows
  enum class Stable {
    yes,
    no,
    undecided
  } stable = Stable::undecided;  ///< under the study's control
  int fewest = 0,
      most = 0;  ///< unstable modes, if in all directions those springs acted that act in one cone
};

/// A special point. All values are those of the located point itself.
struct Event {
  EventKind kind = EventKind::user_value;
  std::string label{};  ///< "LP1": code and number, counted over all branches of the run, each from
                        ///< its first row; where branches meet it is the same on all of them
  std::string detail{};  ///< in words: "spring leg_x.knee becomes active"
  std::size_t row = 0;   ///< its row in Branch::samples; a switching has the rows `row`, `row` + 1
  Matrix stiffness{};    ///< platform stiffness K_Sigma, d x d, world axes; empty if undefined
  Matrix compliance{};   ///< where the body is rigid in some directions: its compliance instead
  Matrix stiffness_after{}, compliance_after{};  ///< a switching: behind it; otherwise empty
  std::vector<double> rates_before{};  ///< d(values)/ds along the branch, arriving; NaN: undefined
  std::vector<double> rates_after{};   ///< the same, leaving; differs at a switching only
  /// Branch points and touches: d(values) along each null vector of dF/dx, of unit length in s, at constant lambda: the
  /// modes in which it buckles. The sign says nothing; of several any other basis would do. NaN: undefined.
  std::vector<std::vector<double>> modes{};
};

/// Why one direction of a trace ended, in words, and whether that is as it was asked for.
struct Stop {
  std::string reason{};
  bool complete = true;  ///< false: stopped early or unresolved (exit code 5)
};

/// One line of the step log.
struct StepNote {
  double s = 0;          ///< arc length at which it happened
  double step = 0;       ///< step length that was tried
  std::string reason{};  ///< in words: why it was refused or cut
};

/// One connected curve, from its backward end (first row) to its forward end (last row). A branch through a start point
/// runs both ways from it; one that begins at a special point has it as its first row. How much of a branch is shown to
/// be one curve, by the test of every arc between its points (TraceSettings::verify_arcs).
struct VerifiedArcs {
  /// Arc lengths [-], negative behind the start.
  struct Stretch {
    double s_begin = 0, s_end = 0;
  };
  double length = 0, verified = 0;
  std::vector<Stretch> sampled{};  ///< where only points are known, in the order of s

  double share() const { return length > 0 ? verified / length : 1; }
};

struct Branch {
  std::vector<Sample> samples{};
  std::vector<Event> events{};
  std::size_t start_row = 0;  ///< row of the start point, s = 0
  Stop backward{};
  Stop forward{};
  std::vector<StepNote> log{};
  std::vector<RestingRows> resting{};  ///< in the order of rows
  int depth = 0;                       ///< special points between it and a start
  std::string origin{};   ///< label of the special point at which it begins; empty: a start point
  int origin_branch = 0;  ///< number (from 1) of the branch on which that point was met first;
                          ///< 0: the start itself is that point
  int start = 0;          ///< 0: the study's start, n: the n-th equilibrium of the searches
  std::optional<VerifiedArcs> arcs{};  ///< where the study asks for it
};

/// A special point at which branches meet.
struct Junction {
  EventKind kind = EventKind::branch_point;
  std::string label{};      ///< as in Event; empty: it lies outside of the study's range
  int branch = 0;           ///< number of the branch on which it was met first; 0: the start itself
  int multiplicity = 1;     ///< how many eigenvalues vanish
  std::vector<int> ways{};  ///< per way out: number of the branch along it, 0: not followed
  bool complete = true;     ///< false: ways may be missing; `why` says what went wrong
  std::string why{};
};

/// What a search for other equilibria at one lambda found.
struct Search {
  double lambda = 0;
  int starts = 0;              ///< starts used
  int found = 0;               ///< equilibria that lie on no branch known before
  int traced = 0;              ///< of them: their branches are in the result
  int out_of_range = 0;        ///< further ones, outside of the study's limits: not traced
  bool limit_reached = false;  ///< ended because so many were found: there may well be more
};

/// One way to leave a start point.
struct WayOut {
  std::vector<double> rates{};  ///< d(values)/ds along it; NaN: undefined
  int branch = 0;               ///< number of the branch along it; 0: not followed
};

/// Closure equations that say again what others say already.
struct RedundantClosures {
  int count = 0;                      ///< dependent equations
  int of = 0;                         ///< all closure equations
  std::vector<std::string> chains{};  ///< names of those whose equations take part
  double smallest_kept = 0;           ///< singular values of the closures, relative to the largest:
  double largest_dropped = 0;         ///< the gap between independent and dependent ones
};

/// The stiffness on one side of the thresholds on which springs rest at a start.
struct StartSide {
  std::string piece{};  ///< segments, as Sample::piece
  Matrix stiffness{};   ///< as StartReport::stiffness
  Matrix compliance{};  ///< where the body is rigid in some directions
};

/// How the start point was found.
struct StartReport {
  bool found = false;
  std::string method{};   ///< in words
  std::string message{};  ///< why not, if not found
  std::string where{};    ///< what the message is about: "start.pose", "chain.leg_x", "body.tool",
                          ///< "until.lambda"; empty: the study as a whole
  std::string advice{};   ///< one thing to try, in words
  std::string outside{};  ///< found, but outside of the study's limits: value and limits, in words
  int attempts = 0;       ///< multi-start tries used
  int iterations = 0;     ///< of the solver in the successful attempt
  std::vector<int> chain_iterations{};  ///< paper's iteration: per chain
  double residual = 0;  ///< largest scaled residual of the equilibrium equations [-]
  /// Stiffness of the study's body at the start, all other bodies free, d x d, world axes: K_Sigma
  /// where it is the only one; empty if undefined.
  Matrix stiffness{};
  Matrix compliance{};  ///< where the body is rigid in some directions: its compliance instead
  std::vector<StartSide> sides{};  ///< springs rest on their thresholds: on all sides of these
  std::vector<Matrix> chain_stiffnesses{};  ///< K_ci, paper eq. (12); empty matrix if undefined
  double guess_residual = 0;   ///< the same residual at the guess, with the wrenches that suit best
  double moved = 0;            ///< largest change of a coordinate or pose from the guess [-]
  std::string moved_most{};    ///< name of that coordinate
  std::string situation{};     ///< "a branch point"; empty: an ordinary point of a curve
  std::vector<WayOut> ways{};  ///< all ways that leave it, where it is not an ordinary point
  /// d(values)/ds at the start, arriving and leaving towards growing lambda, where one curve leads through
  /// it; they differ at a switching. Otherwise empty.
  std::vector<double> rates_before{}, rates_after{};
  /// Eigenvalues of the tangent stiffness reduced to the mechanism's freedoms, real and imaginary
  /// parts, ascending [force/length].
  std::vector<std::pair<double, double>> tangent{};
  int zero_modes = 0;          ///< of them: zero to rounding, motions without stiffness
  std::string free_motions{};  ///< which coordinates move in them, in words
  RedundantClosures redundant{};
};

/// One of several equilibria at the same load.
struct Equilibrium {
  std::string label{};  ///< "EQ1": the one with the lowest potential
  Sample sample{};
  double potential = std::numeric_limits<double>::quiet_NaN();  ///< energy of the springs less the
                                                                ///< work of the dead load
  Matrix stiffness{};                                           ///< as Event::stiffness
  bool is_start = false;                 ///< the one that is found from the study's guess
  std::string note{};                    ///< what is special about it, or empty
  std::optional<RestingRows> resting{};  ///< springs rest: what all pieces say together
};

/// Morse's count of equilibria, where it applies.
struct MorseCount {
  bool applies = false;
  int expected = 0;   ///< Euler characteristic of the set of all configurations
  int found = 0;      ///< sum of (-1)^index over the equilibria found
  std::string why{};  ///< why it does not apply
};

/// AT LEAST these equilibria exist: a search proves nothing about others.
struct EquilibriaReport {
  std::vector<Equilibrium> list{};
  int starts = 0;        ///< first states used
  int out_of_range = 0;  ///< further ones, outside of the study's limits
  int locked =
      0;  ///< further ones at which joints of a chain lose rank (a bar along the first axis
          ///< of its universal joint, a bar of no length)
  bool limit_reached = false;  ///< ended because so many were found
  MorseCount morse{};          ///< counts those out of range too
};

/// The answer of a threshold study.
struct ThresholdReport {
  bool found = false;  ///< false: no value within the range does
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string
      decides{};  ///< the degeneracy at which the value lies, or the piece that is left, in words
  bool verified = false;  ///< traced again on both sides, at value (1 -+ 1e-6)
  std::string message{};  ///< the answer as a sentence
};

/// Names of the answer's numbers for expected values; `found` and `verified` are 1 or 0.
struct ThresholdQuantity {
  std::string_view name{};
  double (*value)(const ThresholdReport&) = nullptr;
};
inline constexpr ThresholdQuantity threshold_quantities[] = {
    {"threshold.value", [](const ThresholdReport& report) { return report.value; }},
    {"threshold.found", [](const ThresholdReport& report) { return report.found ? 1.0 : 0.0; }},
    {"threshold.verified",
     [](const ThresholdReport& report) { return report.verified ? 1.0 : 0.0; }}};

/// What is kept of a run of many whose curves are not kept.
struct SweepRow {
  bool complete = false;
  std::string status{};            ///< "complete", or what is missing, in words
  std::vector<double> values{};    ///< of the table's columns; NaN: there is no such point
  std::vector<double> compared{};  ///< what the case compares of this run, in its order
};

struct StudyResult {
  std::string study{};  ///< name of the study
  int run = 1;          ///< number among the study's varied values
  std::string label{};  ///< "Kv = 0.01", or empty
  Unit lambda_unit = Unit::none;
  std::vector<Quantity> quantities{};
  StartReport start{};
  std::vector<Branch> branches{};     ///< empty if no start was found; kind equilibrium: one sample
  std::vector<Junction> junctions{};  ///< where branches meet, if more than one was asked for
  std::vector<Search> searches{};     ///< one per lambda that was searched
  /// Loads without potential, in words; then no count of unstable modes is given.
  std::vector<std::string> non_conservative{};
  std::vector<std::string> doubts{};             ///< what may be missing in the diagram, in words
  std::optional<EquilibriaReport> equilibria{};  ///< kind equilibria; it has no branches
  std::optional<ThresholdReport> threshold{};    ///< kind threshold
  std::shared_ptr<const DesignReport> design{};  ///< kind design; its branches: before, after
  std::shared_ptr<const SnapReport> snap{};      ///< if the study asks for jumps; otherwise null
  std::shared_ptr<const SweepRow> row{};  ///< curves are not kept: all there is; otherwise null
  double seconds = 0;                     ///< CPU time used; never part of reproducible output
};

/// Ways at junctions that were left out because of the bounds of depth and number.
int ways_not_followed(const StudyResult& result);

/// The start found, all branches complete, nothing on them unresolved and no doubt about the others.
bool complete(const StudyResult& result);

}  // namespace springfold::analysis
