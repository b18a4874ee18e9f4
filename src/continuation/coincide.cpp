#include "coincide.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/locate.hpp"

namespace springfold::continuation {

Vector nearest_signs(const std::vector<Index>& double_covers, const Vector& x, const Vector& near) {
  Vector signs = Vector::Ones(x.size());
  for (const Index i : double_covers)
    if (x.segment<4>(i).dot(near.segment<4>(i)) < 0) signs.segment<4>(i).setConstant(-1);
  return signs;
}

Direction direction_seen_from(const Walker& walker, const Vector& near, const CurvePoint& point) {
  Direction direction = point.tangent;
  const auto covers = walker.problem.double_covers();
  if (!covers.empty())
    direction.dx = direction.dx.cwiseProduct(nearest_signs(covers, point.x, near)).eval();
  return direction;
}

Direction between(const Walker& walker, const CurvePoint& a, const CurvePoint& b) {
  Direction d{b.x, b.lambda - a.lambda};
  const auto covers = walker.problem.double_covers();
  if (!covers.empty()) d.dx = d.dx.cwiseProduct(nearest_signs(covers, b.x, a.x)).eval();
  d.dx -= a.x;
  const Vector periods = walker.problem.periods();
  for (Index i = 0; i < d.dx.size(); ++i)
    if (periods[i] > 0) d.dx[i] = std::remainder(d.dx[i], periods[i]);
  return d;
}

double length_of(const Walker& walker, const Direction& d) {
  return std::sqrt(metric_product(walker.weights, d, d));
}

double cosine(const Walker& walker, const Direction& a, const Direction& b) {
  const double lengths = length_of(walker, a) * length_of(walker, b);
  return lengths > 0 ? metric_product(walker.weights, a, b) / lengths : 0;
}

bool coincide(const Walker& walker, const CurvePoint& a, const CurvePoint& b) {
  const double scale = std::max({1.0, a.x.norm(), std::abs(a.lambda)});
  return a.piece == b.piece && length_of(walker, between(walker, a, b)) <= 1e-7 * scale &&
         std::abs(cosine(walker, a.tangent, direction_seen_from(walker, a.x, b))) >= 0.999;
}

std::optional<CurvePoint> passes(const Walker& walker, const CurvePoint& target,
                                 const CurvePoint& from, const CurvePoint& to) {
  if (target.piece != from.piece) return std::nullopt;
  const Direction offset = between(walker, from, target);
  const double h = to.s - from.s;
  const double along = metric_product(walker.weights, offset, from.tangent);
  // The curve bends away from its tangent by no more than a fraction of the step.
  if (!(along > 0 && along <= h) || length_of(walker, offset) > 1.2 * h) return std::nullopt;
  auto point = point_at(walker, from, along);
  if (!point) return std::nullopt;
  if (!coincide(walker, *point, target)) return std::nullopt;
  return point;
}

std::optional<CurvePoint> start_again(const Walker& walker, const CurvePoint& start,
                                      const CurvePoint& from, const CurvePoint& to) {
  if (!(from.s > 0)) return std::nullopt;
  auto point = passes(walker, start, from, to);
  if (!point || cosine(walker, point->tangent, direction_seen_from(walker, point->x, start)) < 0)
    return std::nullopt;
  return point;
}

}  // namespace springfold::continuation
