#include "continuation/locating/branch_point.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "continuation/locating/reduced_equation.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// What J has in the kernels, entry (q, j) at q (k + 1) + j.
Vector in_kernels(const ReducedEquation& e, const ExtendedMatrix& J) {
  const Matrix G = J.at.structured ? Matrix(e.L.transpose() * product(J, e.N))
                                   : Matrix(e.L.transpose() * J.dense * e.N);
  return Matrix(G.transpose()).reshaped();
}

/// Its derivative along N: k (k + 1) x (k + 1).
Matrix rate_in_kernels(const ReducedEquation& e) {
  const Index m = e.k + 1;
  Matrix rate(e.k * m, m);
  for (Index q = 0; q < e.k; ++q)
    rate.middleRows(q * m, m) = e.quadratic[static_cast<std::size_t>(q)];
  return rate;
}

/// Second derivatives below this are rounding of J over the length of their differences.
double least_rate(const ReducedEquation& e, double largest) {
  const auto J = jacobian_at(*e.walker, e.U0, e.root, e.piece);
  if (!J) return infinity;
  const Index n = J->columns();
  const double size =  // Frobenius norm; structured: estimated
      J->at.structured
          ? std::sqrt(static_cast<double>(n)) * product(*J, irregular_columns(n, 1)).norm()
          : J->dense.norm();
  return promised_place * size + one_place * largest;
}

/// One step from U with the kernels of e: first what F asks for across them, then along them from there.
std::optional<Vector> step_from(const ReducedEquation& e, const Svd& rate, const Vector& U) {
  Vector F;
  if (!residual_at(e, U, F)) return std::nullopt;
  Vector right = Vector::Zero(F.size() + e.k + 1);
  right.head(F.size()) = -F;
  const auto solved = e.bordered.solve(right);
  if (!solved || !solved->allFinite()) return std::nullopt;
  const Vector across = solved->col(0).head(U.size());
  const auto J = jacobian_at(*e.walker, U + across, e.root, e.piece);
  if (!J) return std::nullopt;
  Vector step = across + e.N * rate.solve(-in_kernels(e, *J));
  if (!step.allFinite()) return std::nullopt;
  return step;
}

/// Fixed directions in which rounding is sampled.
Vector aside(Index size, int k) {
  Vector d(size);
  for (Index i = 0; i < size; ++i) d[i] = irregular(i, k);
  return d;
}

/// Places that steps from around U lead to: their scatter is what rounding makes of a place, their mean is
/// more exact than any of them.
struct Places {
  Vector mean{};
  double scatter = infinity;  ///< largest distance from the mean
};

Places places_around(const ReducedEquation& e, const Svd& rate, const Vector& U, int number) {
  std::vector<Vector> ends;
  Places places{.mean = Vector::Zero(U.size())};
  for (int k = 0; k < number; ++k) {
    const Vector start = U + function_noise * e.scale * aside(U.size(), k).normalized();
    const auto step = step_from(e, rate, start);
    if (!step) return places;
    ends.push_back(start + *step - U);
    places.mean += ends.back() / number;
  }
  places.scatter = 0;
  for (const Vector& end : ends)
    places.scatter = std::max(places.scatter, (end - places.mean).norm());
  places.mean += U;
  return places;
}

/// Error of the place by rounding that is the same everywhere, so that no scatter shows it: a unit in the
/// last place of every entry of J, independent of each other.
double constant_error(const ReducedEquation& e, const ExtendedMatrix& J, double least_rate) {
  const Matrix rows = J.at.structured ? Matrix(magnitudes(J, e.N).cwiseAbs2())
                                      : Matrix(J.dense.cwiseAbs2() * e.N.cwiseAbs2());
  const Matrix squares = e.L.cwiseAbs2().transpose() * rows;
  return rounding_unit * std::sqrt(squares.sum()) / least_rate;
}

/// Puts U, which is exact up to rounding, where many steps agree.
/// @returns the estimated error
double settle(const ReducedEquation& e, const Svd& rate, Vector& U) {
  const Places few = places_around(e, rate, U, 4);
  if (!(few.scatter > residual_level * e.scale) || !std::isfinite(few.scatter)) return few.scatter;
  constexpr int many = 32;
  const Places more = places_around(e, rate, U, many);
  if (!std::isfinite(more.scatter)) return few.scatter;
  U = more.mean;
  return 2 * more.scatter / std::sqrt(many);
}

