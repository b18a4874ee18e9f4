// Messages about studies of designs, and figures of sensitivities in a case.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string designed_strut = R"([parameters]
k = 1
c = "2*k"
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "foot", role = "virtual", stiffness = "k" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = "c" },
  { rigid = [1, 0] },
]
[[study]]
name = "a"
kind = "design"
control = "load"
direction = [-1, 0]
design = { parameters = { k = [0.5, 2] }, critical_load = { at_least = 3, of = "loss_of_stability" } }
)";

class DesignMessages : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& old, const std::string& with) const {
    std::string text = designed_strut;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos);
    return messages(text.replace(at, old.size(), with));
  }
};

TEST_F(DesignMessages, AreNoneForAGoodCase) {
  EXPECT_THAT(messages(designed_strut), ElementsAre());
}

TEST_F(DesignMessages, WantTheTable) {
  const auto found = after("design = {", "threshold = {");
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found, testing::Contains(HasSubstr("study[1].design: missing")));
}

TEST_F(DesignMessages, WantParametersOfTheCase) {
  EXPECT_THAT(after("{ k = [0.5, 2] }", "{ kk = [0.5, 2] }"),
              testing::Contains(HasSubstr("study[1].design.parameters.kk: no parameter \"kk\"")));
}

TEST_F(DesignMessages, WantParametersWhoseNamesTheAnswerDoesNotHave) {
  std::string text = designed_strut;
  for (std::size_t at; (at = text.find("k = [0.5, 2]")) != std::string::npos;)
    text.replace(at, 1, "met");
  EXPECT_THAT(
      messages("[parameters]\nmet = 1\n" + text.substr(text.find('\n') + 1)),
      testing::Contains(HasSubstr("design.parameters.met: the answer has a value design.met "
                                  "already, need another name of the parameter")));
}

TEST_F(DesignMessages, WantTheCaseWithinItsBounds) {
  EXPECT_THAT(after("[0.5, 2]", "[1.5, 2]"),
              ElementsAre(HasSubstr("study[1].design.parameters.k: the value of \"k\" is 1, "
                                    "outside the range (1.5 to 2): changes are "
                                    "counted from it")));
}

TEST_F(DesignMessages, WantBoundsThatIncrease) {
  EXPECT_THAT(after("[0.5, 2]", "[2, 0.5]"), testing::Contains(HasSubstr("(low < high)")));
}

TEST_F(DesignMessages, WantARequirement) {
  EXPECT_THAT(after(", critical_load = { at_least = 3, of = \"loss_of_stability\" }", ""),
              ElementsAre(HasSubstr("study[1].design: need a requirement: critical_load,")));
}

TEST_F(DesignMessages, WantColumnsThatExist) {
  EXPECT_THAT(
      after("at_least = 3,", "at_least = 3, quantity = \"forse\","),
      ElementsAre(HasSubstr(
          "study[1].design.critical_load.quantity: \"forse\" is no quantity of this study")));
}

TEST_F(DesignMessages, WantATolerance) {
  EXPECT_THAT(after("critical_load = { at_least = 3, of = \"loss_of_stability\" }",
                    "curve = { points = [[0.1, 1]], tolerance = 0 }"),
              ElementsAre(HasSubstr("study[1].design.curve.tolerance: got 0, need a number > 0")));
}

TEST_F(DesignMessages, WantScalesOfTheDesignsOwnParameters) {
  EXPECT_THAT(
      after("parameters = { k", "scale = { c = 1 }, parameters = { k"),
      ElementsAre(HasSubstr("study[1].design.scale.c: is none of the parameters of this design")));
}

TEST_F(DesignMessages, WantSensitivitiesForATornado) {
  EXPECT_THAT(
      messages(designed_strut + "[[tornado]]\nname = \"t\"\nstudy = \"a\"\nat = \"LP1\"\n"),
      testing::Contains(HasSubstr("tornado[1].study: need a study of kind \"sensitivity\"")));
}

TEST_F(DesignMessages, RefuseTheNameOfAnotherPlot) {
  const std::string sensitivity =
      "[[study]]\nname = \"s\"\nkind = \"sensitivity\"\ncontrol = \"load\"\ndirection = [-1, 0]\n"
      "[[plot]]\nname = \"t\"\ncurves = [{ study = \"s\" }]\n";
  EXPECT_THAT(messages(designed_strut + sensitivity +
                       "[[tornado]]\nname = \"t\"\nstudy = \"s\"\nat = \"LP1\"\n"),
              ElementsAre(HasSubstr("tornado[1].name: \"t\" is already the name")));
}

}  // namespace
}  // namespace springfold::io
