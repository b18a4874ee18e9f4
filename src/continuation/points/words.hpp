// Numbers in messages: few digits, independent of the locale. Private to the engine.
#pragma once

#include <charconv>
#include <string>
#include <system_error>

namespace springfold::continuation {

inline std::string rounded(double value, int digits = 3) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  return error == std::errc{} ? std::string(buffer, end) : "?";
}

}  // namespace springfold::continuation
