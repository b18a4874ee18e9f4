// Which arcs of a curve are verified: tubes never reach a neighbouring branch, simple branch points are crossed on
// their own branch, and a curve that changed to another branch is not called verified there.
#include "springfold/continuation/verification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "crossing.hpp"
#include "exit_problems.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

TraceOptions verifying() {
  TraceOptions options;
  options.verify_arcs = true;
  return options;
}

/// Laws: arcs are in order and without gaps, from the curve's begin to its end.
void expect_to_cover(const Curve& curve) {
  ASSERT_FALSE(curve.arcs.empty());
  EXPECT_EQ(curve.arcs.front().s_begin, curve.points.front().s);
  for (std::size_t i = 1; i < curve.arcs.size(); ++i)
    EXPECT_NEAR(curve.arcs[i].s_begin, curve.arcs[i - 1].s_end, 1e-14);
  EXPECT_GE(curve.arcs.back().s_end, curve.points.back().s);
}

const Arc& arc_at(const Curve& curve, double s) {
  return *std::find_if(curve.arcs.begin(), curve.arcs.end(),
                       [s](const Arc& arc) { return s <= arc.s_end; });
}

/// x - h(lambda) = 0 and the same shifted by `gap`: two branches that do not meet.
ScalarProblem strands(double gap) {
  return {[gap](double x, double l) { return (x - std::sin(l)) * (x - std::sin(l) - gap); },
          [gap](double x, double l) { return 2 * (x - std::sin(l)) - gap; },
          [gap](double x, double l) { return -std::cos(l) * (2 * (x - std::sin(l)) - gap); }};
}

TEST(VerifiedArcs, AreNotLookedForUnlessTheOptionAsks) {
  EXPECT_TRUE(follow(circle(), at(1, 0, 0, 1), {}).arcs.empty());
}

TEST(VerifiedArcs, CoverAWholeCircleWithItsLimitPoints) {
  const Curve curve = follow(circle(), at(1, 0, 0, 1), {}, verifying());
  ASSERT_EQ(curve.stop, StopReason::closed);
  expect_to_cover(curve);
  for (const Arc& arc : curve.arcs) {
    EXPECT_EQ(arc.evidence, ArcEvidence::regular);
    EXPECT_LT(arc.radius, 2) << "the line across the circle meets it again";
  }
  EXPECT_EQ(lengths_of(curve.arcs).share(), 1);
}

class Strands : public testing::TestWithParam<double> {};

TEST_P(Strands, HaveTubesThatDoNotReachTheNextOne) {
  const double gap = GetParam();
  const Curve curve = follow(strands(gap), at(0, 0, 1, 1), {lambda_reaches(2)}, verifying());
  expect_to_cover(curve);
  EXPECT_GT(lengths_of(curve.arcs).share(), 0.99);
  for (const Arc& arc : curve.arcs) {
    EXPECT_NE(arc.evidence, ArcEvidence::crossing);
    EXPECT_LT(arc.radius, gap);  // across the curve the other strand is not farther than that
  }
}

INSTANTIATE_TEST_SUITE_P(Gaps, Strands, testing::Values(1e-4, 1e-3, 1e-2, 0.1, 1.0));

TEST(VerifiedArcs, ShowThatAPitchforkIsPassedOnTheTrivialBranch) {
  const Curve curve = follow(pitchfork(), at(0, -1, 0, 1), {lambda_reaches(1)}, verifying());
  expect_to_cover(curve);
  EXPECT_EQ(lengths_of(curve.arcs).share(), 1);
  ASSERT_EQ(curve.hits.front().kind, HitKind::branch_point);
  EXPECT_EQ(arc_at(curve, curve.hits.front().point.s).evidence, ArcEvidence::crossing);
  for (const Arc& arc : curve.arcs) {
    const double away =
        std::min(std::abs(arc.s_begin - 1), std::abs(arc.s_end - 1));  // from lambda = 0
    if (away > 0.3) {
      EXPECT_EQ(arc.evidence, ArcEvidence::regular);
    }
  }
}

/// Points of the branches p = 0 and p = angle l with their tangents; `changed`: from l = 0 on of the other one.
Curve curve_through(const Crossing& problem, bool changed, double step) {
  Curve curve;
  double s = 0;
  for (double l = -10.5 * step; l < 11 * step; l += step) {
    const double angle = changed && l > 0 ? problem.angle : 0;
    const double slope = problem.bend * l + angle, length = std::hypot(1, slope);
    CurvePoint point{.x = Vector::Constant(1, problem.bend * l * l / 2 + angle * l),
                     .lambda = problem.place + l,
                     .tangent = {Vector::Constant(1, slope / length), 1 / length}};
    if (!curve.points.empty())
      s += std::hypot(point.x[0] - curve.points.back().x[0],
                      point.lambda - curve.points.back().lambda);
    point.s = s;
    curve.points.push_back(point);
  }
  return curve;
}

class CrossingAngle : public testing::TestWithParam<double> {};

