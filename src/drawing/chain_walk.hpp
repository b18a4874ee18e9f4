// Walks a chain from its beginning to its end and puts its parts into a scene. Private to drawing.
#pragma once

#include <vector>

#include "springfold/drawing/scene.hpp"

namespace springfold::drawing {

/// What others fasten to a chain.
struct ChainFrames {
  std::vector<model::Pose<double>> behind{};  ///< the frame behind the first i elements, base axes
  std::vector<PointId> points{};              ///< its place in the scene
  PointId end = 0;
};

PointId add_point(Scene& scene, const model::Vec3<double>& p);

/// @param start  frame in which the chain begins
ChainFrames walk(const statics::System& system, std::size_t chain, const Posture& posture,
                 const model::Pose<double>& start, Scene& scene);

}  // namespace springfold::drawing
