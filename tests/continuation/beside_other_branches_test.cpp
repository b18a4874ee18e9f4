// Kinks just behind a branch point of a path that bends, folds of a piece on the surface where branches cross, and
// closed curves that pass another branch: Newton's method must not be led to the neighbour, nor the neighbour be
// counted as the curve.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// F = D^T (F1, F2) with D = d(x, Y)/d(x, y), Y = y - m x^2: a gradient. F1 = a x + c x^2 + K [x]^+ - lambda is the
/// path, which bends as y = m x^2; F2 = Y (Y - k (lambda + d)) has a branch that crosses it at lambda = -d.
struct BentPath {
  double a = 1, c = 0, K = 0, k = 0, d = 0, m = 0;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  static Index switch_count() { return 1; }
  double slope(const Piece& piece) const { return a + (piece[0] > 0 ? K : 0); }
  double load(double x) const { return (a + (x > 0 ? K : 0)) * x + c * x * x; }
  bool residual(const Vector& q, double lambda, const Piece& piece, Vector& F) const {
    const double x = q[0], Y = q[1] - m * x * x;
    const double F1 = slope(piece) * x + c * x * x - lambda, F2 = Y * (Y - k * (lambda + d));
    F = Vector{{F1 - 2 * m * x * F2, F2}};
    return true;
  }
  bool derivatives(const Vector& q, double lambda, const Piece& piece, Matrix& dF_dq,
                   Vector& dF_dlambda) const {
    const double x = q[0], Y = q[1] - m * x * x, F2 = Y * (Y - k * (lambda + d));
    const double by_Y = 2 * Y - k * (lambda + d), by_x = -2 * m * x * by_Y;
    dF_dq = Matrix{{slope(piece) + 2 * c * x - 2 * m * F2 - 2 * m * x * by_x, -2 * m * x * by_Y},
                   {by_x, by_Y}};
    dF_dlambda = Vector{{-1 + 2 * m * x * k * Y, -k * Y}};
    return true;
  }
  static bool switches(const Vector& q, double, Vector& g) {
    g = q.head(1);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{1, 0}};
    dg_dlambda = Vector::Zero(1);
    return true;
  }
  StartPoint start(double x) const {
    const Piece piece{static_cast<std::int8_t>(x > 0 ? 1 : -1)};
    const double sense = x > 0 ? -1 : 1;
    return {Vector{{x, m * x * x}},
            load(x),
            piece,
            {sense * Vector{{1, 2 * m * x}}, sense * (slope(piece) + 2 * c * x)}};
  }
};

TEST(Kinks, BehindABranchPointLieOnTheCurveThatReachesThem) {
  for (const double distance : {1e-2, 1e-3, 2e-4, 3e-5, 3e-6})
    for (const double k : {-0.05, 0.3, 0.02})
      for (const double from : {0.129, 0.171, -0.14}) {
        const double side = from > 0 ? 1 : -1;
        const BentPath path{1, -0.5, from > 0 ? 2.6 : 0.8, k, -side * distance, 1.7};
        const Curve curve = follow(path, path.start(from), {x_reaches(-0.06 * side)});
        ASSERT_EQ(curve.stop, StopReason::event) << distance << ", " << k << ", " << from;
        EXPECT_EQ(hits_of(curve, HitKind::branch_point).size(), 1u)
            << distance << ", " << k << ", " << from;
        EXPECT_TRUE(hits_of(curve, HitKind::unresolved).empty());
        for (const CurvePoint& p : curve.points)
          EXPECT_NEAR(p.x[1], path.m * p.x[0] * p.x[0], 1e-9) << distance << ", " << k;
      }
}

/// On x < 0 the path has its fold at the surface, where it is crossed: Y = 0 and Y = k c x^2 touch each other there. On
/// x > 0 there are Y = 0 and Y = k lambda.
TEST(Rays, LeaveAFoldOnASurfaceAlongBothOfTwoBranchesThatTouch) {
  const BentPath path{0, 1.054, -3.05, -0.24, 0, 0};
  const Rays rays = rays_from(path, Vector::Zero(2), 0, {1}, {});
  EXPECT_TRUE(rays.complete) << rays.why;
  EXPECT_EQ(rays.rays.size(), 4u);
}

/// Two circles that do not meet: f = (|p - centre|^2 - r^2) / (2 r) of each, p = (x, lambda), and F is their product.
struct TwoCircles {
  double r = 0.5, other = 0.9, gap = 0, angle = 0;
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = Vector::Constant(1, own(x[0], lambda) * far(x[0], lambda));
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const double f = own(x[0], lambda), g = far(x[0], lambda), d = r + other + gap;
    const double u = x[0] - d * std::cos(angle), v = lambda - d * std::sin(angle);
    dF_dx = Matrix::Constant(1, 1, x[0] / r * g + f * u / other);
    dF_dlambda = Vector::Constant(1, lambda / r * g + f * v / other);
    return true;
  }

 private:
  double own(double x, double lambda) const { return (x * x + lambda * lambda - r * r) / (2 * r); }
  double far(double x, double lambda) const {
    const double d = r + other + gap;
    const double u = x - d * std::cos(angle), v = lambda - d * std::sin(angle);
    return (u * u + v * v - other * other) / (2 * other);
  }
};

TEST(ClosedCurves, AreTracedOnceFromBesideAnotherBranch) {
  for (const double gap : {1e-2, 1.5e-3, 1.5e-4, 1e-5, 3e-6})
    for (const double angle : {0.467, 2.88, 4.1})
      for (const double beside : {0.027, -0.0036, 0.09}) {
        const TwoCircles circles{0.5, 0.93, gap, angle};
        const double t = angle + beside;
        const StartPoint start =
            at(0.5 * std::cos(t), 0.5 * std::sin(t), -std::sin(t), std::cos(t));
        const Curve curve = follow(circles, start, {});
        EXPECT_EQ(curve.stop, StopReason::closed) << gap << ", " << angle << ", " << beside;
        EXPECT_EQ(hits_of(curve, HitKind::limit_point).size(), 2u)
            << gap << ", " << angle << ", " << beside;
      }
}

}  // namespace
}  // namespace springfold::continuation
