#include "frozen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "springfold/model/rotation_vector.hpp"

namespace springfold::analysis {
namespace {

PathRule frozen_rule(const PathProblem& traced, double lambda) {
  PathRule rule = traced.rule();
  const statics::Inputs inputs = traced.inputs(lambda);
  rule.t_start += lambda * rule.t_rate;
  rule.t_rate.setZero();
  rule.rho_start = inputs.rho;
  rule.rho_rate.setZero();
  rule.W_start = inputs.W;
  rule.W_rate.setZero();
  rule.load_start += lambda * rule.load_rate;
  rule.load_rate.setZero();
  rule.family = {};
  rule.quaternions = false;
  return rule;
}

/// Poses with rotation vectors as rotation matrices, so that turns do not count.
bool same_poses(const statics::System& system, const Vector& a, const Vector& b, double near) {
  for (std::size_t i = 0; i < system.body_slices.size(); ++i) {
    const auto& slice = system.body_slices[i];
    const model::TaskSpace space = system.mechanism.bodies[i].task_space;
    const Index lengths = translations(space);
    const Vector p = a.segment(slice.t, slice.count), q = b.segment(slice.t, slice.count);
    if ((p - q).head(lengths).lpNorm<Eigen::Infinity>() > near) return false;
    if (space == model::TaskSpace::planar &&
        std::abs(std::remainder(p[2] - q[2], 2 * std::numbers::pi)) > near)
      return false;
    if (space == model::TaskSpace::spatial) {
      const model::Vec3<double> u = p.tail(3), v = q.tail(3);
      if ((model::exp_rotation(u) - model::exp_rotation(v)).cwiseAbs().maxCoeff() > near)
        return false;
    }
  }
  return true;
}

}  // namespace

bool same_equilibrium(const statics::System& system, const Vector& a, const Vector& b) {
  constexpr double near = 1e-7;
  for (const statics::CoordinateSpring& spring : system.springs)
    if (std::abs(a[spring.coordinate] - b[spring.coordinate]) > near) return false;
  for (const statics::CoordinateGroup& group : system.coupled)
    for (const Index i : group.coordinates)
      if (std::abs(a[i] - b[i]) > near) return false;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)] &&
        std::abs(a[i] - b[i]) > near * std::max(1.0, std::abs(a[i])))
      return false;
  return same_poses(system, a, b, near);
}

Frozen::Frozen(const PathProblem& traced, const Scales& scales, double lambda,
               const std::vector<JointDamping>& damping)
    : lambda_{lambda},
      problem_{traced.system(lambda), frozen_rule(traced, lambda)},
      landscape_{terrain(scales, damping)} {}

Terrain Frozen::terrain(const Scales& scales, const std::vector<JointDamping>& damping) const {
  const statics::System& system = problem_.layout();
  Terrain terrain{.problem = problem_, .lambda = 0};
  terrain.redundant = system.redundant;
  const Index n = problem_.size();
  Vector factors = Vector::Zero(n);  // of the moving unknowns among all; joints alone are damped
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool is_joint = i < system.first_pose && !system.is_wrench[k];
    terrain.is_multiplier.push_back(i < system.first_pose && system.is_wrench[k]);
    if (!is_joint) continue;
    factors[i] = 1;
    const double unit =
        system.is_length[k] ? scales.force / scales.length : scales.moment();  // per time
    for (const JointDamping& d : damping)
      if (d.joint == system.coordinate_names[k]) factors[i] = d.value / unit;
  }
  // Bodies that no chain holds have no joints that could be damped for them.
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    const auto body = static_cast<Index>(b) + 1;
    const auto& chains = system.mechanism.chains;
    if (std::any_of(chains.begin(), chains.end(),
                    [body](const auto& chain) { return chain.from == body || chain.to == body; }))
      continue;
    const statics::BodySlice& slice = system.body_slices[b];
    for (Index i = 0; i < slice.count && slice.t + i < n; ++i) factors[slice.t + i] = 1;
  }
  std::vector<Index> moving;
  for (Index i = 0; i < n; ++i)
    if (!terrain.is_multiplier[static_cast<std::size_t>(i)]) moving.push_back(i);
  terrain.damping = Vector(factors(moving)).asDiagonal();
  terrain.energy = [this](const Vector& x) {
    const statics::System& at = problem_.layout();
    const Vector z = problem_.expand(x, 0);
    const statics::Inputs inputs = problem_.inputs(0);
    return spring_energy(at, z, inputs.rho) + load_potential(at, z, inputs);
  };
  terrain.same = [this](const Vector& a, const Vector& b) {
    return same_equilibrium(problem_.layout(), problem_.expand(a, 0), problem_.expand(b, 0));
  };
  return terrain;
}

std::string moves_most(const Frozen& frozen, const Vector& along) {
  const auto& moving = frozen.landscape().moving();
  Vector step = Vector::Zero(frozen.problem().size());
  step(moving) = along;
  const Vector z = frozen.unknowns(step) - frozen.unknowns(Vector::Zero(step.size()));
  const statics::System& system = frozen.problem().layout();
  const auto largest = [&](Index from, Index to) {
    Index found = -1;
    double size = 0.1;
    for (Index i = from; i < to; ++i)
      if (!system.is_wrench[static_cast<std::size_t>(i)] && std::abs(z[i]) > size * (1 + 1e-6))
        size = std::abs(z[i]), found = i;
    return found;
  };
  Index i = largest(system.first_pose, system.size);
  if (i < 0) i = largest(0, system.first_pose);
  if (i < 0) return "";
  return (z[i] < 0 ? "-" : "+") + system.coordinate_names[static_cast<std::size_t>(i)];
}

Vector unknowns_in(const std::vector<double>& values,
                   const std::vector<QuantityDefinition>& quantities, Index size) {
  Vector z = Vector::Zero(size);
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].kind == QuantityDefinition::Kind::unknown)
      z[quantities[i].entry] = values[i] / quantities[i].scale;
  return z;
}

std::size_t column_of(QuantityDefinition::Kind kind,
                      const std::vector<QuantityDefinition>& quantities) {
  return static_cast<std::size_t>(
      std::find_if(quantities.begin(), quantities.end(),
                   [kind](const QuantityDefinition& q) { return q.kind == kind; }) -
      quantities.begin());
}

}  // namespace springfold::analysis
