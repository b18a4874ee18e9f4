// States of rest that rounding does not tell from critical ones. Private to analysis.
#pragma once

#include "landscape.hpp"

namespace springfold::analysis {

/// Do loads, as well as special points are located, not tell on which side of a fold of its own the state lies? With k
/// the softest stiffness and c its rate along the mode a force of k^2/(2 |c|) along it leads there.
/// @param at  of the state, solved
bool is_at_own_fold(const Landscape& landscape, const Ground& at);

}  // namespace springfold::analysis
