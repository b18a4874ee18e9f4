// Curves of special points in two parameters, against closed forms.
#include "springfold/parameters/two_parameter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "parameters/families.hpp"

namespace springfold::continuation {
namespace {

TEST(TwoParameters, TwoLimitPointsMergeInACusp) {
  const Family family = graphs([](double x, double mu) { return x * x * x - mu * x; },
                               [](double x, double mu) { return 3 * x * x - mu; });
  const auto curve = follow_critical(family, start_at(CriticalKind::limit_point, single(-1), 2, 3),
                                     false, {stop_at(-1, 4)}, {});
  const auto cusps = hits_of(curve, Degeneracy::cusp);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_NEAR(cusps[0].point.mu, 0, 1e-12);
  EXPECT_NEAR(cusps[0].point.lambda, 0, 1e-12);
  EXPECT_NEAR(cusps[0].point.x[0], 0, 1e-10);
  EXPECT_EQ(curve.stop_detail, "end");
  EXPECT_NEAR(curve.points.back().mu, 4, 0.1);
  EXPECT_TRUE(hits_of(curve, Degeneracy::extremum).empty());
  for (const auto& p : curve.points) EXPECT_NEAR(p.mu, 3 * p.x[0] * p.x[0], 1e-11);
}

TEST(TwoParameters, WhereTheWholeTangentTurnsOnlyWhatTurnsBackIsTold) {
  // c (x^3 - mu x) = lambda: mu = 3 x^2 turns back, lambda = -2 c x^3 does not. c (x^3 - lambda x) = mu: the reverse.
  for (const double c : {1.0, -1.0, 0.01, -0.01})
    for (const bool of_mu : {true, false})
      for (double step = 0.02; step < 0.2; step *= 1.3) {
        SCOPED_TRACE(std::to_string(c) + (of_mu ? " mu " : " lambda ") + std::to_string(step));
        const Family family = family_of<ScalarProblem>([=](double mu) {
          if (of_mu)
            return graph([=](double x) { return c * (x * x * x - mu * x); },
                         [=](double x) { return c * (3 * x * x - mu); });
          return ScalarProblem{[=](double x, double l) { return x * x * x - l * x - mu / c; },
                               [](double x, double l) { return 3 * x * x - l; },
                               [](double x, double) { return -x; }};
        });
        const double lambda = of_mu ? 2 * c : 3, mu = of_mu ? 3 : 2 * c;  // x = -1
        TraceOptions options;
        options.step.initial = options.step.maximum = step;
        const auto curve = follow_critical(
            family, start_at(CriticalKind::limit_point, single(-1), lambda, mu), !of_mu && c < 0,
            {{"end", [](const CriticalPoint& p) { return p.x[0] - 1; }, EventAction::stop}},
            options);
        EXPECT_EQ(curve.stop_detail, "end");
        ASSERT_EQ(curve.hits.size(), 2U);
        const CriticalHit& hit = curve.hits[0];
        EXPECT_EQ(hit.kind, of_mu ? Degeneracy::cusp : Degeneracy::extremum);
        EXPECT_NEAR(std::abs(hit.point.lambda) + std::abs(hit.point.mu), 0, 1e-10);
      }
}

TEST(TwoParameters, RatesAreExactWhereTheEquationsBendWithinTheStepOfDifferences) {
  // lambda = sin(20 (x - mu)) / 20 has its limit point at x = mu + pi/40.
  const Family family = graphs([](double x, double mu) { return std::sin(20 * (x - mu)) / 20; },
                               [](double x, double mu) { return std::cos(20 * (x - mu)); });
  const auto rate = critical_rate(
      family, start_at(CriticalKind::limit_point, single(std::numbers::pi / 40), 1.0 / 20, 0));
  ASSERT_TRUE(rate);
  EXPECT_NEAR(rate->dx[0], 1, 1e-10);
  EXPECT_NEAR(rate->dlambda, 0, 1e-10);
}

TEST(TwoParameters, NoPointStandsBesideACuspWhateverTheStep) {
  const Family family = graphs([](double x, double mu) { return x * x * x - mu * x; },
                               [](double x, double mu) { return 3 * x * x - mu; });
  for (double step = 0.02; step < 0.2; step *= 1.1) {
    TraceOptions options;
    options.step.initial = options.step.maximum = step;
    const auto curve =
        follow_critical(family, start_at(CriticalKind::limit_point, single(-1), 2, 3), false,
                        {stop_at(-1, 4)}, options);
    const auto cusps = hits_of(curve, Degeneracy::cusp);
    ASSERT_EQ(cusps.size(), 1U) << step;
    for (const auto& p : curve.points) EXPECT_GT(std::abs(p.s - cusps[0].point.s), 1e-6) << step;
  }
}

TEST(TwoParameters, AClosedBranchThatShrinksIsAnIsolaCentreAndSaddlesAreCrossings) {
  for (const double sign : {1.0, -1.0}) {
    const Family family = family_of<ScalarProblem>([=](double mu) {
      return ScalarProblem{[=](double x, double l) { return x * x + sign * (l * l - mu); },
                           [](double x, double) { return 2 * x; },
                           [=](double, double l) { return 2 * sign * l; }};
    });
    const auto curve = follow_critical(family, start_at(CriticalKind::limit_point, single(0), 1, 1),
                                       false, {stop_at(-1, 2)}, {});
    const auto kind = sign > 0 ? Degeneracy::isola_centre : Degeneracy::crossing;
    ASSERT_EQ(hits_of(curve, kind).size(), 1U) << sign;
    EXPECT_NEAR(hits_of(curve, kind)[0].point.mu, 0, 1e-12);
    EXPECT_NEAR(hits_of(curve, kind)[0].point.lambda, 0, 1e-10);
  }
}

TEST(TwoParameters, SwallowtailHasTwoCusps) {
  const double c = -0.7;
  const Family family =
      graphs([=](double x, double b) { return -(x * x * (x * x + c) + b * x); },
             [=](double x, double b) { return -(4 * x * x * x + 2 * c * x + b); });
  const double x0 = -1, b0 = -4 * x0 * x0 * x0 - 2 * c * x0;
  const double a0 = -(x0 * x0 * (x0 * x0 + c) + b0 * x0);
  const auto curve = follow_critical(
      family, start_at(CriticalKind::limit_point, single(x0), a0, b0), false, {stop_at(-5, 5)}, {});
  const auto cusps = hits_of(curve, Degeneracy::cusp);
  ASSERT_EQ(cusps.size(), 2U);
  for (const auto& cusp : cusps) EXPECT_NEAR(std::abs(cusp.point.x[0]), std::sqrt(-c / 6), 1e-9);
}

TEST(TwoParameters, TheFoldsOfTheSwallowtailMeetAtOneLoad) {
  // Double fold at b = 0, a = c^2/4: both limit points at x^2 = -c/2.
  const double c = -0.7, x0 = -1, b0 = -4 * x0 * x0 * x0 - 2 * c * x0;
  const Family family =
      graphs([=](double x, double b) { return -(x * x * (x * x + c) + b * x); },
             [=](double x, double b) { return -(4 * x * x * x + 2 * c * x + b); });
  const auto curve = follow_critical(
      family,
      start_at(CriticalKind::limit_point, single(x0), -(x0 * x0 * (x0 * x0 + c) + b0 * x0), b0),
      false, {stop_at(-5, 5), {"symmetric", [](const CriticalPoint& p) { return p.mu; }}}, {});
  int seen = 0;
  for (const auto& hit : curve.hits)
    if (hit.name == "symmetric" && std::abs(hit.point.x[0]) > 0.1) {
      EXPECT_NEAR(hit.point.lambda, c * c / 4, 1e-11);
      EXPECT_NEAR(std::abs(hit.point.x[0]), std::sqrt(-c / 2), 1e-10);
      ++seen;
    }
  EXPECT_EQ(seen, 2);
}

TEST(TwoParameters, ImperfectArchesLoseStabilityAsPublished) {
  const double e = 3;
  const Family family = family_of<Given>([=](double m) { return arch(e, m); });
  // From a rough guess beside the limit point at m = 0.5 down to m = 1e-4.
  std::vector<CriticalEvent> events{stop_at(1e-5, 1)};
  const std::vector<std::pair<double, double>> known{
      {1e-4, 9.7051770421122}, {0.01, 9.6430193096047}, {0.1, 9.4062121678254}};
  for (const auto& [m, p] : known)
    events.push_back({"mark", [m = m](const CriticalPoint& at) { return at.mu - m; }});
  const auto start = polish_critical(
      family, start_at(CriticalKind::limit_point, Vector{{2.2, -0.34}}, 8.8306, 0.5));
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->lambda, 8.8306070701784, 1e-10);
  const auto curve = follow_critical(
      family, start_at(CriticalKind::limit_point, start->x, start->lambda, 0.5), false, events, {});
  std::size_t seen = 0;
  for (const auto& hit : curve.hits)
    if (hit.name == "mark")
      for (const auto& [m, p] : known)
        if (std::abs(hit.point.mu - m) < 1e-9) {
          EXPECT_NEAR(hit.point.lambda, p, 1e-9);
          ++seen;
        }
  EXPECT_EQ(seen, known.size());
}

TEST(TwoParameters, ThePerfectArchHasItsLimitPointBehindItsBranchPoint) {
  // Symmetric path q2 = 0: p = e - q1 - q1 (q1^2 - e^2), stationary at q1^2 = (e^2 - 1)/3; branches cross it where
  // q1^2 = e^2 - 4.
  const double e = 3, q1 = std::sqrt((e * e - 1) / 3);
  const Family family = family_of<Given>([=](double m) { return arch(e, m); });
  const auto fold =
      polish_critical(family, start_at(CriticalKind::limit_point, Vector{{1.6, 0}}, 11.7, 0));
  ASSERT_TRUE(fold);
  EXPECT_NEAR(fold->lambda, 11.709296863229, 1e-11);
  EXPECT_NEAR(fold->x[0], q1, 1e-9);
  const auto branches =
      polish_critical(family, start_at(CriticalKind::branch_point, Vector{{2.2, 0}}, 9.7, 0));
  ASSERT_TRUE(branches);
  EXPECT_NEAR(branches->lambda, 9.7082039324994, 1e-11);
}

TEST(TwoParameters, ButterflyColumnHasCuspsAtItsTripleRoots) {
  const double b = 2;
  const Family family = family_of<ScalarProblem>([=](double H) {
    return ScalarProblem{
        [=](double t, double P) { return b * t + std::sin(2 * t) / 2 - P * std::sin(t) - H; },
        [=](double t, double P) { return b + std::cos(2 * t) - P * std::cos(t); },
        [](double t, double) { return -std::sin(t); }};
  });
  const double t = -0.3, P = (b + std::cos(2 * t)) / std::cos(t);
  const double H = b * t + std::sin(2 * t) / 2 - P * std::sin(t);
  for (const bool growing : {false, true}) {
    std::vector<CriticalEvent> events{
        {"end", [](const CriticalPoint& p) { return 3.05 - p.lambda; }, EventAction::stop}};
    const auto curve = follow_critical(family, start_at(CriticalKind::limit_point, single(t), P, H),
                                       growing, events, {});
    for (const auto& cusp : hits_of(curve, Degeneracy::cusp)) {
      const bool upper = std::abs(cusp.point.lambda - 3) < 1e-3;
      EXPECT_NEAR(cusp.point.lambda, upper ? 3 : 2.8284271247462, 1e-9);
      EXPECT_NEAR(std::abs(cusp.point.mu), upper ? 0 : 0.070796326794897, 1e-9);
    }
    EXPECT_FALSE(hits_of(curve, Degeneracy::cusp).empty());
  }
}

TEST(TwoParameters, TheFoldsOfTheButterflyColumnMeetAtOneLoad) {
  const double b = 2;
  const Family family = family_of<ScalarProblem>([=](double H) {
    return ScalarProblem{
        [=](double t, double P) { return b * t + std::sin(2 * t) / 2 - P * std::sin(t) - H; },
        [=](double t, double P) { return b + std::cos(2 * t) - P * std::cos(t); },
        [](double t, double) { return -std::sin(t); }};
  });
  const double t = 0.9, P = (b + std::cos(2 * t)) / std::cos(t);
  const double H = b * t + std::sin(2 * t) / 2 - P * std::sin(t);
  std::vector<double> loads;
  for (const bool growing : {false, true}) {
    const std::vector<CriticalEvent> events{
        {"end", [](const CriticalPoint& p) { return 3.05 - p.lambda; }, EventAction::stop},
        {"symmetric", [](const CriticalPoint& p) { return p.mu; }}};
    for (const auto& hit :
         follow_critical(family, start_at(CriticalKind::limit_point, single(t), P, H), growing,
                         events, {})
             .hits)
      if (hit.name == "symmetric" && std::abs(hit.point.x[0]) > 0.1)
        loads.push_back(hit.point.lambda);
  }
  ASSERT_FALSE(loads.empty());
  for (const double load : loads) EXPECT_NEAR(load, 2.9170348529388, 1e-9);
}

TEST(TwoParameters, BranchPointOnALimitPointIsAHilltopSeenFromBothCurves) {
  const Family family = family_of<Given>(hill);
  const double y = 0.5;
  for (const auto kind : {CriticalKind::branch_point, CriticalKind::limit_point}) {
    const bool is_branch = kind == CriticalKind::branch_point;
    const Vector x{{0, is_branch ? y : 1.0}};
    const double lambda = is_branch ? y - y * y * y / 3 : 2.0 / 3;
    const auto curve =
        follow_critical(family, start_at(kind, x, lambda, y), true, {stop_at(0, 1.5)}, {});
    EXPECT_TRUE(curve.kept);
    ASSERT_EQ(hits_of(curve, Degeneracy::hilltop).size(), 1U) << is_branch;
    EXPECT_NEAR(hits_of(curve, Degeneracy::hilltop)[0].point.mu, 1, 1e-9);
    EXPECT_NEAR(hits_of(curve, Degeneracy::hilltop)[0].point.lambda, 2.0 / 3, 1e-10);
  }
}

TEST(TwoParameters, PairsOfBranchPointsAreBornWhereMuTurnsBack) {
  const Family family = family_of<ScalarProblem>([](double mu) {
    return ScalarProblem{[=](double x, double l) { return x * (mu - l * l - x * x); },
                         [=](double x, double l) { return mu - l * l - 3 * x * x; },
                         [](double x, double l) { return -2 * l * x; }};
  });
  const auto curve = follow_critical(family, start_at(CriticalKind::branch_point, single(0), 1, 1),
                                     false, {stop_at(-1, 2)}, {});
  const auto births = hits_of(curve, Degeneracy::branch_points_merge);
  ASSERT_EQ(births.size(), 1U);
  EXPECT_NEAR(births[0].point.mu, 0, 1e-12);
}

/// p (l - mu + b p) = 0 with p = x - l: branches x = l and another one, which cross at x = l = mu. Along the first x is
/// the null vector's own unknown.
Family crossing_askew(double b) {
  return family_of<ScalarProblem>([=](double mu) {
    return ScalarProblem{
        [=](double x, double l) { return (x - l) * (l - mu + b * (x - l)); },
        [=](double x, double l) { return l - mu + 2 * b * (x - l); },
        [=](double x, double l) { return -(l - mu + b * (x - l)) + (x - l) * (1 - b); }};
  });
}

TEST(TwoParameters, ABranchPointMovesAlongItsNullVectorWhereItsBranchDoes) {
  for (const double b : {-2.0, 0.3, 5.0}) {
    const Family family = crossing_askew(b);
    const auto start = start_at(CriticalKind::branch_point, single(0.4), 0.4, 0.4);
    const auto rate = critical_rate(family, start);
    ASSERT_TRUE(rate) << b;
    EXPECT_NEAR(rate->dlambda, 1, 1e-9) << b;
    EXPECT_NEAR(rate->dx[0], 1, 1e-9) << b;
    const auto curve = follow_critical(family, start, true, {stop_at(0, 3)}, {});
    EXPECT_TRUE(curve.kept) << b;
    ASSERT_FALSE(curve.hits.empty()) << b;
    EXPECT_NEAR(curve.hits.back().point.mu, 3, 1e-9) << b;
    for (const CriticalPoint& p : curve.points) {
      EXPECT_NEAR(p.lambda, p.mu, 1e-10) << b;
      EXPECT_NEAR(p.x[0], p.mu, 1e-10) << b;
    }
  }
}

TEST(TwoParameters, AnImperfectionDoesNotKeepABranchPoint) {
  const Family family = family_of<ScalarProblem>([](double mu) {
    return ScalarProblem{[=](double x, double l) { return x * (l - x * x) + mu; },
                         [](double x, double l) { return l - 3 * x * x; },
                         [](double x, double) { return x; }};
  });
  const auto start = start_at(CriticalKind::branch_point, single(0), 0, 0);
  EXPECT_FALSE(follow_critical(family, start, true, {stop_at(-1, 1)}, {}).kept);
  EXPECT_FALSE(critical_rate(family, start));
}

/// lambda = q^3 - 3 a q + k max(0, q - g).
struct Stopped {
  double a = 1, k = 4, g = 0.3;
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    const double q = x[0];
    F = single(q * q * q - 3 * a * q + (piece[0] > 0 ? k * (q - g) : 0) - lambda);
    return true;
  }
  bool derivatives(const Vector& x, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix::Constant(1, 1, 3 * x[0] * x[0] - 3 * a + (piece[0] > 0 ? k : 0));
    dF_dlambda = single(-1);
    return true;
  }
  static Index switch_count() { return 1; }
  bool switches(const Vector& x, double, Vector& value) const {
    value = single(x[0] - g);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Ones(1, 1);
    dg_dlambda = single(0);
    return true;
  }
  static const char* switch_name(Index) { return "stop"; }
};

