// The CSV tables of a set of results, as text. Columns: docs/results.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// One row per point of the branch: all quantities, then piece and event.
/// @param is_over  asked after every block of rows; true: the rest is not wanted any more. May be empty
/// @returns nothing if it was asked to end
std::optional<std::string> branch_csv(const analysis::StudyResult& result,
                                      const analysis::Branch& branch,
                                      const std::function<bool()>& is_over);
std::string branch_csv(const analysis::StudyResult& result, const analysis::Branch& branch);

/// One row per equilibrium of a study of kind `equilibria`.
std::string equilibria_csv(const analysis::StudyResult& result);

/// Per result the file of its equilibria; empty if it has none.
std::vector<std::string> equilibria_files(const std::vector<analysis::StudyResult>& results);

/// One row per special point of all runs, with every quantity that any run has, and the values of
/// all parameters that any study varies ("parameter.Kv").
std::string events_csv(const Case& the_case, const std::vector<analysis::StudyResult>& results);

/// One row per refused or cut step of all runs.
std::string steps_csv(const std::vector<analysis::StudyResult>& results);

/// File of every branch relative to the result folder, "branches/<study>-<run>[-<branch>].csv",
/// first index: result, second: branch. No two are equal.
std::vector<std::vector<std::string>> branch_files(
    const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
