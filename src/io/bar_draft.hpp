// Bars as line springs; nodes and bars for listings.
#pragma once

#include <map>
#include <string>

#include "mechanism_draft.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Adds the bars, behind the springs that are there: linear ones as line springs, those that act one
/// way or have a law as springs of a distance. The free length is the one given; or that between the
/// ends as drawn, less what the pretension has stretched it: (l - T/k), or l/(1 + T/EA). Points of
/// chains are drawn with the guesses of their joints.
/// @param mechanism  bodies, chains and springs are built
void add_bars(const MechanismDraft& draft, const std::vector<double>& numbers,
              model::Mechanism& mechanism);

/// Bars that are line springs, or those that are not, in the order of the mechanism.
std::vector<const BarDraft*> bars_of(const MechanismDraft& draft, bool line);

/// Reports bars without length, and pretensions that no free length gives.
void check_bars(const MechanismDraft& draft, const std::vector<double>& numbers,
                const model::Mechanism& mechanism, const std::string& when, Problems& problems);

/// PlannedRun::members.
std::map<std::string, drawing::Member> members_of(const MechanismDraft& draft);

/// Case::nodes and Case::bars.
void list_nodes(const MechanismDraft& draft, Case& the_case);

}  // namespace springfold::io
