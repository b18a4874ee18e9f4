// Where the variables of a chain's closure stand. Private to statics.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Index in z, or -1, and index in rho, or -1.
struct Place {
  Index z = -1, rho = -1;
};

inline Place place_of(const ChainSlice& slice, Index variable) {
  const auto i = static_cast<std::size_t>(variable);
  return {slice.z_of[i], slice.rho_of[i]};
}

}  // namespace springfold::statics
