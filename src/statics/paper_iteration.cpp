// The paper's own scheme, kept to be compared with Newton's method: eq. (6) and Section 5.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "springfold/core/decompositions.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::statics {
namespace {

/// Coordinates of one chain split as the paper does, in the segments of the present state. A law that is
/// not straight is replaced by its tangent there.
struct Split {
  std::vector<Index> theta{}, q{};  ///< with and without stiffness, numbers within the chain
  Matrix compliance{};              ///< of theta, K_theta^-1
  Vector rest{};                    ///< theta_0: where the torque of the segment vanishes
  Vector constant_torque{};         ///< of q: segments of zero stiffness may carry a constant one
};

/// @returns nothing when coupled springs have a direction without stiffness, so that theta has no
///          compliance
std::optional<Split> split_of(const System& system, const ChainSlice& slice, const Piece& piece,
                              const Vector& z) {
  Matrix K = Matrix::Zero(slice.x_count, slice.x_count);
  Vector torque_at_zero = Vector::Zero(slice.x_count);
  for (const CoordinateSpring& spring : system.springs) {
    const Index i = spring.coordinate - slice.x;
    if (i < 0 || i >= slice.x_count) continue;
    const std::size_t segment = segment_of(spring, piece);
    const double c = z[spring.coordinate];
    K(i, i) = spring.law.stiffness(segment, c);
    torque_at_zero[i] = spring.law.is_straight(segment)
                            ? spring.law.torque(segment, 0.0)
                            : spring.law.torque(segment, c) - K(i, i) * c;
  }
  for (const CoordinateGroup& group : system.coupled) {
    if (group.coordinates.front() < slice.x || group.coordinates.front() >= slice.x + slice.x_count)
      continue;
    std::vector<Index> at = group.coordinates;
    for (Index& i : at) i -= slice.x;
    K(at, at) += group.stiffness;
    torque_at_zero(at) -= group.stiffness * group.free;
  }
  Split split;
  for (Index i = 0; i < slice.x_count; ++i) (K(i, i) != 0 ? split.theta : split.q).push_back(i);
  if (!split.theta.empty()) {
    const Matrix K_theta = K(split.theta, split.theta);
    const Vector size = K_theta.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    const FullPivotLu lu(size.asDiagonal() * K_theta * size.asDiagonal());
    if (!lu.is_invertible()) return std::nullopt;
    split.compliance = size.asDiagonal() * lu.inverse() * size.asDiagonal();
  } else {
    split.compliance.resize(0, 0);
  }
  split.rest = -split.compliance * torque_at_zero(split.theta);
  split.constant_torque = torque_at_zero(split.q);
  return split;
}

/// Total wrench that the chains take from the body, minus the external one: F_Sigma.
bool surplus_wrench(const System& system, const StartProblem& problem, const Vector& z,
                    const Inputs& inputs, Vector& surplus) {
  const BodySlice& body = system.body_slices[static_cast<std::size_t>(problem.body - 1)];
  Workspace work;
  Vector r;
  if (!equilibrium_residual(system, piece_at(system, z), z, inputs, work, r)) return false;
  surplus = r.segment(body.t, body.count);
  return true;
}

bool all_chains(const System& system, const Vector& rho, Vector& z, std::vector<int>& iterations) {
  iterations.clear();
  bool converged = true;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const ChainIteration one = iterate_chain(system, i, rho, z);
    iterations.push_back(one.iterations);
    converged = converged && one.converged;
  }
  return converged;
}

}  // namespace

