// Ticks at round values.
#pragma once

#include <string>
#include <vector>

#include "springfold/io/plot_look.hpp"

namespace springfold::io {

/// Round values in the range, in order, two at least and `most` at most, as texts that read back to them:
/// multiples of 1, 2 or 5 times a power of ten, on a logarithmic axis powers of ten where two or more lie
/// in the range. @pre low < high, most >= 3
std::vector<std::string> round_ticks(const PlotRange& range, bool is_log, std::size_t most);

}  // namespace springfold::io
