#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "quantities.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {

using continuation::CurvePoint;

RoundedRate Evaluator::rate(const QuantityDefinition& q, const CurvePoint& point) const {
  if (rated_column_ != q.name || !is_same(column_rate_.point, point)) {
    column_rate_ = {point, computed_rate(q, point)};
    rated_column_ = q.name;
  }
  return column_rate_.rate;
}

RoundedRate Evaluator::computed_rate(const QuantityDefinition& q, const CurvePoint& point) const {
  const double told = rates({q}, point).front() / q.scale;
  if (std::isnan(told)) return rate_by_differences(q, point);
  // Of how fast the mechanism moves at all: points lie off the curve.
  const Vector& dx = point.tangent.dx;
  return {told, off_curve_rate * std::sqrt(dx.dot(problem_.metric().cwiseProduct(dx)))};
}

namespace {

/// Derivative at zero from values at 0, h, ..., 5 h: error O(h^5).
constexpr std::array one_sided{-137.0 / 60, 5.0, -5.0, 10.0 / 3, -5.0 / 4, 1.0 / 5};

CurvePoint moved(const CurvePoint& point, double s) {
  CurvePoint beside = point;
  beside.x += s * point.tangent.dx;
  beside.lambda += s * point.tangent.dlambda;
  return beside;
}

/// Do all springs act there as the point's piece has it?
bool is_on_piece(const PathProblem& problem, const CurvePoint& point) {
  Vector g;
  if (point.piece.empty() || !problem.switches(point.x, point.lambda, g)) return true;
  for (Index j = 0; j < g.size(); ++j)
    if (g[j] * point.piece[static_cast<std::size_t>(j)] < 0) return false;
  return true;
}

}  // namespace

/// The way along the tangent is as long as the column is smooth: springs may switch nearby, so shorter ones follow
/// until two agree, and the best pair says what is left open. Values come from the point's own piece, at its edge from
/// one side.
RoundedRate Evaluator::rate_by_differences(const QuantityDefinition& q,
                                           const CurvePoint& point) const {
  constexpr std::array ways{1e-2, 2e-3, 4e-4, 8e-5};
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  constexpr int reach = 3, one_sided_reach = 5;
  double size = 0;
  const auto value = [&](double s) -> std::optional<Vector> {
    const double v = this->value(q, moved(point, s)) / q.scale;
    if (!std::isfinite(v)) return std::nullopt;
    size = std::max(size, std::abs(v));
    return Vector::Constant(1, v);
  };
  const auto rate_with = [&](double way) -> std::optional<double> {
    const auto agrees = [&](double s) { return is_on_piece(problem_, moved(point, s)); };
    if (agrees(reach * way) && agrees(-reach * way)) {
      const auto rate = six_point_derivative(value, 0, way);
      return rate ? std::optional((*rate)[0]) : std::nullopt;
    }
    const double h = agrees(one_sided_reach * way) ? way : -way;
    if (!agrees(one_sided_reach * h)) return std::nullopt;
    double sum = 0;
    for (std::size_t k = 0; k < one_sided.size(); ++k) {
      const auto at = value(static_cast<double>(k) * h);
      if (!at) return std::nullopt;
      sum += one_sided[k] * (*at)[0];
    }
    return sum / h;
  };
  RoundedRate best{std::numeric_limits<double>::quiet_NaN(), 0};
  std::optional<double> before;
  double least = std::numeric_limits<double>::infinity();
  for (const double way : ways) {
    const auto here = rate_with(way);
    if (!here) continue;
    const double noise = off_curve_rate + rounding * size / way;
    const double change = before ? std::abs(*here - *before) : least;
    if (std::isnan(best.value) || change < least) best = {*here, std::max(change, noise)};
    least = std::min(least, change);
    if (least <= noise) break;
    before = here;
  }
  // One alone is not checked by another.
  if (!std::isfinite(best.noise)) best.noise = off_curve_rate + rounding * size / ways.back();
  return best;
}

}  // namespace springfold::analysis
