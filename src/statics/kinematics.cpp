#include "springfold/statics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "springfold/core/decompositions.hpp"

namespace springfold::statics {
namespace {

/// Visits the joints that have a coordinate, with its place in z.
template <class Visit>
void for_each_coordinate(const System& system, const Visit& visit) {
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    std::size_t j = 0;
    for (const model::Element& element : system.mechanism.chains[i].elements) {
      const auto* joint = std::get_if<model::Joint>(&element);
      if (joint == nullptr) continue;
      const Index place = system.chain_slices[i].joint_coordinate[j++];
      if (place >= 0) visit(*joint, place);
    }
  }
}

bool moves_freely(const model::Joint& joint) {
  return joint.role == model::JointRole::passive || joint.role == model::JointRole::preloaded;
}

const BodySlice& body_of(const System& system, const CommandTask& task) {
  return system.body_slices[static_cast<std::size_t>(task.body - 1)];
}

/// Entries of z that move while all elastic coordinates rest; `held` ones are left out.
std::vector<Index> moving_entries(const System& system, const std::vector<Index>& held) {
  std::vector<Index> moving;
  for_each_coordinate(system, [&](const model::Joint& joint, Index place) {
    if (moves_freely(joint)) moving.push_back(place);
  });
  for (Index i = system.first_pose; i < system.size; ++i)
    if (std::find(held.begin(), held.end(), i) == held.end()) moving.push_back(i);
  return moving;
}

std::vector<Index> closure_rows(const System& system) {
  std::vector<Index> rows;
  for (const ChainSlice& slice : system.chain_slices)
    for (Index k = 0; k < slice.F_count; ++k) rows.push_back(slice.F + k);
  return rows;
}

/// Closures e and their derivatives by entries of z and of rho.
class Closures {
 public:
  explicit Closures(const System& system) : system_{system}, rows_{closure_rows(system)} {}

  bool evaluate(const Vector& z, const Vector& rho) {
    inputs_.rho = rho;
    inputs_.W.setZero(system_.load_size);
    return equilibrium_matrix(system_, piece_at(system_, z), z, inputs_, work_, r_, A_, &dR_drho_);
  }
  Vector e() const {
    Vector e(count());
    put(r_, 0, e, 0);
    return e;
  }
  /// Derivatives by entries of z, then by commands.
  Matrix by(const std::vector<Index>& entries, const std::vector<Index>& commands) const {
    Matrix J(count(), static_cast<Index>(entries.size() + commands.size()));
    Index column = 0;
    for (const Index i : entries) put(A_, i, J, column++);
    for (const Index i : commands) put(dR_drho_, i, J, column++);
    return J;
  }

 private:
  Index count() const { return static_cast<Index>(rows_.size()); }
  /// Entry by entry: Eigen copies lists of indices for every block that they name.
  template <class From, class To>
  void put(const From& from, Index column, To& to, Index place) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      to(static_cast<Index>(i), place) = -from(rows_[i], column);
  }

  const System& system_;
  std::vector<Index> rows_;
  Inputs inputs_;
  Workspace work_;
  Vector r_;
  Matrix A_, dR_drho_;
};

std::vector<Index> all_of(Index count) {
  std::vector<Index> list(static_cast<std::size_t>(count));
  std::iota(list.begin(), list.end(), Index{0});
  return list;
}

void report_gap(const System& system, const Vector& e, KinematicInverse& result) {
  result.gap = 0;
  Index first = 0;
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    const Index count = system.chain_slices[i].F_count;
    const double gap = e.segment(first, count).norm();
    if (gap > result.gap) {
      result.gap = gap;
      result.chain = i;
    }
    first += count;
  }
}

constexpr double longest_step = 0.3;  // longer ones may pass into another assembly
constexpr double closed_enough = 1e-13;

