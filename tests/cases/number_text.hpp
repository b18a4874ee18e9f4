// Numbers in case files of tests.
#pragma once

#include <cstdio>
#include <string>

namespace springfold::io {

inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace springfold::io
