// Suggestions for mistyped words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace springfold::io {

/// Whichever of `known` is nearest to `got` (swapped, missing, added or wrong letters; upper and
/// lower case count little); empty if none is near.
std::string nearest(std::string_view got, const std::vector<std::string>& known);

}  // namespace springfold::io
