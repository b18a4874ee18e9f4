// Places for words where they cover neither each other nor lines. Private to drawing.
#pragma once

#include <vector>

#include "springfold/drawing/picture.hpp"

namespace springfold::drawing {

struct WantedName {
  Place at{};  ///< what it belongs to
  Words words{};
  double distance = 0;  ///< radius of the mark that is there
};

/// Puts the names into the picture, in their order; those that find no place within `room` are left out.
void place_names(const std::vector<WantedName>& names, const Box& room, Picture& picture);

}  // namespace springfold::drawing
