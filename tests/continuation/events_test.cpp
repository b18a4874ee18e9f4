// Events of the caller, ways to end, and what is said when a trace cannot go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;
using testing::Not;

const ScalarProblem parabola =
    graph([](double x) { return x * x; }, [](double x) { return 2 * x; });

Event mark(const std::string& name, double x) {
  return {name, [x](const CurvePoint& p) { return p.x[0] - x; }};
}

TEST(Events, AreLocatedToTenDigits) {
  const Curve curve =
      follow(strut(0.1), at(0.1, 0, 1, 1), {mark("a", 0.5), mark("b", 1.0), x_reaches(2)});
  ASSERT_EQ(curve.hits.size(), 3u);
  EXPECT_EQ(curve.hits[0].name, "a");
  EXPECT_EQ(curve.hits[1].name, "b");
  EXPECT_EQ(curve.hits[0].kind, HitKind::user);
  EXPECT_NEAR(curve.hits[0].point.x[0], 0.5, 1e-12);
  EXPECT_NEAR(curve.hits[0].point.lambda, 0.834331857173, 1e-12);
  EXPECT_NEAR(curve.hits[1].point.lambda, 1.069555595200, 1e-12);
}

TEST(Events, MayStandInAnyNumberInOneStep) {
  std::vector<Event> events{x_reaches(1)};
  for (int i = 9; i >= 0; --i) events.push_back(mark(std::to_string(i), 0.5 + 1e-4 * i));
  const Curve curve = follow(parabola, at(0.1, 0.01, 1, 0), events);
  ASSERT_EQ(curve.hits.size(), 11u);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(curve.hits[static_cast<std::size_t>(i)].name, std::to_string(i));
    EXPECT_NEAR(curve.hits[static_cast<std::size_t>(i)].point.x[0], 0.5 + 1e-4 * i, 1e-12);
  }
}

TEST(Events, OnAStraightBranchAreLocatedToTenDigitsWhereverTheyStandInAStep) {
  const double many = 60, first = 0.1, last = 0.7;
  const Event wave{
      "wave", [=](const CurvePoint& p) { return p.tangent.dlambda * std::sin(many * p.lambda); }};
  const StartPoint start{Vector{{0, 0}}, first, {}, {Vector{{0, 0}}, 1}};
  const Curve curve = follow(TwoModes{1, 1.4}, start, {wave, lambda_reaches(last)});
  const auto zero = [=](int k) { return std::numbers::pi * k / many; };
  const int before = static_cast<int>(first / zero(1)), all = static_cast<int>(last / zero(1));
  ASSERT_EQ(curve.hits.size(), static_cast<std::size_t>(all - before + 1));
  for (int k = before + 1; k <= all; ++k)
    EXPECT_NEAR(curve.hits[static_cast<std::size_t>(k - before - 1)].point.lambda, zero(k), 1e-12);
}

TEST(Events, ThatOnlyTouchZeroAreNone) {
  const Event touching{"touch",
                       [](const CurvePoint& p) { return std::pow(p.x[0] - 0.5, 2) + 1e-12; }};
  const Curve curve = follow(parabola, at(0.1, 0.01, 1, 0), {touching, x_reaches(1)});
  EXPECT_EQ(curve.hits.size(), 1u);
}

/// Rounding that can be foreseen: no larger than 1e-13.
double ripple(double x) { return 1e-13 * std::sin(1e7 * x); }

TEST(Events, WhoseValuesAreLostInTheirNoiseAreNone) {
  const Event lost{.name = "lost",
                   .value = [](const CurvePoint& p) { return ripple(p.x[0]); },
                   .noise = [](const CurvePoint&) { return 2e-13; }};
  const Curve curve = follow(parabola, at(0.1, 0.01, 1, 0), {lost, x_reaches(1)});
  EXPECT_EQ(curve.stop, StopReason::event);
  EXPECT_EQ(curve.hits.size(), 1u);
}

