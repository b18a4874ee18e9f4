// What a study that starts in the state of another one must obey, once its runs are built.
#pragma once

#include <string>

#include "history_draft.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// The first rule that is broken, as those of analysis::problems_in, "start.from: ..."; empty: none is. A study drives
/// what is held, or prescribes it; it changes a parameter that an earlier one moves, or has with another value.
std::string history_problem(const HistoryDraft& history, const MechanismDraft& mechanism,
                            const PlannedRun& planned);

}  // namespace springfold::io
