// A spring of a joint at one coordinate. Private to drawing.
#pragma once

#include "springfold/model/spring_law.hpp"

namespace springfold::drawing {

struct SpringState {
  bool is_one_sided = false;  ///< some segment has no force
  bool acts = true;           ///< this one has
  double force = 0, energy = 0;
};

/// At coordinate c; at a threshold the segment above it.
SpringState spring_state(const model::SpringLaw& law, double c);

/// Thresholds between a segment without force and one with.
std::vector<double> thresholds_of(const model::SpringLaw& law);

/// A law that never gives a force: nothing is drawn.
bool is_nothing(const model::SpringLaw& law);

}  // namespace springfold::drawing
