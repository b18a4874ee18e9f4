// `start.from`: studies that start where another one ended, as they are read.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string steps = R"([parameters]
k = 1
[[node]]
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
[[bar]]
from = "pin"
to = "top"
stiffness = "k"
[[bar]]
from = "foot"
to = "top"
stiffness = "k"
[[bar]]
from = "pin"
to = "foot"
stiffness = "k"
[[study]]
name = "first"
body = "foot"
control = "load"
direction = [-1, 0]
vary = { parameter = "k", values = [1, 2] }
[[study]]
name = "second"
body = "top"
control = "load"
direction = [0, -1]
start = { from = "first", at = "end", hold = ["foot.x"] }
vary = { parameter = "k", values = [1, 2] }
)";

class HistoryMessages : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& old, const std::string& with) const {
    return messages(replaced(steps, old, with));
  }
};

TEST_F(HistoryMessages, AreNoneForAGoodCase) { EXPECT_THAT(messages(steps), IsEmpty()); }

TEST_F(HistoryMessages, RunsGoTogetherByTheirNumbers) {
  const Case read = load(steps);
  const PlannedRun& second = read.runs.at(3);
  ASSERT_TRUE(second.history.earlier);
  EXPECT_EQ(second.history.earlier->study.name, "first");
  EXPECT_EQ(second.history.earlier->mechanism.line_springs[0].stiffness, 2);
  EXPECT_THAT(second.history.held, ElementsAre("foot.hold"));
  EXPECT_EQ(second.mechanism.chains.back().name, "foot.hold");
}

TEST_F(HistoryMessages, WantAStudyThatExistsAndNoCircle) {
  EXPECT_THAT(after("from = \"first\"", "from = \"frist\""),
              ElementsAre(HasSubstr("study[2].start.from: got \"frist\", need the name of another "
                                    "study, did you mean \"first\"?")));
  EXPECT_THAT(
      after("from = \"first\"", "from = \"second\""),
      ElementsAre(HasSubstr("study[2].start.from: got \"second\", the study itself, need the "
                            "name of another study; known here: first")));
  EXPECT_THAT(
      after("direction = [-1, 0]\n", "direction = [-1, 0]\nstart = { from = \"second\" }\n"),
      ElementsAre(HasSubstr("study[1].start.from: studies start from each other in a circle, "
                            "or more than 16 one after the other"),
                  HasSubstr("study[2].start.from: studies start")));
}

TEST_F(HistoryMessages, WantRunsThatGoTogether) {
  EXPECT_THAT(
      messages(replaced(steps, "values = [1, 2] }\n[[study]]", "values = [1, 2, 3] }\n[[study]]")),
      ElementsAre(HasSubstr("study[2].start.from: study \"first\" has 3 runs and this one 2, "
                            "need as many, which go together by their numbers, or one")));
}

TEST_F(HistoryMessages, WantPointsLoadsAndHoldsThatMakeSense) {
  EXPECT_THAT(after("at = \"end\"", "at = \"LP\""),
              ElementsAre(HasSubstr("study[2].start.at: got \"LP\", need \"start\", \"end\" or a "
                                    "label such as \"LP1\"")));
  EXPECT_THAT(
      after("at = \"end\"", "loads = \"keep\""),
      ElementsAre(HasSubstr("study[2].start.loads: got \"keep\", need \"kept\" or \"own\"")));
  EXPECT_THAT(
      after("\"foot.x\"", "\"foot.z\""),
      ElementsAre(HasSubstr("study[2].start.hold[1]: got \"foot.z\", need a coordinate of a "
                            "node, or of a body with task space \"xy\" or \"xyz\", such as "
                            "\"foot.x\"")));
  EXPECT_THAT(
      after("\"foot.x\"", "\"foot.y\""),
      ElementsAre(HasSubstr("study[2].start.hold[1]: got \"foot.y\", which is fixed already, "
                            "need others")));
  EXPECT_THAT(
      after("at = \"end\"", "pose = [1, 1]"),
      ElementsAre(HasSubstr("study[2].start.pose: has no meaning with from: the study starts "
                            "in that state")));
  EXPECT_THAT(after("from = \"first\", at = \"end\", hold = [\"foot.x\"]", "at = \"end\""),
              ElementsAre(HasSubstr("study[2].start.at: goes with from, need from = \"...\"")));
}

