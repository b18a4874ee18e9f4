// Turns of lambda on stretches as long as a step on which rounding hides its rate: what they are is a matter of
// the curve, not of the steps.
#include <gtest/gtest.h>

#include <cmath>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Gradient of e (P(z) - lambda z) + 1/2 sum (w_i - sin(i z))^2 with P'' = c prod (z - a_i)^m_i, in unknowns mirrored
/// at a plane: lambda turns at a_i if m_i is odd. The springs are stiff beside the small c, and hide lambda's rate.
struct FlatLadder {
  double c = 1;
  std::vector<double> a{};  ///< one for each factor: a touch is there twice
  double e = 1;
  static constexpr Index n = 5;

  static Index size() { return n; }
  static bool symmetric() { return true; }
  static Matrix mirror() { return mirrored(n); }
  double slope(double z) const {
    double value = c;
    for (const double place : a) value *= z - place;
    return value;
  }
  /// Integral of the slope from 0: four pieces of Gauss's rule with four points, exact to degree seven.
  double load(double z) const {
    constexpr double x[] = {0.3399810435848563, 0.8611363115940526};
    constexpr double w[] = {0.6521451548625461, 0.3478548451374538};
    double sum = 0;
    for (int i = 0; i < 2; ++i)
      for (const double side : {-1.0, 1.0}) sum += w[i] * slope(0.5 * z * (1 + side * x[i]));
    return 0.5 * z * sum;
  }
  bool residual(const Vector& q, double lambda, Vector& F) const {
    const Vector z = mirror() * q;
    Vector f(n);
    f[0] = e * (load(z[0]) - lambda);
    for (Index i = 1; i < n; ++i) {
      const auto k = static_cast<double>(i);
      f[i] = z[i] - std::sin(k * z[0]);
      f[0] -= f[i] * k * std::cos(k * z[0]);
    }
    F = mirror() * f;
    return true;
  }
  bool derivatives(const Vector& q, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    const Vector z = mirror() * q;
    Matrix H = Matrix::Identity(n, n);
    H(0, 0) = e * slope(z[0]);
    for (Index i = 1; i < n; ++i) {
      const auto k = static_cast<double>(i);
      const double rate = k * std::cos(k * z[0]);
      H(0, i) = H(i, 0) = -rate;
      H(0, 0) += rate * rate + (z[i] - std::sin(k * z[0])) * k * k * std::sin(k * z[0]);
    }
    dF_dx = mirror() * H * mirror();
    dF_dlambda = -e * mirror().col(0);
    return true;
  }
  Vector at(double z) const {
    Vector point(n);
    point[0] = z;
    for (Index i = 1; i < n; ++i) point[i] = std::sin(static_cast<double>(i) * z);
    return mirror() * point;
  }
  static double place(const Hit& hit) { return (mirror() * hit.point.x)[0]; }
  /// From z upwards, with all step limits multiplied.
  Curve traced(double z, double end, double steps) const {
    TraceOptions options;
    options.step.initial *= steps;
    options.step.maximum *= steps;
    options.step.minimum *= steps;
    options.maximum_points = 100000;
    const Vector towards = at(z + 1e-4) - at(z);
    return follow(
        *this, {at(z), load(z), {}, {towards, 0}},
        {stop_where("end", [=](const CurvePoint& p) { return (mirror() * p.x)[0] - end; })},
        options);
  }
};

constexpr double all_steps[] = {0.125, 0.25, 0.5, 1, 2, 4};

std::vector<Hit> special_points(const Curve& curve) {
  std::vector<Hit> hits = curve.hits;
  std::erase_if(hits, [](const Hit& hit) { return hit.kind == HitKind::user; });
  return hits;
}

TEST(FlatTurns, AreTheSameTouchesAtAllStepLengths) {
  // What rounding lets be placed: an error of the rate moves its minimum by the error's slope over 2 c.
  for (const auto& [c, error] : {std::pair{1e-3, 2e-6}, {1e-5, 5e-5}, {1e-6, 2e-4}})
    for (const double steps : all_steps) {
      const FlatLadder ladder{c, {0.1, 0.1, 0.4, 0.4}};
      const Curve curve = ladder.traced(-0.3, 0.7, steps);
      ASSERT_EQ(curve.stop, StopReason::event) << c << ", " << steps << ": " << curve.stop_detail;
      const auto hits = special_points(curve);
      ASSERT_EQ(hits.size(), 2u) << c << ", steps x " << steps;
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(hits[i].kind, HitKind::touch) << c << ", steps x " << steps;
        EXPECT_EQ(hits[i].multiplicity, 2);
        EXPECT_NEAR(FlatLadder::place(hits[i]), i == 0 ? 0.1 : 0.4, error)
            << c << ", steps x " << steps;
      }
    }
}

