// What happens after a loss of stability, as plain data in the units of the case.
#pragma once

#include <limits>
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
  bool may_run_away = false;         ///< a way without end leads out of it too
  double released =
      std::numeric_limits<double>::quiet_NaN();  ///< Pi(critical) - Pi(landing) [energy]
  double time_scale =
      std::numeric_limits<double>::quiet_NaN();  ///< of the last approach, overdamped:
                                                 ///< 1/(smallest rate) [time]
  std::vector<std::string>
      switches{};  ///< springs that act at the landing and not before, or conversely
  std::vector<SnapWarning> warnings{};
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

struct SnapReport {
  std::vector<Jump> jumps{};
  std::vector<Handover> handovers{};
  std::vector<std::string> refusals{};  ///< why there is no answer, in words
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
/// @pre problems_in(study, mechanism).empty(); the kind is force_deflection, the path arc_length
SnapResult run_with_jumps(const model::Mechanism& mechanism, const Study& study,
                          const ParameterFamily* family = nullptr,
                          const SnapSettings& settings = {}, const Observer& observer = {});

}  // namespace springfold::analysis
