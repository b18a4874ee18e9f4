#include "parameters/held_modes.hpp"

#include <algorithm>
#include <cmath>

#include "parameters/family_differences.hpp"
#include "parameters/solve_augmented.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {
namespace {

Vector lengthened(const Vector& x, Index more, double value) {
  Vector longer = Vector::Constant(x.size() + more, value);
  longer.head(x.size()) = x;
  return longer;
}

/// Orthonormal columns that span what is orthogonal to a direction, size x (size - 1).
Matrix across(const Vector& direction) {
  const Index size = direction.size();
  Matrix columns(size, size);
  columns.col(0) = direction.normalized();
  Index found = 1;
  Index leading = 0;
  direction.cwiseAbs().maxCoeff(&leading);
  for (Index i = 0; i < size; ++i) {
    if (i == leading) continue;
    Vector next = Vector::Unit(size, i);
    for (Index j = 0; j < found; ++j) next -= columns.col(j).dot(next) * columns.col(j);
    columns.col(found++) = next.normalized();
  }
  return columns.rightCols(size - 1);
}

/// Forms C with C^T V = I that vanish on all that the symmetry keeps: W^T D^2F [path, .], since a symmetry that keeps
/// the path changes the sign of W. Nothing where they say nothing of V, or are V itself.
Matrix holding_forms(const Family& family, const CriticalStart& at, const Matrix& W,
                     const Matrix& V, const Vector& path) {
  const Index n = at.x.size(), h = V.cols();
  Vector along = Vector::Zero(n + 1);
  along.head(n) = path;
  Matrix forms(n, h);
  for (Index i = 0; i < h; ++i) {
    const auto form = second_along(family, at.x, at.lambda, at.mu, at.piece, W.col(i), along);
    if (!form) return {};
    forms.col(i) = form->head(n);
  }
  const Matrix on_V = forms.transpose() * V;
  const Vector sizes = jacobi_svd(on_V).values;
  if (!(sizes[h - 1] > poor * forms.norm())) return {};
  const Matrix C = Lu(on_V).solve(Matrix(forms.transpose())).transpose();
  return (C - V).norm() <= poor * V.norm() ? Matrix() : C;
}

}  // namespace

void HeldProblem::add_modes(const Vector& X, Vector& F) const {
  const Index n = inner_.size(), h = start_.held_right.cols();
  F.conservativeResize(n + h);
  F.head(n) += start_.held_left * X.tail(h);
  F.tail(h) = held_by(start_).transpose() * (X.head(n) - start_.x);
}

bool HeldProblem::residual(const Vector& X, double lambda, const Piece& piece, Vector& F) const {
  if (!inner_.residual(X.head(inner_.size()), lambda, piece, F)) return false;
  add_modes(X, F);
  return true;
}

bool HeldProblem::derivatives(const Vector& X, double lambda, const Piece& piece, Matrix& dF_dX,
                              Vector& dF_dlambda) const {
  const Index n = inner_.size(), h = start_.held_right.cols();
  Matrix dF_dx;
  if (!inner_.derivatives(X.head(n), lambda, piece, dF_dx, dF_dlambda)) return false;
  dF_dX = Matrix::Zero(n + h, n + h);
  dF_dX.topLeftCorner(n, n) = dF_dx;
  dF_dX.topRightCorner(n, h) = start_.held_left;
  dF_dX.bottomLeftCorner(h, n) = held_by(start_).transpose();
  dF_dlambda = lengthened(dF_dlambda, h, 0);
  return true;
}

/// The equations of the held modes are linear.
bool HeldProblem::second_along(const Vector& X, double lambda, const Piece& piece, const Vector& w,
                               const Vector& V, Vector& value) const {
  const Index n = inner_.size(), h = start_.held_right.cols();
  Vector inner_V(n + 1), inner_value;
  inner_V << V.head(n), V[n + h];
  if (!inner_.second_along(X.head(n), lambda, piece, w.head(n), inner_V, inner_value)) return false;
  value.setZero(n + h + 1);
  value.head(n) = inner_value.head(n);
  value[n + h] = inner_value[n];
  return true;
}

bool HeldProblem::switch_gradients(const Vector& X, double lambda, Matrix& dg_dX,
                                   Vector& dg_dlambda) const {
  const Index n = inner_.size(), h = start_.held_right.cols();
  Matrix dg_dx;
  if (!inner_.switch_gradients(X.head(n), lambda, dg_dx, dg_dlambda)) return false;
  dg_dX = Matrix::Zero(dg_dx.rows(), n + h);
  dg_dX.leftCols(n) = dg_dx;
  return true;
}

bool HeldProblem::symmetric() const {
  return inner_.symmetric() && start_.held_left == held_by(start_);
}

Vector HeldProblem::metric() const {
  return lengthened(inner_.metric(), start_.held_right.cols(), 1);
}

Vector HeldProblem::periods() const {
  return lengthened(inner_.periods(), start_.held_right.cols(), 0);
}

