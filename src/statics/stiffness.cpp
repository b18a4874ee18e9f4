#include "springfold/statics/stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "springfold/core/inertia.hpp"

namespace springfold::statics {
namespace {

/// The part of A_full that belongs to chain i's own unknowns (x_i, F_i).
Matrix chain_block(const System& system, std::size_t i, const Matrix& A_full) {
  const ChainSlice& s = system.chain_slices[i];
  const Index n = s.x_count + s.F_count;
  return A_full.block(s.x, s.x, n, n);
}

/// Unstable modes of a chain with its ends held; dependent closure rows do not count as closures.
std::optional<Index> chain_index(const System& system, std::size_t i, const Matrix& A_full) {
  const ChainSlice& s = system.chain_slices[i];
  const Matrix A = chain_block(system, i, A_full);
  const auto inertia = inertia_of(A);
  if (!inertia) return std::nullopt;
  if (inertia->zero == 0) return inertia->negative - s.F_count;
  Index rank = 0;
  if (s.x_count > 0) {
    Eigen::ColPivHouseholderQR<Matrix> qr(A.bottomLeftCorner(s.F_count, s.x_count));
    qr.setThreshold(1e-10);
    rank = qr.rank();
  }
  if (inertia->zero != s.F_count - rank) return std::nullopt;  // the chain itself is critical
  return inertia->negative - rank;
}

}  // namespace

std::optional<Matrix> chain_stiffness(const System& system, std::size_t chain, const Matrix& A_full,
                                      const Workspace& work) {
  const ChainSlice& s = system.chain_slices[chain];
  const Index n = s.x_count + s.F_count, t = s.to >= 0 ? s.to : s.from;
  const Matrix B = A_full.block(s.x, t, n, s.F_count);
  const auto X = solve_symmetric(chain_block(system, chain, A_full), B);
  if (!X) return std::nullopt;
  const Index first = s.to >= 0 ? system.chains[chain].first_to() : 0;
  const Matrix D = -work.closures[chain].H.block(first, first, s.F_count, s.F_count);
  return Matrix(D - B.transpose() * *X);
}

PlatformStiffness platform_stiffness(const System& system, const Matrix& A_full) {
  PlatformStiffness result;
  const Index nt = system.load_size, t = system.first_pose;
  Matrix K = A_full.block(t, t, nt, nt);
  bool defined = true;
  for (std::size_t i = 0; i < system.chains.size() && defined; ++i) {
    const ChainSlice& s = system.chain_slices[i];
    const Index n = s.x_count + s.F_count;
    const Matrix B = A_full.block(s.x, t, n, nt);
    const auto X = solve_symmetric(chain_block(system, i, A_full), B);
    defined = X.has_value();
    if (defined) K -= B.transpose() * *X;
  }
  if (defined) {
    result.K = 0.5 * (K + K.transpose());
    result.eigenvalues =
        Eigen::SelfAdjointEigenSolver<Matrix>(result.K, Eigen::EigenvaluesOnly).eigenvalues();
    return result;
  }
  // Rigid chains: the compliance, the pose block of the inverse, exists where the sum does.
  Matrix unit = Matrix::Zero(system.size, nt);
  unit.middleRows(t, nt).setIdentity();
  const auto X = solve_symmetric(A_full, unit);
  if (!X) return result;
  const Matrix C = X->middleRows(t, nt);
  const Vector c =
      Eigen::SelfAdjointEigenSolver<Matrix>(0.5 * (C + C.transpose()), Eigen::EigenvaluesOnly)
          .eigenvalues();
  const double largest = c.cwiseAbs().maxCoeff();
  result.eigenvalues.resize(nt);
  for (Index i = 0; i < nt; ++i)
    result.eigenvalues[i] =
        std::abs(c[i]) > 1e-12 * largest ? 1 / c[i] : std::numeric_limits<double>::infinity();
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end());
  return result;
}

Matrix in_world_axes(const System& system, const Vector& z, const Matrix& K) {
  if (K.size() == 0) return K;
  Matrix twist_to_pose = Matrix::Identity(system.load_size, system.load_size);
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    const BodySlice& body = system.body_slices[b];
    const model::Vec3<double> phi = z.segment(body.t + 3, 3);
    twist_to_pose.block(body.W + 3, body.W + 3, 3, 3) = model::left_jacobian(phi).inverse();
  }
  return twist_to_pose.transpose() * K * twist_to_pose;
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

  // Split the coordinates into theta (active spring) and q (no stiffness in this segment).
  Matrix stiffness = Matrix::Zero(system.first_pose, system.first_pose);
  for (const CoordinateSpring& spring : system.springs)
    stiffness(spring.coordinate, spring.coordinate) +=
        spring.law.segments[segment_of(spring, piece)].stiffness;
  for (const CoordinateGroup& group : system.coupled)
    stiffness(group.coordinates, group.coordinates) += group.stiffness;
  const Matrix K = stiffness.block(s.x, s.x, s.x_count, s.x_count);
  std::vector<Index> theta, q;
  for (Index i = 0; i < s.x_count; ++i) (K(i, i) > 0 ? theta : q).push_back(i);

  const Matrix H = K - A.block(s.x, s.x, s.x_count, s.x_count);
  Eigen::FullPivLU<Matrix> k_inverse;
  if (!theta.empty() && !k_inverse.compute((K - H)(theta, theta)).isInvertible())
    return std::nullopt;
  const auto nq = static_cast<Index>(q.size());
  const Matrix J_theta = J(Eigen::all, theta), J_q = J(Eigen::all, q), H_theta_q = H(theta, q);
  Matrix M(s.F_count + nq, s.F_count + nq);
  const auto times_k = [&](const Matrix& right) -> Matrix {
    return theta.empty() ? Matrix(0, right.cols()) : Matrix(k_inverse.solve(right));
  };
  const Matrix corner = J_q + J_theta * times_k(H_theta_q);
  M << J_theta * times_k(J_theta.transpose()), corner, corner.transpose(),
      H(q, q) + H_theta_q.transpose() * times_k(H_theta_q);
  const Eigen::FullPivLU<Matrix> lu(M);
  if (!lu.isInvertible()) return std::nullopt;
  return Matrix(lu.inverse().topLeftCorner(s.F_count, s.F_count));
}

std::optional<Index> unstable_modes(const Matrix& A, Index closures) {
  const auto inertia = inertia_of(A);
  if (!inertia || inertia->zero > 0) return std::nullopt;
  return inertia->negative - closures;
}

Stability stability(const System& system, const Matrix& A_full) {
  Stability result;
  result.force_controlled = unstable_modes(A_full, system.closure_count());
  Index sum = 0;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const auto index = chain_index(system, i, A_full);
    if (!index) return result;
    sum += *index;
  }
  result.pose_controlled = sum;
  return result;
}

}  // namespace springfold::statics
