// A mechanism with its load, as a case gives them for some values of its parameters.
#pragma once

#include <string>

#include "springfold/core/types.hpp"
#include "springfold/model/mechanism.hpp"

namespace springfold::analysis {

struct Situation {
  model::Mechanism mechanism{};
  Vector constant_load{};  ///< on the study's body, d entries; empty: none
  Vector pose{};           ///< of the study's body, for maps; empty: its own pose
  std::string
      problem{};  ///< why no state is known in which it starts, in words; empty: all is well
};

}  // namespace springfold::analysis
