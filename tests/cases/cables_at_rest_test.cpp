// Cables that just rest, or are stretched or slack by next to nothing, in the upright state of a guyed mast.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

enum class As { chain, spring };

/// A cable of stiffness 1 from the top of the mast to the ground at x = +-1, stretched by `stretch`.
std::string cable(const std::string& name, double side, double stretch, As as) {
  const std::string from = number(std::sqrt(2.0) - stretch);
  const std::string law = "{ law = \"one_sided\", stiffness = 1, from = " + from + " }";
  if (as == As::spring)
    return "[[spring]]\nname = \"" + name + "\"\nfrom_at = [" + number(side) +
           ", 0]\nto = \"top\"\nlaw = " + law + "\n";
  return "[[chain]]\nname = \"" + name + "\"\nfrom_at = [" + number(side) +
         ", 0]\nelements = [{ joint = \"revolute\", axis = \"z\", initial = \"" +
         number(45 * side) +
         "*deg\" }, { joint = \"prismatic\", axis = \"y\", role = \"preloaded\", "
         "initial = \"sqrt(2)\", spring = " +
         law + " }]\n";
}

/// A mast of length 1 with a spring of stiffness c in its foot, under a load on its top.
std::string mast(double c, const std::string& cables) {
  return "[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n"
         "[[chain]]\nname = \"mast\"\nelements = [{ joint = \"revolute\", axis = \"-z\", name = "
         "\"foot\", role = \"preloaded\", spring = { law = \"linear\", stiffness = " +
         number(c) + " } }, { rigid = [0, 1] }]\n" + cables +
         "[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\n"
         "until = { lambda = [-0.2, 2], \"mast.foot\" = [-0.3, 0.3] }\nbranches = { depth = 1 }\n";
}

std::size_t branches_from(const StudyResult& result, const std::string& label) {
  std::size_t count = 0;
  for (const auto& branch : result.branches) count += branch.origin == label ? 1u : 0u;
  return count;
}

/// Index in the rows of the upright state below and above a load.
void expect_index(const StudyResult& result, double from, double to, int index) {
  int rows = 0;
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double load = value(result, row, "lambda");
    if (!(load > from && load < to)) continue;
    EXPECT_EQ(value(result, row, "index"), index) << "at " << load;
    EXPECT_EQ(value(result, row, "index_force"), index) << "at " << load;
    ++rows;
  }
  EXPECT_GT(rows, 2);
}

TEST(CablesAtRest, TwoCablesHoldAMastUpToHalfOfWhatTheyHoldWhenStretched) {
  // Each acts on its own side: P = k sin^2 = 1/2. Stretched by 1e-10 of the length or less they rest.
  for (const As as : {As::chain, As::spring})
    for (const double stretch : {0.0, 1e-12, 3e-11, -1e-12, -3e-11}) {
      SCOPED_TRACE(number(stretch) + (as == As::chain ? ", chain" : ", spring"));
      const StudyResult result =
          run(mast(0, cable("left", -1, stretch, as) + cable("right", 1, stretch, as))).of("press");
      EXPECT_TRUE(complete(result));
      const auto loads = lambdas(result, EventKind::branching_kink);
      ASSERT_EQ(loads.size(), 1u);
      EXPECT_NEAR(loads[0], 0.5, 1e-10);
      EXPECT_EQ(branches_from(result, "KB1"), 2u) << "to both sides";
      expect_index(result, -0.2, 0.4999, 0);
      expect_index(result, 0.5001, 2, 1);
    }
}

TEST(CablesAtRest, OneCableLeavesHalfBranchesAtTwoLoads) {
  // Without it P = c = 0.3, with it c + 1/2: to the other side the mast falls earlier.
  for (const As as : {As::chain, As::spring}) {
    SCOPED_TRACE(as == As::chain ? "chain" : "spring");
    const StudyResult result = run(mast(0.3, cable("left", -1, 0, as))).of("press");
    EXPECT_TRUE(complete(result));
    const auto loads = lambdas(result, EventKind::branching_kink);
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_NEAR(loads[0], 0.3, 1e-10);
    EXPECT_NEAR(loads[1], 0.8, 1e-10);
    expect_index(result, -0.2, 0.2999, 0);
    expect_index(result, 0.3001, 2, 1);
  }
}

