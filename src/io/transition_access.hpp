// Stable states and their transitions as places of expected values, as text, tables, JSON and graphs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// nullptr for other studies.
inline const analysis::TransitionReport* report_of(const analysis::StudyResult& result) {
  return result.snap && result.snap->transitions ? &*result.snap->transitions : nullptr;
}

/// "transitions", the whole; "S1", a state; "S1-S2", the lowest barrier between two.
bool is_transition_place(const std::string& at);

/// NaN if there is no such state or quantity.
double transition_value(const ExpectedValue& expected, const analysis::StudyResult& result);

/// Lines of the summary; empty for other studies.
std::string transition_lines(const analysis::StudyResult& result, const UnitLabels& units);

/// null for other studies.
nlohmann::ordered_json transitions_json(const analysis::StudyResult& result);

/// All states of all runs, one row each; empty if there are none.
std::string states_csv(const std::vector<analysis::StudyResult>& results);
/// Likewise all transitions, and all barriers.
std::string transitions_csv(const std::vector<analysis::StudyResult>& results);
std::string barriers_csv(const std::vector<analysis::StudyResult>& results);
/// The lowest saddle beside every state.
std::string escapes_csv(const std::vector<analysis::StudyResult>& results);

/// File names of the graphs without ending; empty for other studies.
std::vector<std::string> graph_names(const std::vector<analysis::StudyResult>& results);

/// The graph for programs that draw graphs; empty for other studies.
std::string transitions_graphml(const analysis::StudyResult& result);
/// The same for Graphviz.
std::string transitions_dot(const analysis::StudyResult& result);

}  // namespace springfold::io
