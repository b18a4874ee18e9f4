// Load histories: a study that starts in a state of an earlier one.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

struct Earlier;

/// A coordinate of a point body that the earlier study held still and the later one does not.
struct Released {
  Index body = 1;
  Index coordinate = 0;
  std::string chain{};  ///< which held it in the earlier study
};

/// Where a study starts from, if not from its own start.
struct History {
  std::shared_ptr<const Earlier> earlier{};  ///< null: it starts on its own
  /// Names of chains of the mechanism that hold a point body where the study starts.
  std::vector<std::string> held{};
  std::vector<Released>
      released{};  ///< with loads that are kept, the forces that held them are too
};

/// The study whose state another one starts from.
struct Earlier {
  model::Mechanism mechanism{};
  Study study{};
  std::optional<ParameterFamily> family{};  ///< control mode parameter
  History history{};                        ///< of that study itself
  std::string at = "end";                   ///< "start", "end" of branch 1, or a label: "LP1"
  bool keeps_loads = true;  ///< what acts there goes on acting, with the later study's own loads
  std::size_t common_loads =
      0;                      ///< the first loads of both mechanisms are the case's, not a study's
  std::size_t parameter = 0;  ///< control mode parameter: its number in `cases` and `own_cases`
  /// The later study for other values of the parameters; needed where an earlier one moves one.
  std::shared_ptr<const CaseFamily> cases{};
  /// This study for other values of the parameters; needed where the later one changes some.
  std::shared_ptr<const CaseFamily> own_cases{};
};

/// Can a study of this kind be the earlier one? It follows or finds states of one mechanism.
constexpr bool has_states(StudyKind kind) {
  return kind == StudyKind::force_deflection || kind == StudyKind::equilibrium ||
         kind == StudyKind::equilibria;
}

/// Can a study of this kind start where an earlier one ended? Workspaces have no state to start in.
constexpr bool may_start_after(StudyKind kind) { return kind != StudyKind::workspace; }

/// As run_study, after the studies before it: their states and loads are taken over. Poses, joint
/// coordinates and commands begin as they are there; loads become constant ones, and so does the
/// force that drove a pose; chains of History::held hold their bodies where they are then. The later
/// equilibrium is solved again, from that state alone.
///
/// Kinds that change parameters (those of critical points, maps over parameters): for all values the
/// earlier studies are run with these, each value once, so that every member has the history that it would
/// have in a case with these values. Where an earlier study has no such point, that member has no start.
/// @pre if history.earlier: has_states(kind of that study), may_start_after(study.kind); or both kinds are
/// critical_curve: then the later curve begins at the row `at` of the earlier one, in a parameter of its own,
/// after the load steps of the first curve
StudyResult run_study_after(const History& history, const model::Mechanism& mechanism,
                            const Study& study, const ParameterFamily* family = nullptr,
                            const Observer& observer = {}, const RunOptions& options = {});

/// As solve_start, after the studies before it, which are run.
std::optional<StartReport> solve_start_after(const History& history,
                                             const model::Mechanism& mechanism, const Study& study,
                                             const ParameterFamily* family = nullptr);

/// Adds a chain that holds coordinates of a point body (xy, xyz) where it is drawn, and lets it slide
/// along the others. The chain is called "<body>.<name>", its joints "x", "y", "z"; its wrench is the
/// reaction.
/// @param held  per coordinate of the body
/// @pre the body's task space is xy or xyz
void hold(Index body, const std::vector<bool>& held, const std::string& name,
          model::Mechanism& mechanism);

}  // namespace springfold::analysis