/// L^T F at U against its rounding, which is sampled around U: to first order L^T F is constant there.
double left_at(const ReducedEquation& e, const Vector& U) {
  const Vector sizes = U.cwiseAbs().cwiseMax(tiny_share);
  const auto J = jacobian_at(*e.walker, U, e.root, e.piece);
  Vector F;
  if (!J || !residual_at(e, U, F)) return infinity;
  const Vector here = e.L.transpose() * F;
  double noise = rounding_unit * (e.L.cwiseAbs().transpose() * magnitudes(*J, sizes)).norm();
  // Curves this near to each other meet, for all that can be said of a place.
  for (const Matrix& Q : e.quadratic)
    noise = std::max(noise, Q.norm() * std::pow(promised_place * e.scale, 2));
  for (int k = 0; k < 8; ++k) {
    if (!residual_at(e, U + residual_level * aside(U.size(), k).cwiseProduct(sizes), F))
      return infinity;
    noise = std::max(noise, (e.L.transpose() * F - here).norm());
  }
  return here.norm() / std::max(smallest_number, noise);
}

}  // namespace

std::optional<Vector> spectrum_at(const Walker& walker, const CurvePoint& point) {
  Linearisation at;
  if (!linearise_densely(walker.problem, point.x, point.lambda, point.piece, at))
    return std::nullopt;
  return symmetric_eigenvalues(at.dF_dx);
}

double least_eigenvalue(const Walker& walker, const CurvePoint& point) {
  if (!walker.problem.structured()) {
    const auto spectrum = spectrum_at(walker, point);
    return spectrum && spectrum->size() > 0 ? spectrum->cwiseAbs().minCoeff() : infinity;
  }
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return infinity;
  const Index n = point.x.size();
  const FrontalBorders none{Matrix(n, 0), Matrix(n, 0), Matrix(0, 0)};
  Matrix v = irregular_columns(n, 1);
  double largest = 0;  // of the inverse matrix
  for (int step = 0; step < 12; ++step) {
    if (!at.structured->solve(none, v, false)) return 0;
    const double before = largest;
    largest = v.norm();
    v /= largest;
    if (std::abs(largest - before) < negligible_share * largest) break;
  }
  return 1 / largest;
}

std::optional<BranchPlace> place_branch_point(const Walker& walker, const CurvePoint& near,
                                              int corank, double reach) {
  BranchPlace place{.point = near};
  const Index n = near.x.size();
  const Vector root = metric_roots(walker.weights), U_near = scaled_point(near, root);
  Vector U = U_near;
  std::optional<ReducedEquation> e;
  Svd rate;
  const auto take = [&] {
    place.point.x = U.head(n).cwiseQuotient(root.head(n));
    place.point.lambda = U[n];
  };
  const bool found = settles(14, [&](double) -> std::optional<IterationStep> {
    take();
    e = reduce(walker, place.point, corank);
    if (!e) return std::nullopt;
    rate = jacobi_svd(rate_in_kernels(*e), SingularVectors::thin, SingularVectors::thin);
    if (!(rate.values[corank] > least_rate(*e, rate.values[0]))) return std::nullopt;
    const auto step = step_from(*e, rate, U);
    if (!step) return std::nullopt;
    U += *step;
    if (!((U - U_near).norm() <= 2 * reach)) return std::nullopt;
    // What the kernels of a place nearby make of the step is of second order in the distance from it.
    return IterationStep{step->norm(), function_noise * e->scale, together * e->scale};
  });
  if (!found) return std::nullopt;
  for (int polish = 0; polish < 2; ++polish)
    if (const auto last = step_from(*e, rate, U)) U += *last;
  place.off = settle(*e, rate, U);
  if (!((U - U_near).norm() <= reach)) return std::nullopt;
  take();
  const auto J = jacobian_at(walker, U, root, near.piece);
  if (!J) return std::nullopt;
  place.misfit = in_kernels(*e, *J).norm() / rate.values[corank];
  place.off = std::max(place.off, constant_error(*e, *J, rate.values[corank]));
  place.left = left_at(*e, U);
  return place;
}

double left_of_residual(const Walker& walker, const CurvePoint& point, int corank) {
  const auto e = reduce(walker, point, corank);
  return e ? left_at(*e, e->U0) : infinity;
}

std::optional<CurvePoint> refine_branch_point(const Walker& walker, const CurvePoint& near) {
  const auto place = place_branch_point(walker, near, 1);
  if (!place || !(place->left <= branches_apart)) return std::nullopt;
  return place->point;
}

}  // namespace springfold::continuation
