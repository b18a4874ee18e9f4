// What is said about springs of shapes and pressures that cannot be.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string frame = R"([[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { point = "knee", at = [0.5, 0] },
  { rigid = [1, 0] },
]
[[study]]
name = "a"
control = "load"
direction = [1, 0]
)";

class ShapeMessages : public CaseFiles {
 protected:
  std::vector<std::string> spring(const std::string& keys) const {
    return messages(frame + "[[spring]]\nname = \"s\"\n" + keys);
  }
  std::vector<std::string> load(const std::string& keys) const {
    return messages(frame + "[[load]]\n" + keys);
  }
};

const std::string corners = "of = [\"base\", \"arm.knee\", { on = \"tip\" }]\n";

TEST_F(ShapeMessages, WantDifferentPoints) {
  EXPECT_THAT(
      spring("shape = \"path\"\nof = [\"base\", \"arm.knee\", \"arm.knee\"]\nstiffness = 1\n"),
      ElementsAre(
          "case.toml:19:27: spring[1].of[3]: got \"arm.knee\" a second time, need another point"));
  EXPECT_THAT(spring("shape = \"angle\"\nof = [\"base\", \"arm.knee\", \"base\"]\nstiffness = 1\n"),
              ElementsAre(HasSubstr("of[3]: got \"base\" a second time")));
  EXPECT_THAT(spring("shape = \"path\"\nof = [\"base\", \"arm.knee\", \"base\"]\nstiffness = 1\n"),
              ElementsAre());
}

TEST_F(ShapeMessages, WantThePressureOfALoadWithAShape) {
  EXPECT_THAT(load("shape = \"area\"\n" + corners), ElementsAre(HasSubstr("pressure: missing")));
}

TEST_F(ShapeMessages, AreNoneForGoodSprings) {
  for (const std::string shape : {"path", "angle", "area", "line"})
    EXPECT_THAT(spring("shape = \"" + shape + "\"\n" + corners + "stiffness = 1\nfree = 0.5\n"),
                ElementsAre());
  EXPECT_THAT(spring("shape = \"area\"\n" + corners + "gas = { nRT = 1, initial = 2 }\n"),
              ElementsAre());
  EXPECT_THAT(spring("to = \"tip\"\nlaw = { law = \"one_sided\", stiffness = 1, from = 0.5 }\n"),
              ElementsAre());
  EXPECT_THAT(load("shape = \"area\"\n" + corners + "pressure = 1\nscale = \"lambda\"\n"),
              ElementsAre());
}

TEST_F(ShapeMessages, NameShapesThatExist) {
  EXPECT_THAT(spring("shape = \"angel\"\n" + corners + "stiffness = 1\n"),
              ElementsAre(AllOf(HasSubstr("case.toml:18:9: spring[1].shape: got \"angel\""),
                                HasSubstr("\"angle\""))));
  EXPECT_THAT(spring(corners + "stiffness = 1\n"),
              ElementsAre(HasSubstr("spring[1].shape: missing, need \"path\"")));
}

TEST_F(ShapeMessages, WantAsManyPointsAsTheShapeHas) {
  EXPECT_THAT(spring("shape = \"angle\"\nof = [\"base\", \"tip\"]\nstiffness = 1\n"),
              ElementsAre(HasSubstr("spring[1].of: got 2 points, need 3")));
  EXPECT_THAT(spring("shape = \"distance\"\n" + corners + "stiffness = 1\n"),
              ElementsAre(HasSubstr(
                  "spring[1].of: got 3 points, need 2; of more points the shape is \"path\"")));
  EXPECT_THAT(spring("shape = \"path\"\nstiffness = 1\n"),
              testing::Contains(HasSubstr("spring[1].of: missing, need a list of points")));
}

TEST_F(ShapeMessages, RefuseFoldsThatStayFlat) {
  EXPECT_THAT(spring("shape = \"fold\"\nof = [\"tip\", \"base\", \"arm.knee\", { on = \"base\", at "
                     "= [1, 1] }]\n"
                     "stiffness = 1\n"),
              ElementsAre(AllOf(
                  HasSubstr("case.toml:16:1: spring[1]: its points stay in one plane, in which "
                            "the whole mechanism moves"),
                  HasSubstr("need \"angle\""))));
}

