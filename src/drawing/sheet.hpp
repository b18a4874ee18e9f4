// One scale for several panels. Private to drawing.
#pragma once

#include <vector>

#include "painter.hpp"

namespace springfold::drawing {

/// What a panel has for its mechanism [px].
struct Room {
  double width = 0, height = 0;
  bool is_large = false;  ///< long arrows and large joints
};

/// The scale, view and measures with which all panels fit into the room. @pre panels are not empty
Sheet sheet_for(const std::vector<Panel>& panels, const IllustrationOptions& options,
                const Room& room);

}  // namespace springfold::drawing
