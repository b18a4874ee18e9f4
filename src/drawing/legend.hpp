// What the colours and marks of a picture mean. Private to drawing.
#pragma once

#include <vector>

#include "painter.hpp"

namespace springfold::drawing {

/// Adds lines of legend from `top` downwards, only of what occurs in the panels.
/// @param has_mixed  beside them lines lie on more stable ones
/// @returns the height that they take
double add_legend(const std::vector<Panel>& panels, const Sheet& sheet,
                  const IllustrationOptions& options, double top, bool has_mixed, Picture& picture);

}  // namespace springfold::drawing
