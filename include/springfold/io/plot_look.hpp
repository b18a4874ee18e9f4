// How a figure of curves looks: what its [[plot]] says beside its quantities.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace springfold::io {

using PlotRange = std::pair<double, double>;  ///< low, high, in the units of the axis

/// A part of a figure, enlarged in one of its corners.
struct PlotInset {
  PlotRange x{}, y{};                ///< the part
  std::string corner = "top right";  ///< "top left", "top right", "bottom left", "bottom right"
};

struct PlotLook {
  std::optional<PlotRange> x_range{}, y_range{};  ///< none: all that occurs
  bool x_log = false, y_log = false;  ///< logarithmic axes: only positive values are shown
  bool equal = false;                 ///< a unit is as long along x as along y
  bool smooth = true;                 ///< false: straight lines from row to row
  double width = 1200, height = 900;  ///< [pixel], 96 to an inch
  double font_size = 14;              ///< of axes and labels [pt]
  std::string font = "DejaVu Sans";
  std::vector<std::string> formats{"png", "svg"};  ///< also "pdf", "tikz"
  std::vector<PlotInset> insets{};
};

/// How a map or a figure of bars looks, whose axes are those of what it shows.
struct SheetLook {
  double width = 0, height = 0;  ///< [pixel], 96 to an inch; 0: as large as it needs
  double font_size = 14;         ///< of axes and labels [pt]
  std::string font = "DejaVu Sans";
  std::vector<std::string> formats{"png", "svg"};  ///< also "pdf", "tikz"
};

}  // namespace springfold::io
