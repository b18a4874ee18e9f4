#include "continuation/locating/reduced_equation.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::continuation {
namespace {

/// Kernels of J as singular vectors, or, without its entries, by inverse iteration with the matrix that
/// they border.
bool find_kernels(const ExtendedMatrix& J, ReducedEquation& e) {
  const Index k = e.k;
  if (J.at.structured) {
    Borders kernels;
    const bool found = kernel_borders(J, k, kernels);
    e.L = kernels.B;
    e.N = kernels.C;
    return found;
  }
  const auto take = [&e, k](const Svd& svd) {
    e.N = svd.V.rightCols(k + 1);
    e.L = svd.U.rightCols(k);
  };
  take(divided_svd(J.dense, SingularVectors::full, SingularVectors::full));
  // Divide and conquer may lose the vectors of values that agree to the last digits, as symmetric structures have them.
  constexpr double lost = 1000 * promised_place;
  const double largest = J.dense.norm();
  if (!((J.dense * e.N).norm() < lost * largest) ||
      !((e.L.transpose() * J.dense).norm() < lost * largest))
    take(jacobi_svd(J.dense, SingularVectors::full, SingularVectors::full));
  return true;
}

/// Turns the basis so that lambda moves along its last column only.
bool turn_kernel(Matrix& N) {
  const Vector r = N.bottomRows(1).transpose();
  if (!(r.norm() > told_apart)) return false;
  const Matrix Q = orthonormal_basis(r);
  Matrix turned(N.rows(), N.cols());
  turned << N * Q.rightCols(N.cols() - 1), N * (r / r.norm());
  N = turned;
  return true;
}

/// D^2F[N_i, .] N by central differences of the exact derivatives, of sixth order in h; n x k + 1.
std::optional<Matrix> second_derivative(const ReducedEquation& e, Index i, double h) {
  constexpr int weights[]{45, -9, 1};
  Matrix sum = Matrix::Zero(e.L.rows(), e.k + 1);
  for (int j = 1; j <= 3; ++j) {
    const auto plus = jacobian_at(*e.walker, e.U0 + j * h * e.N.col(i), e.root, e.piece);
    const auto minus = jacobian_at(*e.walker, e.U0 - j * h * e.N.col(i), e.root, e.piece);
    if (!plus || !minus) return std::nullopt;
    if (plus->at.structured)
      sum += weights[j - 1] / (60 * h) * (product(*plus, e.N) - product(*minus, e.N));
    else
      sum += weights[j - 1] / (60 * h) * ((plus->dense - minus->dense) * e.N);
  }
  return sum;
}

/// Left borders B with L^T B = I that move as the matrix does along the path, D^2F[N_i, N_m]: what of these lies in the
/// range of J is the mode's own turning and no bend of the chart, but another mode that is nearly critical makes a
/// large one of it. L itself where the modes do not move.
Matrix moving_with_path(const ReducedEquation& e, double h) {
  const auto D = second_derivative(e, e.k, h);
  if (!e.follows || !D) return e.L;
  const Matrix moves = D->leftCols(e.k);
  const Lu share(e.L.transpose() * moves);
  if (!(share.smallest_pivot() > small_share * moves.norm())) return e.L;
  return share.solve_transposed(moves.transpose()).transpose();
}

bool expand(ReducedEquation& e, const ExtendedMatrix& J, const Matrix& B, double h) {
  const Index n = e.L.rows(), m = e.k + 1;
  e.B = B;
  e.bordered = BorderedMatrix(J, {e.B, e.N});
  e.quadratic.assign(static_cast<std::size_t>(e.k), Matrix::Zero(m, m));
  e.bend.clear();
  e.curvature = 0;
  for (Index i = 0; i < m; ++i) {
    const auto D = second_derivative(e, i, h);
    if (!D) return false;
    for (Index q = 0; q < e.k; ++q)
      e.quadratic[static_cast<std::size_t>(q)].row(i) = e.L.col(q).transpose() * *D;
    Matrix right = Matrix::Zero(n + m, m);
    right.topRows(n) = -0.5 * *D;
    const auto solved = e.bordered.solve(right);
    if (!solved || !solved->allFinite()) return false;
    const Matrix W = solved->topRows(n + 1);
    for (Index j = 0; j < m; ++j) e.bend.emplace_back(W.col(j));
    e.curvature = std::max(e.curvature, W.colwise().norm().maxCoeff());
  }
  for (Matrix& Q : e.quadratic) Q = (0.5 * (Q + Q.transpose())).eval();
  return true;
}

}  // namespace

