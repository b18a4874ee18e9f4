// Graphs of stable states where springs rest at their thresholds, where curves harden, and the lowest ways between
// states.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/barriers.hpp"
#include "io/case_files.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {
namespace {

io::Case case_of(const std::string& file) {
  return io::load_case(std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/" + file);
}

double column(const StudyResult& result, const std::vector<double>& values,
              const std::string& name) {
  for (std::size_t i = 0; i < result.quantities.size(); ++i)
    if (result.quantities[i].name == name) return values[i];
  return std::nan("");
}

/// The column of cases/column-with-stop/README.md: straight up to 2 c/l, where its free side gives way. Its spring is
/// at rest all along the straight branch.
TEST(CornerGraph, OfAColumnWithASpringAtRestHandsOverToTheFreeSideOnly) {
  io::Case c = case_of("column-with-stop/case.toml");
  io::PlannedRun& planned = c.runs.at(0);
  planned.plan.snap = SnapSettings{.starts = 0};
  planned.plan.snap->transitions = TransitionSettings{};
  const StudyResult result = run_study(planned.mechanism, planned.plan);
  ASSERT_TRUE(result.snap && result.snap->transitions);
  const TransitionReport& report = *result.snap->transitions;
  EXPECT_TRUE(complete(result)) << (result.doubts.empty() ? "" : result.doubts.front());
  EXPECT_TRUE(report.is_closed);
  ASSERT_EQ(report.states.size(), 2u);
  EXPECT_NEAR(report.states[0].high, 2, 1e-9);
  EXPECT_FALSE(report.states[0].high_is_limit);
  int up = 0, free_side = 0;
  for (const Transition& t : report.transitions)
    if (t.from == 1 && t.loading > 0) ++up, free_side = t.to;
  EXPECT_EQ(up, 1);
  ASSERT_EQ(free_side, 2);
  EXPECT_LT(column(result, report.states[1].found.values, "first.foot"), 0);
  EXPECT_NEAR(report.states[1].low, 2, 1e-3);
}

/// Its sprung side: P = 2 c t/(l sin t) + (k l/2) cos t falls to 3.0954 c/l at t = 1.369 and rises from there. No jump
/// leads to it, and at its loads no state that is reached lies within the limits.
TEST(CornerGraph, OfAColumnWithASpringAtRestFindsTheSprungStateToWhichNoJumpLeads) {
  io::Case c = case_of("column-with-stop/case.toml");
  io::PlannedRun& planned = c.runs.at(0);
  planned.plan.snap = SnapSettings{.starts = 0};
  planned.plan.snap->transitions = TransitionSettings{.search_at = {3.1}};
  const StudyResult result = run_study(planned.mechanism, planned.plan);
  ASSERT_TRUE(result.snap && result.snap->transitions);
  const TransitionReport& report = *result.snap->transitions;
  ASSERT_EQ(report.states.size(), 3u);
  const StableState& sprung = report.states[2];
  const double t = column(result, sprung.found.values, "first.foot");
  EXPECT_NEAR(2 * t / std::sin(t) + 1.5 * std::cos(t), 3.1, 1e-9);
  double low = 10;
  for (double at = 1.2; at < 1.5; at += 1e-5)
    low = std::min(low, 2 * at / std::sin(at) + 1.5 * std::cos(at));
  EXPECT_NEAR(sprung.low, low, 1e-9);
  EXPECT_TRUE(sprung.is_garden_of_eden);
  EXPECT_TRUE(sprung.high_is_limit);
}

/// On the way from the limit point the knee meets its stop; from the corner it leaves it again.
TEST(CornerGraph, AJumpFromACornerSwitchesTheSpringThatItLeaves) {
  const io::Case c = case_of("snap-through/case-toggle.toml");
  const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
  ASSERT_TRUE(result.snap);
  int from_corner = 0;
  for (const Jump& jump : result.snap->jumps) {
    if (std::abs(column(result, jump.critical.values, "lambda") - 0.31569001083599) > 1e-9)
      continue;
    ++from_corner;
    EXPECT_EQ(jump.switches.size(), 1u);
  }
  EXPECT_EQ(from_corner, 1);
}

/// A shallow truss (span 200, height 20, bars of stiffness 50) above a stop at y = -10. Snapped, it rests on the stop;
/// the load falls until it lifts off, where the truss without a stop is unstable and snaps back.
using StopGraph = io::CaseFiles;

TEST_F(StopGraph, JumpsFromTheCornerWhereAStateLetsGoOfItsStop) {
  const io::Case c = load(R"(
[[node]]
name = "l"
at = [-100, 0]
fixed = true
[[node]]
name = "r"
at = [100, 0]
fixed = true
[[node]]
name = "apex"
at = [0, 20]
[[bar]]
from = "l"
to = "apex"
stiffness = 50
[[bar]]
from = "r"
to = "apex"
stiffness = 50
[[spring]]
name = "stop"
shape = "line"
of = ["apex", { on = "base", at = [-1, -10] }, { on = "base", at = [1, -10] }]
law = { law = "one_sided", stiffness = 30, from = 0, side = "below" }
[[study]]
name = "states"
kind = "transitions"
control = "load"
direction = [0, -1]
until = { apex.y = [-50, 30], lambda = [-30, 30] }
)");
  const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
  ASSERT_TRUE(result.snap && result.snap->transitions);
  const TransitionReport& report = *result.snap->transitions;
  const double drawn = std::hypot(100, 20);
  const auto energy = [&](double y) { return 50 * std::pow(std::hypot(100, y) - drawn, 2); };
  const auto lambda = [&](double y) {
    return -100 * (std::hypot(100, y) - drawn) * y / std::hypot(100, y);
  };
  double below = 20, above = 30;  // where the truss without its stop bears the load of the corner
  for (int i = 0; i < 60; ++i) {
    const double middle = (below + above) / 2;
    (lambda(middle) > lambda(-10) ? below : above) = middle;
  }
  const double load = lambda(-10);
  const double released = energy(-10) - 10 * load - energy(below) - below * load;
  int down = 0;
  for (const Transition& t : report.transitions) {
    if (t.loading > 0) continue;
    ++down;
    EXPECT_GT(t.jump, 0);
    EXPECT_EQ(t.to, 1);
    EXPECT_NEAR(t.lambda, load, 1e-8);
    EXPECT_NEAR(t.released, released, 1e-6);
  }
  EXPECT_EQ(down, 1);
}

TEST(LowestWay, GoesOverOtherStatesWhereTheirSaddlesAreLower) {
  TransitionReport report;
  report.states.resize(3);
  const auto barrier = [](int first, int second, double saddle, double a, double b) {
    Barrier at{
        .first = first, .second = second, .from_first = saddle - a, .from_second = saddle - b};
    at.saddle.energy = saddle;
    return at;
  };
  // Minima at 0, 1 and 2; the saddle between 1 and 3 is the highest.
  report.barriers = {barrier(1, 3, 10, 0, 2), barrier(1, 2, 4, 0, 1), barrier(2, 3, 5, 1, 2),
                     barrier(3, 0, 7, 2, 0)};
  find_lowest_ways(report, 0);
  EXPECT_EQ(report.barriers[0].lowest_from_first, 5);
  EXPECT_EQ(report.barriers[0].lowest_from_second, 3);
  EXPECT_EQ(report.barriers[1].lowest_from_first, 4);
  EXPECT_EQ(report.barriers[2].lowest_from_second, 3);
  EXPECT_EQ(report.barriers[3].lowest_from_first, 5);
  ASSERT_EQ(report.escapes.size(), 3u);
  EXPECT_EQ(report.escapes[0].energy, 4);
  EXPECT_EQ(report.escapes[1].energy, 3);
  EXPECT_EQ(report.escapes[2].energy, 3);
  EXPECT_EQ(report.escapes[2].to, 2);
}

TEST(LowestWay, GoesOverStatesThatWereJoinedBefore) {
  TransitionReport report;
  report.states.resize(3);
  const auto barrier = [](int first, int second, double saddle) {
    Barrier at{.first = first, .second = second, .from_first = saddle, .from_second = saddle};
    at.saddle.energy = saddle;
    return at;
  };
  report.barriers = {barrier(2, 3, 4), barrier(1, 2, 5), barrier(1, 3, 10)};  // all minima at 0
  find_lowest_ways(report, 0);
  EXPECT_EQ(report.barriers[2].lowest_from_first, 5);
  EXPECT_EQ(report.barriers[2].lowest_from_second, 5);
}

/// A slide whose spring hardens by nine orders of magnitude within the range of its load.
using HardeningCurve = io::CaseFiles;

const std::string hardening = R"(
[[body]]
name = "pin"
task_space = "xy"
pose = [0, 0]

[[chain]]
name = "slide"
elements = [
  { joint = "prismatic", axis = "x", name = "way", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 1, 0, 1e6, 0, 1e9] } },
]