TEST(Events, ThatAreLostInTheirNoiseAroundTheirZeroAreFoundOnce) {
  const Event flat{
      .name = "flat",
      .value = [](const CurvePoint& p) { return std::pow(p.x[0] - 0.5, 3) + ripple(p.x[0]); },
      .noise = [](const CurvePoint&) { return 2e-13; }};
  const Curve curve = follow(parabola, at(0.1, 0.01, 1, 0), {flat, x_reaches(1)});
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_NEAR(curve.hits[0].point.x[0], 0.5, std::cbrt(4e-13));
}

TEST(Events, AtTheStartBelongToTheStartAndAreNotFoundAgain) {
  const Curve curve = follow(parabola, at(0.5, 0.25, 1, 0), {mark("start", 0.5), x_reaches(1)});
  EXPECT_EQ(curve.hits.size(), 1u);
}

TEST(StopEvents, EndTheCurveExactlyThere) {
  const Curve curve = follow(strut(0.1), at(0.1, 0, 1, 1), {x_reaches(1), mark("beyond", 1.00001)});
  EXPECT_EQ(curve.stop, StopReason::event);
  EXPECT_EQ(curve.stop_detail, "x");
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_NEAR(curve.hits[0].point.x[0], 1, 1e-13);
  for (const CurvePoint& p : curve.points) EXPECT_LT(p.x[0], 1);
  EXPECT_LE(curve.points.back().s, curve.hits[0].point.s);
}

TEST(StopEvents, TheFirstOnTheWayCounts) {
  const Curve curve = follow(strut(0.1), at(0.1, 0, 1, 1),
                             {x_reaches(0.8001), lambda_reaches(0.5), x_reaches(0.8)});
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_EQ(curve.stop_detail, "lambda");
}

TEST(Ends, AtTheLargestNumberOfPoints) {
  TraceOptions options;
  options.maximum_points = 7;
  const Curve curve = follow(parabola, at(0.1, 0.01, 1, 0), {}, options);
  EXPECT_EQ(curve.stop, StopReason::max_points);
  EXPECT_EQ(curve.points.size(), 7u);
}

TEST(Ends, WhereTheObserverSaysSo) {
  int seen = 0;
  const Curve curve = follow(parabola, at(0.1, 0.01, 1, 0), {}, {},
                             [&seen](const CurvePoint&) { return ++seen < 5; });
  EXPECT_EQ(curve.stop, StopReason::observer);
  EXPECT_EQ(seen, 5);
  EXPECT_EQ(curve.points.size(), 6u);  // the start and five steps
}

TEST(Observer, SeesEveryAcceptedPointOnceInItsOrder) {
  std::vector<double> seen;
  const Curve curve =
      follow(parabola, at(0.1, 0.01, 1, 0), {x_reaches(1)}, {}, [&seen](const CurvePoint& p) {
        seen.push_back(p.s);
        return true;
      });
  ASSERT_EQ(seen.size() + 1, curve.points.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], curve.points[i + 1].s);
}

/// x = sqrt(1 - lambda): a leg that reaches no further than lambda = 1.
ScalarProblem reach() {
  ScalarProblem problem{[](double x, double l) { return x - std::sqrt(1 - l); },
                        [](double, double) { return 1.0; },
                        [](double, double l) { return 0.5 / std::sqrt(1 - l); }};
  problem.inside = [](double, double l) { return l < 1; };
  return problem;
}

TEST(Domain, TheTraceComesCloseToItsEndAndSaysWhyItStops) {
  const Curve curve = follow(reach(), at(1, 0, 0, 1), {});
  EXPECT_EQ(curve.stop, StopReason::step_too_small);
  EXPECT_FALSE(curve.stop_detail.empty());
  EXPECT_GT(curve.points.back().lambda, 1 - 1e-6);
  EXPECT_LT(curve.points.back().lambda, 1);
  ASSERT_FALSE(curve.log.empty());
  EXPECT_EQ(curve.log.back().reason, curve.stop_detail);
}