TEST_F(ShapeMessages, AreNoneForAFoldWhoseEdgeStandsUprightOnThePlane) {
  EXPECT_THAT(
      spring("shape = \"fold\"\nof = [\"tip\", \"base\", { on = \"base\", at = [0, 0, 1] }, "
             "{ on = \"base\", at = [0, 1] }]\nstiffness = 1\n"),
      ElementsAre());
}

TEST_F(ShapeMessages, WantPointsThatExistAndSomeThatMove) {
  EXPECT_THAT(spring("shape = \"path\"\nof = [\"base\", \"arm.kne\"]\nstiffness = 1\n"),
              ElementsAre(HasSubstr("did you mean \"arm.knee\"?")));
  EXPECT_THAT(
      spring("shape = \"path\"\nof = [\"base\", { on = \"base\", at = [1, 0] }]\nstiffness = 1\n"),
      ElementsAre(HasSubstr("of: one of the points must be able to move")));
  EXPECT_THAT(spring("shape = \"path\"\nof = [\"base\", 3]\nstiffness = 1\n"),
              testing::Contains(HasSubstr("spring[1].of[2]: got 3, need the name of a body")));
}

TEST_F(ShapeMessages, WantOneSourceOfEnergy) {
  const std::string one = "need one of: stiffness";
  EXPECT_THAT(
      spring("shape = \"area\"\n" + corners + "stiffness = 1\ngas = { nRT = 1, initial = 2 }\n"),
      ElementsAre(HasSubstr(one)));
  EXPECT_THAT(spring("shape = \"area\"\n" + corners), ElementsAre(HasSubstr("stiffness: missing")));
  EXPECT_THAT(spring("shape = \"area\"\n" + corners + "gas = { nRT = -1, initial = 0 }\n"),
              ElementsAre(HasSubstr("gas.nRT: got -1, need a number >= 0"),
                          HasSubstr("gas.initial: got 0, need a number that is not 0")));
  EXPECT_THAT(spring("shape = \"path\"\n" + corners + "gas = { nRT = 1, initial = 2 }\n"),
              ElementsAre(HasSubstr("gas: need the shape \"area\" or \"volume\"")));
}

TEST_F(ShapeMessages, WantKeysOnlyWhereTheyMeanSomething) {
  EXPECT_THAT(spring("shape = \"path\"\n" + corners + "stiffness = 1\nnear = 1\n"),
              ElementsAre(HasSubstr("only the shapes \"angle\" and \"fold\" have it")));
  EXPECT_THAT(spring("shape = \"area\"\n" + corners + "stiffness = 1\nclosed = true\n"),
              ElementsAre(HasSubstr("only the shape \"path\" can be closed")));
  EXPECT_THAT(spring("shape = \"area\"\n" + corners + "stiffness = 1\ntriangles = [[1, 2, 3]]\n"),
              ElementsAre(HasSubstr("only the shape \"volume\" has triangles")));
  EXPECT_THAT(
      spring("to = \"tip\"\nlaw = { law = \"linear\", stiffness = 1, origin = \"start\" }\n"),
      ElementsAre(HasSubstr("springs between points count from their own zero")));
}

TEST_F(ShapeMessages, WantVolumesInSpaceWithClosedSurfaces) {
  const std::string four =
      "of = [\"base\", \"arm.knee\", \"tip\", { on = \"base\", at = [0, 1] }]\n";
  EXPECT_THAT(spring("shape = \"volume\"\n" + four + "stiffness = 1\ntriangles = [[1, 2, 9]]\n"),
              testing::Contains(HasSubstr("need three whole numbers from 1 to 4")));
  EXPECT_THAT(spring("shape = \"volume\"\n" + four + "stiffness = 1\ntriangles = [[1, 2, 3]]\n"),
              testing::Contains(HasSubstr("need a closed surface")));
  EXPECT_THAT(spring("shape = \"volume\"\n" + four +
                     "stiffness = 1\ntriangles = [[1, 3, 2], [1, 2, 4], [2, 3, 4], [1, 4, 3]]\n"),
              ElementsAre(HasSubstr("all bodies move in the plane: need an area or a line")));
}