const std::string third = R"([[study]]
name = "third"
body = "top"
kind = "equilibrium"
vary = { parameter = "k", values = [1, 2] }
)";

TEST_F(HistoryMessages, LaterStudiesHoldWhatThoseBeforeThemHold) {
  const auto held = [this](const std::string& start) {
    return load(steps + third + "start = { " + start + " }\n").runs.at(5).history.held;
  };
  EXPECT_THAT(held("from = \"second\""), ElementsAre("foot.hold"));
  EXPECT_THAT(held("from = \"second\", hold = [\"top.x\"]"), ElementsAre("foot.hold", "top.hold"));
  EXPECT_THAT(held("from = \"first\""), IsEmpty());
}

TEST_F(HistoryMessages, LaterStudiesReleaseWhatThoseBeforeThemHold) {
  const auto held = [this](const std::string& start) {
    return load(steps + third + "start = { " + start + " }\n").runs.at(5).history;
  };
  EXPECT_THAT(held("from = \"second\", release = [\"foot.x\"]").held, IsEmpty());
  const auto other = held("from = \"second\", release = [\"foot.x\"], hold = [\"top.x\"]");
  EXPECT_THAT(other.held, ElementsAre("top.hold"));
  ASSERT_EQ(other.released.size(), 1U);
  EXPECT_EQ(other.released[0].body, 1);
  EXPECT_EQ(other.released[0].coordinate, 0);
  EXPECT_EQ(other.released[0].chain, "foot.hold");
}

TEST_F(HistoryMessages, RefuseToReleaseWhatIsNotHeld) {
  const auto told = [this](const std::string& start) {
    return messages(steps + third + "start = { " + start + " }\n");
  };
  EXPECT_THAT(told("from = \"second\", release = [\"top.y\"]"),
              ElementsAre("case.toml:44:39: study[3].start.release[1]: got \"top.y\", which study "
                          "\"second\" does not hold, need \"foot.x\""));
  EXPECT_THAT(told("from = \"first\", release = [\"foot.x\"]"),
              ElementsAre(HasSubstr("got \"foot.x\", which study \"first\" does not hold, need no "
                                    "release: it holds nothing")));
  EXPECT_THAT(told("from = \"second\", hold = [\"foot.x\"], release = [\"foot.x\"]"),
              ElementsAre(HasSubstr("study[3].start.release[1]: got \"foot.x\", which is held by "
                                    "this study too, need hold or release")));
  EXPECT_THAT(told("from = \"second\", release = [\"foot.x\", \"foot.x\"]"),
              ElementsAre(HasSubstr("study[3].start.release[2]: got \"foot.x\", which is named "
                                    "twice, need others")));
  EXPECT_THAT(told("from = \"second\", release = [\"food.x\"]"),
              ElementsAre(HasSubstr("study[3].start.release[1]: got \"food.x\", need a coordinate "
                                    "of a node")));
  EXPECT_THAT(told("release = [\"foot.x\"]"),
              ElementsAre(HasSubstr("study[3].start.release: goes with from")));
}

