#include "springfold/statics/closing.hpp"

#include <cmath>
#include <limits>

#include "minimum_norm.hpp"

namespace springfold::statics {

bool close_chains(const System& system, const std::vector<Index>& unknowns, Vector& z,
                  Vector& rho) {
  constexpr double longest = 0.3, tolerance = 1e-12;
  std::vector<Index> rows;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) rows.push_back(i);
  Workspace work;
  Vector r;
  Matrix A, dR_drho;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 100; ++iteration) {
    z(rows).setZero();  // no wrenches, so that rows F are the closures and nothing else
    const Inputs inputs{rho, Vector::Zero(system.load_size), {}};
    if (!equilibrium_matrix(system, piece_at(system, z), z, inputs, work, r, A, &dR_drho))
      return false;
    const Vector e = r(rows);
    const double gap = e.lpNorm<Eigen::Infinity>();
    if (gap < 1e-15 || (gap < tolerance && gap > 0.5 * before)) return true;
    if (unknowns.empty()) return gap < tolerance;
    before = gap;
    Matrix J(A.rows(), A.cols() + dR_drho.cols());
    J << A, dR_drho;
    Vector step = -minimum_norm_solution(J(rows, unknowns), e);
    const double length = step.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(length)) return false;
    if (length > longest) step *= longest / length;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      (unknowns[k] < system.size ? z[unknowns[k]] : rho[unknowns[k] - system.size]) +=
          step[static_cast<Index>(k)];
  }
  return before < tolerance;
}

}  // namespace springfold::statics