/// Damped least squares on the closures. True when they vanish.
bool close(Closures& closures, const std::vector<Index>& moving, const std::vector<Index>& commands,
           KinematicInverse& state) {
  const auto nz = static_cast<Index>(moving.size()), nr = static_cast<Index>(commands.size());
  if (!closures.evaluate(state.z, state.rho)) return false;
  Vector e = closures.e();
  double damping = 0;
  for (state.iterations = 0; state.iterations < 100; ++state.iterations) {
    const double size = e.norm();
    const Matrix J = closures.by(moving, commands);
    const Vector gradient = J.transpose() * e;
    if (size == 0) break;
    if (size > closed_enough && gradient.norm() <= 1e-9 * size) break;  // nearest approach
    Vector step;
    if (damping == 0) {
      step = -least_squares(J, e);
    } else {
      Matrix N = J.transpose() * J;
      N.diagonal().array() += damping;
      step = -solve_definite(N, gradient);
    }
    const double length = step.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(length) || length > longest_step) {
      if (std::isfinite(length)) step *= longest_step / length;
    }
    const Vector z = state.z, rho = state.rho;
    state.z(moving) += step.head(nz);
    state.rho(commands) += step.tail(nr);
    const bool finite = step.allFinite() && closures.evaluate(state.z, state.rho);
    const Vector next = finite ? closures.e() : e;
    if (finite && next.norm() < size) {
      e = next;
      damping = damping < 1e-8 ? 0 : damping / 8;
      continue;
    }
    state.z = z;
    state.rho = rho;
    closures.evaluate(z, rho);
    if (size <= closed_enough || damping > 1e6) break;  // rounding, or nothing helps
    damping = damping == 0 ? 1e-6 : 8 * damping;
  }
  return e.lpNorm<Eigen::Infinity>() <=
         closed_enough * std::max(1.0, state.z.cwiseAbs().maxCoeff());
}

}  // namespace

CommandTask completed(const CommandTask& task, const System& system) {
  CommandTask full = task;
  if (full.prescribed.empty()) full.prescribed = all_of(body_of(system, task).count);
  if (full.commands.empty()) full.commands = all_of(system.commands.size());
  return full;
}

bool counts_match(const CommandTask& task, const System& system) {
  const CommandTask full = completed(task, system);
  return full.prescribed.size() == full.commands.size() && !full.commands.empty();
}

Vector at_rest(const System& system, Vector z) {
  for_each_coordinate(system, [&](const model::Joint& joint, Index place) {
    if (!moves_freely(joint) && joint.spring)
      z[place] = relaxed_coordinate(model::compile(*joint.spring), joint.initial);
  });
  std::vector<bool> free(static_cast<std::size_t>(system.size), false);
  for_each_coordinate(system, [&](const model::Joint& joint, Index place) {
    free[static_cast<std::size_t>(place)] = moves_freely(joint);
  });
  for (const CoordinateGroup& group : system.coupled)  // those of preloaded joints move freely
    if (!free[static_cast<std::size_t>(group.coordinates.front())])
      z(group.coordinates) = group.free;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) z[i] = 0;
  return z;
}

KinematicInverse kinematic_inverse(const System& system, const CommandTask& task,
                                   const Vector& target, const Vector& z, const Vector& rho) {
  const CommandTask full = completed(task, system);
  KinematicInverse result;
  result.z = at_rest(system, z);
  result.rho = rho;
  std::vector<Index> held;
  for (std::size_t k = 0; k < full.prescribed.size(); ++k) {
    held.push_back(body_of(system, full).t + full.prescribed[k]);
    result.z[held.back()] = target[static_cast<Index>(k)];
  }
  const std::vector<Index> moving = moving_entries(system, held);
  Closures closures(system);
  result.closed = close(closures, moving, full.commands, result);
  closures.evaluate(result.z, result.rho);
  report_gap(system, closures.e(), result);
  const Matrix J = closures.by(moving, full.commands);
  if (!result.closed) {
    std::vector<Index> elastic;
    for_each_coordinate(system, [&](const model::Joint& joint, Index place) {
      if (!moves_freely(joint)) elastic.push_back(place);
    });
    const Vector e = closures.e();
    result.elastic = (closures.by(elastic, {}).transpose() * e).norm() > 1e-6 * e.norm();
  }
  result.unique = rank_of(J) == J.cols();
  return result;
}

