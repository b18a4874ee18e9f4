// Bars as line springs; nodes and bars for listings.
#pragma once

#include "mechanism_draft.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// The line spring that the bar is. Its free length is the one given; or that between its ends as
/// drawn, less what the pretension has stretched it: (l - T/k), or l/(1 + T/EA). Points of chains are
/// drawn with the guesses of their joints.
/// @param mechanism  bodies and chains are built
model::LineSpring bar_of(const BarDraft& draft, const model::Anchor& from, const model::Anchor& to,
                         const model::Mechanism& mechanism, const std::vector<double>& numbers);

/// Reports bars without length, and pretensions that no free length gives.
void check_bars(const MechanismDraft& draft, const std::vector<double>& numbers,
                const model::Mechanism& mechanism, const std::string& when, Problems& problems);

/// Case::nodes and Case::bars.
void list_nodes(const MechanismDraft& draft, Case& the_case);

}  // namespace springfold::io
