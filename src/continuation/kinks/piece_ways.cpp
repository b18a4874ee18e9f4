
#include <algorithm>
#include <cmath>

#include "continuation/kinks/kink.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/exits.hpp"
#include "continuation/locating/reduced_equation.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/core/piecewise_form.hpp"

namespace springfold::continuation {
namespace {

/// Up to so many unknowns all derivatives may vanish at once; then their size is looked for nearby.
constexpr Index most_of_one_size = 4;

std::optional<Direction> unit(const Vector& v, const Vector& weights) {
  const Index n = v.size() - 1;
  Direction d{v.head(n), v[n]};
  if (!set_length_one(weights, d, refined_step * v.norm())) return std::nullopt;
  return d;
}

Matrix extended(const Linearisation& at) {
  Matrix A(at.dF_dx.rows(), at.dF_dx.rows() + 1);
  A << at.dF_dx, at.dF_dlambda;
  return A;
}

/// Size of the extended Jacobian a little away, where it need not vanish altogether.
double size_nearby(const Walker& walker, const CurvePoint& at) {
  Linearisation linear;
  const double h = small_share * std::max(1.0, at.x.norm());
  const Vector x = at.x.array() + h;
  if (!linearise_densely(walker.problem, x, at.lambda + h, at.piece, linear)) return 0;
  return extended(linear).cwiseAbs().maxCoeff();
}

/// The tangent where dF/dx is structured and no other branch is near: by inverse iteration with the
/// tangent itself as last row.
std::optional<Direction> structured_tangent(const Walker& walker, const CurvePoint& at,
                                            double full_rank) {
  Linearisation linear;
  if (!linearise(walker.problem, at.x, at.lambda, at.piece, linear)) return std::nullopt;
  const Index n = linear.dF_dlambda.size();
  auto tangent = unit(irregular_columns(n + 1, 1), walker.weights);
  for (int step = 0; tangent && step < 3; ++step)
    tangent = tangent_at(linear, walker.weights, *tangent);
  if (!tangent) return std::nullopt;
  if (is_singular(extended_matrix(linear, walker.weights, *tangent), full_rank))
    return std::nullopt;
  if (tangent->dlambda < 0) *tangent = opposite(*tangent);  // that in which lambda grows first
  return tangent;
}

/// How far from here may a small singular value vanish? Its rate along every direction of the point is u^T D^2F[v, .]:
/// one difference of J along its own vector v has them all. In length of the metric; 0 outside the domain.
double way_to_zero(const Walker& walker, const CurvePoint& at, const EquilibratedJacobian& own,
                   const Svd& svd, Index i) {
  const Index n = own.J.rows();
  const Vector root = metric_roots(walker.weights), along = own.columns.cwiseProduct(svd.V.col(i));
  const Vector aside =
      told_apart * along / std::max(smallest_number, along.cwiseProduct(root).norm());
  Linearisation plus, minus;
  if (!linearise_densely(walker.problem, at.x + aside.head(n), at.lambda + aside[n], at.piece,
                         plus) ||
      !linearise_densely(walker.problem, at.x - aside.head(n), at.lambda - aside[n], at.piece,
                         minus))
    return 0;
  const Vector u = own.rows.cwiseProduct(svd.U.col(i));
  const Vector change = ((extended(plus) - extended(minus)).transpose() * u).cwiseQuotient(root);
  const double rate = change.norm() * along.cwiseProduct(root).norm() / (2 * told_apart);
  return svd.values[i] / std::max(rate, smallest_number);
}

/// A stiff member beside soft ones leaves a small singular value that is known as well as the equations' entries are:
/// it is none that vanishes, if it is clear of their rounding and no place near the point makes it zero.
bool is_surely_not_zero(const Walker& walker, const CurvePoint& at, const EquilibratedJacobian& own,
                        const Svd& svd, Index i, double near) {
  return svd.values[i] > between_samples * exact_model * std::max(svd.values[0], 1.0) &&
         way_to_zero(walker, at, own, svd, i) > near;
}

/// Stiff members beside soft ones, and multipliers beside angles, make nothing singular by that alone.
PieceWays equilibrated_ways(const Walker& walker, const CurvePoint& at, double full_rank) {
  PieceWays none{.singular = true};
  const auto own = equilibrated_jacobian(walker, at);
  if (!own) return none;
  const PivotedQr qr = pivoted_qr(own->J.transpose());
  const Index n = own->J.rows();
  // Entries a little away are of size 1, whatever vanishes here.
  if (qr.pivots[n - 1] > full_rank * std::max(qr.pivots[0], 1.0)) {
    const auto tangent = unit(own->columns.cwiseProduct(qr.last_column), walker.weights);
    return tangent ? both_ways(*tangent) : none;
  }
  const Svd svd = jacobi_svd(own->J, SingularVectors::full, SingularVectors::full);
  if (!is_surely_not_zero(walker, at, *own, svd, n - 1, full_rank)) return none;
  const auto tangent = unit(own->columns.cwiseProduct(svd.V.col(n)), walker.weights);
  if (!tangent) return none;
  PieceWays ways = both_ways(*tangent);
  for (PieceWay& way : ways.list)
    way.accuracy = std::max(way.accuracy, refined_step / svd.values[n - 1]);
  return ways;
}

/// The kernel of the piece's extended Jacobian: the singular vectors of all values below
/// `located_rank`, where these stand apart from the others.
struct Kernel {
  Matrix N{};  ///< n + 1 x corank + 1, of unit vectors (dx, dlambda)
  int corank = 0;
};

std::optional<Kernel> kernel_of(const Walker& walker, const CurvePoint& at) {
  const auto own = equilibrated_jacobian(walker, at);
  if (!own) return std::nullopt;
  const Index n = own->J.rows();
  const Svd svd = jacobi_svd(own->J, SingularVectors::full, SingularVectors::full);
  const double size = std::max(svd.values[0], 1.0);  // entries nearby are of size 1
  Index rank = (svd.values.array() > located_rank * size).count();
  while (rank < n && is_surely_not_zero(walker, at, *own, svd, rank, located_rank)) ++rank;
  const Vector root = metric_roots(walker.weights);
  const Matrix scaled =
      root.cwiseProduct(own->columns).asDiagonal() * svd.V.rightCols(n + 1 - rank);
  return Kernel{.N = root.cwiseInverse().asDiagonal() * orthonormal_columns(scaled),
                .corank = static_cast<int>(n - rank)};
}

/// Rates of the active switches along the columns of the kernel, on their sides of the piece.
Matrix rates_in_kernel(const CurvePoint& at, const Surfaces& surfaces, const Matrix& N) {
  const Index n = N.rows() - 1, k = static_cast<Index>(surfaces.active.size());
  Matrix rates(k, N.cols());
  for (Index i = 0; i < k; ++i) {
    const Index j = surfaces.active[static_cast<std::size_t>(i)];
    const double side = at.piece[static_cast<std::size_t>(j)];
    rates.row(i) =
        side * (surfaces.dg_dx.row(j) * N.topRows(n) + surfaces.dg_dlambda[j] * N.bottomRows(1));
    // What the surface's gradient and the direction make of rounding is no rate.
    const double size = surfaces.dg_dx.row(j).norm() + std::abs(surfaces.dg_dlambda[j]);
    if (rates.row(i).norm() <= located_rank * size) rates.row(i).setZero();
  }
  return rates;
}

/// Is the only line of the kernel that lies in the piece's cone one of `known`, or is there none?
bool nothing_new(const Walker& walker, const Matrix& N, const Matrix& rates,
                 const std::vector<Direction>& known) {
  if (!is_subspace(rates)) return false;
  const Svd svd = jacobi_svd(rates, SingularVectors::none, SingularVectors::full);
  const double size = svd.values.size() > 0 ? svd.values[0] : 0;
  const Index rank = (svd.values.array() > located_rank * std::max(size, located_rank)).count();
  const Index left = rates.cols() - rank;
  if (left == 0) return true;
  if (left > 1) return false;
  const auto line = unit(N * svd.V.rightCols(1), walker.weights);
  return line && std::any_of(known.begin(), known.end(), [&](const Direction& d) {
           return is_one_line(metric_product(walker.weights, d, *line));
         });
}

/// A stiff member beside soft ones makes a piece look singular before it is. Where its kernel is one line, and that the
/// line along which the curve arrives, which all pieces share whose switches rest, it is regular and has no other way.
bool is_own_curve(const Walker& walker, const CurvePoint& at, const Kernel& kernel) {
  if (kernel.corank > 0 || at.tangent.dx.size() != at.x.size()) return false;
  const auto line = unit(kernel.N, walker.weights);
  return line && is_one_line(metric_product(walker.weights, at.tangent, *line));
}

}  // namespace

PieceWays both_ways(const Direction& tangent) {
  return {.list = {{tangent, {}, one_place}, {opposite(tangent), {}, one_place}}};
}

/// The kernel of A is what the rows of A leave over: the last columns of Q in A^T P = Q R.
PieceWays regular_ways(const Walker& walker, const CurvePoint& at, double full_rank,
                       bool polished) {
  if (walker.problem.structured())
    if (const auto tangent = structured_tangent(walker, at, full_rank)) return both_ways(*tangent);
  if (walker.problem.structured() && at.x.size() > most_entries)
    return {.why =
                "more than one curve, or none, passes through this point, which has too many "
                "unknowns to look at their directions"};
  Linearisation linear;
  if (!linearise_densely(walker.problem, at.x, at.lambda, at.piece, linear))
    return {.why = "derivatives are not defined here"};
  const Index n = linear.dF_dx.rows();
  if (n == 0) return both_ways({Vector(0), 1.0});
  const Matrix A = extended(linear);
  const PivotedQr qr = pivoted_qr(A.transpose());
  const double size = std::max(qr.pivots[0], n <= most_of_one_size ? size_nearby(walker, at) : 0.0);
  if (!(qr.pivots[n - 1] > full_rank * size))
    return equilibrated_ways(walker, at, polished ? full_rank : told_apart);
  auto d = unit(qr.last_column, walker.weights);
  if (!d) return {.why = "along the curve nothing changes here that the metric measures"};
  // Does lambda stand still? Beside a singular point rounding is in the kernel by the inverse of the least pivot: one
  // inverse iteration takes it out.
  if (std::abs(d->dlambda) <= flat_rate)
    if (auto better = tangent_at(linear, walker.weights, *d)) d = std::move(better);
  PieceWays ways = both_ways(*d);
  ways.conditioning = qr.pivots[n - 1] / size;
  return ways;
}

bool before_next_surface(const Walker& walker, const CurvePoint& at, const Surfaces& surfaces,
                         const CurvePoint& start, const Direction& tangent) {
  const Index m = walker.problem.switch_count();
  if (m == 0) return true;
  Vector here, there;
  if (!walker.problem.switches(at.x, at.lambda, here) ||
      !walker.problem.switches(start.x, start.lambda, there))
    return false;
  for (Index j = 0; j < m; ++j) {
    const double side = start.piece[static_cast<std::size_t>(j)];
    const bool active = contains(surfaces.active, j);
    // Clear of a surface that is left as its rate says; as clear as half of what there is of others.
    const double expected =
        !active ? side * here[j]
                : side * start.s * switch_rate(surfaces.dg_dx, surfaces.dg_dlambda, j, tangent);
    if (active && !(expected > flat_rate * start.s)) continue;
    if (!(side * there[j] >= 0.5 * expected)) return false;
  }
  return true;
}

PieceWays singular_ways(const Walker& walker, const CurvePoint& at, const Surfaces& surfaces,
                        const std::vector<Direction>& known) {
  const auto kernel = kernel_of(walker, at);
  if (!kernel) return {.why = "derivatives are not defined here"};
  if (is_own_curve(walker, at, *kernel)) return both_ways(at.tangent);
  if (nothing_new(walker, kernel->N, rates_in_kernel(at, surfaces, kernel->N), known)) return {};
  const auto near_enough = [&](const CurvePoint& start, const Direction& tangent) {
    return before_next_surface(walker, at, surfaces, start, tangent);
  };
  const Exits exits = exits_at(walker, at, kernel->corank, near_enough);
  PieceWays ways{.singular = true, .why = exits.why};
  for (const Exit& exit : exits.exits)
    ways.list.push_back(
        {exit.tangent, exit.start, std::max(exit.accuracy, one_place), exit.beyond});
  return ways;
}

}  // namespace springfold::continuation
