// What of a figure lies inside its axes, or inside an inset: the key names nothing else.
#pragma once

#include "canvas.hpp"
#include "figure.hpp"

namespace springfold::io {

/// Is the point seen? A marker on the frame is.
bool is_in_view(const Figure& figure, const Canvas& canvas, const PlotPoint& at);

/// Is a part of the line seen?
bool is_in_view(const Figure& figure, const Canvas& canvas, const Polyline& line);

}  // namespace springfold::io
