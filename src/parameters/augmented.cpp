#include "parameters/augmented.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/core/finite.hpp"
#include "springfold/core/small_lu.hpp"

namespace springfold::continuation {
namespace {

/// Residuals above this are to be corrected: derivatives then serve the next correction alone, and need no more digits
/// than that leaves. Below it, with room for the units that the corrector measures them in, they are exact: tangents
/// and rates are made of them.
constexpr double still_far = promised_place;

Exactness exactness_for(const Vector& X, const Vector& F) {
  const double size = std::max(1.0, X.lpNorm<Eigen::Infinity>());
  return F.lpNorm<Eigen::Infinity>() > still_far * size ? Exactness::rough : Exactness::exact;
}

/// M^-1 (0, I) for M = [A B; C^T 0] with k columns in B and C. @returns false where M is singular to rounding
bool solve_borders(const Matrix& A, const Matrix& B, const Matrix& C, Matrix& result) {
  const Index rows = A.rows() + B.cols();
  result = unit_rows_below(rows, B.cols());
  if (SmallLu::fits(rows) && B.cols() == 1) {
    const SmallLu lu(A, B.col(0), C.col(0), 0);
    if (!(lu.smallest_pivot() > 0)) return false;
    lu.solve(result.data());
  } else if (SmallLu::fits(rows)) {
    const SmallLu lu(bordered(A, {B, C}));
    if (!(lu.smallest_pivot() > 0)) return false;
    lu.solve(result);
  } else {
    result = Lu(bordered(A, {B, C})).solve(result);
  }
  return all_finite(result);
}

/// The rotation that brings the columns of `left` nearest to those of `right`.
Matrix aligned(const Matrix& left, const Matrix& right) {
  const Svd svd =
      jacobi_svd(left.transpose() * right, SingularVectors::full, SingularVectors::full);
  return left * (svd.U * svd.V.transpose());
}

}  // namespace

double BorderedPlace::largest() const {
  return std::max(V.colwise().norm().maxCoeff(), W.colwise().norm().maxCoeff());
}

std::optional<BorderedPlace> bordered_place(const Family& family, const Vector& x, double lambda,
                                            double mu, const Piece& piece, const Matrix& B,
                                            const Matrix& C, BaseTerms storage) {
  BorderedPlace p{.base = std::move(storage)};
  if (!base_terms(family, x, lambda, mu, piece, p.base)) return std::nullopt;
  const Index n = x.size(), k = B.cols();
  Matrix solution;
  if (!solve_borders(p.base.A, B, C, solution)) return std::nullopt;
  p.V = solution.topRows(n);
  p.G = solution.bottomRows(k);
  const bool symmetric = family.at(mu)->symmetric() && B == C;
  if (!symmetric && !solve_borders(p.base.A.transpose(), C, B, solution)) return std::nullopt;
  p.W = solution.topRows(n);
  return p;
}

std::optional<NullVectors> null_vectors(const Family& family, const CriticalStart& at, int k) {
  BaseTerms base;
  if (!base_terms(family, at.x, at.lambda, at.mu, at.piece, base)) return std::nullopt;
  const Index n = at.x.size();
  if (n < k) return std::nullopt;
  const Matrix A = base.J.leftCols(n);
  NullVectors null{Matrix(n, k), Matrix(n, k)};
  if (family.at(at.mu)->symmetric()) {
    const SymmetricEigen eigen = symmetric_eigen(A);
    std::vector<Index> order(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = i;
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::abs(eigen.values[a]) < std::abs(eigen.values[b]);
    });
    for (int i = 0; i < k; ++i)
      null.right.col(i) = eigen.vectors.col(order[static_cast<std::size_t>(i)]);
    null.left = null.right;
    return null;
  }
  const Svd svd = jacobi_svd(A, SingularVectors::full, SingularVectors::full);
  null.right = svd.V.rightCols(k);
  null.left = aligned(svd.U.rightCols(k), null.right);
  return null;
}

Augmented::Augmented(const Family& family, const CriticalStart& start, NullVectors borders)
    : family_{family}, start_{start}, borders_{std::move(borders)}, n_{start.x.size()} {
  k_ = start.kind == CriticalKind::branch_point ? start.corank : 0;
  weights_ = Vector::Ones(size());
  if (has_force()) weights_[n_] = 0;
  periods_ = Vector::Zero(size());
  if (const auto problem = family_.at(start.mu)) {
    weights_.head(n_) = problem->metric();
    periods_.head(n_) = problem->periods();
    covers_ = problem->double_covers();
  }
}

bool Augmented::is_bordered() const {
  return start_.kind == CriticalKind::limit_point || start_.kind == CriticalKind::branch_point;
}

