// Nodes and bars as they are read, and messages about them.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string toggle = R"([[node]]
name = "pin"
at = [0, 0]
fixed = true
[[node]]
name = "foot"
at = [2, 0]
fixed = ["y"]
[[node]]
name = "top"
at = [1, 1]
mass = 3
[[bar]]
from = "pin"
to = "top"
stiffness = 2
[[bar]]
name = "right"
from = "foot"
to = "top"
EA = 6
pretension = 1
[[load]]
on = "top"
force = [0, -1]
[[study]]
name = "a"
body = "top"
control = "load"
direction = [0, -1]
)";

class NodeMessages : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& old, const std::string& with) const {
    return messages(replaced(toggle, old, with));
  }
};

TEST_F(NodeMessages, AreNoneForAGoodCase) { EXPECT_THAT(messages(toggle), IsEmpty()); }

TEST_F(NodeMessages, NodesArePointBodiesAndFixedOnesPointsOfTheBase) {
  const Case read = load(toggle);
  const model::Mechanism& mechanism = read.runs.front().mechanism;
  ASSERT_EQ(mechanism.bodies.size(), 2U);
  EXPECT_EQ(mechanism.bodies[1].name, "top");
  EXPECT_EQ(mechanism.bodies[1].task_space, model::TaskSpace::xy);
  EXPECT_EQ(mechanism.bodies[1].mass, 3);
  EXPECT_EQ(mechanism.line_springs[0].from.body, 0);
  EXPECT_TRUE(mechanism.line_springs[0].from.at.isZero(0));
  ASSERT_EQ(read.nodes.size(), 3U);
  EXPECT_FALSE(read.nodes[0].moves);
}

TEST_F(NodeMessages, ANodeHeldInOneDirectionSlidesOnAChainOfItsOwn) {
  const Case read = load(toggle);
  const model::Chain& guide = read.runs.front().mechanism.chains.at(0);
  EXPECT_EQ(guide.name, "foot.guide");
  ASSERT_EQ(guide.elements.size(), 1U);
  const auto& slide = std::get<model::Joint>(guide.elements[0]);
  EXPECT_EQ(slide.name, "x");
  EXPECT_EQ(slide.role, model::JointRole::passive);
  EXPECT_EQ(slide.axis, model::Vec3<double>::UnitX());
  EXPECT_EQ(guide.from_attachment.p, model::Vec3<double>(2, 0, 0));
}

TEST_F(NodeMessages, BarsAreDrawnFreeOfForceOrWithTheirPretension) {
  const auto springs = load(toggle).runs.front().mechanism.line_springs;
  EXPECT_EQ(springs[0].name, "pin-top");
  EXPECT_DOUBLE_EQ(springs[0].free, std::sqrt(2.0));
  EXPECT_EQ(springs[0].stiffness, 2);
  const double l = std::sqrt(2.0), free = l / (1 + 1.0 / 6);
  EXPECT_DOUBLE_EQ(springs[1].free, free);
  EXPECT_DOUBLE_EQ(springs[1].stiffness * (l - free), 1);
  EXPECT_DOUBLE_EQ(springs[1].stiffness, 6 / free);
}

TEST_F(NodeMessages, BarsEndAtPointsOfChainsAsTheyAreGuessed) {
  const std::string text = toggle + R"([[chain]]
name = "arm"
to = "top"
elements = [
  { joint = "revolute", axis = "z", name = "h", initial = "45*deg" },
  { joint = "prismatic", axis = "x", name = "l", role = "actuated", value = 1, stiffness = 5, initial = 0.5 },
  { point = "end" },
  { rigid = ["sqrt(2) - 1.5", 0] },
]
[[bar]]
from = "arm.end"
to = "pin"
stiffness = 1
)";
  EXPECT_NEAR(load(text).runs.front().mechanism.line_springs[2].free, 1.5, 1e-15);
}

TEST_F(NodeMessages, WantTwoOrThreeNumbersAsTheOtherNodesHave) {
  EXPECT_THAT(after("at = [1, 1]", "at = [1]"),
              ElementsAre("case.toml:11:6: node[3].at: got a list of 1, need [x, y] or, in space, "
                          "[x, y, z]"));
  EXPECT_THAT(after("at = [2, 0]", "at = [2, 0, 0]"),
              ElementsAre("case.toml:7:6: node[2].at: got 3 numbers, need 2 as the nodes before it "
                          "have: all lie in the plane or all in space",
                          testing::_));
  EXPECT_THAT(
      after("at = [1, 1]\n", "\n"),
      ElementsAre("case.toml:9:1: node[3].at: missing, need [x, y] or, in space, [x, y, z]"));
}