TEST(TwoParameters, AFoldEndsWhereItMeetsTheActivation) {
  const double a = 1.3;
  const Family family =
      family_of<Stopped>([=](double g) { return Stopped{.a = a, .k = 5, .g = g}; });
  auto start =
      start_at(CriticalKind::limit_point, single(-std::sqrt(a)), 2 * a * std::sqrt(a), 0.3);
  start.piece = {-1};
  const auto curve = follow_critical(family, start, false, {stop_at(-3, 1)}, {});
  const auto ends = hits_of(curve, Degeneracy::fold_meets_activation);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_NEAR(ends[0].point.mu, -std::sqrt(a), 1e-10);
  EXPECT_EQ(ends[0].name, "stop");
  EXPECT_EQ(curve.stop_detail, "fold meets activation");
}

TEST(TwoParameters, ASoftStopLetsTheFoldMoveToItsCusp) {
  const double a = 1.3, g = -2;
  const Family family =
      family_of<Stopped>([=](double k) { return Stopped{.a = a, .k = k, .g = g}; });
  const double k = 1, q = -std::sqrt(a - k / 3);
  auto start =
      start_at(CriticalKind::limit_point, single(q), q * q * q - 3 * a * q + k * (q - g), k);
  start.piece = {1};
  const auto curve = follow_critical(family, start, true, {stop_at(0, 5)}, {});
  const auto cusps = hits_of(curve, Degeneracy::cusp);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_NEAR(cusps[0].point.mu, 3 * a, 1e-11);
}

