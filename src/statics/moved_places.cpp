#include "springfold/statics/moved_places.hpp"

#include <algorithm>
#include <cassert>

namespace springfold::statics {
namespace {

/// The law at its place, and its breakpoints among the switches.
bool renew_law(const model::SpringLaw& law, Index first_switch, model::CompiledSpring& own,
               std::vector<Switch>& switches) {
  model::CompiledSpring anew = model::compile(law);
  if (anew.breakpoints.size() != own.breakpoints.size()) return false;
  own = std::move(anew);
  for (std::size_t i = 0; i < own.breakpoints.size(); ++i)
    switches[static_cast<std::size_t>(first_switch) + i].breakpoint = own.breakpoints[i];
  return true;
}

/// On bodies that turn about one direction, and beyond them, what a moment or a follower comes to depends on its
/// direction.
/// @returns false where that is so
bool renew_load(std::size_t number, System& system) {
  const model::Load& load = system.mechanism.loads[number];
  const bool keeps_form = load.kind == model::LoadKind::pressure ||
                          (load.kind == model::LoadKind::force && !load.follows) ||
                          std::none_of(system.body_slices.begin(), system.body_slices.end(),
                                       [](const BodySlice& body) { return body.turn.has_value(); });
  if (!keeps_form) return false;
  const auto own = static_cast<Index>(number);
  if (load.kind == model::LoadKind::pressure) {
    for (PointShape& shape : system.shapes)
      if (shape.load == own) shape.pressure = load.vector[0];
    return true;
  }
  for (PointLoad& acting : system.loads)
    if (acting.number == own) acting.vector = load.vector;
  return true;
}

}  // namespace

MovedPlaces places_of(const System& system, model::MovedParts parts) {
  MovedPlaces places;
  std::vector<std::vector<std::size_t>> springs;
  std::vector<std::vector<Index>> commands;
  std::vector<std::size_t> groups;
  std::size_t spring = 0, group = 0;
  Index command = 0;
  for (const model::Chain& chain : system.mechanism.chains) {
    springs.emplace_back();
    commands.emplace_back();
    groups.push_back(group);
    group += chain.coupled_springs.size();
    for (const model::Element& element : chain.elements) {
      springs.back().push_back(spring);
      commands.back().push_back(command);
      const auto* joint = std::get_if<model::Joint>(&element);
      if (joint == nullptr) continue;
      if (joint->role == model::JointRole::actuated) ++command;
      if (joint->spring && has_coordinate(*joint)) ++spring;
    }
  }
  for (const auto& [chain, element] : parts.laws) places.springs.push_back(springs[chain][element]);
  for (const auto& [chain, element] : parts.commands)
    places.commands.push_back(commands[chain][element]);
  for (const auto& [chain, number] : parts.coupled) places.groups.push_back(groups[chain] + number);
  places.parts = std::move(parts);
  return places;
}

bool renew(const MovedPlaces& places, System& system) {
  const model::MovedParts& parts = places.parts;
  const model::Mechanism& mechanism = system.mechanism;
  const auto joint_at = [&](const model::MovedParts::OfChain& at) -> const model::Joint& {
    return std::get<model::Joint>(mechanism.chains[at.chain].elements[at.part]);
  };
  for (std::size_t i = 0; i < parts.laws.size(); ++i) {
    CoordinateSpring& own = system.springs[places.springs[i]];
    if (!renew_law(*joint_at(parts.laws[i]).spring, own.first_switch, own.law, system.switches))
      return false;
  }
  for (std::size_t i = 0; i < parts.commands.size(); ++i)
    system.commands[places.commands[i]] = joint_at(parts.commands[i]).command;
  for (std::size_t i = 0; i < parts.coupled.size(); ++i) {
    const auto& [chain, number] = parts.coupled[i];
    const model::CoupledSpring& coupled = mechanism.chains[chain].coupled_springs[number];
    system.coupled[places.groups[i]].stiffness = coupled.stiffness;
    system.coupled[places.groups[i]].free = coupled.free;
  }
  for (const std::size_t i : parts.lines) {
    system.line_springs[i].stiffness = mechanism.line_springs[i].stiffness;
    system.line_springs[i].free = mechanism.line_springs[i].free;
  }
  for (const std::size_t i : parts.shape_laws) {
    PointShape& own = system.shapes[i];
    if (!renew_law(mechanism.shape_springs[i].law, own.first_switch, own.law, system.switches))
      return false;
  }
  return std::all_of(parts.loads.begin(), parts.loads.end(),
                     [&](std::size_t i) { return renew_load(i, system); });
}

}  // namespace springfold::statics