TEST_F(HistoryMessages, RefuseToDriveWhatIsHeld) {
  const auto told = [this](const std::string& control, const std::string& direction) {
    return messages(replaced(steps + third, "kind = \"equilibrium\"",
                             "control = \"" + control + "\"\ndirection = " + direction +
                                 "\nstart = { from = \"second\", hold = [\"top.x\"] }"));
  };
  EXPECT_THAT(told("mixed", "[1, 1]"),
              testing::Contains(
                  "case.toml:43:13: study[3].direction: drives top.x, which study "
                  "\"third\" holds: need another direction, or no hold (study \"third\", run 1)"));
  EXPECT_THAT(told("pose", "[0, 1]"),
              testing::Contains(HasSubstr(
                  "study[3].control: \"pose\" drives all of the body, and study \"third\" "
                  "holds top.x: need \"mixed\", which drives along the direction alone")));
  EXPECT_THAT(told("load", "[1, 0]"),
              testing::Contains(HasSubstr("study[3].direction: pushes only on top.x")));
  EXPECT_THAT(told("load", "[1, 1]"), IsEmpty());
  EXPECT_THAT(told("mixed", "[0, 1]"), IsEmpty());
  EXPECT_THAT(messages(replaced(steps + third, "body = \"top\"\nkind = \"equilibrium\"",
                                "body = \"foot\"\ncontrol = \"mixed\"\ndirection = [1, "
                                "0]\nstart = { from = \"second\" }")),
              testing::Contains(
                  HasSubstr("study[3].direction: drives foot.x, which study \"second\" holds: need "
                            "another direction, or start.release = [\"foot.x\"]")));
}

const std::string rates = R"([[study]]
name = "rates"
kind = "sensitivity"
sensitivity = { parameters = ["k"] }
body = "top"
control = "load"
direction = [0, -1]
start = { from = "first" }
)";

TEST_F(HistoryMessages, RefuseAnEarlierStudyWithoutStatesOfOneMechanism) {
  EXPECT_THAT(messages(steps + rates + "vary = { parameter = \"k\", values = [1, 2] }\n" + third +
                       "start = { from = \"rates\" }\n"),
              ElementsAre(HasSubstr("study[4].start.from: study \"rates\" is of kind "
                                    "\"sensitivity\", which has no states of one mechanism to "
                                    "start from, need a study of kind \"force_deflection\"")));
}

TEST_F(HistoryMessages, RefuseAStartOfAWorkspace) {
  EXPECT_THAT(messages(steps + R"([[study]]
name = "region"
kind = "workspace"
body = "top"
start = { from = "first" }
)"),
              testing::Contains(HasSubstr("study[3].start.from: a workspace is a matter of closed "
                                          "chains alone, which no load step changes")));
}

TEST_F(HistoryMessages, WantOneValueOfAParameterThatIsChanged) {
  EXPECT_THAT(messages(steps + rates + "vary = { parameter = \"k\", values = [1, 2] }\n"),
              IsEmpty());
  const std::string single =
      replaced(steps, "vary = { parameter = \"k\", values = [1, 2] }\n[[study]]", "[[study]]");
  EXPECT_THAT(messages(single + rates + "vary = { parameter = \"k\", values = [1, 2] }\n"),
              testing::Contains(
                  HasSubstr("study[3].start.from: study \"first\" has k = 1 and this one, which "
                            "changes it, 2, need one value: with vary in both, or in neither")));
}

TEST_F(HistoryMessages, RefuseToChangeAParameterThatAnEarlierStudyMoves) {
  const std::string moved = replaced(
      steps,
      "control = \"load\"\ndirection = [-1, 0]\nvary = { parameter = \"k\", values = [1, 2] }",
      "control = \"parameter\"\nparameter = \"k\"\nuntil = { lambda = [1, 2] }");
  EXPECT_THAT(
      messages(moved + rates),
      testing::Contains(HasSubstr("study[3].start.from: study \"first\" moves the parameter "
                                  "\"k\", which this study changes, need another")));
}

TEST_F(HistoryMessages, RefuseToFollowAPointOfADirectionThatIsHeld) {
  std::string of_foot = replaced(rates, "body = \"top\"", "body = \"foot\"");
  of_foot = replaced(of_foot, "direction = [0, -1]", "direction = [1, 0]");
  of_foot = replaced(of_foot, "from = \"first\"", "from = \"second\"");
  EXPECT_THAT(messages(steps + of_foot + "vary = { parameter = \"k\", values = [1, 2] }\n"),
              testing::Contains(HasSubstr(
                  "study[3].direction: pushes only on foot.x, which study \"second\" holds")));
}

}  // namespace
}  // namespace springfold::io
