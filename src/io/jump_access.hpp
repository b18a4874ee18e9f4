// Jumps as places and quantities of expected values, as text, table and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// "J1", a jump with its landing; "J1.2", the second one of its other landings; "J", with `near`.
bool is_jump_place(const std::string& at);

/// "released", "critical.tool.x", "verdict", ...: what a jump has beside the columns of its landing.
bool is_jump_quantity(const std::string& name);
std::vector<std::string> jump_quantities();

/// The column of the branch table that a quantity of a jump reads: "tool.x" of "critical.tool.x"; empty for
/// "released" and the like; other names as they are.
std::string jump_column(const std::string& name);

/// NaN if there is no such jump or quantity.
double jump_value(const ExpectedValue& expected, const analysis::StudyResult& result);

/// Lines of the summary; empty for studies without jumps.
std::string jump_lines(const analysis::StudyResult& result, const UnitLabels& units);

/// null for studies without jumps.
nlohmann::ordered_json jumps_json(const analysis::StudyResult& result);

/// All jumps of all runs, one row each.
std::string jumps_csv(const std::vector<analysis::StudyResult>& results);

/// All moments of the motions of all jumps, one row each; empty if there are none.
std::string motions_csv(const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
