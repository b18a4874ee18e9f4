// Special points of the runs of a study over the parameters that it varies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// A row of a branch.
struct RowPlace {
  const analysis::Branch* branch = nullptr;
  std::size_t row = 0;
};

struct SweepPoints {
  struct Run {
    const PlannedRun* planned = nullptr;
    const analysis::StudyResult* result = nullptr;
    std::vector<std::optional<RowPlace>>
        places{};  ///< one per label; nothing: it has no such point
  };
  std::string study{};
  std::vector<std::string> parameters{};  ///< that differ from run to run
  std::vector<std::string> labels{};      ///< "LP1", "LP2", "BP1": by code, then by number
  std::vector<std::string> codes{};       ///< of the labels
  std::vector<Run> runs{};                ///< in their order
};

/// Of every study that varies parameters and whose runs have special points other than ends of ranges.
/// Keeps pointers to the case and the results. Runs whose curves are not kept are left out.
std::vector<SweepPoints> sweep_points_of(const Case& the_case,
                                         const std::vector<analysis::StudyResult>& results);

/// Files of their tables, "sweeps/<study>-points.csv". No two are equal, nor equal to one of sweep_files.
std::vector<std::string> sweep_points_files(const Case& the_case,
                                            const std::vector<SweepPoints>& sweeps);

/// One row per run: run, parameters, of each point lambda, deflection and force, as far as the study has
/// them, status. Empty where a run has no such point.
std::string sweep_points_csv(const SweepPoints& sweep);

/// The same for people, with the force (lambda where there is none) of every point. Studies of very many
/// runs have the name of the file only.
std::string sweep_points_lines(const SweepPoints& sweep, const std::string& file);

}  // namespace springfold::io
