// Places the texts of a figure where they hide neither curves nor each other.
#pragma once

#include <string>
#include <vector>

#include "canvas.hpp"
#include "figure.hpp"

namespace springfold::io {

/// A text centred at `at`, in pixels.
struct PlacedLabel {
  FigureText text{};
  PlotPoint at{};
  bool is_curve_label = false;
  /// Too far from its point to be understood without a line; that of a curve ends in a dot on it.
  bool has_leader = false;
  PlotPoint leader_from{}, leader_to{};
};

/// Labels of all marks, then of all curves; curves that lie on each other share one. No text is nearer to another curve
/// than to its own, unless a line joins them. In crowded figures they may lie on curves; those that have no place but
/// on another label are left out.
std::vector<PlacedLabel> place_labels(const Figure& figure, const Canvas& canvas);

}  // namespace springfold::io
