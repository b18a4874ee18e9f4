// A chain as the kinematics wants it, and where its closure and derivatives are put.
#pragma once

#include <vector>

#include "springfold/model/mechanism.hpp"
#include "springfold/model/rotation_vector.hpp"

namespace springfold::model {

/// A chain as the kinematics wants it: one entry per joint, rigid links merged.
struct CompiledChain {
  struct JointStep {
    Pose<double> before{};  ///< rigid transform from the previous joint to this one
    Vec3<double> axis = Vec3<double>::UnitZ();
    bool revolute = true;
  };
  TaskSpace space = TaskSpace::spatial;                                      ///< in which it closes
  TaskSpace from_space = TaskSpace::spatial, to_space = TaskSpace::spatial;  ///< of the end bodies
  bool from_moves = false, to_moves = true;  ///< whether the ends are moving bodies
  std::vector<JointStep> joints{};
  Pose<double> last{};           ///< rigid transform behind the last joint
  Pose<double> to_attachment{};  ///< in the frame of the end body
  bool flat =
      false;  ///< all of it stays in the xy plane (is_flat): a shorter way to the same closure

  Index dimension() const { return springfold::model::dimension(space); }
  Index joint_count() const { return static_cast<Index>(joints.size()); }
  /// Variables of the closure in this order: (pose of `from` if it moves, joint displacements,
  /// pose of `to` if it moves).
  Index variable_count() const { return first_to() + to_count(); }
  Index first_joint() const { return from_moves ? springfold::model::dimension(from_space) : 0; }
  Index to_count() const { return to_moves ? springfold::model::dimension(to_space) : 0; }
  Index first_to() const { return first_joint() + joint_count(); }
};

/// Does the chain close in the plane, between bodies that stay in it, by turns about z (or -z) and
/// transforms about z? Its frames may lie at any height, and slides may point anywhere.
bool is_flat(const CompiledChain& chain);

/// @pre problems_in(mechanism).empty()
CompiledChain compile(const Mechanism& mechanism, const Chain& chain);

template <class S>
using VectorOf = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using MatrixOf = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

namespace detail {

/// One variable as a motion of the world: its first-order twist at the end point, and what the
/// second-order terms need.
template <class S>
struct Motion {
  Vec3<S> dp = Vec3<S>::Zero();      ///< d(point of the end)/dv
  Vec3<S> omega = Vec3<S>::Zero();   ///< rotation of the closure's relative rotation
  Vec3<S> spin = Vec3<S>::Zero();    ///< rotation of everything behind (zero for translations)
  Vec3<S> origin = Vec3<S>::Zero();  ///< a point on the axis of that rotation
  int group = 0;                     ///< variables of one rotation vector share a group
  bool of_end_body = false;
};

}  // namespace detail

/// Closure e of a chain with n variables v and its derivatives. e = 0 where the chain's end and
/// the body's attachment coincide; rows as the task space's pose coordinates, world axes, lengths
/// first; the rotational rows are Log(R_end R_attachment^T).
template <class S>
struct Closure {
  VectorOf<S> e{};  ///< d
  MatrixOf<S> J{};  ///< d x n, de/dv
  MatrixOf<S> H{};  ///< n x n, d2(F . e)/dv2, symmetric; the paper's H^F where v are coordinates

  // Scratch, kept so that storage is reused.
  std::vector<detail::Motion<S>> motions{};
  VectorOf<S> spins{};  ///< flat chains: turn about z of every variable, 1, -1 or 0
};

}  // namespace springfold::model
