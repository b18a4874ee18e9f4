#include <algorithm>
#include <cmath>

#include "branches.hpp"
#include "load_cycle.hpp"
#include "run_traced.hpp"
#include "snap_jumps.hpp"
#include "transitions.hpp"

namespace springfold::analysis {
namespace {

constexpr const char* no_potential =
    "loads without potential act: there is no energy that decides where a jump ends";

constexpr const char* begin_stable =
    "; a cycle begins in a stable state: another guess of the start may lead to one, or a start "
    "from "
    "the end of a study";

/// What is left open by a load cycle, as doubts. That a jump has no landing is an answer.
void doubt_cycle(const LoadCycle& cycle, const Scales& scales, StudyResult& result) {
  /// The area is integrated on states of 1e-12.
  constexpr double allowed_gap = 1e-10;
  if (cycle.end != LoadCycle::End::complete && cycle.end != LoadCycle::End::no_landing)
    result.doubts.push_back("the load cycle ended on the way to level " +
                            std::to_string(cycle.level) + ": " + to_string(cycle.end) +
                            (cycle.end == LoadCycle::End::not_stable ? begin_stable : ""));
  double size = std::max({scales.moment(), std::abs(cycle.area), cycle.released});
  // On the way out and back areas cancel that are much larger than what is left.
  for (const CycleStep& step : cycle.steps) size = std::max(size, std::abs(step.area));
  if (!(std::abs(cycle.gap) <= allowed_gap * size))
    result.doubts.push_back("the area of the load cycle is not what its jumps release");
}

/// Traces all branches, then the jumps, until no landing is new.
void trace_with_jumps(const Tracing& tracing, const Scales& scales,
                      const continuation::CurvePoint& start, const SnapSettings& settings,
                      StudyResult& result, SnapResult& snap) {
  if (!tracing.problem.symmetric() && settings.transitions) {
    snap.report.refusals = {no_potential};
    return;
  }
  if (settings.transitions) {
    find_transitions(tracing, scales, start, settings, result, snap.report);
    return;
  }
  constexpr int rounds = 8;
  std::vector<continuation::DiagramStart> landings;
  const StudyResult before = result;
  for (int k = 0; k < rounds; ++k) {
    result = before;
    trace_branches(tracing, start, result, landings);
    if (result.branches.empty()) add_branch_of_start(tracing, start, result);
    std::vector<int> from_landings;
    const int count = static_cast<int>(landings.size());
    for (std::size_t b = 0; b < result.branches.size(); ++b) {
      Branch& branch = result.branches[b];
      if (branch.start == 0) continue;
      if (branch.start <= count) from_landings.push_back(static_cast<int>(b) + 1);
      branch.start = std::max(0, branch.start - count);
    }
    if (!tracing.problem.symmetric()) {
      snap.report.refusals = {no_potential};
      return;
    }
    SnapFindings findings = find_jumps(tracing, scales, settings, result);
    snap.report = std::move(findings.report);
    snap.report.landing_branches = std::move(from_landings);
    if (findings.untraced.empty() || k + 1 == rounds) {
      result.doubts.insert(result.doubts.end(), findings.doubts.begin(), findings.doubts.end());
      if (settings.cycle) {
        snap.report.cycle = run_cycle(tracing, scales, *settings.cycle, result, snap.report);
        doubt_cycle(*snap.report.cycle, scales, result);
      }
      return;
    }
    landings.insert(landings.end(), findings.untraced.begin(), findings.untraced.end());
  }
}

}  // namespace

std::string to_string(SnapVerdict verdict) {
  switch (verdict) {
    case SnapVerdict::unambiguous:
      return "unambiguous";
    case SnapVerdict::depends:
      return "depends on damping and masses";
    case SnapVerdict::runs_away:
      return "runs away";
    case SnapVerdict::no_stable_state:
      return "no stable state";
  }
  return "";
}

std::string to_string(InertialMotion::End end) {
  switch (end) {
    case InertialMotion::End::rest:
      return "at rest";
    case InertialMotion::End::swings_on:
      return "swings on";
    case InertialMotion::End::runs_away:
      return "runs away";
    case InertialMotion::End::no_mass:
      return "without mass";
    case InertialMotion::End::no_end:
      return "no end";
  }
  return "";
}

std::string to_string(LoadCycle::End end) {
  switch (end) {
    case LoadCycle::End::complete:
      return "complete";
    case LoadCycle::End::out_of_range:
      return "out of range";
    case LoadCycle::End::no_landing:
      return "no landing";
    case LoadCycle::End::not_stable:
      return "start not stable";
    case LoadCycle::End::undecided:
      return "undecided";
  }
  return "";
}

SnapResult run_with_jumps(const model::Mechanism& mechanism, const Study& study,
                          const ParameterFamily* family, const SnapSettings& settings,
                          const Observer& observer) {
  require_usable(mechanism, study);
  SnapResult snap;
  snap.traced = run_from_start(mechanism, study, family, observer,
                               [&](const Tracing& tracing, const Scales& scales,
                                   const continuation::CurvePoint& start, StudyResult& result) {
                                 snap = {};  // begun again in another unit of lambda
                                 trace_with_jumps(tracing, scales, start, settings, result, snap);
                               });
  for (const std::string& refusal : snap.report.refusals)
    snap.traced.doubts.push_back("jumps: " + refusal);
  return snap;
}

}  // namespace springfold::analysis
