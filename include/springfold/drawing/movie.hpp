// Postures one after the other beside a curve on which a dot moves: an animated picture.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "springfold/drawing/illustration.hpp"

namespace springfold::drawing {

/// A point of the curve. One whose x or y is NaN interrupts the line.
struct DiagramPoint {
  double x = 0, y = 0;
  std::optional<int> unstable_dead{}, unstable_driven{};  ///< as in Panel
  std::string label{};                                    ///< "LP1": it has a mark; or empty
};

struct Diagram {
  std::string x_name{}, y_name{};  ///< "deflection [m]"
  std::vector<DiagramPoint> points{};
};

/// One posture and its point of the curve. Title and notes stand above the mechanism.
struct Frame {
  Panel panel{};
  std::size_t point = 0;  ///< number in Diagram::points
};

struct Film {
  std::string heading{};  ///< below the title of the case
  std::vector<Frame> frames{};
  std::vector<std::size_t> order{};  ///< the frame in each time slot of one pass
  Diagram diagram{};
};

/// An animated picture as plain data: marks that stay, and those of each frame above them.
struct Movie {
  Picture still{};
  std::vector<std::vector<Mark>> frames{};  ///< the last mark of each is the moving dot
  std::vector<std::size_t> order{};         ///< the frame in each time slot of one loop
  double slot = 0.05;                       ///< length of a time slot [s]
};

/// The film there and back, with a rest at both ends. All frames have one scale; the curve is on the right.
/// @pre the film has frames and a slot, and its numbers exist
Movie animate(const Film& film, const IllustrationOptions& options);

/// Where a point of the diagram comes to lie in the movie [px]. @pre its x and y are finite
Place place_in_movie(const Film& film, const DiagramPoint& point);

/// As an SVG file with CSS animation, which loops. Where nothing is animated the first frame is seen. Texts as
/// in svg_text(Picture).
std::string svg_text(const Movie& movie);

}  // namespace springfold::drawing