TEST(Domain, AStepThatLeavesItIsRefusedWithThatReason) {
  const Curve curve = follow(reach(), at(1, 0, 0, 1), {});
  const auto outside = [](const StepNote& note) {
    return note.reason == to_string(NewtonStatus::outside_domain);
  };
  EXPECT_TRUE(std::any_of(curve.log.begin(), curve.log.end(), outside));
}

TEST(Domain, AStartOutsideHasNoWays) {
  const Rays rays = rays_from(reach(), Vector::Ones(1), 2, {}, {});
  EXPECT_TRUE(rays.rays.empty());
  EXPECT_FALSE(rays.complete);
  EXPECT_THAT(rays.why, HasSubstr("not defined"));
}

TEST(Start, HasTwoOppositeWaysOnACurve) {
  const Rays rays = rays_from(circle(), Vector{{0.6}}, 0.8, {}, {});
  ASSERT_EQ(rays.rays.size(), 2u);
  EXPECT_TRUE(rays.complete);
  EXPECT_NEAR(rays.rays[0].tangent.dlambda + rays.rays[1].tangent.dlambda, 0, 1e-15);
  EXPECT_NEAR(std::abs(rays.rays[0].tangent.dlambda), 0.6, 1e-15);
}

TEST(Start, IsNotTakenWhereBranchesCross) {
  const Rays rays = rays_from(pitchfork(), Vector::Zero(1), 0, {}, {});
  EXPECT_TRUE(rays.rays.empty());
  EXPECT_FALSE(rays.complete);
  EXPECT_THAT(rays.why, HasSubstr("more than one curve"));
}

TEST(StepLog, TellsWhereAndWhyStepsWereRefused) {
  TraceOptions options = steps_up_to(1);
  options.step.initial = 1;
  const Curve curve = follow(circle(), at(1, 0, 0, 1), {x_reaches(-0.9)}, options);
  ASSERT_FALSE(curve.log.empty()) << "a step of 1 on the unit circle cannot pass";
  EXPECT_EQ(curve.log[0].s, 0);
  EXPECT_EQ(curve.log[0].step, 1);
  EXPECT_THAT(curve.log[0].reason, Not(testing::IsEmpty()));
  EXPECT_EQ(curve.log[1].step, 0.5);
}

TEST(StepLog, RefusedStepsLeaveNoTraceInTheCurve) {
  TraceOptions options = steps_up_to(1);
  options.step.initial = 1;
  const Curve bold = follow(circle(), at(1, 0, 0, 1), {x_reaches(-0.9)}, options);
  options.step.initial = bold.points[1].s;  // the first length that was accepted
  const Curve shy = follow(circle(), at(1, 0, 0, 1), {x_reaches(-0.9)}, options);
  ASSERT_EQ(bold.points.size(), shy.points.size());
  for (std::size_t i = 0; i < bold.points.size(); ++i) {
    EXPECT_EQ(bold.points[i].s, shy.points[i].s);
    EXPECT_EQ(bold.points[i].x, shy.points[i].x);
    EXPECT_EQ(bold.points[i].lambda, shy.points[i].lambda);
  }
}

TEST(StepControl, KeepsWithinItsLimits) {
  TraceOptions options = steps_up_to(0.03);
  options.step.turn = 0.02;
  const Curve curve = follow(fold_ladder(), at(0, 0, 1, 1), {x_reaches(2)}, options);
  ASSERT_EQ(curve.stop, StopReason::event);
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const CurvePoint &a = curve.points[i - 1], &b = curve.points[i];
    EXPECT_LE(b.s - a.s, 0.03 * (1 + 1e-12));
    const double turned = std::acos(
        std::min(1.0, a.tangent.dx[0] * b.tangent.dx[0] + a.tangent.dlambda * b.tangent.dlambda));
    EXPECT_LE(turned, 0.02 + 1e-7);
  }
}

