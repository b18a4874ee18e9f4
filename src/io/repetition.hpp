// `repeat`, `use` and `with`: what a case writes once and means several times.
#pragma once

#include <string>
#include <vector>

#include "source_files.hpp"

namespace springfold::io {

/// Lists of tables that make up the mechanism: included files may have them, and their tables may be
/// repeated.
const std::vector<std::string>& parts_of_mechanism();

/// Replaces every table with `repeat` by its copies, and every one with `use` by what its template
/// says, in the lists of the mechanism, in `elements` and in `loads` of studies. Texts in copies have
/// their braces filled; formulas there may name indices and parameters of templates. Places stay
/// those of the text that was repeated. What cannot be expanded is a problem and stays as it is.
/// @returns hints: templates of the case file itself that nothing uses
std::vector<std::string> expand_repetitions(std::vector<Document>& documents, Problems& problems);

}  // namespace springfold::io
