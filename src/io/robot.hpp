// Robots of other programs: links in a tree, as plain data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "problems.hpp"
#include "springfold/core/types.hpp"
#include "springfold/model/rotation_vector.hpp"

namespace springfold::io {

enum class RobotJoint { fixed, revolute, prismatic };

/// A link and the joint that leads to it. Frames: a link's own is that of its joint, behind its motion.
struct RobotLink {
  std::string name{}, joint_name{};  ///< as the file has them
  std::size_t parent = 0;            ///< number of the link before it; of the root its own
  RobotJoint joint = RobotJoint::fixed;
  model::Vec3<double> shift{};  ///< origin of the joint in the parent's frame
  model::Vec3<double> turn{};   ///< rotation vector of that frame
  model::Vec3<double> axis{};   ///< of the joint, in its frame
  double mass = 0;              ///< 0: none is given
  model::Vec3<double> com{};    ///< centre of mass in the link's frame
  /// Moments of inertia about the centre of mass, in the axes of the link's frame; zero: none are given.
  model::Mat3<double> inertia = model::Mat3<double>::Zero();
};

struct Robot {
  std::string name{};
  std::vector<RobotLink> links{};  ///< every parent before its children; the first one is the root
  std::vector<std::string> left_out{};  ///< what the file has besides, as sentences
};

/// Reports what is wrong; the result is of use only without problems.
Robot read_urdf(const std::string& bytes, const std::string& file, Problems& problems);

}  // namespace springfold::io
