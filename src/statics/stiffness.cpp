#include "springfold/statics/stiffness.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"
#include "springfold/core/inertia.hpp"

namespace springfold::statics {
namespace {

/// The part of A_full that belongs to chain i's own unknowns (x_i, F_i).
auto chain_block(const System& system, std::size_t i, const Matrix& A_full) {
  const ChainSlice& s = system.chain_slices[i];
  const Index n = s.x_count + s.F_count;
  return A_full.block(s.x, s.x, n, n);
}

/// Unstable modes of a block of coordinates and wrenches; dependent closures count once.
/// @param J  closure rows, columns of the coordinates
std::optional<Index> block_index(const Matrix& A, const Matrix& J) {
  const auto inertia = inertia_of(A);
  if (!inertia) return std::nullopt;
  if (inertia->zero == 0) return inertia->negative - J.rows();
  Index rank = 0;
  if (J.cols() > 0) {
    rank = rank_of(J, 1e-10);
  }
  if (inertia->zero != J.rows() - rank) return std::nullopt;  // the block itself is critical
  return inertia->negative - rank;
}

/// Unstable modes of a chain with its ends held.
std::optional<Index> chain_index(const System& system, std::size_t i, const Matrix& A_full) {
  const ChainSlice& s = system.chain_slices[i];
  const Matrix A = chain_block(system, i, A_full);
  return block_index(A, A.bottomLeftCorner(s.F_count, s.x_count));
}

/// Which unknowns are wrenches and which are motions.
struct Kinds {
  std::vector<Index> motions{}, wrenches{};
};

/// @param end  unknowns before it only
Kinds kinds_of(const System& system, Index end) {
  Kinds kinds;
  for (Index i = 0; i < end; ++i)
    (system.is_wrench[static_cast<std::size_t>(i)] ? kinds.wrenches : kinds.motions).push_back(i);
  return kinds;
}

/// Unstable modes of all chains together, all bodies held: where they are coupled.
std::optional<Index> chains_index(const System& system, const Matrix& A_full) {
  const Index n = system.first_pose;
  const Matrix A = A_full.topLeftCorner(n, n);
  const Kinds kinds = kinds_of(system, n);
  return block_index(A, A(kinds.wrenches, kinds.motions));
}

Vector real_eigenvalues(const Matrix& M, bool symmetric) {
  if (symmetric) return body_eigenvalues(M);
  Vector real = eigenvalues(M).real();
  std::sort(real.begin(), real.end());
  return real;
}

std::optional<Matrix> solve(const Matrix& A, const Matrix& B, bool symmetric) {
  if (symmetric) return solve_symmetric(A, B);
  if (!A.allFinite()) return std::nullopt;
  const Equilibration scale = equilibrate(A);
  const FullPivotLu lu(scale.rows.asDiagonal() * A * scale.columns.asDiagonal());
  if (!lu.is_invertible()) return std::nullopt;
  return Matrix(scale.columns.asDiagonal() * lu.solve(scale.rows.asDiagonal() * B));
}

/// Stiffness of some unknowns, all others in equilibrium: A_bb - A_bo A_oo^-1 A_ob. Nothing where the
/// others are singular with these held: rigid, or critical.
std::optional<Matrix> eliminated(const Matrix& A, const std::vector<Index>& own, bool symmetric) {
  std::vector<Index> other;
  for (Index i = 0; i < A.rows(); ++i)
    if (std::find(own.begin(), own.end(), i) == own.end()) other.push_back(i);
  const auto X = solve(A(other, other), A(other, own), symmetric);
  if (!X) return std::nullopt;
  const Matrix K = A(own, own) - A(own, other) * *X;
  return symmetric ? Matrix(0.5 * (K + K.transpose())) : K;
}

std::vector<Index> range_of(Index first, Index count) {
  std::vector<Index> range(static_cast<std::size_t>(count));
  std::iota(range.begin(), range.end(), first);
  return range;
}

/// Pose block of A^-1: the compliance of all bodies.
std::optional<Matrix> compliance(const System& system, const Matrix& A_full, bool symmetric) {
  const Index nt = system.load_size, t = system.first_pose;
  Matrix unit = Matrix::Zero(system.size, nt);
  unit.middleRows(t, nt).setIdentity();
  const auto X = solve(A_full, unit, symmetric);
  if (!X) return std::nullopt;
  return Matrix(X->middleRows(t, nt));
}

/// K_Sigma - dW/dt: as a sum over the chains where they couple through bodies only. Nothing where one of
/// them is rigid or buckles.
std::optional<Matrix> stiffness_of_bodies(const System& system, const Matrix& A_full,
                                          bool symmetric) {
  const Index nt = system.load_size, t = system.first_pose;
  if (!system.is_sum_over_chains()) return eliminated(A_full, range_of(t, nt), symmetric);
  Matrix K = A_full.block(t, t, nt, nt);
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const ChainSlice& s = system.chain_slices[i];
    const Index n = s.x_count + s.F_count;
    const auto X = solve(chain_block(system, i, A_full), A_full.block(s.x, t, n, nt), symmetric);
    if (!X) return std::nullopt;
    K -= A_full.block(t, s.x, nt, n) * *X;
  }
  return symmetric ? Matrix(0.5 * (K + K.transpose())) : K;
}

}  // namespace

