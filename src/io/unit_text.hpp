// Numbers that carry a unit, "5 mm": a common slip, told as what it is. Private to io.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace springfold::io {

/// What is wrong with a text that is a number with a unit behind it, "5 mm", "20°", "3e4 N/m"; empty for
/// every other text. @param known  words that have a meaning in formulas: "2 L" lacks its * only
std::string unit_problem(std::string_view text, const std::vector<std::string>& known);

}  // namespace springfold::io