TEST_F(ShapeMessages, WantPressuresOnAreasAndNothingElseThere) {
  EXPECT_THAT(load("shape = \"path\"\n" + corners + "pressure = 1\n"),
              ElementsAre(HasSubstr("load[1].shape: got \"path\", need \"area\" or \"volume\"")));
  EXPECT_THAT(load("shape = \"area\"\n" + corners + "pressure = 1\nforce = [1, 0]\n"),
              ElementsAre(HasSubstr("load[1].force: a pressure acts on the boundary")));
  EXPECT_THAT(load("shape = \"area\"\nforce = [1, 0]\n"),
              ElementsAre(HasSubstr("load[1].shape: only a load with `pressure` has it")));
}

TEST_F(ShapeMessages, TellWhatSpringsInSeriesNeed) {
  const std::string ends = "to = \"tip\"\n";
  const std::string two =
      "series = [{ law = \"linear\", stiffness = 1 }, { law = \"linear\", stiffness = 2 }]\n";
  EXPECT_THAT(spring(ends + two + "initial = 0.1\n"), ElementsAre());
  EXPECT_THAT(spring(ends + two + "initial = [0.1]\n"), ElementsAre());
  EXPECT_THAT(spring("shape = \"area\"\n" + corners + two), ElementsAre());
  EXPECT_THAT(
      spring(ends + two + "initial = [0.1, 0.2]\n"),
      ElementsAre(HasSubstr("case.toml:20:11: spring[1].initial: got a list of 2, need 1 [m]: "
                            "guesses of all coordinates but the last")));
  EXPECT_THAT(
      spring(ends + "series = [{ law = \"linear\", stiffness = 1 }]\n"),
      ElementsAre(HasSubstr("spring[1].series: got a list of 1, need a list of at least two "
                            "springs { law = ... }")));
  EXPECT_THAT(spring(ends + "series = 3\n"),
              ElementsAre(HasSubstr("spring[1].series: got 3, need a list of at least two")));
  EXPECT_THAT(spring(ends + "series = [{ law = \"linear\", stiffness = -1 }, { stiffness = 2 }]\n"),
              ElementsAre(AllOf(HasSubstr("spring[1].series[1].stiffness: got -1"),
                                HasSubstr("falling = true")),
                          HasSubstr("spring[1].series[2].law: missing")));
  EXPECT_THAT(spring(ends + two + "stiffness = 1\n"),
              ElementsAre(HasSubstr("spring[1]: need one of: stiffness")));
  EXPECT_THAT(spring(ends + "law = { law = \"linear\", stiffness = 1 }\ninitial = 1\n"),
              ElementsAre(HasSubstr("spring[1].initial: only springs in series have it")));
  EXPECT_THAT(spring(ends + "series = [{ law = \"linear\", stiffness = 1, origin = \"start\" }, "
                            "{ law = \"linear\", stiffness = 2 }]\n"),
              ElementsAre(HasSubstr(
                  "spring[1].series[1].origin: springs between points count from their own")));
}

TEST_F(ShapeMessages, TellWhichAnglesCountTurns) {
  EXPECT_THAT(spring("shape = \"angle\"\n" + corners + "stiffness = 1\nturns = true\n"),
              ElementsAre(HasSubstr("spring[1].turns: need three nodes in the plane")));
  EXPECT_THAT(spring("shape = \"path\"\n" + corners + "stiffness = 1\nturns = true\n"),
              ElementsAre(HasSubstr("spring[1].turns: only the shape \"angle\" has it")));
  EXPECT_THAT(spring("shape = \"angle\"\nof = [{ on = \"base\", at = [1, 1] }, \"base\", "
                     "\"tip\"]\nstiffness = 1\nturns = true\n"),
              ElementsAre());
}

}  // namespace
}  // namespace springfold::io