ChainIteration iterate_chain(const System& system, std::size_t chain, const Vector& rho, Vector& z,
                             double tolerance, int maximum) {
  const ChainSlice& s = system.chain_slices[chain];
  const Inputs inputs{rho, Vector::Zero(system.load_size)};
  Workspace work;
  Vector residual;
  Matrix A;
  ChainIteration result;
  while (result.iterations < maximum) {
    ++result.iterations;
    const Piece piece = piece_at(system, z);
    if (!equilibrium_matrix(system, piece, z, inputs, work, residual, A)) return result;
    const std::optional<Split> parts = split_of(system, s, piece, z);
    if (!parts) return result;
    const Split& split = *parts;
    const Matrix J = -A.block(s.F, s.x, s.F_count, s.x_count);
    const Matrix J_theta = J(Eigen::all, split.theta), J_q = J(Eigen::all, split.q);
    const Vector x = z.segment(s.x, s.x_count), theta = x(split.theta), q = x(split.q);
    const Matrix& compliance = split.compliance;

    // | J_th K^-1 J_th^T   J_q | | F |   | eps          |
    // |                        | |   | = |              |,  theta = theta_0 + K^-1 J_th^T F
    // | J_q^T              0   | | q |   | torque of q  |
    const Index d = s.F_count, nq = q.size();
    Matrix M = Matrix::Zero(d + nq, d + nq);
    M.topLeftCorner(d, d) = J_theta * compliance * J_theta.transpose();
    M.topRightCorner(d, nq) = J_q;
    M.bottomLeftCorner(nq, d) = J_q.transpose();
    Vector right(d + nq);
    right.head(d) = residual.segment(s.F, d) + J_q * q + J_theta * (theta - split.rest);
    right.tail(nq) = split.constant_torque;
    const FullPivotLu lu(M);
    if (!lu.is_invertible()) return result;
    const Vector solution = lu.solve(right);
    if (!solution.allFinite()) return result;

    Vector next = x;
    next(split.theta) = split.rest + compliance * (J_theta.transpose() * solution.head(d));
    next(split.q) = solution.tail(nq);
    const double change =
        std::max((next - x).lpNorm<Eigen::Infinity>(),
                 (solution.head(d) - z.segment(s.F, d)).lpNorm<Eigen::Infinity>());
    z.segment(s.x, s.x_count) = next;
    z.segment(s.F, d) = solution.head(d);
    if (change <= tolerance * std::max(1.0, z.lpNorm<Eigen::Infinity>())) {
      result.converged = true;
      return result;
    }
  }
  return result;
}

FirstEquilibrium first_equilibrium_paper(const System& system, const StartProblem& problem) {
  assert(problem.unknowns != StartUnknowns::pose);
  FirstEquilibrium result{.z = problem.z, .inputs = problem.inputs, .attempts = 1};
  const BodySlice& body = system.body_slices[static_cast<std::size_t>(problem.body - 1)];
  const bool commands = problem.unknowns == StartUnknowns::commands;
  if (commands && problem.inputs.rho.size() != body.count) {
    result.status = StartStatus::wrong_count;
    return result;
  }
  Vector surplus, other;
  constexpr double difference = 0x1p-20;  // of a command, for the numerical S_Frho
  for (result.iterations = 1; result.iterations <= 50; ++result.iterations) {
    if (!all_chains(system, result.inputs.rho, result.z, result.chain_iterations)) return result;
    if (!surplus_wrench(system, problem, result.z, result.inputs, surplus)) return result;
    if (!commands || surplus.lpNorm<Eigen::Infinity>() <= 1e-12) break;
    Matrix S(body.count, body.count);
    for (Index k = 0; k < body.count; ++k) {
      Inputs moved = result.inputs;
      moved.rho[k] += difference;
      Vector z = result.z;
      std::vector<int> ignored;
      if (!all_chains(system, moved.rho, z, ignored)) return result;
      if (!surplus_wrench(system, problem, z, moved, other)) return result;
      S.col(k) = (other - surplus) / difference;
    }
    const FullPivotLu lu(S);
    if (!lu.is_invertible()) return result;
    result.inputs.rho -= lu.solve(surplus);
  }

  result.piece = piece_at(system, result.z);
  Workspace work;
  Vector r;
  if (!commands)
    result.inputs.W.segment(body.W, body.count) +=
        Lu(load_columns(system, result.z).block(body.t, body.W, body.count, body.count))
            .solve(-surplus);
  equilibrium_residual(system, result.piece, result.z, result.inputs, work, r);
  result.residual = r.lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < system.size; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)])
      result.moved = std::max(result.moved, std::abs(result.z[i] - problem.z[i]));
  if (result.residual <= 1e-10 * std::max(1.0, result.z.lpNorm<Eigen::Infinity>()))
    result.status = StartStatus::found;
  return result;
}

}  // namespace springfold::statics
