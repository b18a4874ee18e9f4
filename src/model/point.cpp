#include "springfold/model/point.hpp"

namespace springfold::model {
namespace {

constexpr double parallel = 1e-12;

/// Directions, in the frame of the body where the way begins and with all joints at zero, of all
/// axes about which the point can turn; whether it can turn about any axis at all.
struct Turning {
  std::vector<Vec3<double>> axes{};
  bool freely = false;
};

Turning turning_of(const CompiledPoint& point) {
  Turning turning;
  turning.freely = point.body_moves && point.space == TaskSpace::spatial;
  if (point.body_moves && point.space == TaskSpace::planar)
    turning.axes.push_back(Vec3<double>::UnitZ());
  Mat3<double> R = Mat3<double>::Identity();
  for (const auto& step : point.joints) {
    R = R * step.before.R;
    if (step.revolute) turning.axes.push_back(R * step.axis);
  }
  return turning;
}

bool are_parallel(const Vec3<double>& a, const Vec3<double>& b) {
  return cross<double>(a, b).norm() <= parallel * a.norm() * b.norm();
}

/// Direction of the vector with all joints at zero; that of axes of one direction does not depend on
/// their angles.
Vec3<double> at_zero(const CompiledPoint& point, const Vec3<double>& vector) {
  Mat3<double> R = Mat3<double>::Identity();
  for (const auto& step : point.joints) R = R * step.before.R;
  return R * point.last.R * vector;
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
  const bool dead_force = load.kind == LoadKind::force && !load.follows;
  if (dead_force || load.kind == LoadKind::pressure || load.vector.isZero(0)) return true;
  const CompiledPoint point = compile(mechanism, load.on);
  const Turning turning = turning_of(point);
  if (turning.freely) return false;
  if (turning.axes.empty()) return true;
  for (const Vec3<double>& axis : turning.axes)
    if (!are_parallel(axis, turning.axes.front())) return false;
  // About one direction: the moment along it is constant, and so is a force along it.
  return load.kind == LoadKind::moment ||
         are_parallel(at_zero(point, load.vector), turning.axes.front());
}

}  // namespace springfold::model
