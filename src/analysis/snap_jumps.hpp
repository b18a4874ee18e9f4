// Jumps from all losses of stability of a traced study. Private to analysis.
#pragma once

#include "grow_diagram.hpp"
#include "scales.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {

/// A place on a traced branch at which stability under the study's control ends.
struct Loss {
  std::size_t branch = 0, event = 0;
  int loading = 1;             ///< +1: lambda grows towards it on the stable side
  std::size_t stable_row = 0;  ///< the branch's row beside it on the stable side
};

/// Every special point with a stable side and an unstable one; points where branches meet once.
std::vector<Loss> losses_of(const StudyResult& result,
                            const std::vector<QuantityDefinition>& quantities);

struct SnapFindings {
  SnapReport report{};
  /// Landings that lie on no traced branch and within the study's limits: where to trace further.
  std::vector<continuation::DiagramStart> untraced{};
  std::vector<std::string> doubts{};
};

/// Jumps from these losses alone, appended to the findings. States of other branches are neither used in
/// the verdict nor compared with the landings.
void find_jumps_from(const std::vector<Loss>& losses, const Tracing& tracing, const Scales& scales,
                     const SnapSettings& settings, const StudyResult& result,
                     SnapFindings& findings);

/// @param result  traced, with its branches
SnapFindings find_jumps(const Tracing& tracing, const Scales& scales, const SnapSettings& settings,
                        const StudyResult& result);

/// Fills `Jump::back` and `Jump::loop`, and the handovers: follows the stable parts of branches.
void close_loops(const std::vector<QuantityDefinition>& quantities, const StudyResult& result,
                 SnapReport& report);

}  // namespace springfold::analysis