[[study]]
name = "push"
control = "load"
direction = [1, 0]
until = { lambda = [-1e9, 1e9] }
)";

TEST_F(HardeningCurve, NeedsFewPointsInEveryKindOfStudyWithJumps) {
  const auto rows = [&](const std::string& kind) {
    const io::Case c = load(hardening + kind);
    const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
    EXPECT_TRUE(complete(result)) << kind;
    return result.branches.at(0).samples.size();
  };
  const std::size_t plain = rows("");
  EXPECT_LT(plain, 2000u);
  for (const std::string kind :
       {"kind = \"snap_through\"\n", "kind = \"load_cycle\"\ncycle = { levels = [1e8, 0] }\n",
        "kind = \"transitions\"\n"})
    EXPECT_LT(rows(kind), 2000u) << kind;
}

using MovedParameter = io::CaseFiles;

/// The law 1 u + b u^3 rises everywhere for b >= 0 only.
TEST_F(MovedParameter, IsDoubtedWhereALawBeginsToFall) {
  const std::string text = R"(
[parameters]
b = { value = 1, unit = "1", description = "cubic term" }
[[body]]
name = "pin"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "slide"
elements = [
  { joint = "prismatic", axis = "x", name = "way", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 1, 0, "b"] } },
]
[[study]]
name = "soften"
control = "parameter"
parameter = "b"
load = [0.1, 0]
)";
  const auto run = [&](const std::string& until) {
    const io::Case c = load(text + until);
    const io::PlannedRun& planned = c.runs.at(0);
    return run_study(planned.mechanism, planned.plan, &planned.family.value());
  };
  EXPECT_TRUE(complete(run("until = { lambda = [0.5, 2] }\n")));
  const StudyResult falling = run("until = { lambda = [-1, 2] }\n");
  EXPECT_FALSE(complete(falling));
  ASSERT_FALSE(falling.doubts.empty());
  EXPECT_NE(falling.doubts.back().find("falls"), std::string::npos) << falling.doubts.back();
}

}  // namespace
}  // namespace springfold::analysis