Vector Augmented::metric() const { return weights_; }
Vector Augmented::periods() const { return periods_; }

double Augmented::unfolding(const Vector& X) const {
  return k_ == 0 ? 0 : X.tail(k_).lpNorm<Eigen::Infinity>();
}

double Augmented::parting(const Vector& X, double mu) const {
  if (k_ < 2) return 0;
  const auto here = place(X, mu);
  return here ? here->G.lpNorm<Eigen::Infinity>() : infinity;
}

Vector Augmented::start_unknowns() const {
  Vector X = Vector::Zero(size());
  X.head(n_) = start_.x;
  X[n_] = start_.lambda;
  return X;
}

std::optional<BorderedPlace> Augmented::place(const Vector& X, double mu) const {
  return bordered_place(family_, state(X), lambda(X), mu, start_.piece, borders_.left,
                        borders_.right, std::move(spare_));
}

std::optional<double> Augmented::surface(const Vector& x, double lambda, double mu) const {
  if (start_.value) return start_.value(x, lambda, mu);
  const auto problem = family_.at(mu);
  Vector g;
  if (!problem || !problem->switches(x, lambda, g)) return std::nullopt;
  return g[start_.switching];
}

/// Exact for switches; differences for a function of the caller.
std::optional<Vector> Augmented::surface_gradient(const Vector& x, double lambda, double mu,
                                                  double* error) const {
  Vector gradient(n_ + 1);
  if (!start_.value) {
    const auto problem = family_.at(mu);
    Matrix dg_dx;
    Vector dg_dlambda;
    if (!problem || !problem->switch_gradients(x, lambda, dg_dx, dg_dlambda)) return std::nullopt;
    gradient.head(n_) = dg_dx.row(start_.switching).transpose();
    gradient[n_] = dg_dlambda[start_.switching];
    return gradient;
  }
  for (Index i = 0; i <= n_; ++i) {
    double off = 0;
    const auto rate = derivative_at_zero(
        [&](double t) -> std::optional<Vector> {
          Vector at = x;
          if (i < n_) at[i] += t;
          const auto value = start_.value(at, i < n_ ? lambda : lambda + t, mu);
          if (!value) return std::nullopt;
          return Vector::Constant(1, *value);
        },
        directional_step, &off);
    if (!rate) return std::nullopt;
    if (error != nullptr) *error = std::max(*error, off);
    gradient[i] = (*rate)[0];
  }
  return gradient;
}

std::optional<Augmented::Terms> Augmented::terms(const Vector& X, double mu) const {
  Terms terms;
  if (is_bordered()) {
    auto p = place(X, mu);
    if (!p) return std::nullopt;
    terms.at = std::move(*p);
    terms.last = terms.at.G.trace();
    if (k_ == 0) return terms;
    Vector right = Vector::Zero(n_ + k_);
    right.head(n_) = terms.at.base.J.col(n_);
    const Vector solution =
        Lu(bordered(terms.at.base.J.leftCols(n_), {borders_.left, borders_.right})).solve(right);
    terms.along.resize(n_ + 1, 1);
    terms.along << -solution.head(n_), 1.0;
    terms.load = solution.tail(k_);
    return terms;
  }
  if (!base_terms(family_, state(X), lambda(X), mu, start_.piece, terms.at.base))
    return std::nullopt;
  const auto value = surface(state(X), lambda(X), mu);
  if (!value) return std::nullopt;
  terms.last = *value;
  return terms;
}

bool Augmented::residual(const Vector& X, double mu, Vector& F) const {
  auto here = terms(X, mu);
  const bool defined = here && put_residual(X, *here, F);
  if (here) spare_ = std::move(here->at.base);
  return defined;
}

bool Augmented::derivatives(const Vector& X, double mu, Matrix& dF_dX, Vector& dF_dmu) const {
  auto here = terms(X, mu);
  if (!here) return false;
  Vector F;
  const auto exactness = put_residual(X, *here, F) ? exactness_for(X, F) : Exactness::exact;
  const bool defined = put_derivatives(X, mu, *here, exactness, dF_dX, dF_dmu);
  spare_ = std::move(here->at.base);
  return defined;
}

bool Augmented::equations(const Vector& X, double mu, Vector& F, Matrix& dF_dX,
                          Vector& dF_dmu) const {
  auto here = terms(X, mu);
  const bool defined = here && put_residual(X, *here, F) &&
                       put_derivatives(X, mu, *here, exactness_for(X, F), dF_dX, dF_dmu);
  if (here) spare_ = std::move(here->at.base);
  return defined;
}

bool Augmented::put_residual(const Vector& X, const Terms& terms, Vector& F) const {
  if (!std::isfinite(terms.last)) return false;
  F.resize(size());
  F.head(n_) = terms.at.base.F;
  if (k_ > 0) {
    F.head(n_) += borders_.left * X.tail(k_);
    F.segment(n_, k_) = terms.load;
  }
  F[n_ + k_] = terms.last;
  return true;
}

