// A frame with axes in a picture: what the plain figures have in common.
#pragma once

#include <string>
#include <vector>

#include "figure.hpp"
#include "springfold/drawing/picture.hpp"

namespace springfold::io::plain {

constexpr const char* ink = "#222222";
constexpr const char* grey = "#777777";

/// Two axes and the rectangle of the picture that shows them.
struct Frame {
  drawing::Box box{};  ///< pixels, y down
  PlotPoint low{}, high{};
  bool x_log = false, y_log = false;

  drawing::Place place(const PlotPoint& at)
      const;  ///< not finite where a logarithmic axis has no place for the value
  bool holds(const drawing::Place& place) const;
};

/// The parts of the line inside the frame, in pixels.
std::vector<std::vector<drawing::Place>> clipped(const Frame& frame, const Polyline& line);

/// The part of a closed outline inside the frame; empty if there is none.
std::vector<drawing::Place> clipped_outline(const Frame& frame, const Polyline& outline);

struct Axes {
  std::vector<std::string> x_ticks{}, y_ticks{};
  double text_size = 19;
  bool has_grid = true;  ///< false: no lines at ticks, nor through zero
};

/// Grid, edges, ticks and their numbers.
void add_axes(const Frame& frame, const Axes& axes, drawing::Picture& picture);

/// What is seen of the text, on one line.
std::string text_of(const FigureText& text);

/// An entry of a key: a mark of its own and words.
struct Entry {
  std::vector<drawing::Mark> marks{};  ///< around the origin, 40 pixels wide
  std::string text{};
};

/// Lays out entries in lines between `left` and `right`, centred, the last line ending above `bottom`.
void add_key(const std::vector<Entry>& entries, const drawing::Box& room, double text_size,
             drawing::Picture& picture);

/// The mark moved by `by`.
drawing::Mark moved(drawing::Mark mark, drawing::Place by);

/// A colour bar right of the frame, with its title and numbers. @param colour  of a part from 0 to 1
void add_bar(const Frame& frame, const ColourBar& bar, double text_size,
             std::string (*colour)(double), drawing::Picture& picture);

}  // namespace springfold::io::plain
