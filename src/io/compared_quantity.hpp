// What an expected value is compared with: more than the columns of the branch table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// A name of an entry of a matrix, "K.x.phi" (stiffness) or "C.x.phi" (its inverse).
struct MatrixEntryName {
  std::string name{};
  MatrixEntry entry{};
};

/// All of them for this mechanism: rows and columns are the pose coordinates of its bodies, with
/// the body's name before them if there are several, "K.a.x.b.y".
std::vector<MatrixEntryName> matrix_entries(const model::Mechanism& mechanism);

/// Is it known without the mechanism: "count.LP", "corank", "ways"?
bool is_general_quantity(const std::string& name);

/// "count.branches", "count.LP", "corank", ...
std::vector<std::string> general_quantities();

/// Codes of special points, "LP", "BP", ..., and "EQ" for one of several equilibria
const std::vector<std::string>& event_codes();

bool is_event_code(const std::string& text);

/// "LP1": a code and a number from 1.
bool is_event_label(const std::string& text);

/// Stands where a code may stand: the rows that are no special points.
inline constexpr const char* any_row = "row";

/// The number in "target 5"; nothing for every other text.
std::optional<int> target_number(const std::string& at);

/// The value that the run has; NaN if the point or the quantity does not exist.
double found_value(const ExpectedValue& expected, const analysis::StudyResult& result);

}  // namespace springfold::io
