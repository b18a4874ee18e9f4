// Curves that lie on each other, so that what is drawn says what is there.
#pragma once

#include <vector>

#include "canvas.hpp"
#include "figure.hpp"

namespace springfold::io {

/// What is drawn of a figure's curves.
struct DrawnLines {
  /// As Figure::curves, without those stretches of dashed lines along which a line is drawn already:
  /// dashes of two lines would fill each other's gaps and look like one solid line.
  std::vector<std::vector<CurvePart>> curves{};
  /// Where lines of different stability lie on each other: the more stable one is drawn, and this beneath it.
  std::vector<Polyline> mixed{};
};

/// Two lines lie on each other where they are within a line's width for longer than the dashes are, and
/// neither cross nor are two ends of one turn.
DrawnLines without_overlaps(const Figure& figure, const Canvas& canvas);

}  // namespace springfold::io
