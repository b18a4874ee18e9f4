#include "continuation/locating/bordered_test.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/finite.hpp"

namespace springfold::continuation {
namespace {

/// Is the spectral radius of a matrix X >= 0 of n rows below 1/2? times() puts X d into Xd.
template <class Times>
bool is_small(Vector& d, Vector& Xd, const Times& times) {
  d.setOnes();
  for (int i = 0; i < 8; ++i) {
    times();
    if ((Xd.array() / d.array()).maxCoeff() < 0.5) return true;
    const double largest = Xd.maxCoeff();
    if (!(largest > 0)) return true;
    d = (Xd / largest).cwiseMax(residual_level);
  }
  return false;
}

/// Sizes of the largest changes from one place to others, and the rows in which there are any.
void measure_motion(Workspace& memory, const LinearisedPoint& middle,
                    std::span<const LinearisedPoint* const> others) {
  const Index n = middle.x.size();
  Matrix& motion = memory.motion;
  motion.setZero(n, n + 1);
  for (const LinearisedPoint* other : others) {
    for (Index j = 0; j < n; ++j)
      motion.col(j) =
          motion.col(j).cwiseMax((other->at.dF_dx.col(j) - middle.at.dF_dx.col(j)).cwiseAbs());
    motion.col(n) =
        motion.col(n).cwiseMax((other->at.dF_dlambda - middle.at.dF_dlambda).cwiseAbs());
  }
  Vector& sizes = memory.sizes;
  sizes = motion.col(n);
  for (Index j = 0; j < n; ++j) sizes = sizes.cwiseMax(motion.col(j));
  memory.moving_rows.clear();
  for (Index i = 0; i < n; ++i)
    if (!(sizes[i] == 0)) memory.moving_rows.push_back(i);
}

/// |E0^-1| |E1 - E0| is no smaller than |E0^-1 (E1 - E0)| and takes one product of a few for all E1, which nearly
/// always is enough. Rows that do not move, the last one among them, count for nothing.
bool surely_regular(Workspace& memory, LinearisedPoint& middle,
                    std::span<const LinearisedPoint* const> others) {
  const Index n = middle.x.size();
  Matrix &inverse = memory.inverse, &motion = memory.motion;
  measure_motion(memory, middle, others);
  const std::vector<Index>& rows = memory.moving_rows;
  const auto count = static_cast<Index>(rows.size());
  middle.factors.invert(rows, inverse);
  if (!all_finite(inverse)) return false;
  Vector &d = memory.bound, &Xd = memory.step, &moved = memory.F;
  d.resize(n + 1);
  Xd.resize(n + 1);
  const auto bound = [&] {
    moved.setZero(n);
    for (Index j = 0; j <= n; ++j) moved += d[j] * motion.col(j);
    Xd.setZero();
    for (Index k = 0; k < count; ++k)
      Xd.array() += moved[rows[static_cast<std::size_t>(k)]] * inverse.col(k).array().abs();
  };
  if (is_small(d, Xd, bound)) return true;
  Matrix difference(count, n + 1), X(n + 1, n + 1);
  for (const LinearisedPoint* other : others) {
    for (Index k = 0; k < count; ++k) {
      const Index row = rows[static_cast<std::size_t>(k)];
      difference.row(k) << other->at.dF_dx.row(row) - middle.at.dF_dx.row(row),
          other->at.dF_dlambda[row] - middle.at.dF_dlambda[row];
    }
    X = (inverse * difference).cwiseAbs();
    if (!X.allFinite() || !is_small(d, Xd, [&] { Xd.noalias() = X * d; })) return false;
  }
  return true;
}

/// Largest magnitude of an eigenvalue of E0^-1 (E1 - E0), of structured matrices with the same last row.
/// @pre the row is set in middle.factors
double largest_motion(Workspace& memory, LinearisedPoint& middle, const LinearisedPoint& other) {
  const Index n = middle.x.size();
  Vector &v = memory.x, &there = memory.F, &here = memory.sizes;
  const auto put_image = [&](const auto& direction, Vector& image) {
    v = direction.head(n);
    other.at.structured->product(v, there);
    there += direction[n] * other.at.dF_dlambda;
    middle.at.structured->product(v, here);
    here += direction[n] * middle.at.dF_dlambda;
    image.resize(n + 1);
    image.head(n) = there - here;
    image[n] = 0;
    return middle.factors.solve(image.data());
  };
  return largest_eigenvalue(memory.arnoldi, n + 1, put_image);
}

}  // namespace

bool surely_regular(const Walker& walker, const Direction& tau, Samples samples) {
  constexpr std::size_t most = 3;
  assert(samples.size() <= most);
  const std::size_t count = samples.size(), middle = count / 2;
  std::array<LinearisedPoint*, most> places{};
  for (std::size_t i = 0; i < count; ++i) {
    const CurvePoint& p = *samples[i];
    places[i] = linearised_at(walker.problem, *walker.memory, p.x, p.lambda, p.piece);
    if (!places[i]) return false;
  }
  if (!places[middle]->factors.set_border(walker.weights, tau)) return false;
  if (places[middle]->at.structured) {
    constexpr double safely = 1.0 / 3;
    for (std::size_t i = 0; i < count; ++i)
      if (i != middle && !(largest_motion(*walker.memory, *places[middle], *places[i]) < safely))
        return false;
    return true;
  }
  std::array<const LinearisedPoint*, most> others{};
  std::size_t number = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (i != middle) others[number++] = places[i];
  return surely_regular(*walker.memory, *places[middle], std::span(others).first(number));
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

bool is_singular(const ExtendedMatrix& E, double share) {
  const double size = magnitudes(E, irregular_columns(E.rows(), 1)).norm();
  if (!E.at.structured) {  // no singular value is below 1 / |E^-1|; the inverse is known to a few digits at least
    constexpr double surely = 2;
    const Matrix unit = Matrix::Identity(E.rows(), E.rows());
    const auto inverse = BorderedMatrix(E, {}).solve(unit);
    if (inverse && surely * share * size * inverse->norm() < 1) return false;
  }
  return !(least_singular_values(E, 1)[0] > share * size);
}

std::optional<Matrix> sigma_of(const ExtendedMatrix& E, const Borders& borders) {
  const Index m = borders.B.cols();
  const auto solution = solve_with(E, borders, unit_rows_below(E.rows() + m, m));
  if (!solution) return std::nullopt;
  return solution->bottomRows(m);
}

double sigma_noise(const ExtendedMatrix& E, const Borders& borders) {
  const Index n = E.rows(), m = borders.B.cols();
  const Matrix right = unit_rows_below(n + m, m);
  const BorderedMatrix M(E, borders);
  const auto Phi = M.solve(right), Psi = M.solve(right, true);
  if (!Phi || !Psi) return infinity;
  const double noise =
      few_roundings *
      (Psi->topRows(n).cwiseAbs().transpose() * magnitudes(E, Phi->topRows(n))).norm();
  return std::isfinite(noise) ? noise : infinity;
}

double rate_noise(const ExtendedMatrix& E) {
  const Index n = E.rows();
  const Matrix unit = Vector::Unit(n, n - 1);
  const BorderedMatrix matrix(E, {});
  const auto solution = matrix.solve(unit), row = matrix.solve(unit, true);
  if (!solution || !row) return infinity;
  const Vector tangent = solution->col(0) / solution->col(0).norm();
  const double noise = few_roundings * row->col(0).cwiseAbs().dot(magnitudes(E, tangent).col(0));
  // No entry of a unit tangent is better than a rounding of its length: where lambda itself is what Newton's method
  // left of zero, in a dead band, the equations' own rounding says nothing.
  return std::isfinite(noise) ? std::max(noise, few_roundings) : infinity;
}

double rate_error(const ExtendedMatrix& E, double error) {
  const Index n = E.rows();
  const auto row = BorderedMatrix(E, {}).solve(Matrix(Vector::Unit(n, n - 1)), true);
  const double most = row ? error * row->col(0).head(n - 1).lpNorm<1>() : infinity;
  return std::isfinite(most) ? most : infinity;
}

}  // namespace springfold::continuation
