// Angles and folds that are led to places where they jump or are not defined.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;

/// A node on a line, driven along it from the first place to the second, and a spring.
std::string driven(const std::string& fixed, const std::string& from, const std::string& direction,
                   const std::string& until, const std::string& spring) {
  return "[[node]]\nname = \"t\"\nat = " + from + "\nfixed = " + fixed +
         "\n[[spring]]\nname = \"s\"\nlaw = { law = \"linear\", stiffness = 1, free = 2.4 }\n" +
         spring +
         "[[study]]\nname = \"p\"\nbody = \"t\"\ncontrol = \"mixed\"\ndirection = " + direction +
         "\nuntil = { " + until + " }\n";
}

std::string angle_of_node(const std::string& more) {
  return driven("[\"x\"]", "[-1, 0.8]", "[0, -1]", "t.y = [-2, 2]",
                "shape = \"angle\"\nof = [{ on = \"base\", at = [1, 0] }, { on = \"base\", at = "
                "[0, 0] }, \"t\"]\n" +
                    more);
}

TEST(AnglesOfNodes, EndTheCurveWhereTheyWouldJump) {
  const auto result = run(angle_of_node("near = 0\n")).results[0];
  const analysis::Branch& branch = result.branches.at(0);
  EXPECT_FALSE(branch.forward.complete);
  EXPECT_THAT(branch.forward.reason,
              HasSubstr("angle of s would jump by a whole turn: half a turn from near = 0"));
  EXPECT_GT(value(result, branch.samples.size() - 1, "t.y"), 0);
}

TEST(AnglesOfNodes, GoOnThereWithAnotherMiddleOfTheirRange) {
  const auto branch = run(angle_of_node("near = \"pi\"\n")).results[0].branches.at(0);
  EXPECT_TRUE(branch.forward.complete) << branch.forward.reason;
}

TEST(AnglesOfNodes, EndTheCurveAtTheirVertex) {
  const auto branch =
      run(driven("[\"y\"]", "[0.7, 0]", "[-1, 0]", "t.x = [-1.5, 1.5]",
                 "shape = \"angle\"\nof = [{ on = \"base\", at = [1, 1] }, { on = \"base\", at = "
                 "[0, 0] }, \"t\"]\n"))
          .results[0]
          .branches.at(0);
  EXPECT_FALSE(branch.forward.complete);
  EXPECT_THAT(branch.forward.reason, HasSubstr("s would be led through its vertex"));
}

std::string fold_from(const std::string& first) {
  return "shape = \"fold\"\nof = [{ on = \"base\", at = " + first +
         " }, { on = \"base\", at = [0, -0.5, 0] }, { on = \"base\", at = [0, 0.7, 0] }, \"t\"]\n";
}

TEST(FoldsOfNodes, EndTheCurveWhereTheyWouldJump) {
  const auto branch = run(driven("[\"x\", \"y\"]", "[-0.7, 0.3, 0.4]", "[0, 0, 1]",
                                 "t.z = [-1.5, 1.5]", "near = 0\n" + fold_from("[0.8, 0.1, 0]")))
                          .results[0]
                          .branches.at(0);
  const auto& end = branch.forward.complete ? branch.backward : branch.forward;
  EXPECT_FALSE(end.complete);
  EXPECT_THAT(end.reason, HasSubstr("angle of s would jump by a whole turn"));
}

TEST(FoldsOfNodes, EndTheCurveWhereAPointIsOnTheirEdge) {
  const auto branch = run(driven("[\"y\", \"z\"]", "[0.7, 0.3, 0]", "[-1, 0, 0]",
                                 "t.x = [-1.5, 1.5]", fold_from("[0.8, 0.1, 0.5]")))
                          .results[0]
                          .branches.at(0);
  EXPECT_FALSE(branch.forward.complete);
  EXPECT_THAT(branch.forward.reason, HasSubstr("s would be led through its edge"));
}

TEST(Folds, ThatAreClosedFlatAreNoEquilibriaWhereTheirEnergyJumps) {
  // A vertex of four creases: faces that lie on each other, at the angle of a whole turn, balance all else.
  const auto result = run(R"toml(
[[node]]
name = "n0"
at = [0, 0, 0.1065]
[[node]]
name = "n1"
at = [1, 0, 0]
fixed = true
[[node]]
name = "n2"
at = [0, 1, 0]
fixed = ["y", "z"]
[[node]]
name = "n3"
at = [-1, 0, 0]
fixed = ["z"]
[[node]]
name = "n4"
at = [0, -1, 0]
[[bar]]
from = "n0"
to = "n1"
stiffness = 5
free = 1.006
[[bar]]
from = "n1"
to = "n2"
stiffness = 5
free = 1.414
[[bar]]
from = "n0"
to = "n2"
stiffness = 5
free = 1.006
[[bar]]
from = "n2"
to = "n3"
stiffness = 5
free = 1.414
[[bar]]
from = "n0"
to = "n3"
stiffness = 5
free = 1.006
[[bar]]
from = "n3"
to = "n4"
stiffness = 5
free = 1.414
[[bar]]
from = "n0"
to = "n4"
stiffness = 5
free = 1.006
[[bar]]
from = "n4"
to = "n1"
stiffness = 5
free = 1.414
[[spring]]
name = "f0"
shape = "fold"
of = ["n4", "n0", "n1", "n2"]
stiffness = 0.228
free = 3.269
[[spring]]
name = "f1"
shape = "fold"
of = ["n1", "n0", "n2", "n3"]
stiffness = 0.228
free = 3.427
[[spring]]
name = "f2"
shape = "fold"
of = ["n2", "n0", "n3", "n4"]
stiffness = 0.228
free = 2.684
[[spring]]
name = "f3"
shape = "fold"
of = ["n3", "n0", "n4", "n1"]
stiffness = 0.228
free = 2.877
[[study]]
name = "e"
kind = "equilibria"
body = "n0"
search = { starts = 60 }
)toml")
                          .of("e");
  ASSERT_TRUE(result.equilibria);
  EXPECT_GE(result.equilibria->list.size(), 16U);
  for (const std::string fold : {"f0", "f1", "f2", "f3"}) {
    const std::size_t i = column(result, fold + ".angle");
    for (const auto& equilibrium : result.equilibria->list) {
      EXPECT_GT(equilibrium.sample.values[i], 1e-6) << equilibrium.label;
      EXPECT_LT(equilibrium.sample.values[i], 2 * std::numbers::pi - 1e-6) << equilibrium.label;
    }
  }
}

}  // namespace
}  // namespace springfold::io
