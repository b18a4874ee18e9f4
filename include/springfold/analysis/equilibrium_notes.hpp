// How notes on equilibria begin that others than readers look for.
#pragma once

#include <string_view>

namespace springfold::analysis {

/// Of an equilibrium that stands for a whole line of them.
inline constexpr std::string_view family_note = "one of a family of equilibria";

}  // namespace springfold::analysis
