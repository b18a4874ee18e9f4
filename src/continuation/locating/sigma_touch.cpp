#include "continuation/locating/sigma_touch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

constexpr Index touch_points = 16, touch_terms = 6;

/// 1, u, u^2, ...
Eigen::RowVectorXd powers(double u) {
  Eigen::RowVectorXd row(touch_terms);
  row[0] = 1;
  for (Index k = 1; k < touch_terms; ++k) row[k] = row[k - 1] * u;
  return row;
}

/// Is Sigma regular on the stretch within `half` of t, beyond its scatter around polynomials?
bool surely_regular_near(const WatchedStep& arc, const Borders& borders, double t, double half) {
  constexpr double beyond_doubt = 30;
  constexpr int grid = 32;
  const Index m = borders.B.cols();
  Matrix A(touch_points, touch_terms), entries(touch_points, m * m);
  for (Index i = 0; i < touch_points; ++i) {
    const double u = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / touch_points);
    const auto Sigma = arc.sigma(t + half * u, borders);
    if (!Sigma) return false;
    A.row(i) = powers(u);
    entries.row(i) = Sigma->reshaped().transpose();
  }
  const Matrix c = fitted(A, entries);
  const double scatter = (A * c - entries).norm() / std::sqrt(touch_points - touch_terms);
  const auto fitted = [&](int k) -> Matrix {
    const Vector at = (powers(0.5 * (2.0 * k / grid - 1)) * c).transpose();
    return at.reshaped(m, m);
  };
  for (int k = 0; k <= grid; ++k) {
    const Matrix here = fitted(k);
    const Lu lu(here);
    if (!(singular_values(here).minCoeff() > beyond_doubt * scatter)) return false;
    // Between this place and the next ones no matrix is singular, either.
    for (const int next : {k - 1, k + 1})
      if (!(lu.solve(fitted(next) - here).norm() < 0.5)) return false;
  }
  return true;
}

}  // namespace

Vector shrunk(const Matrix& from, const Matrix& to) {
  const Matrix share = Lu(from).solve(to);
  if (!share.allFinite()) return Vector::Ones(from.rows());
  Vector sizes = eigenvalues(share).cwiseAbs();
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

Index vanishing_modes(const WatchedStep& arc, Index m, const ZeroOf& zero) {
  const auto& middle = arc.point(0.5 * arc.length());
  const auto E = middle ? arc.matrix(*middle) : std::nullopt;
  if (!E) return m;
  const Borders borders = borders_of(*E, m);
  Index most = 0;
  // Not at the place itself, where points may be inexact.
  const double far = small_share * arc.length(), near = negligible_share * arc.length();
  for (const double side : {-1.0, 1.0}) {
    const double at = zero.at + side * far;
    if (at < arc.low() || at > arc.high()) continue;
    const auto there = arc.sigma(at, borders);
    const auto here = arc.sigma(zero.at + side * near, borders);
    if (there && here)
      most = std::max<Index>(most, (shrunk(*there, *here).array() < aside_share).count());
  }
  return most;
}

bool sigma_may_vanish(const WatchedStep& arc, const Borders& borders, const ZeroOf& touch) {
  for (const double share : half_decades<4>()) {
    const double half = small_share * share * arc.length();
    const double t = std::clamp(touch.at, arc.low() + half, arc.high() - half);
    // Two zeros within the stretch on which the determinant is lost in its rounding may lie beside a narrower window.
    if (t - 0.5 * half > touch.before || t + 0.5 * half < touch.after) continue;
    if (std::abs(t - touch.at) < half / 4 && surely_regular_near(arc, borders, t, half))
      return false;
  }
  return true;
}

}  // namespace springfold::continuation
