// One chain in stages: sums over its joints, its part of residual and matrix. Private to statics.
#pragma once

#include "springfold/statics/stages.hpp"

namespace springfold::statics {

/// The first n numbers of a vector that only grows.
inline auto first_of(Vector& v, Index n) {
  if (v.size() < n) v.resize(n);
  return v.head(n);
}

/// Geometry, closure and loads of chain i in one pass out and one pass back.
void evaluate_chain(const ChainStages& chain, const System& system, std::size_t i, const Vector& z,
                    const Inputs& inputs, ChainSums& out);

/// Adds the chain's rows except those of the springs.
void add_chain_residual(const System& system, std::size_t i, const Vector& z, const ChainSums& sums,
                        Vector& residual);

/// Scales of the chain's variables: unit diagonals for the coordinates, unit compliance for wrench
/// and moments. Joints much softer than the others keep small diagonals and wait for their wrench.
void scale_chain(const StagePlan& plan, const System& system, std::size_t i, StageMatrix& matrix);

/// Values of the chain's fronts, scaled.
void fill_chain(const StagePlan& plan, const System& system, std::size_t i, StageMatrix& matrix);

/// (A dz + dR/drho drho) of the chain without its springs.
void add_chain_product(const System& system, std::size_t i, const ChainSums& sums, const Vector& dz,
                       const Vector& drho, StageScratch& scratch, Vector& product);

}  // namespace springfold::statics
