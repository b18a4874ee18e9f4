#include "gnuplot_text.hpp"

#include <algorithm>

#include "springfold/io/shown_text.hpp"

namespace springfold::io {

std::string gnuplot_string(std::string_view text) {
  std::string one_line{text};
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  std::string result = "'";
  for (const char c : shown(one_line)) {
    if (c == '\'') result += '\'';
    result += c;
  }
  return result + "'";
}

}  // namespace springfold::io
