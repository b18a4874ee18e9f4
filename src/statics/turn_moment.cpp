#include "turn_moment.hpp"

#include <cmath>

#include "springfold/core/rounding.hpp"
#include "springfold/model/axis_of_turn.hpp"

namespace springfold::statics {
namespace {

using model::Mat3;
using model::Vec3;

/// r . Q c, its gradient by a rotation in world axes and the derivative of that.
struct Part {
  double value = 0;
  Vec3<double> slope = Vec3<double>::Zero();
  Mat3<double> rate = Mat3<double>::Zero();

  /// @param c  Q c
  void add(double factor, const Vec3<double>& c, const Vec3<double>& r) {
    value += factor * r.dot(c);
    slope += factor * model::cross<double>(c, r);
    rate += factor * (c * r.transpose() - r.dot(c) * Mat3<double>::Identity());
  }
};

/// The angle about the axis: its gradient and the derivative of that.
TurnMoment turn_about(const BodyTurn& turn, const Mat3<double>& Q) {
  Index least = 0;
  turn.axis.cwiseAbs().minCoeff(&least);
  const Vec3<double> e1 = model::cross<double>(turn.axis, Vec3<double>::Unit(least)).normalized();
  const Vec3<double> e2 = model::cross<double>(turn.axis, e1);
  Part x, y;
  x.add(1, Q * e1, e1);
  x.add(1, Q * e2, e2);
  y.add(1, Q * e1, e2);
  y.add(-1, Q * e2, e1);
  const double n = x.value * x.value + y.value * y.value;
  // A guess may have the axis turned over, where the angle about it is not defined.
  if (!(n > few_roundings)) return {.vector = turn.axis, .rate = Mat3<double>::Zero()};
  TurnMoment angle;
  angle.vector = (x.value * y.slope - y.value * x.slope) / n;
  angle.rate =
      (y.slope * x.slope.transpose() - x.slope * y.slope.transpose() + x.value * y.rate -
       y.value * x.rate - 2 * angle.vector * (x.value * x.slope + y.value * y.slope).transpose()) /
      n;
  return angle;
}

}  // namespace

TurnMoment turn_moment(const BodyTurn& turn, const Mat3<double>& Q, const Vec3<double>& moment,
                       bool follows) {
  const Vec3<double> axis = Q * turn.axis;
  Part across;
  if (follows)
    across.add(1, model::cross<double>(axis, moment), turn.axis);
  else
    across.add(1, axis, model::cross<double>(moment, turn.axis));
  const double along = moment.dot(follows ? axis : turn.axis);
  TurnMoment result = turn_about(turn, Q);
  result.vector = along * result.vector + across.slope;
  result.rate = along * result.rate + across.rate;
  return result;
}

Mat3<double> turned_at(const BodyTurn& turn, const Vec3<double>& phi) {
  return model::exp_rotation<double>(phi) * turn.reference;
}

Matrix directions_of_joints(const BodyTurn& turn, const model::CompiledPoint& point) {
  Matrix directions = Matrix::Zero(3, std::ssize(point.joints));
  Mat3<double> R = turn.reference.transpose();
  for (std::size_t j = 0; j < point.joints.size(); ++j) {
    const auto& step = point.joints[j];
    R = R * step.before.R;
    if (step.revolute) directions.col(static_cast<Index>(j)) = R * step.axis;
  }
  return directions;
}

double angle_of(const BodyTurn& turn, const Vector& z, const Vector& rho) {
  double angle = 0;
  for (const BodyTurn::Part& part : turn.angle)
    angle += part.sign * ((part.z >= 0 ? z[part.z] : 0) + (part.rho >= 0 ? rho[part.rho] : 0));
  return angle;
}

model::AxesOfTurn set_body_turns(System& system) {
  model::AxesOfTurn turns = axes_of_turn(system.mechanism);
  for (std::size_t b = 0; b < turns.size(); ++b) {
    auto& own = system.body_slices[b].turn;
    own.reset();
    if (!turns[b]) continue;
    own = BodyTurn{.axis = turns[b]->axis, .reference = turns[b]->base.transpose()};
    for (const model::TurnPart& part : turns[b]->parts) {
      if (part.body > 0) {
        const auto planar = static_cast<std::size_t>(part.body - 1);
        own->angle.push_back({.z = system.body_slices[planar].t + 2, .sign = part.sign});
        continue;
      }
      const ChainSlice& chain = system.chain_slices[static_cast<std::size_t>(part.chain)];
      own->angle.push_back(
          {chain.joint_coordinate[part.joint], chain.joint_command[part.joint], part.sign});
    }
  }
  return turns;
}

void turn_frames(const System& system, const std::vector<model::Mat3<double>>& rotations,
                 System& turned) {
  const auto turn = [&](Index body, model::Pose<double>& frame,
                        const model::Pose<double>& original) {
    const auto b = static_cast<std::size_t>(body - 1);
    if (body == 0 || system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) return;
    frame.R = rotations[b] * original.R;
    frame.p = rotations[b] * original.p;
  };
  for (std::size_t b = 0; b < system.body_slices.size(); ++b)
    if (const auto& own = system.body_slices[b].turn)
      turned.body_slices[b].turn->reference = rotations[b] * own->reference;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const model::Chain& ends = system.mechanism.chains[i];
    const model::CompiledChain& from = system.chains[i];
    model::CompiledChain& to = turned.chains[i];
    turn(ends.to, to.to_attachment, from.to_attachment);
    if (from.joints.empty())
      turn(ends.from, to.last, from.last);
    else
      turn(ends.from, to.joints.front().before, from.joints.front().before);
  }
  for (std::size_t i = 0; i < system.points.size(); ++i) {
    const model::CompiledPoint& from = system.points[i].point;
    model::CompiledPoint& to = turned.points[i].point;
    if (from.joints.empty())
      turn(system.points[i].body, to.last, from.last);
    else
      turn(system.points[i].body, to.joints.front().before, from.joints.front().before);
  }
}

}  // namespace springfold::statics