TEST(FlatTurns, BesideATouchAreLimitPointsAtAllStepLengths) {
  for (const double steps : all_steps)
    for (const double start : {-0.3, -0.31, -0.325}) {
      const FlatLadder ladder{1e-5, {0.1, 0.1, 0.13, 0.5}};
      const Curve curve = ladder.traced(start, 0.7, steps);
      const auto hits = special_points(curve);
      ASSERT_EQ(hits.size(), 3u) << "steps x " << steps;
      EXPECT_EQ(hits[0].kind, HitKind::touch);
      EXPECT_EQ(hits[1].kind, HitKind::limit_point);
      EXPECT_EQ(hits[2].kind, HitKind::limit_point);
      EXPECT_NEAR(FlatLadder::place(hits[0]), 0.1, 1e-4);
      EXPECT_NEAR(FlatLadder::place(hits[1]), 0.13, 5e-5);
      EXPECT_NEAR(FlatLadder::place(hits[2]), 0.5, 1e-7);
    }
}

TEST(FlatTurns, ThatRoundingBarelyTellsApartAreTwoAtAllStepLengths) {
  for (const double steps : all_steps)
    for (const double start : {-0.3, -0.31, -0.325}) {
      const FlatLadder ladder{1e-4, {0.1, 0.1005, 0.4}};
      const auto hits = special_points(ladder.traced(start, 0.7, steps));
      ASSERT_EQ(hits.size(), 3u) << "steps x " << steps;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(hits[i].kind, HitKind::limit_point) << "steps x " << steps;
        EXPECT_NEAR(FlatLadder::place(hits[i]), ladder.a[i], 5e-5) << "steps x " << steps;
      }
    }
}

TEST(FlatTurns, OfFourthOrderAreReportedOnce) {
  for (const double c : {1e-2, 1e-3, 1e-4})
    for (const double steps : all_steps) {
      const FlatLadder ladder{c, {0.1, 0.1, 0.1, 0.1}};
      const Curve curve = ladder.traced(-0.3, 0.7, steps);
      ASSERT_EQ(curve.stop, StopReason::event) << c << ", " << steps << ": " << curve.stop_detail;
      const auto hits = special_points(curve);
      ASSERT_EQ(hits.size(), 1u) << c << ", steps x " << steps;
      EXPECT_EQ(hits[0].kind, HitKind::touch) << c << ", steps x " << steps;
      EXPECT_NEAR(FlatLadder::place(hits[0]), 0.1, 0.01) << c << ", steps x " << steps;
    }
}

TEST(FlatTurns, BesideStiffMembersThatLeaveLambdaRoomAreNoFamily) {
  int clear = 0;
  for (const double e : {1e-2, 1e-3, 1e-5})
    for (const double c : {1.0, 1e-2, 1e-3, 1e-4})
      for (const double steps : {0.5, 2.0}) {
        const FlatLadder ladder{c, {-0.1, 0.1, 0.1, 0.4}, e};
        const Curve curve = ladder.traced(-0.3, 0.7, steps);
        EXPECT_TRUE(hits_of(curve, HitKind::family).empty()) << e << ", " << c << ", x " << steps;
        // Where rounding hides more, that is said.
        if (!hits_of(curve, HitKind::unresolved).empty()) continue;
        const auto hits = special_points(curve);
        ASSERT_EQ(hits.size(), 3u) << e << ", " << c << ", steps x " << steps;
        EXPECT_EQ(hits[0].kind, HitKind::limit_point);
        EXPECT_EQ(hits[1].kind, HitKind::touch);
        EXPECT_EQ(hits[2].kind, HitKind::limit_point);
        ++clear;
      }
  EXPECT_GE(clear, 8);  // a third of them
}

TEST(FlatTurns, TooFlatForAnyStepAreUnresolvedAndNotPassedInSilence) {
  for (const double steps : all_steps) {
    const FlatLadder ladder{1e-9, {0.1, 0.1, 0.1, 0.1}};
    const Curve curve = ladder.traced(-0.3, 0.7, steps);
    EXPECT_FALSE(hits_of(curve, HitKind::unresolved).empty() &&
                 hits_of(curve, HitKind::family).empty() && curve.stop == StopReason::event)
        << "steps x " << steps;
    EXPECT_TRUE(hits_of(curve, HitKind::limit_point).empty()) << "steps x " << steps;
  }
}

}  // namespace
}  // namespace springfold::continuation
