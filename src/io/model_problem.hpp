// Where in a case file something is that the model complains of. Private to io.
#pragma once

#include <string>
#include <vector>

#include "case_draft.hpp"

namespace springfold::io {

/// Gives a sentence of model::problems_in, which numbers the elements of the model, the place and
/// the key in the file.
void add_model_problem(const std::string& text, const MechanismDraft& draft,
                       const std::vector<double>& numbers, const StudyDraft& study, int run,
                       Problems& problems);

}  // namespace springfold::io
