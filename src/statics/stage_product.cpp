// Products with the matrix in stages.
#include "places.hpp"
#include "stage_chain.hpp"

namespace springfold::statics {
namespace {

using model::CompiledChain;
using model::Vec3;

}  // namespace

void add_chain_product(const System& system, std::size_t i, const ChainSums& sums, const Vector& dz,
                       const Vector& drho, StageScratch& scratch, Vector& product) {
  const ChainSlice& slice = system.chain_slices[i];
  const CompiledChain& chain = system.chains[i];
  const Index from = chain.first_joint(), to = chain.to_count(), n = chain.first_to();
  const auto place = [&](Index k) { return place_of(slice, k); };
  auto v = first_of(scratch.motion, n), Hv = first_of(scratch.turned, n);
  for (Index k = 0; k < n; ++k) {
    const Place p = place(k);
    v[k] = (p.z >= 0 ? dz[p.z] : 0.0) + (p.rho >= 0 && drho.size() > 0 ? drho[p.rho] : 0.0);
  }
  const auto v_to = dz.segment(to > 0 ? slice.to : 0, to);
  const auto dF = dz.segment(slice.F, slice.F_count);
  auto closure = first_of(scratch.closure, slice.F_count);
  closure.noalias() = sums.J * v;
  closure.noalias() += sums.J_to * v_to;
  product.segment(slice.F, slice.F_count) -= closure;
  Vec3<double> moment = Vec3<double>::Zero(), turn = Vec3<double>::Zero();
  if (to > 0) moment = sums.to_moment * v_to;
  for (Index k = n; k-- > 0;) {  // the later ones; within the front body's pose see H_from
    if (k >= from) moment += sums.moment.col(k) * v[k];
    Hv[k] = sums.turn.col(k).dot(moment);
  }
  for (Index k = 0; k < n; ++k) {  // the earlier ones
    if (k >= from) Hv[k] += sums.moment.col(k).dot(turn);
    turn += sums.turn.col(k) * v[k];
  }
  if (from > 0) Hv.head(from).noalias() += sums.H_from * v.head(from);
  for (Index k = 0; k < n; ++k)
    if (const Index row = place(k).z; row >= 0) product[row] -= Hv[k] + sums.J.col(k).dot(dF);
  if (to == 0) return;
  auto wrench = first_of(scratch.wrench, to);
  wrench.noalias() = sums.H_to * v_to;
  wrench.noalias() += sums.to_moment.transpose() * turn;
  wrench.noalias() += sums.J_to.transpose() * dF;
  product.segment(slice.to, to) -= wrench;
}

namespace {

/// product += block v, in the rows at these places.
template <class Given>
void add_product(const Matrix& block, const Given& v, const std::vector<Index>& places,
                 StageScratch& scratch, Vector& product) {
  auto out = first_of(scratch.out, block.rows());
  out.noalias() = block * v;
  for (std::size_t k = 0; k < places.size(); ++k) product[places[k]] += out[static_cast<Index>(k)];
}

/// product += block dz, for the unknowns at these places.
void add_block(const Matrix& block, const std::vector<Index>& places, const Vector& dz,
               StageScratch& scratch, Vector& product) {
  const auto n = static_cast<Index>(places.size());
  auto in = first_of(scratch.in, n);
  for (Index k = 0; k < n; ++k) in[k] = dz[places[static_cast<std::size_t>(k)]];
  add_product(block, in, places, scratch, product);
}

}  // namespace

void stage_product(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                   const Vector& dz, const Vector& drho, StageScratch& scratch, Vector& product) {
  product.setZero(system.size);
  product.head(plan.chain_unknowns) = matrix.stiffness.cwiseProduct(dz.head(plan.chain_unknowns));
  for (std::size_t i = 0; i < plan.chains.size(); ++i) {
    if (!plan.chains[i].staged) continue;
    add_chain_product(system, i, matrix.sums[i], dz, drho, scratch, product);
    for (const StageGroup& entry : plan.chains[i].groups)
      add_block(matrix.groups[entry.group], system.coupled[entry.group].coordinates, dz, scratch,
                product);
  }
  for (std::size_t p = 0; p < matrix.blocks.size(); ++p) {
    const bool bodies = p == plan.chains.size();
    if (!bodies && plan.chains[p].staged) continue;
    const std::vector<Index>& places = plan.dense[p].places;
    add_block(matrix.blocks[p], places, dz, scratch, product);
    if (drho.size() > 0) add_product(matrix.block_rates[p], drho, places, scratch, product);
  }
}

Vector stage_product(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                     const Vector& dz, const Vector& drho) {
  StageScratch scratch;
  Vector product;
  stage_product(plan, system, matrix, dz, drho, scratch, product);
  return product;
}

/// All signs such that the terms of the product add up.
void put_sizes(const StageMatrix& matrix, StageMatrix& sizes) {
  sizes.stiffness = -matrix.stiffness.cwiseAbs();
  sizes.groups.resize(matrix.groups.size());
  for (std::size_t k = 0; k < matrix.groups.size(); ++k)
    sizes.groups[k] = -matrix.groups[k].cwiseAbs();
  sizes.sums.resize(matrix.sums.size());
  for (std::size_t i = 0; i < matrix.sums.size(); ++i) {
    const ChainSums& sums = matrix.sums[i];
    ChainSums& size = sizes.sums[i];
    size.turn = sums.turn.cwiseAbs();
    size.moment = sums.moment.cwiseAbs();
    size.J = sums.J.cwiseAbs();
    size.to_moment = sums.to_moment.cwiseAbs();
    size.J_to = sums.J_to.cwiseAbs();
    size.H_from = sums.H_from.cwiseAbs();
    size.H_to = sums.H_to.cwiseAbs();
  }
  sizes.blocks.resize(matrix.blocks.size());
  for (std::size_t p = 0; p < matrix.blocks.size(); ++p)
    sizes.blocks[p] = -matrix.blocks[p].cwiseAbs();
}

Vector stage_magnitudes(const StagePlan& plan, const System& system, const StageMatrix& matrix,
                        const Vector& dz) {
  StageMatrix sizes;
  put_sizes(matrix, sizes);
  return -stage_product(plan, system, sizes, dz.cwiseAbs(), {});
}

}  // namespace springfold::statics
