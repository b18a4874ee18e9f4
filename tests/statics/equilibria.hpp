// Random mechanisms, random equilibria, and a plain Newton iteration to solve them anew. Fixed
// seeds only.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <cassert>
#include <vector>

#include "lagrangian.hpp"
#include "model/random_chain.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

using model::random_pose;
using model::random_unit;
using model::random_vector;
using model::TaskSpace;

/// A mechanism's system in a given state.
struct State {
  System system{};
  Vector z{};
  Inputs inputs{};
  Piece piece() const { return piece_at(system, z); }
};

/// Everything that equilibrium_matrix gives.
struct Evaluated {
  Vector residual{};
  Matrix A{}, dR_drho{};
  Workspace work{};
};

inline Evaluated evaluate(const State& state, const Piece& piece) {
  Evaluated at;
  const bool finite = equilibrium_matrix(state.system, piece, state.z, state.inputs, at.work,
                                         at.residual, at.A, &at.dR_drho);
  if (!finite) at.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
  return at;
}

inline Evaluated evaluate(const State& state) { return evaluate(state, state.piece()); }

inline Vector residual_at(const State& state, const Piece& piece) {
  Workspace work;
  Vector r;
  equilibrium_residual(state.system, piece, state.z, state.inputs, work, r);
  return r;
}

/// Newton's method for the unknowns `free` of z; the rows of the others are left alone. Linear
/// springs only: the piece does not change.
/// @returns false when it does not converge
inline bool solve(State& state, const std::vector<Index>& free) {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Evaluated at = evaluate(state);
    const Vector step = at.A(free, free).partialPivLu().solve(Vector(at.residual(free)));
    if (!step.allFinite()) return false;
    state.z(free) -= step;
    const double length = step.norm() / (1 + state.z.norm());
    if (length < 1e-15 || (length < 1e-9 && length >= last)) return true;  // rounding only
    last = length;
  }
  return false;
}

inline std::vector<Index> indices(Index from, Index to) {
  std::vector<Index> list;
  for (Index i = from; i < to; ++i) list.push_back(i);
  return list;
}

inline bool solve(State& state) { return solve(state, indices(0, state.system.size)); }

/// Shape of a random chain: so many passive joints, so many with a spring.
struct ChainShape {
  int passive = 1, springs = 2;
};

/// Every third joint slides, so that no random chain is degenerate for its task space.
inline model::Chain random_elastic_chain(std::mt19937& random, TaskSpace space, ChainShape shape) {
  const bool in_plane = space == TaskSpace::xy || space == TaskSpace::planar;
  model::Chain chain;
  for (int j = 0; j < shape.passive + shape.springs; ++j) {
    const bool passive = j % 2 == 0 ? j / 2 < shape.passive : j / 2 >= shape.springs;
    const bool actuated = !passive && j % 3 == 0, turns = j % 3 != 2;
    model::Joint joint{
        .name = "joint" + std::to_string(j),
        .kind = turns ? model::JointKind::revolute : model::JointKind::prismatic,
        .axis = random_unit(random),
        .role = passive    ? model::JointRole::passive
                : actuated ? model::JointRole::actuated
                           : model::JointRole::compliant,
        .initial = random_vector(random, 1, 1.0)[0],
    };
    if (in_plane && turns) joint.axis = model::Vec3<double>::UnitZ();
    if (in_plane && !turns) joint.axis = random_pose(random, true).R.col(0);
    if (actuated) joint.command = random_vector(random, 1, 1.0)[0];
    if (!passive) joint.spring = model::LinearSpring{1 + random_vector(random, 1, 0.8)[0], 0};
    chain.elements.push_back(model::RigidLink{random_pose(random, in_plane)});
    chain.elements.push_back(joint);
  }
  chain.to_attachment = random_pose(random, in_plane);
  return chain;
}

inline model::Pose<double> real_part(const Frame& T) {
  return {T.topLeftCorner<3, 3>().real(), T.topRightCorner<3, 1>().real()};
}

inline model::Pose<double> inverse(const model::Pose<double>& T) {
  return {T.R.transpose(), -(T.R.transpose() * T.p)};
}

/// End of a chain from its own start, at its initial coordinates and commands.
inline model::Pose<double> shape_of(const model::Chain& chain) {
  Frame end = Frame::Identity();
  for (const model::Element& element : chain.elements) {
    const auto* link = std::get_if<model::RigidLink>(&element);
    if (link != nullptr) {
      end = (end * frame_of(link->transform)).eval();
      continue;
    }
    const auto& joint = std::get<model::Joint>(element);
    const double command = joint.role == model::JointRole::actuated ? joint.command : 0;
    end = (end * frame_of_joint(joint, joint.initial + command)).eval();
  }
  return real_part(end);
}

/// Sets the springs' free coordinates so that the chains carry random wrenches of size `load` (as
/// far as their passive joints allow) and the external wrench so that all is balanced.
inline State balanced(std::mt19937& random, model::Mechanism m, double load) {
  State state{.system = prepare(m)};
  state.z = guess(state.system);
  state.inputs = {state.system.commands, Vector::Zero(state.system.load_size)};
  const Evaluated at = evaluate(state);
  for (std::size_t i = 0; i < m.chains.size(); ++i) {
    const ChainSlice& s = state.system.chain_slices[i];
    const Matrix J = -at.A.block(s.F, s.x, s.F_count, s.x_count);
    std::vector<model::Joint*> joints;
    std::vector<Index> passive;
    for (model::Element& element : m.chains[i].elements)
      if (auto* joint = std::get_if<model::Joint>(&element); joint && has_coordinate(*joint)) {
        if (!joint->spring) passive.push_back(static_cast<Index>(joints.size()));
        joints.push_back(joint);
      }
    Vector F = random_vector(random, s.F_count, load);
    const Matrix J_q = J(Eigen::all, passive);
    if (!passive.empty()) F -= J_q * J_q.completeOrthogonalDecomposition().solve(F);
    const Vector torque = J.transpose() * F;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (!joints[k]->spring) continue;
      auto& spring = std::get<model::LinearSpring>(*joints[k]->spring);
      spring.free = joints[k]->initial - torque[static_cast<Index>(k)] / spring.stiffness;
    }
    state.z.segment(s.F, s.F_count) = F;
  }
  state.system = prepare(m);
  const Index t = state.system.first_pose, n = state.system.load_size;
  const Vector surplus = residual_at(state, state.piece()).segment(t, n);
  state.inputs.W =
      load_columns(state.system, state.z).middleRows(t, n).partialPivLu().solve(-surplus);
  return state;
}

/// A body held by random chains, in equilibrium under a random load. The base ends of the chains
/// are put where the chains begin.
inline State random_equilibrium(std::mt19937& random, TaskSpace space, int chains, ChainShape shape,
                                double load) {
  model::Mechanism m;
  m.bodies = {{"tool", space, random_vector(random, dimension(space), 0.8)}};
  const model::Pose<double> body =
      real_part(frame_of_body(space, m.bodies[0].pose.cast<Complex>()));
  for (int i = 0; i < chains; ++i) {
    model::Chain chain = random_elastic_chain(random, space, shape);
    chain.name = "chain" + std::to_string(i);
    chain.from_attachment = body * chain.to_attachment * inverse(shape_of(chain));
    m.chains.push_back(chain);
  }
  assert(problems_in(m).empty());
  return balanced(random, m, load);
}

inline void drop_wrenches(const System& system, Vector& v) {
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) v[i] = 0;
}

}  // namespace springfold::statics
