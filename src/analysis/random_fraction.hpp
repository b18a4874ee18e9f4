// Random numbers of searches.
#pragma once

#include <random>

namespace springfold::analysis {

/// From 0 to 1. Bits of the generator are used as they are: library distributions differ between libraries.
inline double random_fraction(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace springfold::analysis