HeldFamily::HeldFamily(const Family& family, const CriticalStart& start) : start_{start} {
  held_.step = family.step;
  held_.line = family.line;
  held_.at = [this, &family](double mu) -> std::optional<ProblemView> {
    const auto inner = family.at(mu);
    if (!inner) return std::nullopt;
    problem_.emplace(*inner, start_);
    return ProblemView(*problem_);
  };
}

CriticalStart HeldFamily::start() const {
  CriticalStart start = start_;
  start.x = lengthened(start_.x, start_.held_right.cols(), 0);
  start.held_left = start.held_right = start.held_by = {};
  return start;
}

CriticalPoint HeldFamily::own(CriticalPoint point) const {
  point.x.conservativeResize(start_.x.size());
  if (point.dx.size() > start_.x.size()) point.dx.conservativeResize(start_.x.size());
  return point;
}

double HeldFamily::unfolding(const CriticalPoint& point) const {
  return point.x.tail(start_.held_right.cols()).lpNorm<Eigen::Infinity>();
}

double HeldFamily::unfolding_of_rate(const CriticalPoint& point) const {
  return point.dx.tail(start_.held_right.cols()).lpNorm<Eigen::Infinity>();
}

bool parts_modes(const Family& family, const CriticalStart& start, const CriticalPoint& rate) {
  const auto eigenvalues = [&](double t) -> std::optional<Vector> {
    BaseTerms at;
    if (!base_terms(family, start.x + t * rate.dx, start.lambda + t * rate.dlambda, start.mu + t,
                    start.piece, at))
      return std::nullopt;
    return Vector((start.held_left.transpose() * at.A * start.held_right).reshaped());
  };
  const auto change = derivative_at_zero(eigenvalues, family.step);
  // With a unit of a small parameter everything changes little: then only rounding of differences is nothing.
  const double own = std::max(std::abs(rate.dlambda), rate.dx.lpNorm<Eigen::Infinity>());
  return !change || change->lpNorm<Eigen::Infinity>() > std::max(poor * own, residual_level);
}

CriticalCurve follow_held(const Family& family, const CriticalStart& start, bool growing,
                          std::vector<CriticalEvent> events, const TraceOptions& options,
                          const std::function<bool(const CriticalPoint&)>& observer,
                          const FurtherPoints& further) {
  const HeldFamily held(family, start);
  for (CriticalEvent& event : events)
    event.value = [&held, of = std::move(event.value)](const CriticalPoint& p) {
      return of(held.own(p));
    };
  const std::function<bool(const CriticalPoint&)> observe = [&](const CriticalPoint& p) {
    return held.unfolding(p) <= kept_within && (!observer || observer(held.own(p)));
  };
  CriticalCurve curve =
      follow_critical(held.family(), held.start(), growing, events, options, observe, further);
  const auto lost = std::find_if(curve.points.begin(), curve.points.end(),
                                 [&](const auto& p) { return held.unfolding(p) > kept_within; });
  if (lost != curve.points.end()) {
    const double end = lost->s;
    curve.kept = false;
    curve.stop_detail = "the second parameter does not keep the branch";
    curve.points.erase(lost, curve.points.end());
    std::erase_if(curve.hits, [end](const CriticalHit& hit) { return hit.point.s >= end; });
  }
  for (CriticalPoint& p : curve.points) p = held.own(std::move(p));
  for (CriticalHit& hit : curve.hits) hit.point = held.own(std::move(hit.point));
  return curve;
}

std::optional<CriticalStart> hilltop_start(const Family& family, const CriticalStart& branch_point,
                                           const Direction& path) {
  if (std::abs(path.dlambda) > root_of_rounding * path.dx.norm()) return std::nullopt;
  // The path's own mode, and those of the branches that cross it.
  const auto null = null_vectors(family, branch_point, branch_point.corank + 1);
  BaseTerms base;
  if (!null || !base_terms(family, branch_point.x, branch_point.lambda, branch_point.mu,
                           branch_point.piece, base))
    return std::nullopt;
  if ((base.A * null->right).norm() > poor * std::max(1.0, base.A.norm())) return std::nullopt;
  const Vector along = null->right.transpose() * path.dx;
  const Vector loaded = null->left.transpose() * base.b;
  const bool turns = (null->right * along - path.dx).norm() <= poor * path.dx.norm() &&
                     loaded.norm() > poor * base.b.norm();
  if (!turns) return std::nullopt;
  CriticalStart start = branch_point;
  start.kind = CriticalKind::limit_point;
  start.corank = 1;
  start.held_left = null->left * across(loaded);
  const bool symmetric = family.at(branch_point.mu)->symmetric();
  start.held_right = symmetric ? start.held_left : Matrix(null->right * across(along));
  start.held_by = holding_forms(family, branch_point, start.held_left, start.held_right, path.dx);
  // Without forms the modes themselves have to hold: none of them along the path.
  const Vector on_path = start.held_right.transpose() * path.dx;
  if (start.held_by.size() == 0 && on_path.norm() > poor * path.dx.norm())
    start.held_right = null->right * across(along);
  return start;
}

}  // namespace springfold::continuation
