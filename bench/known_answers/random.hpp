// Random numbers that are the same on every platform.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace springfold::known_answers {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

inline double log_uniform(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/// 0, 1, ..., count - 1
inline int choice(Random& random, int count) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(count));
}

inline double sign(Random& random) { return choice(random, 2) ? 1 : -1; }

/// Relative distances that are worth drawing: from 1e-6 to 1e-1.
inline double closeness(Random& random) { return log_uniform(random, 1e-6, 1e-1); }

}  // namespace springfold::known_answers
