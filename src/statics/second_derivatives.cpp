#include "springfold/statics/second_derivatives.hpp"

#include <algorithm>

#include "springfold/model/flat_third.hpp"

namespace springfold::statics {
namespace {

/// What the variables of a chain have of a vector of the state, and of one of the commands.
void gather(const ChainSlice& slice, const Vector& z, const Vector* rho,
            model::ClosureVector& own) {
  own.v.resize(std::ssize(slice.z_of));
  for (std::size_t k = 0; k < slice.z_of.size(); ++k) {
    const Index at = slice.z_of[k], command = slice.rho_of[k];
    own.v[static_cast<Index>(k)] =
        (at >= 0 ? z[at] : 0.0) + (rho != nullptr && command >= 0 ? (*rho)[command] : 0.0);
  }
  own.F = z.segment(slice.F, slice.F_count);
}

/// The Lagrangian has -F . e of every chain.
void subtract(const ChainSlice& slice, const model::ClosureVector& own, StateDirection& sum) {
  for (std::size_t k = 0; k < slice.z_of.size(); ++k) {
    const double value = own.v[static_cast<Index>(k)];
    if (slice.z_of[k] >= 0) sum.z[slice.z_of[k]] -= value;
    if (slice.rho_of[k] >= 0) sum.rho[slice.rho_of[k]] -= value;
  }
  sum.z.segment(slice.F, slice.F_count) -= own.F;
}

}  // namespace

bool has_second_derivatives(const System& system) {
  return system.loads.empty() && system.line_springs.empty() && system.shapes.empty() &&
         system.redundant == 0 && std::ranges::all_of(system.chains, &model::CompiledChain::flat) &&
         std::ranges::none_of(system.mechanism.bodies, [](const model::Body& body) {
           return body.task_space == model::TaskSpace::spatial;
         });
}

void put_second_derivatives(const System& system, const Piece& piece, const Vector& z,
                            const Vector& rho, const Vector& w, const StateDirection& b,
                            Workspace& work, StateDirection& result) {
  work.closures.resize(system.chains.size());
  result.z.setZero(system.size);
  result.rho.setZero(rho.size());
  model::ClosureVector state, row, along, own;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const ChainSlice& slice = system.chain_slices[i];
    gather(slice, z, &rho, state);
    gather(slice, w, nullptr, row);
    gather(slice, b.z, &b.rho, along);
    model::evaluate_closure<double>(system.chains[i], state.v, nullptr, work.closures[i]);
    model::put_flat_third(system.chains[i], work.closures[i], state.F, row, along, own);
    subtract(slice, own, result);
  }
  for (const CoordinateSpring& spring : system.springs) {
    const Index c = spring.coordinate;
    result.z[c] += spring.law.stiffness_rate(segment_of(spring, piece), z[c]) * w[c] * b.z[c];
  }
}

}  // namespace springfold::statics
