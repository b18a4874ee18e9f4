// Which of the junctions that a diagram has is met, and by which of its ways. Private to the engine.
#pragma once

#include <vector>

#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// A junction that a branch meets, and its ways on the two sides of it.
struct Met {
  double s = 0;
  int junction = -1, way_back = -1, way_on = -1;
};

/// The nearest junction that is the same point, or -1. Points that a curve has passed right before are others: between
/// two passages of one point lies a whole loop.
/// @param met         by the curve so far
/// @param same_place  distance up to which points are the same, relative to their size
int junction_where(const Walker& walker, const std::vector<Junction>& junctions, const Hit& hit,
                   const std::vector<Met>& met, double same_place);

/// Number of the way that leads most nearly into this direction, or -1.
int way_along(const Walker& walker, const Junction& junction, const Direction& direction,
              const Piece& piece);

}  // namespace springfold::continuation