Vector metric_roots(const Vector& weights) {
  const double least =
      tiny_share * std::max(weights.size() > 0 ? weights.maxCoeff() : 0.0, tiny_share);
  Vector root(weights.size() + 1);
  root << weights.unaryExpr([least](double w) { return std::sqrt(w > 0 ? w : least); }), 1.0;
  return root;
}

Vector scaled_point(const CurvePoint& at, const Vector& root) {
  Vector U(at.x.size() + 1);
  U << at.x, at.lambda;
  return U.cwiseProduct(root);
}

std::optional<ExtendedMatrix> jacobian_at(const Walker& walker, const Vector& U, const Vector& root,
                                          const Piece& piece, bool densely) {
  const Index n = U.size() - 1;
  const Vector x = U.head(n).cwiseQuotient(root.head(n)), columns = root.head(n).cwiseInverse();
  ExtendedMatrix J{.has_last = false};
  if (walker.problem.structured() && !densely) {
    if (!linearise(walker.problem, x, U[n], piece, J.at)) return std::nullopt;
    J.at.structured =
        std::make_shared<StructuredMatrix>(scaled(*J.at.structured, Vector::Ones(n), columns));
    return J;
  }
  Linearisation at;
  if (!linearise_densely(walker.problem, x, U[n], piece, at)) return std::nullopt;
  J.dense.resize(n, n + 1);
  J.dense << at.dF_dx * columns.asDiagonal(), at.dF_dlambda;
  return J;
}

std::optional<EquilibratedJacobian> equilibrated_jacobian(const Walker& walker,
                                                          const CurvePoint& at) {
  const Vector root = metric_roots(walker.weights), U = scaled_point(at, root);
  const auto here = jacobian_at(walker, U, root, at.piece, true);
  if (!here) return std::nullopt;
  const Matrix& J = here->dense;
  // How far away, and how much of what changes there counts.
  constexpr double aside = small_share, counts = negligible_share;
  Matrix sizes = J.cwiseAbs();
  const Vector direction = Vector::LinSpaced(U.size(), 1, 2).normalized();
  for (const double h : {-aside, aside})
    if (const auto other = jacobian_at(walker, U + h * direction, root, at.piece, true))
      sizes = sizes.cwiseMax(counts * (other->dense - J).cwiseAbs());
  const Equilibration scale = equilibrate(sizes);
  return EquilibratedJacobian{scale.rows.asDiagonal() * J * scale.columns.asDiagonal(),
                              scale.columns.cwiseQuotient(root), scale.rows};
}

bool residual_at(const ReducedEquation& e, const Vector& U, Vector& F) {
  const Index n = U.size() - 1;
  return e.walker->problem.residual(U.head(n).cwiseQuotient(e.root.head(n)), U[n], e.piece, F) &&
         F.allFinite();
}

std::optional<ReducedEquation> reduce(const Walker& walker, const CurvePoint& at, int corank) {
  ReducedEquation e{.walker = &walker, .piece = at.piece, .root = metric_roots(walker.weights)};
  e.U0 = scaled_point(at, e.root);
  e.k = corank;
  e.scale = std::max(1.0, e.U0.lpNorm<Eigen::Infinity>());
  const auto J = jacobian_at(walker, e.U0, e.root, e.piece);
  if (!J || !find_kernels(*J, e)) return std::nullopt;
  e.follows = turn_kernel(e.N);
  const auto is_flat = [&](const Matrix& B, double h) {
    return expand(e, *J, B, h) && h * e.curvature < small_share;
  };
  for (double h = tiny_share * e.scale; h > poor; h /= 10)
    if (is_flat(e.L, h) || is_flat(moving_with_path(e, h), h)) return e;
  return std::nullopt;
}

Vector bend_along(const ReducedEquation& e, const Vector& c) {
  const Index m = e.k + 1;
  Vector w = Vector::Zero(e.U0.size());
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) w += c[i] * c[j] * e.bend[static_cast<std::size_t>(i * m + j)];
  return w;
}

