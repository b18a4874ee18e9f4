// Points of curves of special points between their steps.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "parameters/families.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {
namespace {

TEST(FurtherPoints, LieOnTheCurveAtMultiplesOfTheirSpacing) {
  const Family family =
      graphs([](double x, double mu) { return std::sin(x) * x * x - mu * x; },
             [](double x, double mu) { return std::cos(x) * x * x + 2 * x * std::sin(x) - mu; });
  const auto fold = [](double x) { return std::cos(x) * x * x + 2 * x * std::sin(x); };
  TraceOptions options;
  options.step.maximum = 0.3;
  const double x = -0.9, mu = fold(x);
  const CriticalStart start =
      start_at(CriticalKind::limit_point, single(x), std::sin(x) * x * x - mu * x, mu);
  const std::vector<CriticalEvent> events{stop_at(-1, mu)};
  const auto own = follow_critical(family, start, false, events, options);
  const double spacing = 0.004;
  const auto curve =
      follow_critical(family, start, false, events, options, {}, {.spacing = spacing});
  EXPECT_EQ(curve.missed, 0);
  EXPECT_EQ(curve.left_out, 0);
  EXPECT_GT(curve.points.size(), 5 * own.points.size());
  double before = -1;
  int even = 0;
  for (const auto& p : curve.points) {
    EXPECT_GT(p.s, before);
    before = p.s;
    EXPECT_NEAR(p.mu, fold(p.x[0]), 1e-12);
    EXPECT_NEAR(p.lambda, std::sin(p.x[0]) * p.x[0] * p.x[0] - p.mu * p.x[0], 1e-12);
    even += std::abs(std::remainder(p.s, spacing)) < 1e-9 * spacing ? 1 : 0;
  }
  EXPECT_GE(even, static_cast<int>(own.points.back().s / spacing) - 1);
  ASSERT_EQ(hits_of(curve, Degeneracy::cusp).size(), 1U);
  EXPECT_EQ(hits_of(curve, Degeneracy::cusp)[0].point.s, hits_of(own, Degeneracy::cusp)[0].point.s);
}

TEST(FurtherPoints, AskForHardlyMoreMembersOfTheFamilyThanThereAreOfThem) {
  const Family family =
      graphs([](double x, double mu) { return std::sin(x) * x * x - mu * x; },
             [](double x, double mu) { return std::cos(x) * x * x + 2 * x * std::sin(x) - mu; });
  const double x = -0.9, mu = std::cos(x) * x * x + 2 * x * std::sin(x);
  const CriticalStart start =
      start_at(CriticalKind::limit_point, single(x), std::sin(x) * x * x - mu * x, mu);
  std::set<double> asked;
  Family watched = family;
  watched.at = [&](double m) {
    asked.insert(m);
    return family.at(m);
  };
  const auto own = follow_critical(watched, start, false, {stop_at(-1, mu)}, {});
  const std::size_t of_steps = asked.size();
  asked.clear();
  const auto curve =
      follow_critical(watched, start, false, {stop_at(-1, mu)}, {}, {}, {.spacing = 0.01});
  const double further = static_cast<double>(curve.points.size() - own.points.size());
  EXPECT_GT(further, 50);
  EXPECT_LT(static_cast<double>(asked.size() - of_steps), 1.2 * further);
}

TEST(FurtherPoints, ThatAreMoreThanAllowedAreLeftOutAndCounted) {
  const Family family = graphs([](double x, double mu) { return x * x * x - mu * x; },
                               [](double x, double mu) { return 3 * x * x - mu; });
  const CriticalStart start = start_at(CriticalKind::limit_point, single(-1), 2, 3);
  const auto own = follow_critical(family, start, false, {stop_at(-1, 4)}, {});
  const auto curve = follow_critical(family, start, false, {stop_at(-1, 4)}, {}, {},
                                     {.spacing = 1e-3, .most = 10});
  EXPECT_EQ(curve.points.size(), own.points.size());
  EXPECT_NEAR(curve.left_out, own.points.back().s / 1e-3, 1);
}

}  // namespace
}  // namespace springfold::continuation
