// A compared value as cells of a table and as JSON: the same in every table and file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "springfold/io/results.hpp"

namespace springfold::io {

/// "equal", "at_least", "at_most".
std::string word_of(Agreement agreement);

/// Name, ours, reference, difference, tolerance, "ok" or "NOT OK", source.
std::vector<std::string> comparison_cells(const Comparison& comparison);

nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace springfold::io
