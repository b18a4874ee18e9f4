#include "springfold/analysis/result.hpp"

#include <algorithm>

#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {

std::string code_of(EventKind kind) {
  switch (kind) {
    case EventKind::limit_point:
      return "LP";
    case EventKind::branch_point:
      return "BP";
    case EventKind::switching:
      return "SA";
    case EventKind::corner_limit_point:
      return "CL";
    case EventKind::branching_kink:
      return "KB";
    case EventKind::kinematic_singularity:
      return "KS";
    case EventKind::touch:
      return "TP";
    case EventKind::family:
      return "FM";
    case EventKind::user_value:
      return "UZ";
    case EventKind::end_of_range:
      return "EP";
    case EventKind::stability_change:
      return "SC";
    case EventKind::unresolved:
      return "UR";
    case EventKind::cusp:
      return "CP";
    case EventKind::isola_centre:
      return "IC";
    case EventKind::crossing:
      return "CX";
    case EventKind::hilltop:
      return "HT";
    case EventKind::branch_points_merge:
      return "BB";
    case EventKind::more_modes:
      return "C2";
    case EventKind::fold_meets_activation:
      return "FA";
    case EventKind::corner_loses_reversal:
      return "CR";
    case EventKind::touches_activation:
      return "TA";
    case EventKind::two_activations:
      return "AA";
    case EventKind::bends_other_way:
      return "SB";
    case EventKind::parameter_turns:
      return "PT";
    case EventKind::extremum:
      return "EX";
    case EventKind::threshold:
      return "TH";
    case EventKind::jump:
      return "JP";
  }
  return "??";
}

int ways_not_followed(const StudyResult& result) {
  std::ptrdiff_t count = 0;
  for (const Junction& junction : result.junctions)
    count += std::count(junction.ways.begin(), junction.ways.end(), 0);
  return static_cast<int>(count);
}

namespace {

/// A question about jumps, or about their motions with masses, has no answer.
bool is_refused(const SnapReport& report) {
  return !report.refusals.empty() ||
         std::any_of(report.jumps.begin(), report.jumps.end(), [](const Jump& jump) {
           return jump.inertial && jump.inertial->end == InertialMotion::End::no_mass;
         });
}

}  // namespace

bool complete(const StudyResult& result) {
  if (result.row) return result.row->complete;
  const bool refused = result.snap && is_refused(*result.snap);
  return result.start.found && result.doubts.empty() && !refused &&
         std::all_of(result.branches.begin(), result.branches.end(), [](const Branch& branch) {
           return branch.backward.complete && branch.forward.complete &&
                  std::none_of(branch.events.begin(), branch.events.end(), [](const Event& event) {
                    return event.kind == EventKind::unresolved;
                  });
         });
}

}  // namespace springfold::analysis
