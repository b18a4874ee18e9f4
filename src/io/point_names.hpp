// What codes of special points are called in the keys of figures.
#pragma once

#include <string>

namespace springfold::io {

/// "limit point (LP)"; the code itself where it has no name. As point_name() of plots/style.gp.
std::string point_name(const std::string& code);

}  // namespace springfold::io
