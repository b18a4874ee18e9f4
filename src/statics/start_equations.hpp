// The equations of a first equilibrium: its unknowns and rows, chosen out of those of the statics. Private to statics.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "springfold/core/rounding.hpp"
#include "springfold/statics/first_equilibrium.hpp"
#include "unknowns.hpp"

namespace springfold::statics {

/// Which entries of (z, rho) are unknown and which rows of the residual must vanish.
struct StartSelection {
  std::vector<Index> unknowns{};  ///< numbers >= system.size are commands
  std::vector<Index> rows{};
};

inline StartSelection start_selection(const System& system, const StartProblem& problem) {
  StartSelection s;
  const BodySlice& body = system.body_slices[static_cast<std::size_t>(problem.body - 1)];
  const auto of_body = [&](Index i) { return i >= body.t && i < body.t + body.count; };
  const bool pose_given = problem.unknowns != StartUnknowns::pose;
  s.unknowns.reserve(static_cast<std::size_t>(system.size + problem.inputs.rho.size()));
  s.rows.reserve(static_cast<std::size_t>(system.size));
  for (Index i = 0; i < system.size; ++i) {
    if (!(pose_given && of_body(i))) s.unknowns.push_back(i);
    if (!(problem.unknowns == StartUnknowns::wrench && of_body(i))) s.rows.push_back(i);
  }
  if (problem.unknowns == StartUnknowns::commands)
    for (Index i = 0; i < problem.inputs.rho.size(); ++i) s.unknowns.push_back(system.size + i);
  return s;
}

/// The equilibrium equations in the selected unknowns; springs in the segments of the state itself.
class StartEquations {
 public:
  /// @param work  storage
  StartEquations(const System& system, const StartProblem& problem, Workspace& work)
      : system_{system}, selection_{start_selection(system, problem)}, work_{work} {}

  Vector pack(const StartState& state) const {
    Vector y(static_cast<Index>(selection_.unknowns.size()));
    for (Index i = 0; i < y.size(); ++i) {
      const Index k = selection_.unknowns[static_cast<std::size_t>(i)];
      y[i] = k < system_.size ? state.z[k] : state.inputs.rho[k - system_.size];
    }
    return y;
  }

  void unpack(const Vector& y, StartState& state) const {
    for (Index i = 0; i < y.size(); ++i) {
      const Index k = selection_.unknowns[static_cast<std::size_t>(i)];
      (k < system_.size ? state.z[k] : state.inputs.rho[k - system_.size]) = y[i];
    }
  }

  /// Largest change of a coordinate, pose or command in a step.
  double way(const Vector& step) const {
    double way = 0;
    for (Index i = 0; i < step.size(); ++i)
      if (!is_wrench(i)) way = std::max(way, std::abs(step[i]));
    return way;
  }

  /// Does it change one of them by more than its rounding? Lengths are judged against max(1, their size).
  bool moves(const StartState& state, const Vector& step) const {
    const Vector y = pack(state);
    for (Index i = 0; i < step.size(); ++i)
      if (!is_wrench(i) && std::abs(step[i]) > few_roundings * std::max(1.0, std::abs(y[i])))
        return true;
    return false;
  }

  bool is_wrench(Index unknown) const {
    const Index k = selection_.unknowns[static_cast<std::size_t>(unknown)];
    return k < system_.size && system_.is_wrench[static_cast<std::size_t>(k)];
  }

  bool is_pose(Index unknown) const {
    const Index k = selection_.unknowns[static_cast<std::size_t>(unknown)];
    return k >= system_.first_pose && k < system_.size;
  }

  std::vector<Index> angles() const {
    std::vector<Index> angles;
    for (std::size_t i = 0; i < selection_.unknowns.size(); ++i)
      if (is_angle(system_, selection_.unknowns[i])) angles.push_back(static_cast<Index>(i));
    return angles;
  }

  bool residual(const StartState& state, Vector& r) {
    const bool finite = equilibrium_residual(system_, piece_at(system_, state.z, state.inputs.rho),
                                             state.z, state.inputs, work_, full_);
    r = full_(selection_.rows);
    return finite;
  }

  bool solved(const StartState& state, double tolerance) {
    Vector r;
    return residual(state, r) &&
           (vanishes(state, r, tolerance) || cancels_to_rounding(state, r, tolerance));
  }