TEST_F(NodeMessages, WantDirectionsThatExist) {
  EXPECT_THAT(after("[\"y\"]", "[\"z\"]"),
              ElementsAre("case.toml:8:10: node[2].fixed[1]: got \"z\", need \"x\" or \"y\""));
  EXPECT_THAT(after("[\"y\"]", "\"y\""),
              ElementsAre("case.toml:8:9: node[2].fixed: got \"y\", need true, false or a list of "
                          "directions such as [\"x\"] in which the node is held"));
}

TEST_F(NodeMessages, WantOneStiffnessAndOneFreeLength) {
  EXPECT_THAT(
      after("EA = 6\n", "EA = 6\nstiffness = 1\n"),
      ElementsAre("case.toml:17:1: bar[2]: got stiffness and EA, need exactly one of them"));
  EXPECT_THAT(after("EA = 6\n", "\n"),
              ElementsAre("case.toml:17:1: bar[2]: got neither stiffness nor EA, need exactly one "
                          "of them"));
  EXPECT_THAT(
      after("pretension = 1", "pretension = 1\nfree = 1"),
      ElementsAre("case.toml:22:14: bar[2].pretension: either free or pretension, not both: "
                  "each says how long the bar is without force"));
  EXPECT_THAT(after("EA = 6", "EA = -6"),
              ElementsAre("case.toml:21:6: bar[2].EA: got -6, need a number > 0 [N]"));
}

TEST_F(NodeMessages, WantBarsThatHaveALength) {
  EXPECT_THAT(after("at = [1, 1]", "at = [0, 0]"),
              ElementsAre("case.toml:13:1: bar[1]: the ends of the bar lie on each other as drawn, "
                          "need other ends, or free with stiffness (study \"a\")"));
  EXPECT_THAT(after("pretension = 1", "pretension = -6"),
              ElementsAre("case.toml:17:1: bar[2]: pretension: got -6, need a tension > -EA = -6 "
                          "(study \"a\")"));
  EXPECT_THAT(
      after("stiffness = 2", "stiffness = 2\npretension = 5"),
      ElementsAre("case.toml:13:1: bar[1]: pretension: got 5, need at most stiffness times "
                  "length as drawn, 2.8284271247461903, and a stiffness > 0: the free length "
                  "would be negative (study \"a\")"));
}

TEST_F(NodeMessages, WantNamesOfNodesThatExistAndBarsThatDiffer) {
  EXPECT_THAT(
      after("from = \"pin\"", "from = \"pim\""),
      ElementsAre("case.toml:14:8: bar[1].from: got \"pim\", need \"base\", the name of a "
                  "moving body, or \"chain.point\" for a { point = ... } in a chain, did you "
                  "mean \"pin\"?"));
  EXPECT_THAT(after("name = \"right\"\nfrom = \"foot\"", "from = \"pin\""),
              ElementsAre("case.toml:17:1: bar[2].name: missing, need a name: \"pin-top\", as it "
                          "would be called, is taken"));
  EXPECT_THAT(
      after("name = \"top\"", "name = \"pin\""),
      testing::Contains("case.toml:10:8: node[3].name: \"pin\" is already taken: bodies, "
                        "chains and springs need different names, and \"base\" is the fixed "
                        "body"));
}

TEST_F(NodeMessages, RefuseWhatAFixedNodeCannotDo) {
  EXPECT_THAT(
      after("on = \"top\"", "on = \"pin\""),
      ElementsAre("case.toml:24:6: load[1].on: got \"pin\", a fixed node, where a load does "
                  "nothing, need one that moves"));
  EXPECT_THAT(
      after("to = \"top\"", "from_at = [1, 0]\nto = \"top\""),
      ElementsAre("case.toml:15:11: bar[1].from_at: a fixed node is a point and has no other "
                  "points, need none"));
  EXPECT_THAT(
      messages("[[node]]\nname = \"a\"\nat = [0, 0]\nfixed = true\n[[bar]]\nfrom = "
               "\"a\"\nto = \"a\"\nstiffness = 1\n[[study]]\nname = \"s\"\nkind = "
               "\"equilibrium\"\n"),
      testing::Contains("case.toml:1:1: node[1]: all nodes are fixed, need one that moves"));
}

}  // namespace
}  // namespace springfold::io
