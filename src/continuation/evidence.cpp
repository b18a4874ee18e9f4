#include "springfold/continuation/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "springfold/continuation/branch_point.hpp"
#include "springfold/continuation/locate.hpp"
#include "words.hpp"

namespace springfold::continuation {
namespace {

double length(const Vector& weights, const Direction& d) {
  return std::sqrt(metric_product(weights, d, d));
}

Direction between(const CurvePoint& a, const CurvePoint& b) {
  return {b.x - a.x, b.lambda - a.lambda};
}

/// Residual on the predictor line at a quarter, half and three quarters against its end. A smooth
/// curve gives t^2, near an inflection t^3; the limits leave room for changing curvature.
std::string residual_doubt(const Walker& walker, const CurvePoint& from, double ds) {
  constexpr std::array<std::pair<double, double>, 3> limits{{{0.25, 0.4}, {0.5, 0.6}, {0.75, 0.9}}};
  constexpr double noise = 1e-12;
  const auto size_at = [&](double t) {
    Vector F;
    const double d = t * ds;
    const bool inside = walker.problem.residual(
        from.x + d * from.tangent.dx, from.lambda + d * from.tangent.dlambda, from.piece, F);
    return inside && F.size() > 0 ? F.norm() : 0.0;
  };
  const double at_end = size_at(1), scale = std::max(1.0, from.x.norm());
  for (const auto& [t, limit] : limits)
    if (size_at(t) > limit * at_end + noise * scale)
      return "residual does not grow evenly along the predictor: another branch may be near";
  return {};
}

/// Distance of the corrected middle from the cubic through both ends, across the curve.
double off_cubic(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                 const CurvePoint& middle) {
  const double chord = length(walker.weights, between(from, to));
  Direction off{middle.x - 0.5 * (from.x + to.x) - chord / 8 * (from.tangent.dx - to.tangent.dx),
                middle.lambda - 0.5 * (from.lambda + to.lambda) -
                    chord / 8 * (from.tangent.dlambda - to.tangent.dlambda)};
  const double along = metric_product(walker.weights, off, middle.tangent);
  off.dx -= along * middle.tangent.dx;
  off.dlambda -= along * middle.tangent.dlambda;
  return length(walker.weights, off);
}

/// Errors that residuals at rounding level leave where dF/dx is nearly singular.
double corrector_noise(const Walker& walker, const CurvePoint& point) {
  const auto spectrum = walker.problem.symmetric() ? spectrum_at(walker, point) : std::nullopt;
  if (!spectrum || spectrum->size() == 0) return 0;
  const double least = spectrum->cwiseAbs().minCoeff(), scale = std::max(1.0, point.x.norm());
  return least > 0 ? 1e-13 * scale / least : 1;
}

}  // namespace

Evidence examine(const Walker& walker, const CurvePoint& from, const CurvePoint& to) {
  const double ds = to.s - from.s;
  Evidence evidence;
  evidence.doubt = residual_doubt(walker, from, ds);
  if (!evidence.doubt.empty()) return evidence;
  evidence.middle = point_at(walker, from, 0.5 * ds);
  if (!evidence.middle) {
    evidence.doubt = "no point of the curve found half-way";
    return evidence;
  }
  const CurvePoint& middle = *evidence.middle;
  const auto bend = [&](const CurvePoint& p) {
    Direction d = between(from, p);
    const double along = p.s - from.s;
    d.dx -= along * from.tangent.dx;
    d.dlambda -= along * from.tangent.dlambda;
    return length(walker.weights, d);
  };
  constexpr double share = 0.1;
  const double noise = 1e-11 + corrector_noise(walker, middle);
  const double off = off_cubic(walker, from, to, middle);
  const double allowed = share * std::max(bend(middle), 0.25 * bend(to)) + noise;
  if (off > allowed) {
    evidence.doubt = "the point half-way is " + rounded(off / ds) +
                     " steps off the cubic through both ends: another branch may be near";
    return evidence;
  }
  return evidence;
}

}  // namespace springfold::continuation
