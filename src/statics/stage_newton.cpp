#include "stage_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace springfold::statics {
namespace {

/// Body whose pose is given, -1: none.
Index given_body(const StartProblem& problem) {
  return problem.unknowns == StartUnknowns::wrench ? problem.body - 1 : -1;
}

std::vector<std::vector<Index>> free_poses(const System& system, Index given) {
  std::vector<std::vector<Index>> columns(system.body_slices.size());
  Index next = 0;
  for (std::size_t b = 0; b < columns.size(); ++b)
    for (Index k = 0; static_cast<Index>(b) != given && k < system.body_slices[b].count; ++k)
      columns[b].push_back(next++);
  return columns;
}

Matrix basis_of(const System& system, Index given) {
  const auto columns = free_poses(system, given);
  Index count = 0;
  for (const auto& list : columns) count += static_cast<Index>(list.size());
  Matrix basis = Matrix::Zero(system.size - system.first_pose, count);
  for (std::size_t b = 0; b < columns.size(); ++b)
    for (std::size_t k = 0; k < columns[b].size(); ++k)
      basis(system.body_slices[b].t - system.first_pose + static_cast<Index>(k), columns[b][k]) = 1;
  return basis;
}

}  // namespace

StageNewton::StageNewton(const System& system, const StartProblem& problem)
    : system_{system},
      basis_{basis_of(system, given_body(problem))},
      stages_{system, free_poses(system, given_body(problem))} {}

/// Rows of a given pose do not count: there the wrench that holds it acts.
bool StageNewton::residual(const Vector& z, const Inputs& inputs, Vector& r) {
  Vector full;
  if (!stages_.residual(system_, piece_at(system_, z), z, inputs, full)) return false;
  const Index first = system_.first_pose;
  r.resize(first + basis_.cols());
  r << full.head(first), basis_.transpose() * full.tail(full.size() - first);
  return true;
}

Vector StageNewton::spread(const Matrix& step) const {
  const Index first = system_.first_pose;
  Vector dz(system_.size);
  dz << step.col(0).head(first), basis_ * step.col(0).tail(basis_.cols());
  return dz;
}

double StageNewton::way(const Vector& dz) const {
  double way = 0;
  for (Index i = 0; i < dz.size(); ++i)
    if (!system_.is_wrench[static_cast<std::size_t>(i)]) way = std::max(way, std::abs(dz[i]));
  return way;
}

double StageNewton::solve(Vector& z, const Inputs& inputs, int& iterations) {
  constexpr int most = 100;
  constexpr double longest = 0.5;  // change of a coordinate in one step
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Index first = system_.first_pose, root = basis_.cols();
  const FrontalBorders none{Matrix(first + root, 0), Matrix(first + root, 0), Matrix(0, 0)};
  Vector r, full, trial;
  if (!residual(z, inputs, r)) return infinity;
  double size = r.norm();
  for (iterations = 0; iterations < most && size > 0; ++iterations) {
    StructuredMatrix A;
    Matrix step = r;
    if (!stages_.matrix(system_, piece_at(system_, z), z, inputs, basis_, {}, full, A) ||
        !A.solve(none, step, false))
      break;
    const Vector dz = spread(step);
    const double moved = way(dz), first_part = std::min(1.0, longest / moved);
    // What stiff springs leave may be rounding already, and hide all of what soft ones do: then the next step by this
    // matrix tells (Deuflhard's natural test).
    const auto comes_nearer = [&] {
      Matrix next = r;
      return A.solve(none, next, false) && way(spread(next)) < (1 - 0.5 * first_part) * moved;
    };
    bool better = false;
    for (double part = first_part; !better && part > 1e-3; part /= 2) {
      trial = z - part * dz;
      better = residual(trial, inputs, r) &&
               (r.norm() < (1 - 0.25 * part) * size || (part == first_part && comes_nearer()));
    }
    if (!better) break;
    z = trial;
    size = r.norm();
  }
  return residual(z, inputs, r) ? r.lpNorm<Eigen::Infinity>() : infinity;
}

}  // namespace springfold::statics
