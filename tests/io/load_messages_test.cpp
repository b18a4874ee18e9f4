// Messages about gravity, masses, points, springs between points and loads.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;

const std::string arm = R"(gravity = [0, -9.81]
[[body]]
name = "tip"
task_space = "planar"
pose = [1, 0, 0]
mass = 2
com = [0.1, 0]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "virtual", spring = { law = "linear", stiffness = 1, origin = "start" } },
  { point = "knee", at = [0.5, 0], mass = 0.1 },
  { rigid = [1, 0], mass = 1 },
]
[[spring]]
name = "s"
from_at = [0, 1]
to = "arm.knee"
stiffness = 2
[[load]]
on = "arm.knee"
force = [0, 1]
[[study]]
name = "a"
control = "load"
loads = [{ force = [1, 0], scale = "lambda" }]
)";

class LoadMessages : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& old, const std::string& with) const {
    std::string text = arm;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos);
    return messages(text.replace(at, old.size(), with));
  }
};

TEST_F(LoadMessages, AreNoneForAGoodCase) { EXPECT_THAT(messages(arm), ElementsAre()); }

TEST_F(LoadMessages, WantGravityAsAVector) {
  EXPECT_THAT(after("[0, -9.81]", "9.81"),
              ElementsAre("case.toml:1:11: gravity: got 9.81, need [x, y] or [x, y, z]"));
}

TEST_F(LoadMessages, WantMassesThatAreNotNegativeAndAMassWithItsCentre) {
  EXPECT_THAT(after("mass = 2\n", "mass = -2\n"),
              ElementsAre("case.toml:6:8: body[1].mass: got -2, need a number >= 0 "
                          "[N per unit of gravity]"));
  EXPECT_THAT(after("mass = 2\n", "\n"),
              ElementsAre("case.toml:2:1: body[1].mass: missing, need the mass of the body, whose "
                          "centre this is"));
  EXPECT_THAT(
      after("mass = 1 }", "com = [1, 0] }"),
      ElementsAre("case.toml:13:3: chain[1].elements[3].mass: missing, need the mass of the "
                  "link, whose centre this is"));
}

TEST_F(LoadMessages, WantPlacesThatExist) {
  EXPECT_THAT(
      after("on = \"arm.knee\"", "on = \"arm.kne\""),
      ElementsAre("case.toml:21:6: load[1].on: got \"arm.kne\", need the name of a moving body, or "
                  "\"chain.point\" for a { point = ... } in a chain, did you mean \"arm.knee\"?"));
  EXPECT_THAT(after("to = \"arm.knee\"", "to = \"base\""),
              ElementsAre("case.toml:15:1: spring[1]: from, to: one of both must be able to move "
                          "(study \"a\")"));
}

TEST_F(LoadMessages, WantOneForceOrMoment) {
  EXPECT_THAT(
      after("force = [0, 1]", ""),
      ElementsAre("case.toml:20:1: load[1]: got neither force nor moment, need exactly one of "
                  "them"));
  EXPECT_THAT(after("{ force = [1, 0], scale", "{ force = [1, 0], moment = 1, scale"),
              ElementsAre("case.toml:26:10: study[1].loads[1]: got force and moment, need exactly "
                          "one of them"));
}

TEST_F(LoadMessages, WantWordsForFollowsScaleAndOrigin) {
  EXPECT_THAT(after("scale = \"lambda\"", "follows = 1, scale = \"lambda\""),
              ElementsAre("case.toml:26:38: study[1].loads[1].follows: got 1, need true or false"));
  EXPECT_THAT(
      after("origin = \"start\"", "origin = \"strat\""),
      ElementsAre("case.toml:11:118: chain[1].elements[1].spring.origin: got \"strat\", need "
                  "\"joint\" or \"start\""));
}

TEST_F(LoadMessages, WantNamesOfPointsAndSpringsOnce) {
  EXPECT_THAT(
      after("  { rigid", "  { point = \"knee\" },\n  { rigid"),
      ElementsAre("case.toml:13:13: chain[1].elements[3].point: \"knee\" is already the name "
                  "of another point of this chain, need different names"));
  EXPECT_THAT(
      after("name = \"s\"", "name = \"arm\""),
      ElementsAre("case.toml:16:8: spring[1].name: \"arm\" is already taken: bodies, chains "
                  "and springs need different names, and \"base\" is the fixed body"));
}

TEST_F(LoadMessages, WantNoLoadThatGrowsWithoutLambda) {
  EXPECT_THAT(after("control = \"load\"", "kind = \"equilibrium\""),
              ElementsAre("case.toml:26:9: study[1].loads: scale = \"lambda\" needs a study that "
                          "drives one of load, pose, mixed, actuator (study \"a\")"));
}

TEST_F(LoadMessages, WantLoadsThatTheTaskSpaceHas) {
  EXPECT_THAT(after("{ force = [1, 0], scale", "{ force = [1, 0, 2], scale"),
              ElementsAre("case.toml:26:10: study[1].loads[1]: force: in the plane it has no z "
                          "component (study \"a\")"));
}

}  // namespace
}  // namespace springfold::io