Matrix without_gauge(const Matrix& A_full, const Workspace& work) {
  if (work.gauge.size() == 0) return A_full;
  return A_full + work.gauge.transpose() * work.gauge;
}

std::optional<Matrix> chain_stiffness(const System& system, std::size_t chain, const Matrix& A_full,
                                      const Workspace& work) {
  const ChainSlice& s = system.chain_slices[chain];
  const Index n = s.x_count + s.F_count, t = s.to >= 0 ? s.to : s.from;
  const model::CompiledChain& compiled = system.chains[chain];
  const Index count = s.to >= 0 ? compiled.to_count() : compiled.first_joint();
  const Matrix A = without_gauge(A_full, work);
  const Matrix B = A.block(s.x, t, n, count);
  const auto X = solve_symmetric(chain_block(system, chain, A), B);
  if (!X) return std::nullopt;
  const Index first = s.to >= 0 ? compiled.first_to() : 0;
  const Matrix D = -work.closures[chain].H.block(first, first, count, count);
  return Matrix(D - B.transpose() * *X);
}

PlatformStiffness platform_stiffness(const System& system, const Matrix& A_full, bool symmetric) {
  PlatformStiffness result;
  if (const auto K = stiffness_of_bodies(system, A_full, symmetric)) {
    result.K = *K;
    result.eigenvalues = real_eigenvalues(result.K, symmetric);
    return result;
  }
  // Rigid chains: the compliance, the pose block of the inverse, exists where the sum does.
  const auto C = compliance(system, A_full, symmetric);
  if (!C) return result;
  const Vector c = real_eigenvalues(*C, symmetric);
  const double largest = c.cwiseAbs().maxCoeff();
  result.eigenvalues.resize(c.size());
  for (Index i = 0; i < c.size(); ++i)
    result.eigenvalues[i] =
        std::abs(c[i]) > 1e-12 * largest ? 1 / c[i] : std::numeric_limits<double>::infinity();
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end());
  return result;
}

Matrix body_stiffness(const System& system, const Matrix& A_full, const PlatformStiffness& platform,
                      Index body, bool symmetric) {
  const BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
  const bool alone = b.count == system.load_size;
  if (alone) return platform.K;
  const auto K = eliminated(A_full, range_of(system.first_pose + b.W, b.count), symmetric);
  return K ? *K : Matrix();
}

std::optional<Matrix> body_compliance(const System& system, const Matrix& A_full, Index body,
                                      bool symmetric) {
  const BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
  const auto C = compliance(system, A_full, symmetric);
  if (!C) return std::nullopt;
  return Matrix(C->block(b.W, b.W, b.count, b.count));
}

Matrix tangent_stiffness(const System& system, const Matrix& A_full, const Workspace& work) {
  const Kinds kinds = kinds_of(system, system.size);
  const Matrix J = without_gauge(A_full, work)(kinds.wrenches, kinds.motions);
  const Matrix Z = kernel_of(J, 1e-10);
  return Z.transpose() * without_gauge(A_full, work)(kinds.motions, kinds.motions) * Z;
}

Index zero_modes(const System& system, const Matrix& A_full) {
  const Matrix null = null_directions(A_full)(kinds_of(system, system.size).motions, Eigen::all);
  if (null.cols() == 0) return 0;
  return (jacobi_svd(null).values.array() > 1e-6).count();
}

std::vector<std::pair<double, double>> eigenvalues_of(const Matrix& T) {
  std::vector<std::pair<double, double>> values;
  if (T.rows() == 0 || !T.allFinite()) return values;
  for (const auto& value : eigenvalues(T)) values.emplace_back(value.real(), value.imag());
  std::sort(values.begin(), values.end());
  return values;
}

double tangent_determinant(const System& system, const Matrix& A_full) {
  const double sign = system.closure_count() % 2 == 0 ? 1 : -1;
  return sign * Lu(A_full).determinant();
}

Matrix in_world_axes(const System& system, const Vector& z, const Matrix& K, Index body) {
  if (K.size() == 0) return K;
  const Index first =
      body > 0 ? system.body_slices[static_cast<std::size_t>(body - 1)].W : Index{0};
  Matrix twist_to_pose = Matrix::Identity(K.rows(), K.rows());
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    if (body > 0 && body != static_cast<Index>(b) + 1) continue;
    const BodySlice& slice = system.body_slices[b];
    const model::Vec3<double> phi = z.segment(slice.t + 3, 3);
    twist_to_pose.block(slice.W - first + 3, slice.W - first + 3, 3, 3) =
        model::left_jacobian(phi).inverse();
  }
  return twist_to_pose.transpose() * K * twist_to_pose;
}

Matrix compliance_in_world_axes(const System& system, const Vector& z, const Matrix& C,
                                Index body) {
  const auto b = static_cast<std::size_t>(body - 1);
  if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) return C;
  Matrix pose_to_twist = Matrix::Identity(6, 6);
  pose_to_twist.bottomRightCorner(3, 3) =
      model::left_jacobian(model::Vec3<double>(z.segment(system.body_slices[b].t + 3, 3)));
  return pose_to_twist * C * pose_to_twist.transpose();
}

