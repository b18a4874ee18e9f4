// Dashed lines that lie on lines, so that what is drawn says what is there: dashes of two lines would fill each
// other's gaps and look like one solid line.
#pragma once

#include <cstddef>
#include <vector>

#include "springfold/drawing/picture.hpp"

namespace springfold::drawing {

/// A line of one style in pixels.
struct RankedLine {
  std::size_t curve = 0;        ///< lines of one curve follow each other along it
  int rank = 0;                 ///< lines of a lower one cover it; 0: solid, never covered
  std::vector<Place> places{};  ///< those that are not finite are seen nowhere
};

struct Stretch {
  std::vector<Place> places{};
  std::vector<double>
      numbers{};  ///< of each place in its line; 2.5: halfway between the third and the fourth
};

/// What is drawn of a line.
struct SeenLine {
  bool is_whole = true;              ///< nothing covers it: drawn as it is
  std::vector<Stretch> stretches{};  ///< where it is not whole: what is drawn of it
  std::vector<Stretch> beneath{};    ///< where a line of a lower rank covers it
};

/// One for each line. Lines of lower rank are drawn first, then those that are earlier in the list. Two lines lie on
/// each other where they are within a line's width for longer than the dashes are, and neither cross nor are two ends
/// of one turn; but a line that turns on the spot and runs back on its own way lies on itself.
/// @param width, height  of the picture [px]
std::vector<SeenLine> without_overlaps(const std::vector<RankedLine>& lines, double width,
                                       double height);

}  // namespace springfold::drawing
