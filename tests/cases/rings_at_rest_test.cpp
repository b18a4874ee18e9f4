// A mast in space within a ring of equal cables at rest: half-branches along which cables across stay at rest to first
// order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using std::numbers::pi;

using analysis::EventKind;
using analysis::StudyResult;

constexpr double foot_spring = 0.05;

/// Cables around a mast, the first one in the direction `first`, and the spring of its joint.
struct Ring {
  int n = 0;
  double first = 0;
  double foot = foot_spring;
};

/// A mast of length 1 on a universal joint with springs, and n cables of stiffness 1 from a circle of radius 1 to its
/// top. Where it leans by w the cables with w . u < 0 act, each with 1/2 of its stiffness across: for even n > 2
/// together n/8 in all directions. Cables across w keep their length, but for what the springs of the joint add to
/// third order.
std::string ring(const Ring& of) {
  const auto& [n, first, foot] = of;
  std::string text = R"([[body]]
name = "top"
task_space = "xyz"
pose = [0, 0, 1]
[[chain]]
name = "mast"
elements = [
  { joint = "universal", axes = ["x", "y"], role = "preloaded", spring = { law = "linear", stiffness = )" +
                     number(foot) + R"( } },
  { rigid = [0, 0, 1] },
]
)";
  for (int i = 0; i < n; ++i) {
    const double angle = first + 2 * pi * i / n;
    text +=
        "[[spring]]\nname = \"c" + std::to_string(i) + "\"\nfrom_at = [" + number(std::cos(angle)) +
        ", " + number(std::sin(angle)) +
        ", 0]\nto = \"top\"\nlaw = { law = \"one_sided\", stiffness = 1, from = \"sqrt(2)\" }\n";
  }
  return text + R"([[study]]
name = "press"
control = "load"
direction = [0, 0, -1]
until = { lambda = [-0.1, 2], "top.z" = [0.95, 1.1] }
branches = { depth = 1 }
)";
}

/// Angles in which branches leave at a load, each against the nearest multiple of `unit` from `first`.
std::vector<double> off_directions(const StudyResult& result, const std::string& label,
                                   double first, double unit) {
  std::vector<double> list;
  for (const auto& branch : result.branches) {
    if (branch.origin != label) continue;
    const auto row = branch.samples.size() / 2;
    const double angle =
        std::atan2(value(result, branch, row, "top.y"), value(result, branch, row, "top.x"));
    list.push_back(std::remainder(angle - first, unit));
  }
  return list;
}

TEST(RingsAtRest, BranchesLeaveAlongEachCableAndHalfWayBetween) {
  // Along the diagonal of the joint cables across leave their thresholds to fifth order only.
  const Ring rings[] = {{4, 0.0}, {4, 0.13}, {6, 0.7}, {6, 0.0, 0.00113}, {8, 0.0}};
  for (const auto& [n, first, foot] : rings) {
    SCOPED_TRACE(std::to_string(n) + " cables from " + number(first));
    const StudyResult result = run(ring({n, first, foot})).of("press");
    EXPECT_TRUE(complete(result));
    const auto loads = lambdas(result, EventKind::branching_kink);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_NEAR(loads[0], foot + n / 8.0, 1e-10);
    const auto off = off_directions(result, "KB1", first, pi / n);
    EXPECT_EQ(off.size(), 2u * static_cast<std::size_t>(n));
    for (const double angle : off) EXPECT_NEAR(angle, 0, 0.1);
  }
}

TEST(RingsAtRest, BetweenTwoCablesTheMastLeansAcrossThemFirst) {
  for (const double first : {0.13, 0.3, 0.7, 1.3}) {
    SCOPED_TRACE(first);
    const StudyResult result = run(ring({2, first})).of("press");
    EXPECT_TRUE(complete(result));
    std::vector<double> loads = lambdas(result, EventKind::branching_kink);
    for (const double load : lambdas(result, EventKind::branch_point)) loads.push_back(load);
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_NEAR(loads[0], foot_spring, 1e-10);
    EXPECT_NEAR(loads[1], foot_spring + 0.5, 1e-10);
    for (const std::string label : {"KB1", "KB2"}) {
      const double along = label == "KB1" ? first + pi / 2 : first;
      const auto off = off_directions(result, label, along, pi);
      EXPECT_EQ(off.size(), 2u);
      for (const double angle : off) EXPECT_NEAR(angle, 0, 0.1);
    }
  }
}

/// The joint is as stiff in all directions, and its mast leans along the axes and diagonals of the joint: to those of
/// them on which the cable is slack. Across the cable, which bears it to third order only, it leans to one side.
TEST(RingsAtRest, BesideOneCableOfAJointAsStiffInAllDirectionsEveryWayIsThereOnce) {
  struct Leans {
    double first = 0;
    std::vector<double> angles{};
  };
  const Leans cases[] = {{0.0, {-pi / 2, -pi / 4, 0, pi / 4, pi / 2}},
                         {0.3, {0.3 - pi / 2, -pi / 4, 0, pi / 4, pi / 2}}};
  for (const auto& [first, angles] : cases) {
    SCOPED_TRACE(first);
    const StudyResult result = run(ring({1, first})).of("press");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    const auto loads = lambdas(result, EventKind::branching_kink);
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_NEAR(loads[0], foot_spring, 1e-10);
    EXPECT_NEAR(loads[1], foot_spring + 0.5, 1e-10);
    auto leans = off_directions(result, "KB1", 0, 2 * pi);
    std::sort(leans.begin(), leans.end());
    ASSERT_EQ(leans.size(), angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i) EXPECT_NEAR(leans[i], angles[i], 0.1);
  }
}

}  // namespace
}  // namespace springfold::io