std::optional<Matrix> chain_stiffness_paper(const System& system, std::size_t chain,
                                            const Piece& piece, const Vector& z,
                                            const Inputs& inputs) {
  Workspace work;
  Vector residual;
  Matrix A;
  if (!equilibrium_matrix(system, piece, z, inputs, work, residual, A)) return std::nullopt;
  const ChainSlice& s = system.chain_slices[chain];
  const Matrix J = -A.block(s.F, s.x, s.F_count, s.x_count);

  // Split the coordinates into theta (active spring) and q (no stiffness here).
  Matrix stiffness = Matrix::Zero(system.first_pose, system.first_pose);
  for (const CoordinateSpring& spring : system.springs)
    stiffness(spring.coordinate, spring.coordinate) +=
        spring.law.stiffness(segment_of(spring, piece), z[spring.coordinate]);
  for (const CoordinateGroup& group : system.coupled)
    stiffness(group.coordinates, group.coordinates) += group.stiffness;
  const Matrix K = stiffness.block(s.x, s.x, s.x_count, s.x_count);
  std::vector<Index> theta, q;
  for (Index i = 0; i < s.x_count; ++i) (K(i, i) != 0 ? theta : q).push_back(i);

  const Matrix H = K - A.block(s.x, s.x, s.x_count, s.x_count);
  std::optional<FullPivotLu> k_inverse;
  if (!theta.empty() && !k_inverse.emplace((K - H)(theta, theta)).is_invertible())
    return std::nullopt;
  const auto nq = static_cast<Index>(q.size());
  const Matrix J_theta = J(Eigen::all, theta), J_q = J(Eigen::all, q), H_theta_q = H(theta, q);
  Matrix M(s.F_count + nq, s.F_count + nq);
  const auto times_k = [&](const Matrix& right) -> Matrix {
    return theta.empty() ? Matrix(0, right.cols()) : k_inverse->solve(right);
  };
  const Matrix corner = J_q + J_theta * times_k(H_theta_q);
  M << J_theta * times_k(J_theta.transpose()), corner, corner.transpose(),
      H(q, q) + H_theta_q.transpose() * times_k(H_theta_q);
  const FullPivotLu lu(M);
  if (!lu.is_invertible()) return std::nullopt;
  return Matrix(lu.inverse().topLeftCorner(s.F_count, s.F_count));
}

namespace {

/// The chains condensed one by one; nothing where one of them is singular.
std::optional<Condensed> condensed_chains(const System& system, const Matrix& A_full) {
  const Index nt = system.load_size, t = system.first_pose;
  Matrix K = A_full.block(t, t, nt, nt);
  double largest = K.size() > 0 ? K.cwiseAbs().maxCoeff() : 0;
  Index unstable = 0;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const ChainSlice& s = system.chain_slices[i];
    const Index n = s.x_count + s.F_count;
    const auto B = A_full.block(s.x, t, n, nt);
    const auto solution = solve_and_count(chain_block(system, i, A_full), B);
    if (!solution) return std::nullopt;
    K.noalias() -= B.transpose().lazyProduct(solution->X);
    if (K.size() > 0) largest = std::max(largest, K.cwiseAbs().maxCoeff());
    unstable += solution->inertia.negative - s.F_count;
  }
  Condensed result{{0.5 * (K + K.transpose()), {}}, {unstable, {}}};
  result.platform.eigenvalues = real_eigenvalues(result.platform.K, true);
  constexpr double rounding = 1e-13;
  Index negative = 0;
  for (const double value : result.platform.eigenvalues) {
    if (!(std::abs(value) >
          rounding * largest)) {  // critical, or badly scaled: the whole matrix knows
      result.stability.force_controlled = unstable_modes(A_full, system.closure_count());
      return result;
    }
    negative += value < 0 ? 1 : 0;
  }
  result.stability.force_controlled = unstable + negative;
  return result;
}

}  // namespace

Condensed condense(const System& system, const Matrix& A_full, const Workspace& work) {
  if (system.is_sum_over_chains() && A_full.allFinite())
    if (auto result = condensed_chains(system, A_full)) return std::move(*result);
  return {platform_stiffness(system, A_full), stability(system, A_full, work)};
}

std::optional<Index> unstable_modes(const Matrix& A, Index closures) {
  const auto inertia = inertia_of(A);
  if (!inertia || inertia->zero > 0) return std::nullopt;
  return inertia->negative - closures;
}

Stability stability(const System& system, const Matrix& A_full, const Workspace& work) {
  Stability result;
  result.force_controlled = unstable_modes(A_full, system.closure_count());
  const Matrix plain = without_gauge(A_full, work);
  if (system.chains_coupled || system.inner_count() > 0) {
    result.pose_controlled = chains_index(system, plain);
    return result;
  }
  Index sum = 0;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const auto index = chain_index(system, i, plain);
    if (!index) return result;
    sum += *index;
  }
  result.pose_controlled = sum;
  return result;
}

}  // namespace springfold::statics
