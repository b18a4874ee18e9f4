#include "straight_drives.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::statics {
namespace {

/// What is known of the joint that a spring sits on.
struct JointOfSpring {
  bool gives_way = false;  ///< it does not move freely
  Index command = -1;
};

JointOfSpring joint_at(const System& system, Index coordinate) {
  for (std::size_t c = 0; c < system.chain_slices.size(); ++c) {
    const ChainSlice& chain = system.chain_slices[c];
    std::size_t j = 0;
    for (const model::Element& element : system.mechanism.chains[c].elements) {
      const auto* joint = std::get_if<model::Joint>(&element);
      if (joint == nullptr) continue;
      const std::size_t number = j++;
      if (chain.joint_coordinate[number] != coordinate) continue;
      const bool moves_freely =
          joint->role == model::JointRole::passive || joint->role == model::JointRole::preloaded;
      return {!moves_freely, chain.joint_command[number]};
    }
  }
  return {};
}

bool is_flat_somewhere(const model::CompiledSpring& law, double c) {
  for (std::size_t i = 0; i < law.segments.size(); ++i)
    if (law.is_straight(i) && law.segments[i].stiffness == 0) return true;
  return law.stiffness(law.segment_at(c), c) == 0;
}

double greatest_slope(const model::CompiledSpring& law) {
  double slope = 0;
  for (std::size_t i = 0; i < law.segments.size(); ++i)
    slope = std::max(slope, law.stiffness(i, law.segments[i].anchor));
  return slope > 0 ? slope : 1;
}

}  // namespace

std::vector<AskedSpring> asked_springs(const System& system, const ControlSolver& solver) {
  std::vector<AskedSpring> asked;
  for (std::size_t i = 0; i < system.springs.size(); ++i) {
    const CoordinateSpring& spring = system.springs[i];
    const JointOfSpring joint = joint_at(system, spring.coordinate);
    if (!joint.gives_way) continue;
    const bool is_unknown =
        joint.command >= 0 && std::find(solver.unknowns.begin(), solver.unknowns.end(),
                                        system.size + joint.command) != solver.unknowns.end();
    if (is_unknown)
      asked.push_back({i, joint.command});
    else if (is_flat_somewhere(spring.law, solver.z[spring.coordinate]))
      asked.push_back({i, -1});
  }
  return asked;
}

System straightened(const System& system, const ControlSolver& solver,
                    const std::vector<AskedSpring>& asked) {
  System straight = system;
  for (const AskedSpring& one : asked) {
    CoordinateSpring& spring = straight.springs[one.spring];
    const double c = solver.z[spring.coordinate];
    const model::CompiledSpring::Segment line{
        .anchor = c,
        .torque = spring.law.torque(spring.law.segment_at(c), c),
        .stiffness = greatest_slope(spring.law)};
    std::fill(spring.law.segments.begin(), spring.law.segments.end(), line);
    spring.law.curves.clear();
  }
  return straight;
}

bool put_deflections(const System& system, const StraightSprings& straight,
                     const ControlSolver& start, ControlSolver& solver) {
  const bool forces_are_known =
      std::all_of(straight.asked.begin(), straight.asked.end(),
                  [](const AskedSpring& one) { return one.command >= 0; });
  for (const AskedSpring& one : straight.asked) {
    const CoordinateSpring& spring = system.springs[one.spring];
    const double here = solver.z[spring.coordinate], from = start.z[spring.coordinate];
    const double force = straight.system.springs[one.spring].law.torque(0, here);
    const double there = spring.law.torque(spring.law.segment_at(from), from);
    // Where the law has the force along a whole segment the spring stays where it stood, if that is in it.
    double to = from;
    if (std::abs(force - there) > straight.force_error) {
      const auto found = coordinate_of_torque(spring.law, force, from);
      if (!found) {
        if (forces_are_known && never_falls(spring.law))
          solver.unable = UnableDrive{spring.coordinate, force};
        return false;
      }
      to = *found;
    }
    solver.z[spring.coordinate] = to;
    if (one.command >= 0) solver.inputs.rho[one.command] += here - to;
  }
  return true;
}

System with_straight_drives(const System& system, const ControlSolver& solver) {
  return straightened(system, solver, asked_springs(system, solver));
}

}  // namespace springfold::statics
