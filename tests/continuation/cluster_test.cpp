// Special points that rounding does not let tell apart: how many they are, and where the curve goes.
#include <gtest/gtest.h>

#include <numbers>

#include "tracing.hpp"
#include "von_mises.hpp"

namespace springfold::continuation {
namespace {

/// Three springs (stiffness 1, free length 1) from a ring of radius R to a point, pushed down by
/// lambda: gradient of 1/2 sum (L_i - 1)^2 + lambda z. On the axis: limit point at L^3 = R^2, double
/// branch points at L^3 - L^2 + R^2/2 = 0. All three fall together at R^2 = 8/27. The second unknown is y / unit.
struct ScaledDome {
  double R = 0.5, unit = 1;
  static Index size() { return 3; }
  static bool symmetric() { return true; }
  Vector arm(const Vector& u, int i) const {
    const double angle = 2 * std::numbers::pi * i / 3;
    return Vector{{u[0], unit * u[1], u[2]}} -
           Vector{{R * std::cos(angle), R * std::sin(angle), 0}};
  }
  bool residual(const Vector& u, double lambda, Vector& F) const {
    F = Vector{{0, 0, lambda}};
    for (int i = 0; i < 3; ++i) F += (1 - 1 / arm(u, i).norm()) * arm(u, i);
    F[1] *= unit;
    return true;
  }
  bool derivatives(const Vector& u, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix::Zero(3, 3);
    for (int i = 0; i < 3; ++i) {
      const Vector a = arm(u, i);
      const double L = a.norm();
      dF_dx += (1 - 1 / L) * Matrix::Identity(3, 3) + a * a.transpose() / (L * L * L);
    }
    dF_dx.row(1) *= unit;
    dF_dx.col(1) *= unit;
    dF_dlambda = Vector{{0, 0, 1}};
    return true;
  }
  double limit_height() const { return std::sqrt(std::cbrt(R * R * R * R) - R * R); }
  Curve pushed_down() const {
    const double top = 1.4 * limit_height();
    const double load = 3 * top * (1 / std::hypot(R, top) - 1);
    const StartPoint start{Vector{{0, 0, top}}, load, {}, {Vector{{0, 0, -1}}, 0}};
    return follow(*this, start, {x_reaches(0.5 * top, 2)});
  }
};

ScaledDome nearly_degenerate(double off, double unit = 1) {
  return {std::sqrt(8.0 / 27 * (1 - off)), unit};
}

TEST(Cluster, HasTheTotalMultiplicityOfItsPointsHoweverCloseTheyAre) {
  for (double off = 1e-2; off > 1e-14; off /= 10)
    for (const double unit : {1.0, 0.5}) {
      const Curve curve = nearly_degenerate(off, unit).pushed_down();
      ASSERT_EQ(curve.stop, StopReason::event) << off << ": " << curve.stop_detail;
      int total = 0;
      for (const Hit& hit : curve.hits)
        if (hit.kind != HitKind::user) total += hit.multiplicity;
      EXPECT_EQ(total, 5) << off << ", unit " << unit;
      EXPECT_NEAR(curve.hits.back().point.x.head(2).norm(), 0, 1e-6) << off << ": left the axis";
    }
}

TEST(Cluster, IsAnIntervalAroundItsPoints) {
  const ScaledDome dome = nearly_degenerate(1e-11);
  const Curve curve = dome.pushed_down();
  const auto clusters = hits_of(curve, HitKind::unresolved);
  ASSERT_EQ(clusters.size(), 1u);
  const Hit& cluster = clusters.front();
  EXPECT_EQ(cluster.multiplicity, 5);
  EXPECT_LT(cluster.s_after - cluster.s_before, 0.02);
  EXPECT_NEAR(cluster.point.x[2], dome.limit_height(), 0.01);
  for (const CurvePoint& p : curve.points)
    EXPECT_FALSE(p.s > cluster.s_before && p.s < cluster.s_after) << "a point within it";
}

TEST(CloseCall, EigenvaluesThatTurnBackTogetherJustBeforeZeroAreNoTouch) {
  for (double off = 3.3e-2; off > 1e-14; off /= 10)
    for (const auto& [unit, share] : {std::pair(1.0, 1.0), {0.07, 1.0}, {0.03, 1.0}, {1.0, 0.5}}) {
      const Curve curve = nearly_degenerate(-share * off, unit).pushed_down();
      ASSERT_EQ(curve.stop, StopReason::event) << share * off << ": " << curve.stop_detail;
      ASSERT_EQ(curve.hits.size(), 2u) << share * off;
      EXPECT_TRUE(curve.hits[0].kind == HitKind::limit_point ||
                  (share * off < 2e-8 && curve.hits[0].kind == HitKind::unresolved))
          << share * off;
    }
}

TEST(CloseCall, BranchPointsOfSwayThatNearlyMeetAreTwo) {
  for (double off = 1e-3; off > 5e-14; off /= 10) {
    const VonMises truss{.a = std::sqrt(4.0 / 27 * (1 - off)), .k = 1, .L0 = 1};
    const StartPoint start{Vector{{0, 0.6}}, truss.upright_load(0.6), {}, {Vector{{0, -1}}, 0}};
    const Curve curve = follow(truss, start, {x_reaches(0.5, 1)});
    EXPECT_EQ(hits_of(curve, HitKind::branch_point).size(), 2u) << off;
  }
}

}  // namespace
}  // namespace springfold::continuation
