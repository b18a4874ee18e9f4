// A study whose numbers are still formulas, and the runs that it stands for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_draft.hpp"
#include "critical_draft.hpp"
#include "design_draft.hpp"
#include "history_draft.hpp"
#include "mechanism_draft.hpp"
#include "snap_reader.hpp"
#include "springfold/analysis/study.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

struct LimitDraft {
  NamedPlace quantity{};
  NumberId low = 0, high = 0;
};
struct MarkDraft {
  NamedPlace quantity{};
  NumberId value = 0;
};
struct RateDraft {
  std::string actuator{};
  NumberId rate = 0;
};

struct NearDraft {
  NamedPlace quantity{};
  NumberId value = 0;
};

/// A value of a run that is looked up: an expected one, or a column of a sweep's table.
struct ExpectedDraft {
  ExpectedValue value{};  ///< without its numbers
  NumberTable numbers{};
  NumberId expected = 0, tolerance = 0, factor = 0;
  std::optional<std::size_t> study{};  ///< position in CaseDraft::studies
  NamedPlace quantity{}, per{};
  std::vector<NearDraft> near{};
};

/// Several runs, each with values of its own for some parameters.
struct VaryDraft {
  std::vector<std::size_t> parameters{};
  std::vector<std::vector<Definition>> values{};  ///< for every run, in the order of `parameters`
  std::vector<std::string> labels{};              ///< one per run, or empty
  std::vector<ExpectedDraft> columns{};           ///< of the table with one row per run
  bool keeps_curves = true;
};

struct StudyDraft {
  NumberTable numbers{};  ///< all numbers of the study
  std::string name{};
  analysis::StudyKind kind = analysis::StudyKind::force_deflection;
  analysis::ControlMode control = analysis::ControlMode::load;
  Index body = 1;
  std::vector<NumberId> direction{};  ///< d or none
  std::vector<std::string> prescribed{};
  std::vector<NumberId> load{};    ///< d or none
  std::vector<LoadDraft> loads{};  ///< beside those of the mechanism
  std::vector<RateDraft> actuators{};
  std::optional<std::size_t> parameter{};  ///< control mode parameter
  analysis::StartSolve start_solve = analysis::StartSolve::pose;
  analysis::StartSolver start_solver = analysis::StartSolver::newton;
  std::vector<NumberId> start_pose{};  ///< d or none
  NumberId attempts = 0, seed = 0, maximum_move = 0;
  HistoryDraft history{};  ///< start.from
  analysis::Path path = analysis::Path::arc_length;
  /// Steps that the case leaves out follow those that it gives.
  std::optional<NumberId> initial_step{}, minimum_step{}, maximum_step{};
  NumberId maximum_points = 0, spacing = 0;
  bool verify_arcs = false;
  NumberId depth = 0, maximum_branches = 0, search_starts = 0, search_seed = 0;
  std::vector<NumberId> search_at{};
  NumberId equilibria_starts = 0, equilibria_seed = 0, equilibria_maximum = 0;
  std::vector<LimitDraft> box{};
  std::vector<LimitDraft> until{};
  std::vector<MarkDraft> marks{};
  std::vector<NamedPlace> extrema{};
  SnapDraft snap{};
  CommandDraft commands{};        ///< kinds control, map and workspace
  CriticalPointDraft critical{};  ///< kinds critical_curve, threshold, sensitivity, critical_load
  DesignDraft design{};           ///< kind design
  Redefinitions set{};
  std::optional<VaryDraft> vary{};
  bool runs_known = true;  ///< false: `vary` is there but unusable
  Place place{};
  std::string key{};
  std::vector<NamedPlace>
      entries{};  ///< every key of the table, "start.pose", and its value's place

  int runs() const { return vary ? static_cast<int>(vary->values.size()) : 1; }
  /// Parameters as this run has them; runs are numbered from 1.
  Redefinitions changes(int run) const;
  /// ` (study "Q2", run 3)`, for messages.
  std::string when(int run) const;
};

/// Reports a direction without length, and one that mixes translation and rotation where that has
/// no meaning. @param numbers  usable values of draft.numbers
void check_direction(const StudyDraft& draft, model::TaskSpace space, const Values& numbers,
                     const std::string& when, Problems& problems);

/// @param numbers  values of draft.numbers, as many as these
/// @param parameters  all names, for control mode `parameter`
analysis::Study build_study(const StudyDraft& draft, model::TaskSpace space,
                            const std::vector<double>& numbers,
                            const std::vector<Parameter>& parameters);

}  // namespace springfold::io
