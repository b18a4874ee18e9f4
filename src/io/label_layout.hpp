// Places the texts of a figure where they hide neither curves nor each other.
#pragma once

#include <string>
#include <vector>

#include "figure.hpp"

namespace springfold::io {

/// Size of a figure and its parts in pixels, origin at the lower left. The templates get the same
/// numbers, so that what is computed here holds in the picture.
struct Canvas {
  double width = 1200, height = 900;
  double left = 135, right = 1165, bottom = 95, top = 775;  ///< frame of the axes
  double text_height = 19;                                  ///< of labels
};

/// A text centred at `at`, in pixels.
struct PlacedLabel {
  FigureText text{};
  PlotPoint at{};
  bool is_curve_label = false;
  bool has_leader = false;  ///< too far from its point to be understood without a line
  PlotPoint leader_from{}, leader_to{};
};

/// Labels of all marks, then of all curves. Crowded figures get the least bad places.
std::vector<PlacedLabel> place_labels(const Figure& figure, const Canvas& canvas);

}  // namespace springfold::io
