#include "continuation/following/tube_test.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// Of the motion of M with a tube's radius, which is nearly linear, so much is aimed at when the radius is made
/// smaller.
constexpr double aim = 1 - small_share;

/// The direction v of unit length across the curve in which |M v| is smallest, roughly, by inverse iteration.
/// @param along  the last row of M, of unit length
Vector weakest_across(const Lu& M, const Vector& along) {
  constexpr int rounds = 4;
  Vector v(along.size());
  for (Index i = 0; i < v.size(); ++i) v[i] = irregular(i, 0);
  for (int i = 0; i < rounds; ++i) {
    v -= along.dot(v) * along;
    v.normalize();
    v = M.solve(Vector(M.solve_transposed(v)));
  }
  v -= along.dot(v) * along;
  return v.normalized();
}

}  // namespace

TubeTest::TubeTest(const Walker& walker, const Piece& piece)
    : walker_{walker}, piece_{piece}, n_{walker.weights.size()} {
  scale_.resize(n_ + 1);
  scale_ << walker.weights.unaryExpr([](double w) { return w > 0 ? std::sqrt(w) : 1.0; }), 1.0;
}

bool TubeTest::residual(const Vector& u, Vector& F) {
  x_ = u.head(n_);
  return walker_.problem.residual(x_, u[n_], piece_, F) && F.allFinite();
}

bool TubeTest::derivatives(const Vector& u, Matrix& J) {
  x_ = u.head(n_);
  if (!linearise_densely(walker_.problem, x_, u[n_], piece_, linearisation_)) return false;
  J.resize(n_, n_ + 1);
  J.leftCols(n_) = linearisation_.dF_dx * scale_.head(n_).cwiseInverse().asDiagonal();
  J.col(n_) = linearisation_.dF_dlambda;
  return true;
}

/// The model and the derivatives at the ends and the middle of the window.
bool TubeTest::begin(const ArcModel& model, const Window& window) {
  const std::array<double, 3> places{window.begin, window.middle(), window.end};
  for (std::size_t i = 0; i < places.size(); ++i) {
    model.evaluate(places[i], at_[i], rate_);
    if (i == 1) {
      row_ = rate_.cwiseProduct(scale_);
      for (Index j = 0; j < n_; ++j)
        if (!(walker_.weights[j] > 0)) row_[j] = 0;
      row_.normalize();
    }
    if (!derivatives(at_[i], J_[i])) return false;
  }
  return row_.allFinite();
}

/// |S (J(u) - J)|, in the norm of Frobenius, which is not less than the wanted one; infinity outside of the domain.
double TubeTest::change(const Vector& u, const Matrix& J) {
  if (!derivatives(u, trial_)) return infinity;
  return (S_ * (trial_ - J)).norm();
}

std::optional<double> TubeTest::radius(double longest) {
  constexpr int tries = 8;
  // The change of a matrix across the curve is measured in its weakest direction: elsewhere it may be so many times
  // larger.
  constexpr double displaced_safety = 2, most = 0.5 / displaced_safety;
  double error = 0, along = 0;
  for (std::size_t i = 0; i < at_.size(); ++i) {
    if (!residual(at_[i], F_)) return std::nullopt;
    error = std::max(error, between_samples * (S_ * F_).norm());
    along = std::max(along, (S_ * (J_[i] - J_[1])).norm());
  }
  if (!(along < most)) return std::nullopt;
  double r = longest;
  for (int i = 0; i < tries && error <= 0.5 * r; ++i) {
    const Vector aside = r * weakest_.cwiseQuotient(scale_);
    double across = 0;
    for (std::size_t k = 0; k < at_.size(); ++k)
      for (const double side : {-1.0, 1.0})
        across = std::max(across, change(at_[k] + side * aside, J_[k]));
    if (along + across <= most) return r;
    r *= std::clamp(aim * (most - along) / across, small_share, 0.5);
  }
  return std::nullopt;
}

std::optional<double> TubeTest::regular(const ArcModel& model, const Window& window) {
  if (!begin(model, window)) return std::nullopt;
  Matrix M(n_ + 1, n_ + 1);
  M << J_[1], row_.transpose();
  const Lu lu(M);
  if (!(lu.smallest_pivot() > rounding_unit * lu.largest_pivot())) return std::nullopt;
  S_ = lu.solve(Matrix(Matrix::Identity(n_ + 1, n_)));
  weakest_ = weakest_across(lu, row_);
  if (!S_.allFinite() || !weakest_.allFinite()) return std::nullopt;
  return radius(window.length());
}

std::optional<double> TubeTest::crossing(const ArcModel& model, const Window& window) {
  if (!begin(model, window)) return std::nullopt;
  Matrix M = Matrix::Zero(n_ + 2, n_ + 2);
  M.topLeftCorner(n_, n_ + 1) = J_[1];
  M.row(n_).head(n_ + 1) = row_.transpose();
  const Svd weak =
      divided_svd(M.topLeftCorner(n_ + 1, n_ + 1), SingularVectors::thin, SingularVectors::thin);
  weakest_ = weak.V.col(n_);
  border_ = weak.U.col(n_).head(n_);
  M.col(n_ + 1).head(n_) = border_;
  M.row(n_ + 1).head(n_ + 1) = weakest_.transpose();
  const Lu lu(M);
  if (!(lu.smallest_pivot() > rounding_unit * lu.largest_pivot())) return std::nullopt;
  S_ = lu.solve(Matrix(Matrix::Identity(n_ + 2, n_)));
  if (!S_.allFinite()) return std::nullopt;
  const auto found = radius(window.length());
  return found && sigma_is_rounding(model, window) ? found : std::nullopt;
}

/// Solves the bordered equations on hyperplanes of the window, by Newton's method with the matrix at its middle, which
/// the test of the tube has shown to contract.
bool TubeTest::sigma_is_rounding(const ArcModel& model, const Window& window) {
  constexpr int places = 5, most_corrections = 40;
  const double size = std::max(1.0, at_[1].cwiseProduct(scale_).norm());
  Vector u, F;
  for (int i = 0; i < places; ++i) {
    model.evaluate(window.begin + window.length() * i / (places - 1), u, rate_);
    double sigma = 0, last = infinity;
    for (int k = 0; k < most_corrections; ++k) {
      if (!residual(u, F)) return false;
      const Vector correction = S_ * (F + sigma * border_);
      u -= correction.head(n_ + 1).cwiseQuotient(scale_);
      sigma -= correction[n_ + 1];
      const double length = correction.norm();
      if (!(length < last) || length <= rounding_unit * size) break;
      last = length;
    }
    if (!(std::abs(sigma) <= walker_.options.newton.residual_tolerance * size)) return false;
  }
  return true;
}

}  // namespace springfold::continuation