TEST(Ends, ExactlyAtTheEndOfAStepAreNotPassed) {
  // x = 0 all along, steps of 2^-5: lambda is the limit itself after sixteen of them.
  const ScalarProblem straight{[](double x, double) { return x; },
                               [](double, double) { return 1.0; },
                               [](double, double) { return 0.0; }};
  TraceOptions options;
  options.step.initial = options.step.maximum = 0x1p-5;
  const Curve curve = follow(straight, at(0, 0, 0, 1), {lambda_reaches(0.5)}, options);
  EXPECT_EQ(curve.stop, StopReason::event);
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_EQ(curve.hits[0].point.lambda, 0.5);
}

TEST(UserEvent, BesideABranchPointIsOnItsOwnBranch) {
  // The bent branch of a perfect strut: points beside theta = 0 are easily mistaken for straight ones.
  const ScalarProblem perfect = strut(0);
  for (double off = 1e-1; off > 1e-10; off /= 4)
    for (const double theta : {off, -off}) {
      std::vector<Event> events{{"wanted", [theta](const CurvePoint& p) { return p.x[0] - theta; }},
                                x_reaches(1)};
      const Curve curve = follow(perfect, at(-1, 1 / std::sin(1.0), 1, 0), events);
      ASSERT_EQ(curve.stop, StopReason::event) << theta;
      const auto found = hits_of(curve, HitKind::user);
      ASSERT_EQ(found.size(), 2u) << theta;
      EXPECT_NEAR(found[0].point.x[0], theta, 1e-10);
      EXPECT_NEAR(found[0].point.lambda, theta / std::sin(theta), 1e-6) << theta;
      EXPECT_EQ(hits_of(curve, HitKind::branch_point).size(), 1u) << theta;
    }
}

/// x = sin l, from l = -0.5 on.
Curve along_a_sine(const std::vector<Event>& events) {
  const ScalarProblem sine{[](double x, double l) { return x - std::sin(l); },
                           [](double, double) { return 1.0; },
                           [](double, double l) { return -std::cos(l); }};
  return follow(sine, at(std::sin(-0.5), -0.5, 1, 1), events);
}

TEST(Events, AreMetHoweverSteeplyTheyChangeTheirSign) {
  const std::vector<std::function<double(double)>> steep{
      [](double u) { return std::tanh(100 * u); },
      [](double u) { return std::tanh(300 * u); },
      [](double u) { return std::tanh(300 * u) + 0.2; },
      [](double u) { return std::tanh(1e4 * u); },
      [](double u) { return std::atan(1e9 * u); },
      [](double u) { return std::cbrt(u); },
      [](double u) { return std::copysign(std::pow(std::abs(u), 0.8), u); },
      [](double u) { return u < 0 ? -1.0 : 1.0; },
      [](double u) { return u < 0 ? -1.0 : 5.0; }};
  const double shift = std::atanh(0.2) / 300;
  for (std::size_t i = 0; i < steep.size(); ++i)
    for (const double place : {-0.31, 0.0123, 0.2, 0.4567, 0.71}) {
      SCOPED_TRACE(i);
      SCOPED_TRACE(place);
      const Curve curve = along_a_sine(
          {stop_where("steep", [&](const CurvePoint& p) { return steep[i](p.lambda - place); }),
           lambda_reaches(1)});
      EXPECT_EQ(curve.stop, StopReason::event);
      EXPECT_EQ(curve.stop_detail, "steep");
      ASSERT_FALSE(curve.hits.empty());
      EXPECT_NEAR(curve.hits.back().point.lambda, i == 2 ? place - shift : place, 1e-9);
    }
}