TEST_P(CrossingAngle, IsPassedOnAVerifiedArcOfTheBranchThatWasFollowed) {
  for (const double step : {0.05, 0.02, 0.01}) {
    const Crossing problem{.angle = GetParam(), .bend = 0.7};
    const auto arcs = verified_arcs(problem, curve_through(problem, false, step), {});
    EXPECT_EQ(lengths_of(arcs).share(), 1) << step;
  }
}

TEST_P(CrossingAngle, IsNotVerifiedWhereTheCurveChangedToTheOtherBranch) {
  for (const double step : {0.05, 0.02, 0.01}) {
    const Crossing problem{.angle = GetParam(), .bend = 0.7};
    const Curve curve = curve_through(problem, true, step);
    bool sampled = false;
    for (const Arc& arc : verified_arcs(problem, curve, {}))
      sampled = sampled || arc.evidence == ArcEvidence::sampled;
    EXPECT_TRUE(sampled) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, CrossingAngle, testing::Values(1e-4, 1e-3, 1e-2, 0.1));

TEST(VerifiedArcs, AreNotClaimedWhereACurveJumpsToAnotherStrand) {
  for (const double gap : {1e-4, 1e-3, 1e-2}) {
    Curve curve;
    for (int i = 0; i <= 40; ++i) {
      const double l = 0.02 * i, length = std::hypot(1, std::cos(l));
      curve.points.push_back({.s = std::sqrt(2.0) * l,
                              .x = Vector::Constant(1, std::sin(l) + (i > 20 ? gap : 0)),
                              .lambda = l,
                              .tangent = {Vector::Constant(1, std::cos(l) / length), 1 / length}});
    }
    const auto arcs = verified_arcs(strands(gap), curve, {});
    const double jump = curve.points[20].s;
    bool sampled = false;
    for (const Arc& arc : arcs)
      sampled = sampled || (arc.evidence == ArcEvidence::sampled && arc.s_begin >= jump - 0.1 &&
                            arc.s_end <= jump + 0.2);
    EXPECT_TRUE(sampled) << gap;
  }
}

TEST(VerifiedArcs, LeaveOutAPointAtWhichTwoEigenvaluesVanish) {
  const Small modes{2, [](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
                      const double x = z[0], y = z[1];
                      F = -l * z + Vector{{x * (x * x + 3 * y * y), y * (y * y + 3 * x * x)}};
                      const double same = 3 * (x * x + y * y) - l;
                      H = Matrix{{same, 6 * x * y}, {6 * x * y, same}};
                      F_l = -z;
                    }};
  const Curve curve = follow(modes, {Vector::Zero(2), -1, {}, {Vector::Zero(2), 1}},
                             {lambda_reaches(1)}, verifying());
  expect_to_cover(curve);
  ASSERT_FALSE(curve.hits.empty());
  EXPECT_EQ(arc_at(curve, curve.hits.front().point.s).evidence, ArcEvidence::sampled);
  EXPECT_GT(lengths_of(curve.arcs).share(), 0.8);
}

TEST(VerifiedArcs, AreTheSameWhateverPowerOfTwoTheEquationsAreMultipliedWith) {
  const auto times = [](double factor) {
    const ScalarProblem plain = pitchfork();
    return ScalarProblem{[=](double x, double l) { return factor * plain.F(x, l); },
                         [=](double x, double l) { return factor * plain.F_x(x, l); },
                         [=](double x, double l) { return factor * plain.F_lambda(x, l); }};
  };
  const Curve a = follow(times(1), at(0, -1, 0, 1), {lambda_reaches(1)}, verifying());
  const Curve b = trace(times(1024), Vector::Zero(1), -1, ray_of(times(1024), at(0, -1, 0, 1), {}),
                        {lambda_reaches(1)}, verifying());
  ASSERT_EQ(a.arcs.size(), b.arcs.size());
  for (std::size_t i = 0; i < a.arcs.size(); ++i) {
    EXPECT_EQ(a.arcs[i].s_end, b.arcs[i].s_end);
    EXPECT_EQ(a.arcs[i].evidence, b.arcs[i].evidence);
    EXPECT_EQ(a.arcs[i].radius, b.arcs[i].radius);
  }
}

TEST(VerifiedArcs, StayVerifiedAmongManyMixedUnknowns) {
  std::mt19937_64 random(11);
  for (const double angle : {1e-3, 1e-2, 0.1}) {
    const Small crossing{1, [angle](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
                           const double p = z[0] - l * l / 2, q = p - angle * l;
                           F[0] = p * q, H(0, 0) = p + q, F_l[0] = -l * q - p * (l + angle);
                         }};
    const Hidden hidden(crossing, 8, random, 3, true);
    const CurvePoint begin = hidden.place(Vector::Constant(1, 0.125), -0.5);
    const Direction way = hidden.lift(Vector::Constant(1, 0.125), Vector::Constant(1, -0.5), 1);
    const Curve curve =
        follow(hidden, {begin.x, begin.lambda, {}, way}, {lambda_reaches(0.5)}, verifying());
    EXPECT_GT(lengths_of(curve.arcs).share(), 0.95) << angle;
  }
}

}  // namespace
}  // namespace springfold::continuation
