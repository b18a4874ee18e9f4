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
  EXPECT_THAT(after("EA = 6\n", "\n"), ElementsAre("case.toml:17:1: bar[2]: got neither stiffness "
                                                   "nor EA nor a law nor springs in series, need "
                                                   "exactly one of them"));
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

TEST_F(NodeMessages, BarsWithALawAreSpringsOfADistanceFromTheirFreeLength) {
  const auto read = load(replaced(
      replaced(toggle, "stiffness = 2", "law = { law = \"one_sided\", stiffness = 2, from = 0 }"),
      "pretension = 1", "free = 1.5\ncompression_only = true"));
  const model::Mechanism& mechanism = read.runs.front().mechanism;
  EXPECT_TRUE(mechanism.line_springs.empty());
  ASSERT_EQ(mechanism.shape_springs.size(), 2U);
  const auto& cable = std::get<model::OneSidedSpring>(mechanism.shape_springs[0].law);
  EXPECT_EQ(cable.from, std::sqrt(2.0));
  EXPECT_EQ(cable.side, model::OneSidedSpring::Side::above);
  const auto& pusher = std::get<model::OneSidedSpring>(mechanism.shape_springs[1].law);
  EXPECT_EQ(pusher.from, 1.5);
  EXPECT_EQ(pusher.stiffness, 6 / 1.5);
  EXPECT_EQ(pusher.side, model::OneSidedSpring::Side::below);
  EXPECT_THAT(read.bars, ElementsAre("pin-top", "right"));
}

TEST_F(NodeMessages, WantOneLawOrOneStiffness) {
  const std::string law = "law = { law = \"linear\", stiffness = 2 }\n";
  EXPECT_THAT(
      after("EA = 6\n", "EA = 6\n" + law),
      testing::Contains("case.toml:17:1: bar[2]: got EA and law, need exactly one of them"));
  EXPECT_THAT(after("EA = 6\n", law),
              ElementsAre("case.toml:22:14: bar[2].pretension: goes with stiffness or EA; of a bar "
                          "with a law give the free length, free"));
  EXPECT_THAT(after("EA = 6\npretension = 1", law + "tension_only = true"),
              ElementsAre("case.toml:22:16: bar[2].tension_only: goes with stiffness or EA; of a "
                          "law say so in the law, such as { law = \"one_sided\", stiffness = 3, "
                          "from = 0 }"));
  EXPECT_THAT(after("stiffness = 2", "law = { law = \"linear\", stiffness = -2 }"),
              ElementsAre("case.toml:16:37: bar[1].law.stiffness: got -2, need a number >= 0 "
                          "[N/m], or falling = true for a law that may fall"));
  EXPECT_THAT(
      after("stiffness = 2", "law = { law = \"linear\", stiffness = 2, origin = \"start\" }"),
      ElementsAre("case.toml:16:7: bar[1].law.origin: laws of bars count from the free "
                  "length: need \"joint\" or no origin"));
}

TEST_F(NodeMessages, WantPretensionsThatStrutsAndCablesCanCarry) {
  EXPECT_THAT(after("pretension = 1", "pretension = -1\ntension_only = true"),
              ElementsAre("case.toml:17:1: bar[2]: pretension: got -1, need a number >= 0: the bar "
                          "has tension_only = true (study \"a\")"));
  EXPECT_THAT(after("pretension = 1", "pretension = 1\ncompression_only = true"),
              ElementsAre("case.toml:17:1: bar[2]: pretension: got 1, need a number <= 0: the bar "
                          "has compression_only = true (study \"a\")"));
  EXPECT_THAT(after("pretension = 1", "tension_only = true\ncompression_only = true"),
              ElementsAre("case.toml:23:20: bar[2].compression_only: either tension_only or "
                          "compression_only, not both: it would carry nothing"));
}

// The second bar is a line spring, the first one is not: each has its own place.
TEST_F(NodeMessages, NameTheRightBarWhereOthersHaveLaws) {
  const std::string mixed = replaced(toggle, "stiffness = 2", "stiffness = 2\ntension_only = true");
  EXPECT_THAT(messages(replaced(mixed, "pretension = 1", "pretension = -6")),
              ElementsAre("case.toml:18:1: bar[2]: pretension: got -6, need a tension > -EA = -6 "
                          "(study \"a\")"));
  EXPECT_THAT(messages(replaced(mixed, "pretension = 1", "to_at = [1, 0]")),
              ElementsAre("case.toml:18:1: bar[2]: to: at: a body that is a point has no other "
                          "points, need none (study \"a\")"));
  EXPECT_THAT(messages(replaced(mixed, "stiffness = 2", "to_at = [1, 0]\nstiffness = 2")),
              ElementsAre("case.toml:13:1: bar[1]: to: at: a body that is a point has no other "
                          "points, need none (study \"a\")"));
  EXPECT_THAT(messages(replaced(mixed, "from = \"pin\"\nto = \"top\"",
                                "from = \"pin\"\nto = \"base\"\nto_at = [3, 3]")),
              ElementsAre("case.toml:13:1: bar[1]: from, to: one of both must be able to move "
                          "(study \"a\")"));
}

}  // namespace
}  // namespace springfold::io
