// Numbers in pictures. Private to drawing.
#pragma once

#include <charconv>
#include <string>

namespace springfold::drawing {

/// A few digits, independent of locale.
inline std::string brief(double value, int digits = 4) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  return {buffer, end};
}

}  // namespace springfold::drawing
