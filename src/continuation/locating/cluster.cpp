#include "continuation/locating/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "continuation/locating/tested_step.hpp"
#include "continuation/points/chebyshev.hpp"
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
bool surely_regular_near(const TestedStep& arc, const Borders& borders, double t, double half) {
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

using Roots = std::vector<std::complex<double>>;

/// All zeros of the interpolating polynomial, as places on [-1, 1] and beside it.
Roots roots_of(const Interpolant& p) {
  constexpr Index n = Interpolant::samples;
  Matrix powers(n, n);
  Vector values(n);
  for (Index i = 0; i < n; ++i) {
    const double t = 2 * (p.at[static_cast<std::size_t>(i)] - p.a) / (p.b - p.a) - 1;
    for (Index k = 0; k < n; ++k) powers(i, k) = std::pow(t, static_cast<double>(k));
    values[i] = p.values(0, i);
  }
  Vector c = Lu(powers).solve(values);
  // Coefficients that rounding alone may have made would have zeros far away.
  Index degree = n - 1;
  while (degree > 0 && std::abs(c[degree]) <= function_noise * c.cwiseAbs().maxCoeff()) --degree;
  if (degree == 0) return {};
  Matrix companion = Matrix::Zero(degree, degree);
  companion.bottomLeftCorner(degree - 1, degree - 1).setIdentity();
  companion.col(degree - 1) = -c.head(degree) / c[degree];
  const Eigen::VectorXcd roots = eigenvalues(companion);
  return {roots.begin(), roots.end()};
}

/// A function on the step, interpolated; nothing where that is not accurate.
std::optional<Interpolant> accurate(const SampledFunction& f, double a, double b) {
  auto p = interpolate_value(f, a, b);
  if (!p) return std::nullopt;
  // A check that falls among the special points, which are expected in the middle, may be spoilt by rounding; most must
  // not.
  const double scale = p->values.cwiseAbs().maxCoeff();
  int good = 0;
  for (const double share : shares_towards_ends<6>()) {
    const double t = a + share * (b - a);
    const auto value = f(t);
    const double error = value ? std::abs(*value - p->first(t)) : 0;
    if (!(error <= negligible_share * scale)) return std::nullopt;
    if (value && error <= together * scale) ++good;
  }
  if (good < 4) return std::nullopt;
  return p;
}

/// Zeros of lambda's rate and of det Sigma; nothing if one of them is not smooth on the step.
std::optional<Roots> all_roots(const TestedStep& arc, Samples samples) {
  std::vector<ExtendedMatrix> E;
  for (const CurvePoint* p : samples) {
    auto matrix = arc.matrix(*p);
    if (!matrix) return std::nullopt;
    E.push_back(std::move(*matrix));
  }
  const std::size_t middle = E.size() / 2;
  const Borders borders = borders_of(E[middle], reach_of(E, middle).order);
  const auto determinant = [&](double ds) -> std::optional<double> {
    const auto Sigma = arc.sigma(ds, borders);
    return Sigma ? std::optional<double>(Sigma->determinant()) : std::nullopt;
  };
  const auto rate = [&](double ds) { return arc.rate(ds); };
  // A family at one lambda is no cluster.
  if (std::none_of(samples.begin(), samples.end(),
                   [](const CurvePoint* p) { return std::abs(p->tangent.dlambda) > flat_rate; }))
    return std::nullopt;
  Roots all;
  for (const SampledFunction& f : {SampledFunction(determinant), SampledFunction(rate)}) {
    const auto p = accurate(f, arc.low(), arc.high());
    if (!p) return std::nullopt;
    const Roots roots = roots_of(*p);
    all.insert(all.end(), roots.begin(), roots.end());
  }
  return all;
}

}  // namespace

Vector shrunk(const Matrix& from, const Matrix& to) {
  const Matrix share = Lu(from).solve(to);
  if (!share.allFinite()) return Vector::Ones(from.rows());
  Vector sizes = eigenvalues(share).cwiseAbs();
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

Index vanishing_modes(const TestedStep& arc, Index m, const ZeroOf& zero) {
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

bool sigma_may_vanish(const TestedStep& arc, const Borders& borders, const ZeroOf& touch) {
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

std::optional<Hit> cluster_on_step(const Walker& walker, Samples samples) {
  // Shares of half the step: how wide a cluster may be, and how far from the step's ends.
  constexpr double wide = 0.35, clear = wide;
  const CurvePoint &from = *samples.front(), &to = *samples.back();
  const TestedStep arc(walker, samples);
  const auto roots = all_roots(arc, samples);
  if (!roots) return std::nullopt;
  Roots near;
  for (const auto& root : *roots)
    if (std::abs(root.real()) <= 1 && std::abs(root.imag()) <= clear) near.push_back(root);
  if (near.empty()) return std::nullopt;
  double centre = 0;
  for (const auto& root : near) centre += root.real() / static_cast<double>(near.size());
  double radius = negligible_share;
  for (const auto& root : near) radius = std::max(radius, std::abs(root - centre));
  if (radius > wide || std::abs(centre) > 1 - clear) return std::nullopt;

  const double half = 0.5 * (arc.high() - arc.low());
  const double place = arc.low() + half * (1 + centre);
  radius *= 1.5;
  Hit hit{.kind = HitKind::unresolved,
          .name = "unresolved: special points too close together to be told apart"};
  hit.multiplicity = static_cast<int>(near.size());
  hit.s_before = from.s + std::max(0.0, place - radius * half);
  hit.s_after = from.s + std::min(arc.length(), place + radius * half);
  const auto& point = arc.point(place);
  hit.point = point ? *point : arc.point(place + radius * half).value_or(to);
  hit.point.negative.reset();
  hit.s_before = std::min(hit.s_before, hit.point.s);
  hit.s_after = std::max(hit.s_after, hit.point.s);
  if (from.negative && to.negative && std::abs(*to.negative - *from.negative) > hit.multiplicity)
    return std::nullopt;
  return hit;
}

}  // namespace springfold::continuation
