// Numbers in messages and pictures: few digits, independent of the locale.
#pragma once

#include <charconv>
#include <string>
#include <system_error>

namespace springfold {

/// At most `digits` significant digits.
inline std::string rounded(double value, int digits = 4) {
  char buffer[40];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  return error == std::errc{} ? std::string(buffer, end) : "?";
}

}  // namespace springfold
