// The generalised force of a moment on a body that can turn about one direction only. Private to statics.
#pragma once

#include "springfold/model/axis_of_turn.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// A moment m in space has no potential. On a body that its chains let turn about the axis a only, this one does the
/// same work: with Q what the body has turned,
///
///     V = - (a . m) angle(Q) - (m x a) . Q a,   angle(Q) = atan2(e2.Q e1 - e1.Q e2, e1.Q e1 + e2.Q e2),
///
/// where e1, e2 are across the axis. Its gradient by a rotation in world axes is -m wherever the chains are closed, so
/// the chains' wrenches are those under m too; its second derivatives are symmetric. A moment that follows the body has
/// its part across the axis in -a . Q (a x m) instead.
struct TurnMoment {
  model::Vec3<double> vector{};  ///< -dV/d(rotation) [world axes]
  model::Mat3<double> rate{};    ///< d vector/d(rotation)
};

/// @param Q  what the body has turned: R reference of its BodyTurn
/// @param moment  in world axes, also of a follower, which is one in the present state
TurnMoment turn_moment(const BodyTurn& turn, const model::Mat3<double>& Q,
                       const model::Vec3<double>& moment, bool follows);

/// What the body has turned at the rotation vector phi.
model::Mat3<double> turned_at(const BodyTurn& turn, const model::Vec3<double>& phi);

/// Directions in the world of the axes of a chain's joints that turn, one column per joint; others are zero. The chain
/// begins at the body, and all of these directions are those of the body's axis, if that turns.
Matrix directions_of_joints(const BodyTurn& turn, const model::CompiledPoint& point);

/// The sum of the coordinates that turn the body [rad].
double angle_of(const BodyTurn& turn, const Vector& z, const Vector& rho);

/// Finds the bodies that can turn about one direction only.
model::AxesOfTurn set_body_turns(System& system);

}  // namespace springfold::statics