TEST(CablesAtRest, StretchedByAMillionthTheirBranchesSwitchRightBehindTheBranchPoint) {
  // P = 1 - T / sqrt(2) with the tension T = k times the stretch: second-order terms of both cables.
  for (const double stretch : {1e-6, 1e-5, 1e-3}) {
    SCOPED_TRACE(stretch);
    const StudyResult result = run(mast(0, cable("left", -1, stretch, As::spring) +
                                               cable("right", 1, stretch, As::spring)))
                                   .of("press");
    EXPECT_TRUE(complete(result));
    const auto loads = lambdas(result, EventKind::branch_point);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_NEAR(loads[0], 1 - stretch / std::sqrt(2.0), 1e-10);
    EXPECT_EQ(branches_from(result, "BP1"), 2u);
    for (std::size_t b = 1; b < result.branches.size(); ++b) {
      ASSERT_FALSE(result.branches[b].events.empty());
      int releases = 0;
      for (const auto& event : result.branches[b].events)
        releases +=
            event.kind == EventKind::switching || event.kind == EventKind::corner_limit_point;
      EXPECT_EQ(releases, 1) << "one cable goes slack";
    }
  }
}

/// A column of two links of lengths 0.93 and 0.56 with springs in its hinges; a resting cable leads from its top to the
/// ground.
std::string guyed_column(const std::string& trace) {
  return R"([[body]]
name = "top"
task_space = "xy"
pose = [0, 1.49]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", role = "preloaded", spring = { law = "linear", stiffness = 0.26 } },
  { rigid = [0, 0.93] },
  { joint = "revolute", axis = "z", role = "preloaded", spring = { law = "linear", stiffness = 0.74 } },
  { rigid = [0, 0.56] },
  { point = "top" },
]
[[spring]]
name = "cable"
from_at = [-1.14, -0.09]
to = "c.top"
law = { law = "one_sided", stiffness = 0.72, from = 1.9483326204732088 }
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { lambda = [-0.13, 2.7] }
branches = { depth = 0 }
)" + trace;
}

TEST(CablesAtRest, AtAHalfBranchTheIndexIsTheSmallerOfBothSidesWhateverTheSteps) {
  // Without the cable the determinant of the stiffness is (c1 - P l1 + c2) (c2 - P l2) - (c2)^2 in absolute angles;
  // with it both loads are larger: four in all. The count of all pieces grows at the first and at the last.
  for (const std::string trace :
       {"", "trace = { maximum_step = 0.05 }\n", "trace = { maximum_step = 0.013 }\n"}) {
    SCOPED_TRACE(trace);
    const StudyResult result = run(guyed_column(trace)).of("press");
    EXPECT_TRUE(complete(result));
    std::vector<double> here, before, behind;
    for (const auto& event : result.branches[0].events)
      if (event.kind == EventKind::branching_kink)
        for (const char* index : {"index", "index_force"}) {
          before.push_back(value(result, event.row - 1, index));
          here.push_back(value(result, event.row, index));
          behind.push_back(value(result, event.row + 1, index));
        }
    EXPECT_EQ(before, (std::vector<double>{0, 0, 1, 1, 1, 1, 1, 1}));
    EXPECT_EQ(here, before);
    EXPECT_EQ(behind, (std::vector<double>{1, 1, 1, 1, 1, 1, 2, 2}));
  }
}

/// The load at which the cable on the side that the mast leans to goes slack, c = k = 1, free lengths sqrt(2) -
/// stretch: s = sin q = 1 - (free/sqrt(2))^2, P s = c q + k (l - free) dl/dq with the other cable's l^2 - free^2 = 4 s.
double load_at_slack(double stretch) {
  const double share = stretch / std::sqrt(2.0), s = 2 * share - share * share, q = std::asin(s);
  const double l = std::sqrt(2 + 2 * s), free = std::sqrt(2.0) - stretch;
  return q / s + 4 * std::cos(q) / (l * (l + free));
}