  /// Gaps are compared with lengths, forces with forces: a huge wrench must not excuse a gap.
  bool vanishes(const StartState& state, const Vector& r, double tolerance) const {
    const double size = size_of(state, false), wrench = size_of(state, true);
    return largest(r, true) <= tolerance * size &&
           largest(r, false) <= tolerance * std::max(size, wrench);
  }

  /// Forces of stiff springs that balance each other leave their rounding, whatever a soft one makes of the unit of
  /// force: each row that of its own terms. (Those of a bar that has shrunk to no length would excuse every other row.)
  bool cancels_to_rounding(const StartState& state, const Vector& r, double tolerance) {
    Matrix J;
    if (!(largest(r, true) <= tolerance) || pulls_nowhere(state, tolerance) || !jacobian(state, J))
      return false;
    Vector sizes = pack(state).cwiseAbs();
    for (Index i = 0; i < sizes.size(); ++i)
      if (!is_wrench(i)) sizes[i] = std::max(1.0, sizes[i]);
    const Vector rounding = few_roundings * J.cwiseAbs() * sizes;
    const double most = tolerance * std::max(size_of(state, false), size_of(state, true));
    for (Index i = 0; i < r.size(); ++i)
      if (!is_gap(i) && !(std::abs(r[i]) <= std::max(most, rounding[i]))) return false;
    return true;
  }

  /// Gaps against lengths, every force against the unit of force and the terms of its own row: a stiff spring must not
  /// excuse what a soft one leaves.
  bool vanishes_by_rows(const StartState& state, double tolerance) {
    Vector r;
    Matrix J;
    if (!residual(state, r) || !jacobian(state, J)) return false;
    const Vector sizes = J.cwiseAbs() * pack(state).cwiseAbs();
    const double size = size_of(state, false);
    for (Index i = 0; i < r.size(); ++i) {
      if (!(std::abs(r[i]) <= tolerance * (is_gap(i) ? size : std::max(1.0, sizes[i]))))
        return false;
    }
    return true;
  }

  bool jacobian(const StartState& state, Matrix& J) {
    const bool finite = equilibrium_matrix(system_, piece_at(system_, state.z, state.inputs.rho),
                                           state.z, state.inputs, work_, full_, A_, &dR_drho_);
    Matrix wide(A_.rows(), A_.cols() + dR_drho_.cols());
    wide << A_, dR_drho_;
    J = wide(selection_.rows, selection_.unknowns);
    return finite;
  }

  /// The closure equations alone and their derivatives by the unknowns `columns`.
  bool closures(const StartState& state, const std::vector<Index>& columns, Vector& e, Matrix& J) {
    Matrix all;
    if (!jacobian(state, all)) return false;
    std::vector<Index> rows;
    for (std::size_t i = 0; i < selection_.rows.size(); ++i)
      if (system_.is_wrench[static_cast<std::size_t>(selection_.rows[i])])
        rows.push_back(static_cast<Index>(i));
    Vector r = full_(selection_.rows);
    e = r(rows);
    J = all(rows, columns);
    return true;
  }

 private:
  /// Is the row one of the closures?
  bool is_gap(Index row) const {
    return system_
        .is_wrench[static_cast<std::size_t>(selection_.rows[static_cast<std::size_t>(row)])];
  }

  /// Of the wrenches, or of the other unknowns: the largest, and no less than 1.
  double size_of(const StartState& state, bool wrenches) const {
    double size = 1;
    for (Index i = 0; i < system_.size; ++i)
      if (system_.is_wrench[static_cast<std::size_t>(i)] == wrenches)
        size = std::max(size, std::abs(state.z[i]));
    return size;
  }

  /// Is a line spring so short that its force has no known direction? It would excuse all rows of its ends.
  bool pulls_nowhere(const StartState& state, double tolerance) const {
    const double shortest = tolerance * size_of(state, false);
    for (std::size_t i = 0; i < system_.line_springs.size(); ++i)
      if (system_.line_springs[i].free != 0 &&
          line_spring_state(system_, i, state.z, state.inputs.rho).length <= shortest)
        return true;
    return false;
  }

  /// Largest entry in the rows of the closures, or in those of the forces.
  double largest(const Vector& rows, bool closures) const {
    double result = 0;
    for (Index i = 0; i < rows.size(); ++i)
      if (is_gap(i) == closures) result = std::max(result, std::abs(rows[i]));
    return result;
  }

  const System& system_;
  StartSelection selection_;
  Workspace& work_;
  Vector full_;
  Matrix A_, dR_drho_;
};

}  // namespace springfold::statics
