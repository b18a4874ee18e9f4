// Half-branches of guyed columns whose foot stands on a stiff slide, under load control and with the displacement
// driven.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

std::string sprung_hinge(double stiffness) {
  return "  { joint = \"revolute\", axis = \"z\", role = \"preloaded\", spring = { law = "
         "\"linear\", "
         "stiffness = " +
         number(stiffness) + " } },\n";
}

std::string resting_cable(const std::string& name, double side) {
  return "[[spring]]\nname = \"" + name + "\"\nfrom = \"c." + name +
         "\"\nto = \"c.top\"\nlaw = { law = \"one_sided\", stiffness = 1, from = " +
         number(std::hypot(side, 3.3)) + " }\n";
}

/// Three links on a slide that the column's weight presses down; two cables rest between the slide and the top.
std::string column_on_slide(double foot) {
  return "[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [0, 3.2]\n[[chain]]\nname = "
         "\"c\"\nelements = [\n  { joint = \"prismatic\", axis = \"y\", role = \"preloaded\", "
         "spring = { law = \"linear\", stiffness = " +
         number(foot) +
         " } },\n  { point = \"left\", at = [-0.5, -0.1] },\n  { point = \"right\", at = [0.5, "
         "-0.1] "
         "},\n" +
         sprung_hinge(0.22) + "  { rigid = [0, 1.2] },\n" + sprung_hinge(0.86) +
         "  { rigid = [0, 1] },\n" + sprung_hinge(0.21) +
         "  { rigid = [0, 1] },\n  { point = \"top\" },\n]\n" + resting_cable("left", -0.5) +
         resting_cable("right", 0.5);
}

struct Places {
  std::vector<double> forces{}, branches{};
};

Places half_branches(const StudyResult& result) {
  Places places;
  for (const auto& event : result.branches[0].events) {
    if (event.kind != EventKind::branching_kink) continue;
    places.forces.push_back(value(result, event.row, "force"));
    double count = 0;
    for (const auto& branch : result.branches) count += branch.origin == event.label ? 1 : 0;
    places.branches.push_back(count);
  }
  return places;
}

TEST(CablesOnSlides, HalfBranchesLeaveAtTheSameForcesHoweverTheColumnIsDriven) {
  // What one cable adds to the stiffness is the same wherever the slide stands.
  const auto places = [](double foot, const std::string& control, double reach) {
    const StudyResult result =
        run(column_on_slide(foot) + "[[study]]\nname = \"s\"\ncontrol = \"" + control +
            "\"\ndirection = [0, -1]\nuntil = { lambda = [" + number(-0.1 * reach) + ", " +
            number(2 * reach) + "], tip.x = [-0.2, 0.2] }\nbranches = { depth = 1 }\n")
            .of("s");
    EXPECT_TRUE(complete(result)) << foot << " " << control;
    return half_branches(result);
  };
  const Places loaded = places(1, "load", 1);
  ASSERT_EQ(loaded.forces.size(), 3u);
  EXPECT_EQ(loaded.branches, (std::vector<double>{2, 2, 2}));
  for (const double foot : {1.0, 50.0, 100.0, 1000.0}) {
    const Places driven = places(foot, "mixed", 1 / foot);
    ASSERT_EQ(driven.forces.size(), 3u) << foot;
    EXPECT_EQ(driven.branches, loaded.branches) << foot;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(driven.forces[i], loaded.forces[i], 1e-9) << foot;
  }
}

}  // namespace
}  // namespace springfold::io
