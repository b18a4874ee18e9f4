// Spatial bodies that their chains let turn about one direction only: a moment on them has a potential.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "springfold/core/types.hpp"
#include "springfold/model/mechanism.hpp"
#include "springfold/model/point.hpp"

namespace springfold::model {

/// A coordinate that turns a body: of a joint, or the angle of a planar body.
struct TurnPart {
  Index body = 0;         ///< number of a planar body, or 0
  Index chain = 0;        ///< otherwise: number of the chain
  std::size_t joint = 0;  ///< of the chain, its rigid links not counted
  double sign = 1;
};

/// R = Exp(angle axis) base, with the angle the sum of its parts.
struct AxisOfTurn {
  bool turns = false;  ///< otherwise the body is only shifted, and any axis serves
  Vec3<double> axis = Vec3<double>::UnitZ();
  Mat3<double> base = Mat3<double>::Identity();
  std::vector<TurnPart> parts{};
};

using AxesOfTurn = std::vector<std::optional<AxisOfTurn>>;

/// Per body. Chains that hold the direction of a body lead to it from the base, from planar bodies, or from others
/// that turn about the same direction. Nothing: no single chain tells that the body is one of these.
/// @pre problems_in(mechanism).empty()
AxesOfTurn axes_of_turn(const Mechanism& mechanism);

/// The same as without `turns`, which are those of the mechanism.
bool is_conservative(const Mechanism& mechanism, const AxesOfTurn& turns, const Load& load);

/// Are two directions the same or opposite, up to rounding?
bool are_parallel(const Vec3<double>& a, const Vec3<double>& b);

/// Direction of a vector fixed at the point, in the frame of the body where the way begins, with all joints at zero;
/// where the point turns about that direction only, with any.
Vec3<double> at_zero(const CompiledPoint& point, const Vec3<double>& vector);

/// A follower load at a point of such a body, or of a chain from it, that nothing turns: in world axes.
std::optional<Vec3<double>> unturned(const AxisOfTurn& turn, const CompiledPoint& point,
                                     const Vec3<double>& vector);

}  // namespace springfold::model
