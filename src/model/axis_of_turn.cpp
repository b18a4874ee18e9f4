#include "springfold/model/axis_of_turn.hpp"

namespace springfold::model {
namespace {

constexpr double parallel = 1e-12;

/// Directions of a chain's axes in the frame where it begins, its end there, all with joints at zero.
struct Walk {
  std::vector<Vec3<double>> axes{};
  std::vector<std::size_t> joints{};
  Mat3<double> end = Mat3<double>::Identity();
};

Walk walk_of(const Chain& chain) {
  Walk walk;
  walk.end = chain.from_attachment.R;
  std::size_t number = 0;
  for (const Element& element : chain.elements) {
    if (const auto* link = std::get_if<RigidLink>(&element)) {
      walk.end = walk.end * link->transform.R;
      continue;
    }
    const auto& joint = std::get<Joint>(element);
    if (joint.kind == JointKind::revolute) {
      walk.axes.push_back(walk.end * joint.axis);
      walk.joints.push_back(number);
    }
    ++number;
  }
  return walk;
}

/// The body at the other end of the chain; nothing if it turns about another direction too.
/// @param forwards  `known` is the body where the chain begins
std::optional<AxisOfTurn> beyond(const Chain& chain, Index number, const AxisOfTurn& known,
                                 bool forwards) {
  const Walk walk = walk_of(chain);
  const Mat3<double>& attached = chain.to_attachment.R;
  AxisOfTurn turn = known;
  turn.base = forwards ? known.base * walk.end * attached.transpose()
                       : known.base * attached * walk.end.transpose();
  const Mat3<double>& beginning = forwards ? known.base : turn.base;
  for (std::size_t i = 0; i < walk.axes.size(); ++i) {
    const Vec3<double> axis = beginning * walk.axes[i];
    if (!turn.turns) turn.axis = axis.normalized();
    turn.turns = true;
    if (!are_parallel(axis, turn.axis)) return std::nullopt;
    const bool same = (axis.dot(turn.axis) > 0) == forwards;
    turn.parts.push_back({.chain = number, .joint = walk.joints[i], .sign = same ? 1.0 : -1.0});
  }
  return turn;
}

}  // namespace

bool are_parallel(const Vec3<double>& a, const Vec3<double>& b) {
  return cross<double>(a, b).norm() <= parallel * a.norm() * b.norm();
}

Vec3<double> at_zero(const CompiledPoint& point, const Vec3<double>& vector) {
  Mat3<double> R = Mat3<double>::Identity();
  for (const auto& step : point.joints) R = R * step.before.R;
  return R * point.last.R * vector;
}

AxesOfTurn axes_of_turn(const Mechanism& mechanism) {
  const std::size_t count = mechanism.bodies.size();
  AxesOfTurn list(count + 1);
  list[0].emplace();
  bool any = false;
  for (std::size_t b = 1; b <= count; ++b) {
    const TaskSpace space = mechanism.bodies[b - 1].task_space;
    any |= space == TaskSpace::spatial;
    if (space == TaskSpace::planar)
      list[b] = AxisOfTurn{.turns = true, .parts = {{.body = static_cast<Index>(b)}}};
  }
  for (bool found = any; found;) {
    found = false;
    for (std::size_t i = 0; i < mechanism.chains.size(); ++i) {
      const Chain& chain = mechanism.chains[i];
      const auto from = static_cast<std::size_t>(chain.from),
                 to = static_cast<std::size_t>(chain.to);
      const bool forwards = list[from].has_value();
      if (forwards == list[to].has_value()) continue;
      if (task_space_of(mechanism, chain) != TaskSpace::spatial) continue;
      auto& end = list[forwards ? to : from];
      end = beyond(chain, static_cast<Index>(i), *list[forwards ? from : to], forwards);
      found |= end.has_value();
    }
  }
  list.erase(list.begin());
  for (std::size_t b = 0; b < count; ++b)
    if (mechanism.bodies[b].task_space != TaskSpace::spatial) list[b].reset();
  return list;
}

std::optional<Vec3<double>> unturned(const AxisOfTurn& turn, const CompiledPoint& point,
                                     const Vec3<double>& vector) {
  const Vec3<double> world = turn.base * at_zero(point, vector);
  std::optional<Vec3<double>> axis;
  if (turn.turns) axis = turn.axis;
  Mat3<double> R = turn.base;
  for (const auto& step : point.joints) {
    R = R * step.before.R;
    if (!step.revolute) continue;
    const Vec3<double> own = R * step.axis;
    if (axis && !are_parallel(own, *axis)) return std::nullopt;
    axis = own;
  }
  if (axis && !are_parallel(world, *axis)) return std::nullopt;
  return world;
}

}  // namespace springfold::model
