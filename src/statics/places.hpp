// Where the variables of a chain's closure stand. Private to statics.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Index in z, or -1, and index in rho, or -1.
struct Place {
  Index z = -1, rho = -1;
};

inline Place place_of(const ChainSlice& slice, const model::CompiledChain& chain, Index variable) {
  if (variable < chain.first_joint()) return {slice.from + variable, -1};
  if (variable >= chain.first_to()) return {slice.to + variable - chain.first_to(), -1};
  const auto j = static_cast<std::size_t>(variable - chain.first_joint());
  return {slice.joint_coordinate[j], slice.joint_command[j]};
}

}  // namespace springfold::statics
