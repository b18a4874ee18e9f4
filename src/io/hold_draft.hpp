// Coordinates that a study holds still where it starts, and those that it no longer holds.
#pragma once

#include <string>
#include <vector>

#include "history_draft.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// "foot.x" into a list of holds; reports others.
void read_hold(const Item& item, const MechanismDraft& mechanism, std::vector<HoldDraft>& holds,
               Reading& reading);

/// "foot.x" into a list of releases; reports others, and what the study holds itself.
void read_release(const Item& item, const MechanismDraft& mechanism, HistoryDraft& history,
                  Reading& reading);

/// Takes over what the study before holds and this one does not release; reports releases of what is
/// not held. @pre `before` is complete
void inherit_holds(const MechanismDraft& mechanism, const std::vector<HoldDraft>& before,
                   StudyDraft& study, Problems& problems);

/// Adds the chains that hold bodies.
void add_holds(const HistoryDraft& history, model::Mechanism& mechanism);

/// Names of the chains that hold bodies, and what the study gives free; without the earlier study.
analysis::History history_of(const HistoryDraft& history, const MechanismDraft& mechanism);

/// Does the study drive what is held, or push on nothing else? A sentence as those of
/// analysis::problems_in, "direction: ..."; empty: it does not.
std::string held_drive(const HistoryDraft& history, const MechanismDraft& mechanism,
                       const PlannedRun& planned);

}  // namespace springfold::io
