// [[plot]] tables and the file of expected values.
#pragma once

#include <vector>

#include "case_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// Position of the named study; reports an unknown one with the nearest known one.
std::optional<std::size_t> study_number(const std::string& name, const Item& at,
                                        const std::vector<StudyDraft>& studies, Reading& reading);

std::vector<PlotDraft> read_plots(const std::vector<Item>& tables,
                                  const std::vector<StudyDraft>& studies, Reading& reading);

std::vector<ExpectedDraft> read_expected(const std::vector<Item>& tables,
                                         const std::vector<StudyDraft>& studies, Reading& reading);

}  // namespace springfold::io