std::optional<ReducedValue> reduced_value(const ReducedEquation& e, const Vector& c) {
  const Index n = e.L.rows(), m = e.k + 1;
  const double rho = c.norm(), enough = std::max(one_place * rho * rho, rounding_unit * e.scale);
  const Vector U1 = e.U0 + e.N * c;
  Vector w = bend_along(e, c), g, F, right = Vector::Zero(n + m);
  BorderedMatrix own;
  const BorderedMatrix* system = &e.bordered;
  bool slow = false;
  const bool found = settles(12, [&](double before) -> std::optional<IterationStep> {
    if (slow) {
      const auto J = jacobian_at(*e.walker, U1 + w, e.root, e.piece);
      if (!J) return std::nullopt;
      own = BorderedMatrix(*J, {e.B, e.N});
      system = &own;
    }
    if (!residual_at(e, U1 + w, F)) return std::nullopt;
    right.head(n) = -F;
    const auto step = system->solve(right);
    if (!step) return std::nullopt;
    w += step->col(0).head(n + 1);
    g = -step->col(0).tail(e.k);
    if (!(w.norm() < rho)) return std::nullopt;
    const double moved = step->col(0).head(n + 1).norm();
    slow = moved > still_falls * before;
    return IterationStep{moved, enough, residual_level * e.scale};
  });
  return found ? std::optional(ReducedValue{U1 + w, g}) : std::nullopt;
}

std::optional<RayPoint> ray_point(const ReducedEquation& e, const Vector& start, double rho) {
  const Index n = e.L.rows();
  RayPoint ray{.U = start, .c = e.N.transpose() * (start - e.U0)};
  Matrix A(n + 1, n + 1);
  Vector F, right(n + 1);
  Lu lu;
  const bool found = settles(16, [&](double) -> std::optional<IterationStep> {
    const double length = ray.c.norm();
    const auto J = jacobian_at(*e.walker, ray.U, e.root, e.piece, true);
    if (!J || !residual_at(e, ray.U, F)) return std::nullopt;
    A << J->dense, (e.N * (ray.c / length)).transpose();
    right << -F, rho - length;
    lu.compute(A);
    Vector step = lu.solve(right);
    if (!step.allFinite()) return std::nullopt;
    const double moved = step.norm();
    if (moved > near_share * rho) step *= near_share * rho / moved;
    ray.U += step;
    ray.c = e.N.transpose() * (ray.U - e.U0);
    if ((ray.U - e.U0).norm() > 2 * rho || ray.c.norm() < near_share * rho) return std::nullopt;
    ray.noise = 0.5 * rounding_unit * e.scale * lu.largest_pivot() / lu.smallest_pivot() / rho;
    ray.sign = lu.sign();
    const bool small =
        F.lpNorm<Eigen::Infinity>() <=
        residual_bound(e.walker->problem, e.piece, e.walker->options.newton, e.scale);
    return IterationStep{moved, function_noise * rho, small ? near_share * told_apart * rho : 0};
  });
  if (!found) return std::nullopt;
  ray.rate = rho * lu.solve(Vector(Vector::Unit(n + 1, n)));
  if (!ray.rate.allFinite()) ray.rate.resize(0);
  return ray;
}

std::optional<Vector> quadratic_direction(const ReducedEquation& e, const Vector& start,
                                          double reach) {
  const Index m = e.k + 1;
  Vector c = start.normalized();
  double size = 0;
  for (const Matrix& Q : e.quadratic) size = std::max(size, Q.norm());
  if (!(size > 0) && e.k > 0) return std::nullopt;
  const bool found = settles(10, [&](double) -> std::optional<IterationStep> {
    Matrix A(m, m);
    Vector right(m);
    for (Index q = 0; q < e.k; ++q) {
      const Vector Qc = e.quadratic[static_cast<std::size_t>(q)] * c / size;
      A.row(q) = Qc.transpose();
      right[q] = -0.5 * c.dot(Qc);
    }
    A.row(e.k) = c.transpose();
    right[e.k] = 0;
    const Svd svd = jacobi_svd(A, SingularVectors::full, SingularVectors::full);
    if (!(svd.values[m - 1] > tiny_share)) return std::nullopt;
    const Vector step = svd.solve(right);
    c = (c + step).normalized();
    if (!((c - start.normalized()).norm() < reach)) return std::nullopt;
    return IterationStep{step.norm(), refined_step, residual_level};
  });
  return found ? std::optional(c) : std::nullopt;
}

}  // namespace springfold::continuation
