// The same mechanism with other numbers, again and again.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// What prepare(mechanism) gives. Where `old` was prepared from a mechanism that differs in numbers alone, its places, its
/// names and its memory are used.
/// @pre model::problems_in(mechanism).empty()
System prepare(model::Mechanism mechanism, System old);

}  // namespace springfold::statics
