// Short ways to start a trace, and the laws that every traced curve must meet.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "problems.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

struct StartPoint {
  Vector x{};
  double lambda = 0;
  Piece piece{};
  Direction towards{};  ///< of the two ways the one nearer to this is taken
};

/// Reflection at a plane askew to all axes: mixes n unknowns and leaves the curves as they are.
inline Matrix mirrored(Index n) {
  Vector v(n);
  for (Index i = 0; i < n; ++i) v[i] = 1 + 0.3 * std::cos(2.0 * static_cast<double>(i));
  return Matrix::Identity(n, n) - 2 / v.squaredNorm() * v * v.transpose();
}

/// Start of a scalar problem.
inline StartPoint at(double x, double lambda, double dx, double dlambda, Piece piece = {}) {
  return {Vector::Constant(1, x), lambda, std::move(piece), {Vector::Constant(1, dx), dlambda}};
}

inline TraceOptions steps_up_to(double longest) {
  TraceOptions options;
  options.step.maximum = longest;
  options.step.initial = std::min(options.step.initial, longest);
  return options;
}

inline Event stop_where(std::string name, std::function<double(const CurvePoint&)> value) {
  return {std::move(name), std::move(value), EventAction::stop};
}

inline Event x_reaches(double value, Index i = 0) {
  return stop_where("x", [value, i](const CurvePoint& p) { return p.x[i] - value; });
}

inline Event lambda_reaches(double value) {
  return stop_where("lambda", [value](const CurvePoint& p) { return p.lambda - value; });
}

inline Ray ray_of(ProblemView problem, const StartPoint& start, const TraceOptions& options) {
  const Rays rays = rays_from(problem, start.x, start.lambda, start.piece, options);
  EXPECT_TRUE(rays.complete) << rays.why;
  const auto along = [&](const Ray& ray) {
    return metric_product(problem.metric(), ray.tangent, start.towards);
  };
  return *std::max_element(rays.rays.begin(), rays.rays.end(),
                           [&](const Ray& a, const Ray& b) { return along(a) < along(b); });
}

/// Laws: every point on the curve with a unit tangent along it, s increasing, every special point
/// on the curve and inside the interval that proves it, in the order of s; the last one stops the curve, or none does.
inline void expect_laws(ProblemView problem, const Curve& curve) {
  const Vector weights = problem.metric();
  const auto expect_on_curve = [&](const CurvePoint& p, const std::string& what) {
    Vector F;
    Linearisation linear;
    ASSERT_TRUE(problem.residual(p.x, p.lambda, p.piece, F)) << what;
    ASSERT_TRUE(linearise(problem, p.x, p.lambda, p.piece, linear)) << what;
    const double scale = std::max({1.0, p.x.lpNorm<Eigen::Infinity>(), std::abs(p.lambda)});
    EXPECT_LE(F.lpNorm<Eigen::Infinity>(), 1e-12 * scale) << what << " at s = " << p.s;
    EXPECT_NEAR(metric_product(weights, p.tangent, p.tangent), 1, 1e-12) << what;
    const Vector off = linear.dF_dx * p.tangent.dx + linear.dF_dlambda * p.tangent.dlambda;
    const double slope = std::max(1.0, linear.dF_dx.norm());
    EXPECT_LE(off.norm(), 1e-7 * slope) << what << " at s = " << p.s;
  };
  double s = -1;
  for (const CurvePoint& p : curve.points) {
    expect_on_curve(p, "point");
    EXPECT_GT(p.s, s);
    s = p.s;
  }
  s = 0;
  const bool ends_at_one = curve.stop == StopReason::event || curve.stop == StopReason::joined ||
                           curve.stop == StopReason::several_ways ||
                           curve.stop == StopReason::no_way_out ||
                           curve.stop == StopReason::turns_upon_itself;
  for (const Hit& hit : curve.hits) {
    if (hit.kind != HitKind::unresolved) expect_on_curve(hit.point, hit.name);
    EXPECT_LE(hit.s_before, hit.s_after) << hit.name;
    EXPECT_GE(hit.point.s, hit.s_before - 1e-9) << hit.name;
    EXPECT_LE(hit.point.s, hit.s_after + 1e-9) << hit.name;
    EXPECT_GE(hit.point.s, s - 1e-9) << hit.name << ": special points come in the order of s";
    EXPECT_EQ(hit.stops, ends_at_one && &hit == &curve.hits.back()) << hit.name;
    s = hit.point.s;
  }
  EXPECT_FALSE(to_string(curve.stop).empty());
}

/// Traces from `start` until one of the events stops it, and checks the laws.
inline Curve follow(ProblemView problem, const StartPoint& start, const std::vector<Event>& events,
                    const TraceOptions& options = {}, const StepObserver& observer = {}) {
  EXPECT_TRUE(problems_in(options).empty());
  const Ray ray = ray_of(problem, start, options);
  Curve curve = trace(problem, start.x, start.lambda, ray, events, options, observer);
  expect_laws(problem, curve);
  return curve;
}

inline std::vector<Hit> hits_of(const Curve& curve, HitKind kind) {
  std::vector<Hit> hits;
  std::copy_if(curve.hits.begin(), curve.hits.end(), std::back_inserter(hits),
               [kind](const Hit& hit) { return hit.kind == kind; });
  return hits;
}

/// Same special points in the same order, by kind, place and multiplicity.
inline void expect_same_hits(const std::vector<Hit>& a, const std::vector<Hit>& b,
                             double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].multiplicity, b[i].multiplicity);
    EXPECT_LT((a[i].point.x - b[i].point.x).norm(), tolerance) << a[i].name << " " << i;
    EXPECT_NEAR(a[i].point.lambda, b[i].point.lambda, tolerance) << a[i].name << " " << i;
  }
}

}  // namespace springfold::continuation
