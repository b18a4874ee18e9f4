// Arrows of jumps as a figure shows them: gnuplot does not clip arrows.
#pragma once

#include <vector>

#include "figure.hpp"

namespace springfold::io {

struct ShownArrow {
  PlotPoint from{}, to{};
  bool has_head = true;  ///< false: it leaves the frame and ends there
};

/// The parts of Figure::arrows inside the frame; arrows outside of it are left out.
std::vector<ShownArrow> arrows_inside(const Figure& figure);

}  // namespace springfold::io
