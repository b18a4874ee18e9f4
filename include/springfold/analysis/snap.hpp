// What happens after a loss of stability, as plain data in the units of the case.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap_settings.hpp"

namespace springfold::analysis {

/// Does the landing depend on more than springs and loads?
enum class SnapVerdict {
  unambiguous,      ///< the connected part of {Pi < Pi(critical)} that is entered holds one minimum
  depends,          ///< it holds several, or one and a way without end: damping and masses decide
  runs_away,        ///< it holds no minimum, and the way down has no end
  no_stable_state,  ///< it holds no minimum, and the way down ends where no stable state is
};

/// "unambiguous", "depends on damping and masses", "runs away", "no stable state".
std::string to_string(SnapVerdict verdict);

/// A state at rest, with the values of a row of the branch table.
struct SnapState {
  std::vector<double> values{};  ///< in the order of StudyResult::quantities
  std::string piece{};           ///< as in Sample
  double energy =
      std::numeric_limits<double>::quiet_NaN();  ///< Pi at the load of the jump [energy]
  int index = 0;                                 ///< unstable modes
  int branch = 0;       ///< number (from 1) of the branch it lies on; 0: on none that was traced
  std::size_t row = 0;  ///< the row of that branch before it
};

/// A joint or leg that stands at the landing where it hardly ever is meant to.
struct SnapWarning {
  enum class Kind {
    turned_beyond,  ///< the leg's angle is beyond 90 degrees
    dead_point,     ///< within 1e-6 of a dead point: 90 degrees
  };
  Kind kind = Kind::turned_beyond;
  std::string coordinate{};  ///< "leg_x.knee"
  double angle = 0;          ///< against the direction of the leg's drive, 0 to pi [rad]
};

/// The motion with the masses of bodies, links and points, from the same push: at rest, but for an amplitude of
/// 1e-3 radian or sizes of the mechanism. A unit of time is that in which a unit of force moves a unit of mass from
/// rest by half a unit of length.
struct InertialMotion {
  enum class End {
    rest,       ///< at `landing`
    swings_on,  ///< about `landing`, which it cannot leave any more, but for too long to be followed until it settles
    runs_away,  ///< a coordinate left all bounds
    no_mass,    ///< refused: `massless` moves and has no mass
    no_end,     ///< refused or given up: no landing that sets the damping, or too many steps
  };
  End end = End::no_end;
  std::string massless{};  ///< a coordinate that moves most where nothing with a mass moves
  SnapState landing{};
  double released =
      std::numeric_limits<double>::quiet_NaN();  ///< Pi(critical) - Pi(landing) [energy]
  /// The push after which it begins, as a part of the straight way to the overdamped landing; NaN: there is none.
  double push = std::numeric_limits<double>::quiet_NaN();
  double peak_speed = std::numeric_limits<double>::quiet_NaN();  ///< of a mass [length/time]
  double peak_force = std::numeric_limits<double>::quiet_NaN();  ///< component of a chain's wrench
  std::string peak_force_of{};                                   ///< "leg.Fx"
  double peak_moment = std::numeric_limits<double>::quiet_NaN();
  std::string peak_moment_of{};
  double duration = std::numeric_limits<
      double>::quiet_NaN();  ///< from the push until 0.9999 of the energy is dissipated [time]
  double dissipated = std::numeric_limits<double>::quiet_NaN();  ///< work of the dampers [energy]
  double closure = 0;   ///< largest gap of the closures on the way [-]
  double followed = 0;  ///< time from the push to where the integration ended [time]
  /// Where it swings on: the energy above that of the landing by then, and the duration that it would have as its
  /// energy falls there.
  double left = std::numeric_limits<double>::quiet_NaN();
  double would_last = std::numeric_limits<double>::quiet_NaN();
};

/// "at rest", "swings on", "runs away", "without mass", "no end".
std::string to_string(InertialMotion::End end);

/// A moment of a motion.
struct SnapMoment {
  double time = 0;  ///< since the push; overdamped: in units of the dampers
  double way =
      0;  ///< length in the space of all coordinates, as arc length: radians, sizes of the mechanism
  SnapState state{};  ///< `energy` falls from moment to moment
};

/// One jump: from a loss of stability to where the mechanism comes to rest, at one lambda.
struct Jump {
  std::string label{};  ///< "J1"
  std::string from{};   ///< label of the special point that is left
  int branch = 0;       ///< number of the branch on which that was
  int loading = 1;      ///< +1: lambda grew on the way there, -1: it fell
  int side = 0;         ///< of the push along the null vector: +1, -1
  std::string
      towards{};  ///< the coordinate of a body or joint that the push moves most, with its sign:
                  ///< "+apex.y"
  SnapVerdict verdict = SnapVerdict::unambiguous;
  SnapState critical{}, landing{};   ///< landing: empty values if there is none
  std::vector<SnapState> others{};   ///< further minima in the same part of {Pi < Pi(critical)}
  std::vector<SnapState> saddles{};  ///< the saddles in it that join them
  /// How far the lowest saddle beside the landing, then beside each of the others, lies above it [energy].
  std::vector<double> barriers{};
  bool may_run_away = false;  ///< a way without end leads out of it too
  double released =
      std::numeric_limits<double>::quiet_NaN();  ///< Pi(critical) - Pi(landing) [energy]
  double time_scale =
      std::numeric_limits<double>::quiet_NaN();  ///< of the last approach, overdamped:
                                                 ///< 1/(smallest rate) [time]
  std::vector<std::string>
      switches{};  ///< springs that act at the landing and not before, or conversely
  std::vector<SnapWarning> warnings{};
  std::optional<InertialMotion> inertial{};  ///< if it was asked for
  /// The overdamped motion from the push to the landing, at even lengths of way; none in a graph of all states. Forces
  /// in closed chains are those that balance best: nothing is at rest there.
  std::vector<SnapMoment> motion{};
  /// Where lambda goes back from the landing and stability is lost again: number of that jump, from 1;
  /// 0: none within the range.
  int back = 0;
  /// Energy lost in a closed cycle of this jump and the one back; NaN: the cycle does not close.
  double loop = std::numeric_limits<double>::quiet_NaN();
};

/// A branch point at which stability passes on to a branch that leaves it: nothing jumps.
struct Handover {
  std::string at{};       ///< label of the special point
  int branch = 0;         ///< on which stability ends
  int next = 0;           ///< branch that is stable beyond
  std::string towards{};  ///< as in Jump: the side that is followed
};

/// What happens on the way through the levels of a load cycle.
struct CycleStep {
  int level = 0;   ///< number of the level that is gone to, from 1
  int jump = 0;    ///< number of the jump (from 1) that happens; 0: the level itself is reached
  SnapState at{};  ///< the level's state; at a jump where it lands
  double released = 0;  ///< by the jump [energy]
  double area = 0;      ///< integral of dPi/dlambda over lambda up to here [energy]
};

/// Levels of lambda that were gone to one after the other along stable branches, with jumps where these end.
struct LoadCycle {
  enum class End {
    complete,      ///< all levels were reached
    out_of_range,  ///< a branch ends at a limit of the study, or where tracing stopped
    no_landing,    ///< a jump has none, or none within the limits
    not_stable,    ///< the start is not stable
    undecided,     ///< stability ends at a point from which no jump was found
  };
  End end = End::complete;
  int level = 0;                   ///< the level on the way to which it ended
  std::vector<CycleStep> steps{};  ///< the first one is the start, level 0
  int jumps = 0;
  double released = 0;       ///< by all jumps [energy]
  double energy_change = 0;  ///< Pi at the end, at its lambda, less Pi at the start at its own
  /// Integral of dPi/dlambda over lambda along the whole way, by quadrature. For loads that is minus the
  /// displacement's: its part of a closed cycle is the area of the loop of force over displacement.
  double area = 0;
  double gap = 0;        ///< area - energy_change - released: how exactly the cycle closes [energy]
  int closed_with = -1;  ///< step whose state is that of the end once more; -1: the cycle is open
  double loop = std::numeric_limits<double>::quiet_NaN();           ///< area of the closed part
  double loop_released = std::numeric_limits<double>::quiet_NaN();  ///< by the jumps in it
};

/// "complete", "out of range", "no landing", "start not stable", "undecided".
std::string to_string(LoadCycle::End end);

/// A stretch of a branch along which lambda grows and no mode is unstable.
struct StableState {
  std::string label{};                               ///< "S1": the start's
  int branch = 0;                                    ///< its branch, from 1
  double low = 0, high = 0;                          ///< lambda between which it exists
  bool low_is_limit = false, high_is_limit = false;  ///< there the study ends, not the stretch
  SnapState found{};                                 ///< where it was found first
  bool reached = false;            ///< some history of lambda leads there from the start's stretch
  bool is_garden_of_eden = false;  ///< no transition leads there
};

/// What happens at the end of a stretch. Numbers of states are counted from 1.
struct Transition {
  int from = 0;
  int to = 0;       ///< 0: nowhere that is known
  int loading = 1;  ///< +1: at its upper end, -1: at its lower one
  double lambda = 0;
  int jump = 0;  ///< number of the jump, from 1; 0: stability is handed over without one
  SnapVerdict verdict = SnapVerdict::unambiguous;
  double released = 0;  ///< [energy]
  /// Not where the overdamped motion ends, but where another damping or masses may lead. Nothing else of the
  /// report is said of these.
  bool is_alternative = false;
};

/// A saddle with one unstable mode and the two minima beside it, at one lambda.
struct Barrier {
  double lambda = 0;
  int first = 0;  ///< state, from 1
  int second =
      0;  ///< state, which may be the first a turn farther; 0: a way without end, or out of the study's range
  double from_first = 0, from_second = 0;  ///< energy of the saddle above theirs
  /// The same of the lowest way between both, over other states and saddles if that is lower: its highest saddle.
  double lowest_from_first = std::numeric_limits<double>::quiet_NaN();
  double lowest_from_second = std::numeric_limits<double>::quiet_NaN();
  SnapState saddle{};
};

/// The lowest saddle by which a state is left, at one lambda.
struct Escape {
  double lambda = 0;
  int state = 0;      ///< from 1
  int to = 0;         ///< state behind the saddle; 0 as in Barrier
  double energy = 0;  ///< of the saddle above the state's
};

/// Two states of one lambda between which no way was found, by climbs, drives or strings.
struct Unjoined {
  double lambda = 0;
  int first = 0,
      second = 0;  ///< from 1; of states that are joined with one another one stands for all
};

/// All stable states that were found, and where each is left to.
struct TransitionReport {
  std::vector<StableState> states{};
  std::vector<Transition> transitions{};
  std::vector<Barrier> barriers{};  ///< for each pair of states beside one saddle the lowest one
  std::vector<Unjoined> unjoined{};
  std::vector<Escape> escapes{};  ///< of each state that a saddle was found beside
  bool limit_reached = false;     ///< ended because so many were found
  /// Loads do work in whole turns: states are counted once for all turns, barriers are those beside each, and lowest
  /// ways over several saddles are not given.
  bool energy_counts_turns = false;
  bool is_closed = false;  ///< every end of a stretch within the range leads to states of the list
  enum class Memory {
    holds,      ///< every loop that was gone through comes back to its state
    fails,      ///< one does not
    undecided,  ///< a transition leads nowhere known, or to one of several states
  };
  Memory memory = Memory::undecided;  ///< return-point memory, of loops nested three deep
  int loops = 0;                      ///< so many were gone through
};

struct SnapReport {
  std::vector<Jump> jumps{};
  std::vector<Handover> handovers{};
  std::vector<std::string> refusals{};            ///< why there is no answer, in words
  std::optional<LoadCycle> cycle{};               ///< if the study has levels
  std::optional<TransitionReport> transitions{};  ///< kind transitions
  std::vector<int> landing_branches{};  ///< numbers (from 1) of branches that only a jump leads to
};

/// Branches of a study and the jumps between them.
struct SnapResult {
  StudyResult traced{};  ///< as run_study, with the branches on which jumps end
  SnapReport report{};
};

/// Traces the study to `branches.depth`, and every jump from every loss of stability on its branches, in
/// both senses of loading. A landing on no branch within the study's limits is traced as a further one,
/// until no landing is new. Doubts about jumps are among those of `traced`.
/// @pre the kind is force_deflection, the path arc_length
/// @throws std::invalid_argument as run_study does
SnapResult run_with_jumps(const model::Mechanism& mechanism, const Study& study,
                          const ParameterFamily* family = nullptr,
                          const SnapSettings& settings = {}, const Observer& observer = {});

}  // namespace springfold::analysis
