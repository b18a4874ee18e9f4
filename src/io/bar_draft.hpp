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

/// The bar with a law of its elongation, or with none where it is slack, as a spring of its length.
model::ShapeSpring law_bar_of(const BarDraft& draft, const model::Anchor& from,
                              const model::Anchor& to, const model::Mechanism& mechanism,
                              const std::vector<double>& numbers);

/// alpha of the shape as drawn; not finite where it has no value there.
/// @param mechanism  bodies and chains are built
double drawn_value(const model::Mechanism& mechanism, const model::Shape& shape);

/// Reports springs that are counted from where they are drawn, but have no value or slope there.
void check_drawn_shapes(const MechanismDraft& draft, const model::Mechanism& mechanism,
                        const std::string& when, Problems& problems);

/// Reports bars without length, and pretensions that no free length gives.
void check_bars(const MechanismDraft& draft, const std::vector<double>& numbers,
                const model::Mechanism& mechanism, const std::string& when, Problems& problems);

/// Case::nodes and Case::bars.
void list_nodes(const MechanismDraft& draft, Case& the_case);

}  // namespace springfold::io
