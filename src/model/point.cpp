#include "springfold/model/point.hpp"

#include "springfold/model/axis_of_turn.hpp"

namespace springfold::model {
namespace {

/// Directions, in the frame of the body where the way begins and with all joints at zero, of all
/// axes about which the point can turn; whether it can turn about any axis at all.
struct Turning {
  std::vector<Vec3<double>> axes{};
  bool freely = false;
};

/// @param body  how the body where the way begins turns, if it is spatial and turns about one direction
Turning turning_of(const CompiledPoint& point, const std::optional<AxisOfTurn>& body) {
  Turning turning;
  if (point.body_moves && point.space == TaskSpace::spatial) {
    turning.freely = !body.has_value();
    if (body && body->turns) turning.axes.push_back(body->base.transpose() * body->axis);
  }
  if (point.body_moves && point.space == TaskSpace::planar)
    turning.axes.push_back(Vec3<double>::UnitZ());
  Mat3<double> R = Mat3<double>::Identity();
  for (const auto& step : point.joints) {
    R = R * step.before.R;
    if (step.revolute) turning.axes.push_back(R * step.axis);
  }
  return turning;
}

Index body_of(const Mechanism& mechanism, const Anchor& anchor) {
  if (anchor.chain < 0) return anchor.body;
  return mechanism.chains[static_cast<std::size_t>(anchor.chain)].from;
}

}  // namespace

CompiledPoint compile(const Mechanism& mechanism, const Anchor& anchor) {
  CompiledPoint point;
  Index body = anchor.body;
  const Chain* chain = nullptr;
  if (anchor.chain >= 0) {
    chain = &mechanism.chains[static_cast<std::size_t>(anchor.chain)];
    body = chain->from;
  }
  point.body_moves = body > 0;
  if (point.body_moves)
    point.space = mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space;
  Pose<double> shift;
  shift.p = anchor.at;
  if (chain == nullptr) {
    point.last = shift;
    return point;
  }
  const ChainPoint& at = chain->points[anchor.point];
  Pose<double> pending = chain->from_attachment;
  for (std::size_t i = 0; i < at.elements_before; ++i) {
    if (const auto* link = std::get_if<RigidLink>(&chain->elements[i])) {
      pending = pending * link->transform;
      continue;
    }
    const auto& joint = std::get<Joint>(chain->elements[i]);
    point.joints.push_back({pending, joint.axis, joint.kind == JointKind::revolute});
    pending = Pose<double>{};
  }
  shift.p += at.at;
  point.last = pending * shift;
  return point;
}

bool is_conservative(const Mechanism& mechanism, const Load& load) {
  const Index body = body_of(mechanism, load.on);
  const bool asks =
      load.kind != LoadKind::pressure && body > 0 &&
      (load.kind == LoadKind::moment || load.follows) &&
      mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space == TaskSpace::spatial;
  return is_conservative(mechanism, asks ? axes_of_turn(mechanism) : AxesOfTurn{}, load);
}

bool is_conservative(const Mechanism& mechanism, const AxesOfTurn& turns, const Load& load) {
  const bool dead_force = load.kind == LoadKind::force && !load.follows;
  if (dead_force || load.kind == LoadKind::pressure || load.vector.isZero(0)) return true;
  const CompiledPoint point = compile(mechanism, load.on);
  std::optional<AxisOfTurn> body;
  if (point.body_moves && point.space == TaskSpace::spatial)
    body = turns[static_cast<std::size_t>(body_of(mechanism, load.on) - 1)];
  const Turning turning = turning_of(point, body);
  if (turning.freely) return false;
  if (turning.axes.empty()) return true;
  for (const Vec3<double>& axis : turning.axes)
    if (!are_parallel(axis, turning.axes.front())) return false;
  // About one direction: the moment along it is constant, and so is a force along it.
  if (are_parallel(at_zero(point, load.vector), turning.axes.front())) return true;
  // What turns with joints beyond such a body is not known to the statics as a potential.
  return load.kind == LoadKind::moment && (!load.follows || !body || point.joints.empty());
}

}  // namespace springfold::model
