// A mechanism with its load, as a case gives them for some values of its parameters.
#pragma once

#include "springfold/core/types.hpp"
#include "springfold/model/mechanism.hpp"

namespace springfold::analysis {

struct Situation {
  model::Mechanism mechanism{};
  Vector constant_load{};  ///< on the study's body, d entries; empty: none
  Vector pose{};           ///< of the study's body, for maps; empty: its own pose
};

}  // namespace springfold::analysis