NearestApproach nearest_approach(const System& system, const std::vector<Index>& moving,
                                 const std::vector<Index>& commands, const Vector& z,
                                 const Vector& rho) {
  constexpr double visible = 1e-9;
  KinematicInverse state;
  state.z = z;
  state.rho = rho;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) state.z[i] = 0;
  Closures closures(system);
  NearestApproach result;
  result.closed = close(closures, moving, commands, state);
  closures.evaluate(state.z, state.rho);
  const Vector e = closures.e();
  Index first = 0;
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    const Index count = system.chain_slices[i].F_count;
    const Index lengths = translations(system.chains[i].space);
    const ChainGap gap{i, e.segment(first, lengths).norm(),
                       e.segment(first + lengths, count - lengths).norm()};
    if (std::max(gap.length, gap.angle) > visible) result.gaps.push_back(gap);
    first += count;
  }
  std::stable_sort(result.gaps.begin(), result.gaps.end(),
                   [](const ChainGap& a, const ChainGap& b) {
                     return std::max(a.length, a.angle) > std::max(b.length, b.angle);
                   });
  result.z = std::move(state.z);
  result.rho = std::move(state.rho);
  return result;
}

Transmission transmission(const System& system, const CommandTask& task, const Vector& z,
                          const Vector& rho) {
  const CommandTask full = completed(task, system);
  const BodySlice& body = body_of(system, full);
  Transmission result;
  Closures closures(system);
  if (!closures.evaluate(z, rho)) return result;
  // Twists of a spatial body: omega = J_l d(rotation vector)/dt.
  Matrix to_twist = Matrix::Identity(body.count, body.count);
  const auto b = static_cast<std::size_t>(full.body - 1);
  if (system.mechanism.bodies[b].task_space == model::TaskSpace::spatial) {
    const model::Vec3<double> phi = z.segment(body.t + 3, 3);
    to_twist.bottomRightCorner(3, 3) = model::left_jacobian(phi);
  }
  const auto solve = [](const Matrix& M, const Matrix& right) -> Matrix {
    const auto X = unique_least_squares(M, right, 1e-11);
    if (!X) return {};
    const double miss = (M * *X - right).cwiseAbs().maxCoeff();
    return miss <= 1e-9 * std::max(1.0, right.cwiseAbs().maxCoeff()) ? *X : Matrix();
  };
  // | e_q  e_t | (q', t') = -e_rho rho'     and     | e_q  e_rho  e_other | (q', rho', ..) = -e_t t'
  std::vector<Index> entries = moving_entries(system, {});
  const Matrix forward = solve(closures.by(entries, {}), -closures.by({}, full.commands));
  if (forward.size() > 0) {
    const auto first = std::find(entries.begin(), entries.end(), body.t) - entries.begin();
    result.velocity = to_twist * forward.middleRows(first, body.count);
  }
  if (static_cast<Index>(full.commands.size()) != body.count) return result;
  std::vector<Index> pose(static_cast<std::size_t>(body.count));
  std::iota(pose.begin(), pose.end(), body.t);
  entries = moving_entries(system, pose);
  const auto nr = static_cast<Index>(full.commands.size());
  const Matrix backward = solve(closures.by(entries, full.commands), -closures.by(pose, {}));
  if (backward.size() > 0)
    result.force = Lu(to_twist.transpose()).solve(Matrix(backward.bottomRows(nr).transpose()));
  return result;
}

Factors factors_of(const Matrix& rows) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  if (rows.size() == 0) return {undefined, undefined};
  const Vector values = jacobi_svd(rows).values;
  return {values[values.size() - 1], values[0]};
}

}  // namespace springfold::statics
