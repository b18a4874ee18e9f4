// Lines of words. Private to drawing.
#pragma once

#include <string>

#include "springfold/drawing/picture.hpp"

namespace springfold::drawing {

/// A line of words below `y`, which moves down by its height; cut with an ellipsis where it is wider than
/// `width` pixels. No words, no line.
void add_line(const std::string& text, double font, bool is_bold, double x, double width, double& y,
              Picture& picture);

}  // namespace springfold::drawing
