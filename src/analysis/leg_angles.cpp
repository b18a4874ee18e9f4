#include "leg_angles.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "springfold/model/rotation_vector.hpp"

namespace springfold::analysis {
namespace {

/// A leg this near to a right angle with its slide stands at a dead point [rad].
constexpr double dead_point_reach = 1e-6;

struct Leg {
  std::size_t slide = 0, hinge = 0;  ///< numbers among the chain's joints
};

std::optional<Leg> leg_of(const statics::System& system, std::size_t chain) {
  const model::CompiledChain& compiled = system.chains[chain];
  const statics::ChainSlice& slice = system.chain_slices[chain];
  std::optional<std::size_t> slide;
  for (std::size_t j = 0; j < compiled.joints.size(); ++j) {
    const bool turns = compiled.joints[j].revolute;
    if (!turns && slice.joint_command[j] >= 0) slide = j;
    if (turns && slide) return Leg{*slide, j};
  }
  return std::nullopt;
}

/// Cosine of the angle between the slide's axis and the line from the hinge to the chain's end; nothing
/// for a line of no length.
std::optional<double> cosine(const statics::System& system, std::size_t chain, const Leg& leg,
                             const Vector& rho, const Vector& z) {
  const model::CompiledChain& compiled = system.chains[chain];
  const statics::ChainSlice& slice = system.chain_slices[chain];
  model::Pose<double> frame;
  model::Vec3<double> axis = model::Vec3<double>::UnitX(), hinge = model::Vec3<double>::Zero();
  for (std::size_t j = 0; j < compiled.joints.size(); ++j) {
    const auto& joint = compiled.joints[j];
    frame = frame * joint.before;
    if (j == leg.slide) axis = frame.R * joint.axis;
    if (j == leg.hinge) hinge = frame.p;
    double c = 0;
    if (slice.joint_coordinate[j] >= 0) c += z[slice.joint_coordinate[j]];
    if (slice.joint_command[j] >= 0) c += rho[slice.joint_command[j]];
    model::Pose<double> moved;
    if (joint.revolute)
      moved.R = model::exp_rotation<double>(model::Vec3<double>(c * joint.axis));
    else
      moved.p = c * joint.axis;
    frame = frame * moved;
  }
  frame = frame * compiled.last;
  const model::Vec3<double> line = frame.p - hinge;
  if (!(line.norm() > 0)) return std::nullopt;
  return line.dot(axis) / line.norm();
}

/// The hinge's coordinate: "leg_x.knee".
std::string name_of(const statics::System& system, std::size_t chain, const Leg& leg) {
  const Index at = system.chain_slices[chain].joint_coordinate[leg.hinge];
  return at >= 0 ? system.coordinate_names[static_cast<std::size_t>(at)]
                 : system.mechanism.chains[chain].name;
}

}  // namespace

std::vector<SnapWarning> leg_warnings(const statics::System& system, const Vector& rho,
                                      const Vector& start, const Vector& landing) {
  std::vector<SnapWarning> warnings;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const auto leg = leg_of(system, i);
    if (!leg || system.chains[i].from_moves) continue;
    const auto before = cosine(system, i, *leg, rho, start);
    const auto after = cosine(system, i, *leg, rho, landing);
    if (!before || !after || *before == 0) continue;
    const double c = *before > 0 ? *after : -*after;
    const double angle = std::acos(std::max(-1.0, std::min(1.0, c)));
    const double beyond = angle - std::numbers::pi / 2;
    if (std::abs(beyond) <= dead_point_reach)
      warnings.push_back({SnapWarning::Kind::dead_point, name_of(system, i, *leg), angle});
    else if (beyond > 0)
      warnings.push_back({SnapWarning::Kind::turned_beyond, name_of(system, i, *leg), angle});
  }
  return warnings;
}

}  // namespace springfold::analysis
