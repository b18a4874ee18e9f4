// Figures without gnuplot: what they show, drawn more plainly, as pictures of which SVG files are made.
#pragma once

#include "figure.hpp"
#include "map_figure.hpp"
#include "springfold/drawing/picture.hpp"
#include "tornado_figure.hpp"

namespace springfold::io::plain {

/// The same frame, lines, marks, labels, key and insets as in gnuplot's figure. Texts in markup lose it; the ordinate's
/// title stands above its axis.
drawing::Picture picture_of(const Figure& figure);
drawing::Picture picture_of(const MapFigure& figure);
drawing::Picture picture_of(const TornadoFigure& figure);

}  // namespace springfold::io::plain
