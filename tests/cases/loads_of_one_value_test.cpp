// First critical loads over a parameter of which one value has another critical point than all values beside it: a
// strut on a softening hinge, whose load is tilted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

/// Moment q up to 0.8, a fifth of its slope behind. Upright it branches at c/L = 1, supercritically; tilted by next to
/// nothing it bends at once, and the load turns back at the breakpoint: lambda sin(0.8) = 0.8.
const double load_of_tilted = 0.8 / std::sin(0.8);

std::string tilted_strut(const std::string& range) {
  return strut_on_hinge(
             "{ law = \"piecewise_linear\", breakpoints = [-0.8, 0.8], stiffnesses = [0.2, 1, 0.2] "
             "}") +
         R"toml([[study]]
name = "tilt"
kind = "critical_load"
control = "load"
direction = ["sin(e)", "-cos(e)"]
until = { lambda = [-0.1, 3], s.q = [-2, 2] }
critical_load = { of = "loss_of_stability", parameter = "e", )toml" +
         range + " }\n";
}

double load_at(const analysis::Sample& row) { return row.values[1]; }
double tilt_at(const analysis::Sample& row) { return row.values.back(); }

/// The branch of one row, if there is just one.
const analysis::Branch* lone_value(const analysis::StudyResult& result) {
  const auto is_alone = [](const analysis::Branch& b) { return b.samples.size() == 1; };
  return std::ranges::count_if(result.branches, is_alone) == 1
             ? &*std::ranges::find_if(result.branches, is_alone)
             : nullptr;
}

void expect_lone_branch_point(const analysis::StudyResult& result) {
  const analysis::Branch* lone = lone_value(result);
  ASSERT_NE(lone, nullptr);
  EXPECT_EQ(tilt_at(lone->samples.front()), 0);
  EXPECT_NEAR(load_at(lone->samples.front()), 1, 1e-12);
  ASSERT_EQ(lone->events.size(), 1U);
  EXPECT_EQ(lone->events.front().kind, analysis::EventKind::branch_point);
  EXPECT_TRUE(result.doubts.empty());
}

TEST(LoadsOfOneValue, AValueWhoseBranchPointNoNeighbourHasIsARowOfItsOwn) {
  const auto result = run(tilted_strut("range = [-0.1, 0.1], values = 5")).of("tilt");
  expect_lone_branch_point(result);
  ASSERT_EQ(result.branches.size(), 3U);
  EXPECT_NEAR(load_at(result.branches[0].samples.back()), load_of_tilted, 1e-9);
  EXPECT_NEAR(load_at(result.branches[2].samples.front()), load_of_tilted, 1e-9);
}

TEST(LoadsOfOneValue, AMarkedValueIsLookedAtToo) {
  const auto result =
      run(tilted_strut("range = [-0.1, 0.1], values = 4 }\nmark = { e = [0] ")).of("tilt");
  expect_lone_branch_point(result);
}

TEST(LoadsOfOneValue, AtTheEndOfTheRangeTheValueHasNotTheLoadThatItsNeighboursComeTo) {
  for (const std::string range :
       {"range = [0, 0.1], values = 4", "range = [-0.1, 0], values = 4"}) {
    SCOPED_TRACE(range);
    const auto result = run(tilted_strut(range)).of("tilt");
    expect_lone_branch_point(result);
    ASSERT_EQ(result.branches.size(), 2U);
    for (const analysis::Branch& branch : result.branches) {
      if (branch.samples.size() == 1) continue;
      for (const analysis::Sample& row : branch.samples) EXPECT_NE(tilt_at(row), 0);
    }
  }
}

TEST(LoadsOfOneValue, ARangeThatMissesTheValueHasTheLoadOfItsNeighboursThroughout) {
  const auto result = run(tilted_strut("range = [-0.1, 0.1], values = 4")).of("tilt");
  EXPECT_EQ(lone_value(result), nullptr);
  EXPECT_TRUE(result.doubts.empty());
}

TEST(LoadsOfOneValue, PiecesThatComeToItAndEndBeforeTheNextValueAreFollowed) {
  // An asymmetric hinge, torque T = q + q^2/2 + q^3: limit points for small tilts of one sign only, from the
  // transcritical branch point of the upright strut to the cusp at T + T'' = 0, tan(q - e) = T/T' (the sign of e is
  // that of the load's side).
  const auto result =
      run(strut_on_hinge("{ law = \"polynomial\", coefficients = [0, 1, 0.5, 1] }") +
          R"toml([[study]]
name = "tilt"
kind = "critical_load"
control = "load"
direction = ["sin(e)", "-cos(e)"]
until = { lambda = [-0.2, 1.4], s.q = [-1.5, 1.5] }
critical_load = { of = "loss_of_stability", parameter = "e", range = [-0.1, 0.1], values = 5 }
)toml")
          .of("tilt");
  EXPECT_TRUE(result.doubts.empty());
  ASSERT_EQ(result.branches.size(), 1U);
  double q = -0.14;  // of T + T'' = 1 + 7 q + q^2/2 + q^3
  for (int i = 0; i < 20; ++i) q -= (1 + q * (7 + q * (0.5 + q))) / (7 + q * (1 + 3 * q));
  const double torque = q * (1 + q * (0.5 + q)), slope = 1 + q * (1 + 3 * q);
  const double tilt = q - std::atan(torque / slope);
  const auto& rows = result.branches.front().samples;
  EXPECT_NEAR(tilt_at(rows.front()), 0, 1e-9);
  EXPECT_NEAR(load_at(rows.front()), 1, 1e-9);
  EXPECT_NEAR(tilt_at(rows.back()), tilt, 1e-9);
  EXPECT_NEAR(load_at(rows.back()), torque / std::sin(q - tilt), 1e-9);
}

TEST(LoadsOfOneValue, SpringsThatSwitchAtOnceThereLeaveNoDoubt) {
  // A flat truss that is pressed between two stops, which meet it at once; tilted, one of them is the first.
  const std::string truss = truss_between_springs + R"toml([[study]]
name = "tilt"
kind = "critical_load"
control = "load"
direction = ["sin(psi)", "-cos(psi)"]
until = { lambda = [-0.01, 0.3], t.y = [-0.6, 0.6] }
critical_load = { of = "loss_of_stability", parameter = "psi", range = [-0.1, 0.1], values = )toml";
  const auto hits = run(truss + "5 }\n").of("tilt"), misses = run(truss + "4 }\n").of("tilt");
  EXPECT_EQ(hits.doubts, misses.doubts);
  EXPECT_TRUE(hits.doubts.empty());
}

}  // namespace
}  // namespace springfold::io
