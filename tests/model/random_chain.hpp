// Random chains for derivative tests. Fixed seeds only.
#pragma once

#include <random>

#include "springfold/model/closure.hpp"

namespace springfold::model {

inline Vec3<double> random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  // One after the other: in which order arguments are evaluated is up to the compiler.
  const double z = normal(random), y = normal(random), x = normal(random);
  return Vec3<double>(x, y, z).normalized();
}

inline Vector random_vector(std::mt19937& random, Index n, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Vector v(n);
  for (double& value : v) value = uniform(random);
  return v;
}

/// A pose; in plane task spaces one that stays in the plane.
inline Pose<double> random_pose(std::mt19937& random, bool in_plane) {
  Pose<double> T;
  T.p = random_vector(random, 3, 1.0);
  const double angle = random_vector(random, 1, 3.0)[0];
  T.R = rotation_about(in_plane ? Vec3<double>::UnitZ() : random_unit(random), angle);
  if (in_plane) T.p[2] = 0;
  return T;
}

inline CompiledChain random_chain(std::mt19937& random, TaskSpace space, bool from_moves,
                                  bool to_moves, int joints) {
  const bool in_plane = space == TaskSpace::xy || space == TaskSpace::planar;
  CompiledChain chain;
  chain.space = chain.from_space = chain.to_space = space;
  chain.from_moves = from_moves;
  chain.to_moves = to_moves;
  chain.last = random_pose(random, in_plane);
  chain.to_attachment = random_pose(random, in_plane);
  for (int j = 0; j < joints; ++j) {
    CompiledChain::JointStep step;
    step.before = random_pose(random, in_plane);
    step.revolute = std::uniform_int_distribution<int>(0, 2)(random) > 0;
    step.axis = random_unit(random);
    if (in_plane && step.revolute) step.axis = (j % 2 ? -1 : 1) * Vec3<double>::UnitZ();
    if (in_plane && !step.revolute)
      step.axis = Vec3<double>(step.axis[0], step.axis[1], 0).normalized();
    chain.joints.push_back(step);
  }
  return chain;
}

}  // namespace springfold::model
