// [[study]] tables.
#pragma once

#include <vector>

#include "mechanism_draft.hpp"
#include "study_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// Number of the named parameter; reports an unknown one with the nearest known one.
std::optional<std::size_t> parameter_number(const std::string& name, const Place& place,
                                            const std::string& key, const FormulaBook& book,
                                            Problems& problems);

/// `set` of a study: other values for named parameters.
Redefinitions read_set(const TableReader& study, Reading& reading);

/// `vary` of a study; nothing if there is none or it is unusable. @param set  already read
std::optional<VaryDraft> read_vary(const TableReader& study, const Redefinitions& set,
                                   Reading& reading);

/// What is looked up in a run's result, and where: keys `at`, `near`, `quantity`, `per`, `side`, `factor`.
ExpectedDraft read_wanted(const TableReader& table, Reading& reading);

/// @param mechanism  already read
std::vector<StudyDraft> read_studies(const std::vector<Item>& tables,
                                     const MechanismDraft& mechanism, Reading& reading);

}  // namespace springfold::io