TEST(CablesAtRest, StretchedByABillionthTheMastIsStableUntilOneGoesSlackAndFallsThen) {
  for (const As as : {As::chain, As::spring})
    for (const double stretch : {2e-9, 3e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
      SCOPED_TRACE(number(stretch) + (as == As::chain ? ", chain" : ", spring"));
      const StudyResult result =
          run(mast(1, cable("left", -1, stretch, as) + cable("right", 1, stretch, as))).of("press");
      EXPECT_TRUE(complete(result));
      ASSERT_EQ(result.branches.size(), 3u);
      for (const std::size_t b : {1u, 2u}) {
        const analysis::Branch& branch = result.branches[b];
        const auto slack = std::find_if(branch.events.begin(), branch.events.end(), [](auto& e) {
          return e.kind == EventKind::corner_limit_point;
        });
        ASSERT_NE(slack, branch.events.end());
        EXPECT_NEAR(value(result, branch, slack->row, "lambda"), load_at_slack(stretch), 1e-12);
        for (const char* index : {"index", "index_force"}) {
          EXPECT_EQ(value(result, branch, slack->row - 1, index), 0);
          EXPECT_EQ(value(result, branch, slack->row, index), 0);
          EXPECT_EQ(value(result, branch, slack->row + 1, index), 1);
        }
      }
    }
}

TEST(CablesAtRest, SlackByAMillionthTheyBearTheMastRightBehindTheBranchPoint) {
  // P = c = 0.3; a cable that has become taut bears the mast from there on, at a sway of a few millionths.
  for (const As as : {As::chain, As::spring})
    for (const double slack : {1e-6, 1e-5}) {
      SCOPED_TRACE(number(slack) + (as == As::chain ? ", chain" : ", spring"));
      const StudyResult result =
          run(mast(0.3, cable("left", -1, -slack, as) + cable("right", 1, -slack, as))).of("press");
      EXPECT_TRUE(complete(result));
      const auto loads = lambdas(result, EventKind::branch_point);
      ASSERT_FALSE(loads.empty());
      EXPECT_NEAR(loads[0], 0.3, 1e-10);
      EXPECT_EQ(branches_from(result, "BP1"), 2u);
      for (std::size_t i = 1; i < result.branches.size(); ++i) {
        const auto& events = result.branches[i].events;
        EXPECT_EQ(std::count_if(events.begin(), events.end(),
                                [](const auto& e) { return e.kind == EventKind::switching; }),
                  1);
      }
    }
}

TEST(CablesAtRest, SlackByABillionthAndStifferThanTheFootTheyBearTheMast) {
  for (const As as : {As::chain, As::spring}) {
    std::string text = mast(0.01, cable("left", -1, -1.5e-9, as) + cable("right", 1, -1.5e-9, as));
    const std::string range = "lambda = [-0.2, 2]";
    text.replace(text.find(range), range.size(), "lambda = [-0.002, 0.013]");
    const StudyResult result = run(text).of("press");
    EXPECT_TRUE(complete(result));
    EXPECT_EQ(branches_from(result, "BP1"), 2u);
  }
}

/// An elastic mast of length 1 on a hinge of stiffness 1, and one cable at rest: its length is sqrt(2).
std::string elastic_mast(double axial, double cable) {
  return "[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n"
         "[[chain]]\nname = \"mast\"\nelements = [{ joint = \"revolute\", axis = \"z\", name = "
         "\"foot\", role = \"preloaded\", spring = { law = \"linear\", stiffness = 1 } }, { joint "
         "= \"prismatic\", axis = \"y\", name = \"ax\", role = \"virtual\", stiffness = " +
         number(axial) +
         " }, { rigid = [0, 1] }]\n[[spring]]\nname = \"c1\"\nfrom_at = [-1, 0]\nto = \"top\"\n"
         "law = { law = \"one_sided\", stiffness = " +
         number(cable) +
         ", from = \"sqrt(2)\" }\n[[study]]\nname = \"press\"\ncontrol = \"load\"\n"
         "direction = [0, -1]\nuntil = { lambda = [-2, 2], mast.foot = [-1, 1] }\n"
         "branches = { depth = 1 }\n";
}

TEST(CablesAtRest, OneOnAnElasticMastIsSlackUnderPressureAndTautUnderPullHoweverStiffBothAre) {
  // Under pressure P the mast is 1 - P / axial long, and P (1 - P / axial) = 1 where it buckles.
  constexpr std::pair<double, double> pairs[] = {{1e2, 1e2}, {1e5, 1e3}, {1e5, 1e5},
                                                 {1e3, 1e6}, {1e8, 1e2}, {1e2, 1e8}};
  for (const auto& [axial, cable] : pairs) {
    SCOPED_TRACE(number(axial) + ", " + number(cable));
    const StudyResult result = run(elastic_mast(axial, cable)).of("press");
    EXPECT_TRUE(complete(result));
    EXPECT_EQ(result.branches.size(), 3u);
    const auto switched = lambdas(result, EventKind::switching),
               buckles = lambdas(result, EventKind::branch_point);
    ASSERT_EQ(switched.size(), 1u);
    EXPECT_NEAR(switched[0], 0, 1e-9);
    ASSERT_EQ(buckles.size(), 1u);
    EXPECT_NEAR(buckles[0], 2 / (1 + std::sqrt(1 - 4 / axial)), 1e-9);
    const auto& last = result.branches[0].samples.front();  // pulled: the taut cable draws the mast
    EXPECT_LT(last.values[column(result, "lambda")], -1.9);
    EXPECT_GT(last.values[column(result, "mast.foot")], 0);
  }
}

}  // namespace
}  // namespace springfold::io
