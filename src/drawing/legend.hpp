// What the colours and marks of a picture mean. Private to drawing.
#pragma once

#include <vector>

#include "painter.hpp"

namespace springfold::drawing {

/// Adds lines of legend from `top` downwards, only of what occurs in the panels.
/// @returns the height that they take
double add_legend(const std::vector<Panel>& panels, const Sheet& sheet,
                  const IllustrationOptions& options, double top, Picture& picture);

}  // namespace springfold::drawing