TEST(Events, AreMetJustBeforeTheirValueIsNoNumberAnyMore) {
  for (const double level : {0.05, 1e-3}) {
    const Curve curve = along_a_sine(
        {stop_where("root", [=](const CurvePoint& p) { return std::sqrt(0.2 - p.lambda) - level; }),
         lambda_reaches(1)});
    EXPECT_EQ(curve.stop_detail, "root");
    EXPECT_NEAR(curve.hits.back().point.lambda, 0.2 - level * level, 1e-9);
  }
}

TEST(Events, AreNotMetAtTheirPoles) {
  const std::vector<std::function<double(double)>> poles{
      [](double u) { return 1 / u; }, [](double u) { return 1 / (u * u * u); },
      [](double u) { return std::tan(u + std::numbers::pi / 2); }};
  for (const auto& f : poles) {
    const Curve curve = along_a_sine(
        {{"pole", [&](const CurvePoint& p) { return f(p.lambda - 0.2); }}, lambda_reaches(1)});
    for (const Hit& hit : curve.hits) EXPECT_NE(hit.name, "pole");
  }
}

TEST(Events, EndTheCurveWhereTheyFallToZeroAndAreNoNumberFromThereOn) {
  const auto until = [](double u) { return u < 0.2 ? u - 0.2 : std::nan(""); };
  const Curve curve =
      along_a_sine({stop_where("until", [=](const CurvePoint& p) { return until(p.lambda); }),
                    lambda_reaches(1)});
  EXPECT_EQ(curve.stop, StopReason::step_too_small);
  EXPECT_THAT(curve.stop_detail, HasSubstr("until"));
  EXPECT_NEAR(curve.points.back().lambda, 0.2, 1e-3);
  const auto far = [](double u) { return u < 0.2 ? 1 + u : std::nan(""); };
  EXPECT_EQ(along_a_sine({stop_where("far", [=](const CurvePoint& p) { return far(p.lambda); }),
                          lambda_reaches(1)})
                .stop_detail,
            lambda_reaches(1).name);
}

/// x^3 - tanh(K (l - a)) x = 0: x = 0 is crossed at a. It does not say that it is symmetric, so nothing is counted.
struct SteepEigenvalue {
  double K = 1, a = 0;
  static Index size() { return 1; }
  double rate(double l) const { return std::tanh(K * (l - a)); }
  bool residual(const Vector& x, double l, Vector& F) const {
    F = Vector::Constant(1, (x[0] * x[0] - rate(l)) * x[0]);
    return true;
  }
  bool derivatives(const Vector& x, double l, Matrix& dF_dx, Vector& by_l) const {
    dF_dx = Matrix::Constant(1, 1, 3 * x[0] * x[0] - rate(l));
    by_l = Vector::Constant(1, -K * (1 - rate(l) * rate(l)) * x[0]);
    return true;
  }
};

TEST(BranchPoints, AreNotPassedWhereTheEigenvalueChangesItsSignSteeply) {
  for (const double K : {30.0, 100.0, 300.0, 1e3, 1e4, 1e6})
    for (const double a : {-0.3123, -0.071, 0.2222, 0.5, 0.777}) {
      SCOPED_TRACE(K);
      SCOPED_TRACE(a);
      const Curve curve = trace(SteepEigenvalue{K, a}, Vector::Zero(1), -0.5,
                                Ray{{}, {Vector::Zero(1), 1}}, {lambda_reaches(1)}, {});
      const bool told = std::any_of(curve.hits.begin(), curve.hits.end(), [&](const Hit& hit) {
        return (hit.kind == HitKind::branch_point || hit.kind == HitKind::unresolved) &&
               std::abs(hit.point.lambda - a) < 1e-3;
      });
      EXPECT_EQ(curve.stop, StopReason::event);
      EXPECT_TRUE(told);
      EXPECT_TRUE(K > 100 || hits_of(curve, HitKind::branch_point).size() == 1);
    }
}

}  // namespace
}  // namespace springfold::continuation
