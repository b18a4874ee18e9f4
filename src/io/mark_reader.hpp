// `mark` and `extrema` of a study. Private to io.
#pragma once

#include "study_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

void read_marks(const TableReader& study, StudyDraft& draft, Reading& reading);

}  // namespace springfold::io
