// Where the points of a figure lie in its picture.
#pragma once

#include "figure.hpp"

namespace springfold::io {

/// Size of a figure and its parts in pixels, origin at the lower left. The templates get the same
/// numbers, so that what is computed here holds in the picture.
struct Canvas {
  double width = 1200, height = 900;
  double left = 135, right = 1165, bottom = 95, top = 775;  ///< frame of the axes
  double text_height = 19;                                  ///< of labels
};

/// The canvas of a figure with this look: margins grow with the font. @param with_bar  a colour bar
/// stands right of the frame
Canvas canvas_of(const PlotLook& look, bool with_bar);

/// Place in the picture [pixel]; not finite where a logarithmic axis has no place for the value.
PlotPoint in_pixels(const Figure& figure, const Canvas& canvas, const PlotPoint& at);

/// The inverse: the point of the axes that is seen there.
PlotPoint from_pixels(const Figure& figure, const Canvas& canvas, const PlotPoint& pixel);

/// Where an inset lies in the picture, and its ticks.
struct InsetPlace {
  PlotPoint low{}, high{};                        ///< lower left and upper right corner [pixel]
  double left_room = 0, bottom_room = 0;          ///< of the numbers beside it [pixel]
  std::vector<std::string> x_ticks{}, y_ticks{};  ///< round values, as round_ticks
};
InsetPlace place_of_inset(const PlotInset& inset, const PlotLook& look, const Canvas& canvas);

}  // namespace springfold::io
