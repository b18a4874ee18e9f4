// Questions asked of results by tables, files and plots alike.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "springfold/analysis/event_rows.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Number of the named column; nothing if the result has no such quantity.
std::optional<std::size_t> column_of(const analysis::StudyResult& result, std::string_view name);

/// Value in one row of the branch; NaN if the row or the quantity does not exist.
double value_at(const analysis::StudyResult& result, const analysis::Branch& branch,
                std::size_t row, std::string_view quantity);

/// Columns of all results of which that holds, each name once, in the order of the results.
std::vector<std::string> columns_where(const std::vector<analysis::StudyResult>& results,
                                       bool (*holds)(const analysis::StudyResult&));

/// "saddle.tool.x": a column at the saddle.
inline const std::string saddle_prefix = "saddle.";

/// Value of a state of rest; NaN if the quantity does not exist.
double column_value(const analysis::StudyResult& result, const analysis::SnapState& state,
                    std::string_view name);

/// What is no larger is rounding beside the scale: rows are solved to such a residual, and no better.
double shown_below(double scale);

/// The number for people: 0 where it is nothing but rounding beside the scale.
double shown_against(double value, double scale);

/// A stiffness or compliance for people: entries are 0 where they are rounding beside the diagonal entries that they
/// couple, whatever the units of both, or where no accuracy of the whole matrix reaches down to them.
Matrix shown_matrix(Matrix matrix);

/// What people are told that a column is: what drives a body along a rotation is a moment, and the way is an angle, but
/// columns have one name for both ("force", "deflection").
std::string shown_name(const analysis::StudyResult& result, const std::string& quantity);

/// The result of one run of a study; nullptr if it was not run.
const analysis::StudyResult* result_of(const std::vector<analysis::StudyResult>& results,
                                       std::string_view study, int run);

/// What was planned for this result; nullptr if the case does not have it.
const PlannedRun* plan_of(const Case& the_case, const analysis::StudyResult& result);

/// "parameter.Kv": what tables and figures call a parameter that a study varies.
inline constexpr const char* parameter_prefix = "parameter.";

/// Parameters that any study varies, in the order of the studies.
std::vector<std::string> varied_parameters(const Case& the_case);

/// Value of a parameter that this run's study varies; NaN if it does not. @param planned  may be null
double varied_value(const PlannedRun* planned, const std::string& name);

/// Special points per code over all branches, each once, only codes that occur.
std::map<std::string, int> event_counts(const analysis::StudyResult& result);

/// Every planned run is there and complete.
bool all_complete(const Case& the_case, const std::vector<analysis::StudyResult>& results);

/// "N/m" in the labels of the case; empty for a pure number.
std::string unit_label(analysis::Unit unit, analysis::Unit lambda_unit, const UnitLabels& labels);

/// The parameter whose values the column holds: a curve or a map over it, or lambda that is one; empty: none.
/// @param planned  may be null
std::string parameter_in(const PlannedRun* planned, const std::string& quantity);

/// As unit_label(), and of a parameter the unit that the case gives it. @param planned  may be null
std::string column_unit(const analysis::StudyResult& result, std::size_t column,
                        const PlannedRun* planned, const UnitLabels& labels);

/// As shown_name(), and of a lambda that is a parameter "lambda (Kv)". @param planned  may be null
std::string column_title(const analysis::StudyResult& result, const std::string& quantity,
                         const PlannedRun* planned);

/// "Kv [N/m]"; without a unit "Kv".
std::string parameter_title(const std::string& name, const UnitLabels& labels);

/// "push, run 2 (Kv = 0.01)".
std::string heading_of(const analysis::StudyResult& result);

}  // namespace springfold::io
