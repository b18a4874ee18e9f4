#include "bordered_test.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "small_lu.hpp"
#include "springfold/core/finite.hpp"

namespace springfold::continuation {
namespace {

constexpr double few_units = 4 * std::numeric_limits<double>::epsilon();

using OnStack = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, SmallLu::largest, 1>;

/// Is the spectral radius of a matrix X >= 0 of n rows below 1/2? times(d, Xd) puts X d into Xd.
template <class V, class Times>
bool is_small(Index n, const Times& times) {
  V d = V::Ones(n), Xd(n);
  for (int i = 0; i < 8; ++i) {
    times(d, Xd);
    if ((Xd.array() / d.array()).maxCoeff() < 0.5) return true;
    const double largest = Xd.maxCoeff();
    if (!(largest > 0)) return true;
    d = (Xd / largest).cwiseMax(1e-12);
  }
  return false;
}

template <class V>
bool is_small(const Matrix& X) {
  return X.allFinite() && is_small<V>(X.rows(), [&](const V& d, V& Xd) { Xd.noalias() = X * d; });
}

/// surely_regular() with few unknowns. |E0^-1| |E - E0| is no smaller than |E0^-1 (E - E0)| and takes one inverse
/// for all E, which nearly always is enough.
bool surely_regular(const SmallLu& lu, const std::vector<ExtendedMatrix>& E, const Matrix& E0) {
  const Index n = E0.rows();
  if (!(lu.smallest_pivot() > 0)) return false;
  Matrix inverse = Matrix::Identity(n, n), motion = Matrix::Zero(n, n);
  lu.solve(inverse);
  inverse = inverse.cwiseAbs();
  for (const ExtendedMatrix& other : E) motion = motion.cwiseMax((other.dense - E0).cwiseAbs());
  OnStack moved(n);
  const auto bound = [&](const OnStack& d, OnStack& Xd) {
    moved.noalias() = motion * d;
    Xd.noalias() = inverse * moved;
  };
  if (all_finite(inverse) && all_finite(motion) && is_small<OnStack>(n, bound)) return true;
  for (const ExtendedMatrix& other : E) {
    Matrix X = other.dense - E0;
    lu.solve(X);
    if (!is_small<OnStack>(Matrix(X.cwiseAbs()))) return false;
  }
  return true;
}

}  // namespace

bool surely_regular(const std::vector<ExtendedMatrix>& E, std::size_t middle) {
  const ExtendedMatrix& E0 = E[middle];
  if (E0.at.structured) {
    constexpr double safely = 1.0 / 3;
    for (std::size_t i = 0; i < E.size(); ++i)
      if (i != middle && !(relative_motion(E0, E0, E[i], true).front() < safely)) return false;
    return true;
  }
  if (SmallLu::fits(E0.rows())) return surely_regular(SmallLu(E0.dense), E, E0.dense);
  const Eigen::PartialPivLU<Matrix> lu(E0.dense);
  for (std::size_t i = 0; i < E.size(); ++i)
    if (i != middle && !is_small<Vector>(lu.solve(E[i].dense - E0.dense).cwiseAbs())) return false;
  return true;
}

Reach reach_of(const std::vector<ExtendedMatrix>& E, std::size_t middle) {
  const ExtendedMatrix& E0 = E[middle];
  Reach reach;
  if (!E0.at.structured) {
    for (const ExtendedMatrix& other : E)
      reach.size = std::max(reach.size, (other.dense - E0.dense).norm());
    const Vector values = least_singular_values(E0, E0.rows());
    reach.order = std::max<Index>(1, (values.array() < 2 * reach.size).count());
    return reach;
  }
  constexpr double may_vanish = 0.25;
  constexpr Index most = 6;
  for (std::size_t i = 0; i < E.size(); ++i) {
    if (i == middle) continue;
    const auto values = relative_motion(E0, E0, E[i]);
    const auto count = std::count_if(values.begin(), values.end(),
                                     [](double value) { return value > may_vanish; });
    reach.order = std::clamp<Index>(count, reach.order, most);
  }
  const Matrix C = borders_of(E0, reach.order).C, there = product(E0, C);
  for (const ExtendedMatrix& other : E)
    reach.size = std::max(reach.size, (product(other, C) - there).norm());
  return reach;
}

std::optional<Matrix> sigma_of(const ExtendedMatrix& E, const Borders& borders) {
  const Index n = E.rows(), m = borders.B.cols();
  Matrix right = Matrix::Zero(n + m, m);
  right.bottomRows(m).setIdentity();
  const auto solution = solve_with(E, borders, right);
  if (!solution) return std::nullopt;
  return solution->bottomRows(m);
}

double sigma_noise(const ExtendedMatrix& E, const Borders& borders) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Index n = E.rows(), m = borders.B.cols();
  Matrix right = Matrix::Zero(n + m, m);
  right.bottomRows(m).setIdentity();
  const auto Phi = solve_with(E, borders, right), Psi = solve_with(E, borders, right, true);
  if (!Phi || !Psi) return infinity;
  const double noise =
      few_units * (Psi->topRows(n).cwiseAbs().transpose() * magnitudes(E, Phi->topRows(n))).norm();
  return std::isfinite(noise) ? noise : infinity;
}

double rate_noise(const ExtendedMatrix& E) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Index n = E.rows();
  const Matrix unit = Vector::Unit(n, n - 1);
  const auto solution = solve_with(E, {}, unit), row = solve_with(E, {}, unit, true);
  if (!solution || !row) return infinity;
  const Vector tangent = solution->col(0) / solution->col(0).norm();
  const double noise = few_units * row->col(0).cwiseAbs().dot(magnitudes(E, tangent).col(0));
  return std::isfinite(noise) ? noise : infinity;
}

}  // namespace springfold::continuation
