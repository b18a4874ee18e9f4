// Parts of SVG files. Private to drawing.
#pragma once

#include <string>

#include "springfold/drawing/picture.hpp"

namespace springfold::drawing {

/// One mark as an element and its line break.
std::string svg_mark(const Mark& mark);

/// A file with the picture that is not closed yet: "</svg>" is missing.
std::string svg_head(const Picture& picture);

}  // namespace springfold::drawing
