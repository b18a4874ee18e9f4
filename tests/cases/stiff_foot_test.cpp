// Columns of soft hinges on a foot that is orders of magnitude stiffer, under mixed control: the modes stay apart.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

/// Links of length 1 along x, a hinge of stiffness 1 in each of their feet, an axial spring c under the first one.
analysis::StudyResult pushed_column(int links, double c) {
  std::string elements =
      "{ joint = \"prismatic\", axis = \"x\", name = \"foot\", role = \"preloaded\", spring = { "
      "law = "
      "\"linear\", stiffness = " +
      number(c) + " } }";
  for (int i = 1; i <= links; ++i)
    elements +=
        ", { joint = \"revolute\", axis = \"z\", name = \"hinge" + std::to_string(i) +
        "\", role = \"preloaded\", spring = { law = \"linear\", stiffness = 1 } }, { rigid = "
        "[1, 0] }";
  return run("[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [" + std::to_string(links) +
             ", 0]\n[[chain]]\nname = \"column\"\nelements = [" + elements +
             "]\n[[study]]\nname = \"press\"\ncontrol = \"mixed\"\ndirection = [-1, 0]\nuntil = { "
             "force = [-10, 10], column.hinge2 = [\"-60*deg\", \"60*deg\"] }\nbranches = { depth = "
             "1 "
             "}\n")
      .of("press");
}

/// Forces at the branch points of the straight column.
std::vector<double> branching_forces(const analysis::StudyResult& result) {
  std::vector<double> forces;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == analysis::EventKind::branch_point)
      forces.push_back(value(result, event.row, "force"));
  return forces;
}

TEST(StiffFoot, LeavesTheModesOfTwoLinksApart) {
  const double root = std::sqrt(5.0);
  for (const double c : {1e3, 1e5, 3e5, 1e6, 3e6}) {
    SCOPED_TRACE(c);
    const auto result = pushed_column(2, c);
    EXPECT_TRUE(complete(result));
    const auto forces = branching_forces(result);
    ASSERT_EQ(forces.size(), 2u);
    EXPECT_NEAR(forces[0], (3 - root) / 2, 1e-9);
    EXPECT_NEAR(forces[1], (3 + root) / 2, 1e-9);
  }
}

TEST(StiffFoot, LeavesTheModesOfThreeLinksApart) {
  for (const double c : {3e4, 1e5, 3e5, 1e6, 3e6}) {
    SCOPED_TRACE(c);
    const auto result = pushed_column(3, c);
    EXPECT_TRUE(complete(result));
    const auto forces = branching_forces(result);
    ASSERT_EQ(forces.size(), 3u);
    for (const std::size_t j : {0u, 1u, 2u}) {
      const double half = std::sin((2.0 * static_cast<double>(j) + 1) * std::numbers::pi / 14);
      EXPECT_NEAR(forces[j], 4 * half * half, 1e-9);
    }
  }
}

}  // namespace
}  // namespace springfold::io
