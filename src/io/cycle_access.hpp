// Load cycles as places of expected values, as text, table and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// "cycle", the whole of it; "level 2", the state at the second level.
bool is_cycle_place(const std::string& at);

/// NaN if there is no such level or quantity.
double cycle_value(const ExpectedValue& expected, const analysis::StudyResult& result);

/// Lines of the summary; empty for studies without levels.
std::string cycle_lines(const analysis::StudyResult& result, const UnitLabels& units);

/// null for studies without levels.
nlohmann::ordered_json cycle_json(const analysis::StudyResult& result);

/// All steps of all runs, one row each; empty if there are none.
std::string cycles_csv(const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
