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

}  // namespace
}  // namespace springfold::io
