#include "continuation/points/arc.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "continuation/points/coincide.hpp"
#include "continuation/points/normalised.hpp"
#include "continuation/points/workspace.hpp"

namespace springfold::continuation {

double way_to(const Vector& weights, const CurvePoint& origin, const CurvePoint& point) {
  return (weights.array() * (point.x - origin.x).array() * origin.tangent.dx.array()).sum() +
         (point.lambda - origin.lambda) * origin.tangent.dlambda;
}

bool ArcModel::go_through(const Vector& weights, const CurvePoint& origin, Samples nodes) {
  bool in_order = interpolate(weights, origin, nodes);
  for (std::size_t k = 2; k < knots_; k += 2) in_order = in_order && at_[k] > at_[k - 1];
  if (!in_order) knots_ = 0;
  return in_order;
}

bool ArcModel::interpolate(const Vector& weights, const CurvePoint& origin, Samples nodes) {
  assert(nodes.size() <= most_nodes);
  knots_ = 0;
  const Index n = origin.x.size();
  const auto order = static_cast<Index>(2 * nodes.size());
  if (c_.rows() != n + 1 || c_.cols() != order) c_.resize(n + 1, order);
  rate_.resize(n + 1);
  for (Index i = 0; i < order; i += 2) {
    const CurvePoint& p = *nodes[static_cast<std::size_t>(i / 2)];
    const double t = way_to(weights, origin, p);
    const auto k = static_cast<std::size_t>(i);
    const auto known = at_.begin() + i;
    if (!(metric_product(weights, p.tangent, origin.tangent) > 0) || !std::isfinite(t) ||
        std::find(at_.begin(), known, t) != known)
      return false;
    at_[k] = at_[k + 1] = t;
    for (const Index c : {i, i + 1}) c_.col(c) << p.x, p.lambda;
  }
  const auto column = [](std::size_t i) { return static_cast<Index>(i); };
  for (std::size_t k = 1; k < static_cast<std::size_t>(order); ++k)
    for (std::size_t i = static_cast<std::size_t>(order) - 1; i >= k; --i) {
      const double width = at_[i] - at_[i - k];
      if (width != 0) {
        c_.col(column(i)) = (c_.col(column(i)) - c_.col(column(i - 1))) / width;
        continue;
      }
      const CurvePoint& p = *nodes[i / 2];
      const double along = metric_product(weights, p.tangent, origin.tangent);
      c_.col(column(i)).head(n) = p.tangent.dx / along;
      c_(n, column(i)) = p.tangent.dlambda / along;
    }
  knots_ = static_cast<std::size_t>(order);
  return true;
}

void ArcModel::evaluate(double t, Vector& u, Vector& rate, Index left_out) const {
  const Index last = c_.cols() - 1 - 2 * left_out, n = c_.rows();
  u = c_.col(last);
  rate.setZero(n);
  for (Index i = last - 1; i >= 0; --i) {
    const double away = t - at_[static_cast<std::size_t>(i)];
    for (Index k = 0; k < n; ++k) {
      rate[k] = u[k] + away * rate[k];
      u[k] = c_(k, i) + away * u[k];
    }
  }
}

double ArcModel::rate_of_lambda(double t) const {
  const Index n = c_.rows() - 1;
  double value = c_(n, c_.cols() - 1), rate = 0;
  for (Index i = c_.cols() - 2; i >= 0; --i) {
    const double away = t - at_[static_cast<std::size_t>(i)];
    rate = value + away * rate;
    value = c_(n, i) + away * value;
  }
  return rate;
}

void ArcModel::point(const Vector& weights, const CurvePoint& origin, double t,
                     CurvePoint& point) const {
  evaluate(t, u_, rate_);
  const Index n = u_.size() - 1;
  point.x = u_.head(n);
  point.lambda = u_[n];
  point.tangent.dx = rate_.head(n);
  point.tangent.dlambda = rate_[n];
  const double length = std::sqrt(metric_product(weights, point.tangent, point.tangent));
  point.tangent.dx /= length;
  point.tangent.dlambda /= length;
  point.s = origin.s + t;
  point.piece = origin.piece;
  point.negative.reset();
}

double distance_of(const Walker& walker, const ArcModel& model, const CurvePoint& origin,
                   const CurvePoint& point) {
  CurvePoint& expected = walker.memory->trial;
  Direction& off = walker.memory->direction;
  model.point(walker.weights, origin, way_to(walker.weights, origin, point), expected);
  off.dx = expected.x - point.x;
  off.dlambda = expected.lambda - point.lambda;
  return length_of(walker, off);
}

std::vector<Stretch> smooth_stretches(const Walker& walker, const Normalised& own,
                                      const Curve& curve) {
  std::vector<Stretch> found{{own.inside(curve.points.front())}};
  const auto begin = [&](const CurvePoint& point) { found.push_back({own.inside(point)}); };
  const auto add = [&](const CurvePoint& point) {
    const CurvePoint& before = found.back().back();
    if (!(point.s > before.s)) return;
    if (point.piece != before.piece) return begin(point);
    CurvePoint next = own.inside(point);
    next.tangent = direction_seen_from(walker, before.x, next);
    next.x = before.x + between(walker, before, next).dx;
    found.back().push_back(std::move(next));
  };
  auto hit = curve.hits.begin();
  const auto take_hits = [&](double until) {
    for (; hit != curve.hits.end() && hit->point.s <= until; ++hit) {
      const bool last = hit + 1 == curve.hits.end() && hit->point.s > curve.points.back().s;
      if (hit->switches.empty() && !last) continue;
      add(hit->point);
      begin(hit->leaving.empty() ? hit->point : hit->leaving.front());
    }
  };
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    take_hits(curve.points[i].s);
    add(curve.points[i]);
  }
  take_hits(infinity);
  return found;
}

}  // namespace springfold::continuation
