// Where half-branches leave a branch point rates and determinants vanish with the distance from it: rounding has their
// sign, and it is no event.
#include <gtest/gtest.h>

#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

std::string sway_leg(const std::string& name, const std::string& x) {
  return "[[chain]]\nname = \"" + name + "\"\nfrom_at = [" + x + ", 0]\nto_at = [" + x +
         ", 0]\nelements = [\n" +
         R"toml(
  { joint = "revolute", axis = "z", name = "f", role = "preloaded", initial = "90*deg", spring = { law = "linear", stiffness = 0.93, free = "90*deg" } },
  { joint = "prismatic", axis = "x", name = "e", role = "virtual", stiffness = 136 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", initial = "-90*deg", spring = { law = "linear", stiffness = 0.73, free = "-90*deg" } },
]
)toml";
}

std::size_t count_of(const analysis::Branch& branch, EventKind kind) {
  std::size_t found = 0;
  for (const auto& event : branch.events) found += event.kind == kind ? 1u : 0u;
  return found;
}

/// A plate on two legs with springs in their hinges, pressed down by a driven displacement: it sways to either side
/// from the branch point on, and the force grows along both ways.
TEST(HalfBranchStarts, OfAParallelGuideHaveNoExtremumOfTheForce) {
  const StudyResult result =
      run("[[body]]\nname = \"p\"\ntask_space = \"planar\"\npose = [0, 1, 0]\n" +
          sway_leg("left", "-0.75") + sway_leg("right", "0.75") +
          "[[study]]\nname = \"press\"\ncontrol = \"mixed\"\ndirection = [0, -1, 0]\n"
          "until = { lambda = [-0.1, 0.5], p.x = [-0.9, 0.9] }\nbranches = { depth = 1 }\n")
          .of("press");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 3u);
  const auto index = column(result, "index_force");
  for (std::size_t b : {1u, 2u}) {
    SCOPED_TRACE(b);
    EXPECT_EQ(count_of(result.branches[b], EventKind::limit_point), 0u);
    for (const auto& row : result.branches[b].samples) EXPECT_EQ(row.values[index], 0);
  }
}

/// Two links side by side, each under the same load: what one does is nothing to the other. With k = 1 and 1.5 the
/// first one falls at 1, the second one at 1.5, and both branches are stable.
TEST(HalfBranchStarts, OfTwoLinksSideBySideHaveNoChangeOfStability) {
  const auto link = [](const std::string& name, const std::string& x, const std::string& k) {
    return "[[body]]\nname = \"" + name + "\"\ntask_space = \"xy\"\npose = [" + x +
           ", 1]\n[[chain]]\nname = \"" + name + "-bar\"\nto = \"" + name + "\"\nfrom_at = [" + x +
           ", 0]\nelements = [{ joint = \"revolute\", axis = \"-z\", name = \"foot\", role = "
           "\"preloaded\", spring = { law = \"linear\", stiffness = " +
           k + " } }, { rigid = [0, 1] }]\n";
  };
  const StudyResult result =
      run(link("a", "0", "1") + link("b", "3", "1.5") +
          "[[study]]\nname = \"press\"\nbody = \"b\"\ncontrol = \"load\"\n"
          "loads = [{ on = \"a\", force = [0, -1], scale = \"lambda\" }, "
          "{ on = \"b\", force = [0, -1], scale = \"lambda\" }]\n"
          "until = { lambda = [-0.5, 4], a-bar.foot = [-2, 2], b-bar.foot = [-2, 2] }\n"
          "branches = { depth = 3 }\n")
          .of("press");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  EXPECT_EQ(result.branches.size(), 9u);
  for (const auto& branch : result.branches)
    EXPECT_EQ(count_of(branch, EventKind::stability_change), 0u);
}

/// A plate on four cables that turns half round under its load: both ways end in one point, where they are mirror
/// images and the way down turns back.
TEST(HalfBranchEnds, OfAPlateOnCablesThatTurnsRoundHaveNoEventOfTheirOwn) {
  std::string text = "[[body]]\nname = \"p\"\ntask_space = \"planar\"\npose = [0, 0, 0]\n";
  const auto cable = [&](const std::string& name, const std::string& foot, const std::string& at,
                         const std::string& from) {
    text += "[[spring]]\nname = \"" + name + "\"\nfrom = \"base\"\nfrom_at = " + foot +
            "\nto = \"p\"\nto_at = " + at +
            "\nlaw = { law = \"one_sided\", stiffness = 8.4, from = " + from + " }\n";
  };
  cable("a", "[-0.99, 1.24]", "[0.35, 0]", "1.643134808833408");
  cable("b", "[0.99, 1.24]", "[-0.35, 0]", "1.643134808833408");
  cable("c", "[-0.99, -1.24]", "[-0.35, 0]", "1.325650029230943");
  cable("d", "[0.99, -1.24]", "[0.35, 0]", "1.325650029230943");
  const StudyResult result =
      run(text +
          "[[study]]\nname = \"s\"\ntrace = { maximum_step = 0.05, maximum_points = 1500 }\n"
          "control = \"load\"\ndirection = [0, -1, 0]\nuntil = { lambda = [-8, 8], p.x = [-3, 3], "
          "p.y = [-3, 3], p.phi = [-4, 4] }\nbranches = { depth = 1 }\n")
          .of("s");
  ASSERT_GE(result.branches.size(), 3u);
  EXPECT_EQ(count_of(result.branches[1], EventKind::stability_change),
            count_of(result.branches[2], EventKind::stability_change));
}

}  // namespace
}  // namespace springfold::io