TEST(TwoParameters, ACornerIsALimitPointBetweenTheFoldsOfItsTwoSides) {
  const double a = 1, k = 1.2;
  const Family family =
      family_of<Stopped>([=](double g) { return Stopped{.a = a, .k = k, .g = g}; });
  const double g = -0.9;  // behind: 3 g^2 - 3 a + k > 0, before: < 0
  CriticalStart start = start_at(CriticalKind::surface, single(g), g * g * g - 3 * a * g, g);
  start.piece = {-1};
  start.behind = {1};
  start.switching = 0;
  std::vector<CriticalHit> hits;
  for (const bool growing : {true, false})
    for (const auto& hit : follow_critical(family, start, growing, {stop_at(-1.5, -0.1)}, {}).hits)
      if (hit.kind != Degeneracy::user) hits.push_back(hit);
  int before = 0, behind = 0;
  for (const auto& hit : hits) {
    const bool is_before = hit.kind == Degeneracy::fold_meets_activation;
    if (!is_before && hit.kind != Degeneracy::corner_loses_reversal) continue;
    ++(is_before ? before : behind);
    EXPECT_NEAR(hit.point.mu, -std::sqrt(is_before ? a : a - k / 3), 1e-9);
  }
  EXPECT_EQ(before, 1);
  EXPECT_EQ(behind, 1);
}

TEST(TwoParameters, CriticalLoadsMoveAtTheRateOfTheClosedForm) {
  const Family family = graphs([](double x, double mu) { return mu * x - x * x * x; },
                               [](double x, double mu) { return mu - 3 * x * x; });
  const double mu = 1.7, x = std::sqrt(mu / 3);
  const auto rate =
      critical_rate(family, start_at(CriticalKind::limit_point, single(x), mu * x - x * x * x, mu));
  ASSERT_TRUE(rate);
  EXPECT_NEAR(rate->dlambda, x, 1e-10);
  EXPECT_NEAR(rate->dx[0], 1 / (6 * x), 1e-10);
}

}  // namespace
}  // namespace springfold::continuation
