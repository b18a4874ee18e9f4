#include "spring_origins.hpp"

#include "springfold/statics/closing.hpp"

namespace springfold::analysis {
namespace {

using model::Joint;

bool counts_from_start(const Joint& joint) { return joint.spring && joint.spring_from_start; }

/// Calls visit(chain number, element number, joint, its unknown in z or -1).
template <class Visit>
void for_each_joint(const model::Mechanism& mechanism, const statics::System& system,
                    const Visit& visit) {
  for (std::size_t c = 0; c < mechanism.chains.size(); ++c) {
    std::size_t j = 0;
    const auto& elements = mechanism.chains[c].elements;
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (const auto* joint = std::get_if<Joint>(&elements[i]))
        visit(c, i, *joint, system.chain_slices[c].joint_coordinate[j++]);
  }
}

std::vector<Index> unknowns_of(const model::Mechanism& mechanism, const Study& study,
                               const statics::System& system, bool all) {
  std::vector<Index> unknowns;
  for_each_joint(mechanism, system, [&](std::size_t, std::size_t, const Joint& joint, Index z) {
    const bool gives_way = joint.role == model::JointRole::passive ||
                           joint.role == model::JointRole::preloaded || counts_from_start(joint);
    if (z >= 0 && (all || gives_way)) unknowns.push_back(z);
  });
  if (study.start.solve == StartSolve::actuators)
    for (Index i = 0; i < system.commands.size(); ++i) unknowns.push_back(system.size + i);
  return unknowns;
}

}  // namespace

std::optional<Origins> spring_origins(const model::Mechanism& mechanism, const Study& study,
                                      const statics::System& system, const Vector& z) {
  bool wanted = false;
  for_each_joint(mechanism, system, [&](std::size_t, std::size_t, const Joint& joint, Index) {
    wanted |= counts_from_start(joint);
  });
  if (!wanted) return Origins{};
  Vector at = z, rho = system.commands;
  if (!close_chains(system, unknowns_of(mechanism, study, system, false), at, rho)) {
    at = z;
    rho = system.commands;
    if (!close_chains(system, unknowns_of(mechanism, study, system, true), at, rho))
      return std::nullopt;
  }
  Origins origins;
  for (const model::Chain& chain : mechanism.chains)
    origins.emplace_back(chain.elements.size(), 0.0);
  for_each_joint(mechanism, system,
                 [&](std::size_t c, std::size_t i, const Joint& joint, Index unknown) {
                   if (counts_from_start(joint)) origins[c][i] = at[unknown];
                 });
  return origins;
}

model::Mechanism with_origins(model::Mechanism mechanism, const Origins& origins) {
  for (std::size_t c = 0; c < origins.size(); ++c)
    for (std::size_t i = 0; i < origins[c].size(); ++i)
      if (auto* joint = std::get_if<Joint>(&mechanism.chains[c].elements[i]);
          joint && counts_from_start(*joint)) {
        joint->spring = model::moved(*joint->spring, origins[c][i]);
        joint->spring_from_start = false;
      }
  return mechanism;
}

}  // namespace springfold::analysis