const Augmented::Differences* Augmented::known_differences(const Vector& X, double mu) const {
  if (exact_.X.size() != X.size()) return nullptr;
  const double size = std::max(1.0, X.lpNorm<Eigen::Infinity>());
  const double away = std::max((X - exact_.X).lpNorm<Eigen::Infinity>(), std::abs(mu - exact_.mu));
  return away <= exact_model * size ? &exact_ : nullptr;
}

/// Of the bordered kinds all that depends on mu is linear in the equations; surfaces are the caller's.
std::optional<double> Augmented::far_on_line(double mu) const {
  if (!is_bordered() || !family_.line) return std::nullopt;
  return family_.line(mu);
}

bool Augmented::put_rows(const Vector& X, double mu, const Terms& terms, Exactness exactness,
                         Matrix& rows) const {
  const Vector x = state(X);
  const double l = lambda(X);
  const Matrix &V = terms.at.V, &W = terms.at.W;
  const Index crossing = rows.rows() - 1;
  const auto second = [&](const Vector& w, const Vector& along) {
    return second_along(family_, x, l, mu, start_.piece, w, along, exactness);
  };
  for (Index i = 0; i < crossing; ++i) {
    const auto part = second(W.col(i), terms.along.col(0));
    if (!part) return false;
    rows.row(i) = part->transpose();
  }
  if (!is_bordered()) {
    const auto gradient = surface_gradient(x, l, mu);
    if (gradient) rows.row(crossing) = gradient->transpose();
    return gradient.has_value();
  }
  for (Index i = 0; i < V.cols(); ++i) {
    Vector along = Vector::Zero(n_ + 1);
    along.head(n_) = V.col(i);
    const auto part = second(W.col(i), along);
    if (!part) return false;
    rows.row(crossing) -= part->transpose();
  }
  return true;
}

bool Augmented::differences(const Vector& X, double mu, const Terms& terms, Exactness exactness,
                            Differences& found) const {
  const Vector x = state(X);
  const double l = lambda(X);
  const Matrix &V = terms.at.V, &W = terms.at.W;
  found.by_X = Matrix::Zero(k_ + 1, n_ + 1);
  if (!put_rows(X, mu, terms, exactness, found.by_X)) return false;
  const auto values_of = [&](const BaseTerms& base, double m) -> std::optional<Vector> {
    Vector values(n_ + k_ + 1);
    values.head(n_) = base.F;
    if (k_ > 0) values.segment(n_, k_) = W.transpose() * (base.J * terms.along);
    if (is_bordered()) {
      values[n_ + k_] = -(W.cwiseProduct(base.J.leftCols(n_) * V)).sum();
      return values;
    }
    const auto g = surface(x, l, m);
    if (!g) return std::nullopt;
    values[n_] = *g;
    return values;
  };
  const auto at_parameter = [&](double m) -> std::optional<Vector> {
    if (!base_terms(family_, x, l, m, start_.piece, far_)) return std::nullopt;
    return values_of(far_, m);
  };
  if (const auto other = far_on_line(mu)) {
    const auto far = at_parameter(*other), here = values_of(terms.at.base, mu);
    if (!far || !here) return false;
    found.by_mu = (*far - *here) / (*other - mu);
    found.error = 0;
  } else {
    // A member of the family is dear: neighbours share those of a grid.
    auto by_mu = derivative_by_parameter(at_parameter, mu, family_.step, exactness, found.error);
    if (!by_mu) return false;
    found.by_mu = std::move(*by_mu);
  }
  found.X = X;
  found.mu = mu;
  return true;
}

bool Augmented::put_derivatives(const Vector& X, double mu, const Terms& terms, Exactness exactness,
                                Matrix& dF_dX, Vector& dF_dmu) const {
  Differences own;
  const Differences* at = known_differences(X, mu);
  if (at == nullptr) {
    if (!differences(X, mu, terms, exactness, own)) return false;
    if (exactness == Exactness::exact) exact_ = std::move(own);
    at = exactness == Exactness::exact ? &exact_ : &own;
  }
  dF_dX = Matrix::Zero(size(), size());
  dF_dX.topLeftCorner(n_, n_ + 1) = terms.at.base.J;
  if (k_ > 0) dF_dX.topRightCorner(n_, k_) = borders_.left;
  dF_dX.bottomLeftCorner(k_ + 1, n_ + 1) = at->by_X;
  dF_dmu = at->by_mu;
  return dF_dX.allFinite() && dF_dmu.allFinite();
}

}  // namespace springfold::continuation
