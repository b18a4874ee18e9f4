// Messages about studies of special points in a second parameter.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;

const std::string critical_strut = R"([parameters]
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
kind = "critical_curve"
control = "load"
direction = [-1, 0]
mark = { k = [0.5] }
critical_curve = { of = "BP1", parameter = "k", range = [0.1, 2] }
)";

class CriticalMessages : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& old, const std::string& with) const {
    std::string text = critical_strut;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos);
    return messages(text.replace(at, old.size(), with));
  }
};

TEST_F(CriticalMessages, AreNoneForAGoodCase) {
  EXPECT_THAT(messages(critical_strut), ElementsAre());
}

TEST_F(CriticalMessages, WantTheTableOfTheKind) {
  const auto found = after("critical_curve = {", "threshold = {");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_THAT(found[1], testing::HasSubstr("study[1].threshold: has no meaning here, need kind = "
                                           "\"threshold\" with it"));
  EXPECT_THAT(found[0], testing::HasSubstr("study[1].critical_curve: "));
}

TEST_F(CriticalMessages, WantALabelOfAPointThatIsFollowed) {
  for (const std::string label : {"EP1", "BPx", "BP", "LP-1"}) {
    const auto found = after("of = \"BP1\"", "of = \"" + label + "\"");
    ASSERT_EQ(found.size(), 1U) << label;
    EXPECT_THAT(found[0],
                testing::HasSubstr("critical_curve.of: got \"" + label +
                                   "\", need LP, BP, CL, SA, KB, KS, SC or UZ and a number"));
  }
}

TEST_F(CriticalMessages, NameAParameterThatStandsTwiceOnce) {
  const auto found = after(
      "kind = \"critical_curve\"\ncontrol = \"load\"\ndirection = [-1, 0]\nmark = { k = [0.5] }\n"
      "critical_curve = { of = \"BP1\", parameter = \"k\", range = [0.1, 2] }",
      "kind = \"sensitivity\"\ncontrol = \"load\"\ndirection = [-1, 0]\n"
      "sensitivity = { parameters = [\"k\", \"c\", \"k\"] }");
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0], testing::HasSubstr("sensitivity.parameters[3]: got \"k\" twice"));
  EXPECT_EQ(found.size(), 1U);
}

TEST_F(CriticalMessages, WantAParameterOfTheCase) {
  const auto found = after("parameter = \"k\"", "parameter = \"kk\"");
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0], testing::HasSubstr("critical_curve.parameter: no parameter \"kk\""));
}

TEST_F(CriticalMessages, WantARangeInWhichTheCurveBegins) {
  EXPECT_THAT(after("[0.1, 2]", "[1.5, 2]"),
              ElementsAre(testing::HasSubstr(
                  "critical_curve.range: the value of \"k\" is 1, outside the range (1.5 to 2)")));
  EXPECT_THAT(after("[0.1, 2]", "3"),
              ElementsAre(testing::HasSubstr("critical_curve.range: got 3, need [low, high]")));
}

TEST_F(CriticalMessages, KnowTheParameterAsAColumn) {
  EXPECT_THAT(after("mark = { k = ", "mark = { c = "),
              ElementsAre(testing::HasSubstr("no quantity \"c\" in study \"a\"")));
}

TEST_F(CriticalMessages, WantARangeAndTwoValuesForAFirstCriticalLoad) {
  std::string text = critical_strut.substr(0, critical_strut.find("kind = "));
  text += "kind = \"critical_load\"\ncontrol = \"load\"\ndirection = [-1, 0]\n";
  EXPECT_THAT(messages(text + "critical_load = { of = \"limit_point\", parameter = \"k\" }\n"),
              ElementsAre(testing::HasSubstr("critical_load.range: missing, need [low, high]")));
  EXPECT_THAT(messages(text + "critical_load = { of = \"limit_point\", parameter = \"k\", range = "
                              "[0.1, 2], values = 1 }\n"),
              ElementsAre(testing::HasSubstr("critical_load.values: got 1, need a whole number")));
  EXPECT_THAT(messages(text + "critical_load = { of = \"limit_point\", parameter = \"k\", range = "
                              "[0.1, 2], value = \"smallest\" }\n"),
              ElementsAre(testing::HasSubstr("critical_load.value: unknown key")));
}

TEST_F(CriticalMessages, WantParametersThatAreNoColumns) {
  std::string text = critical_strut;
  for (const auto& [old, with] : {std::pair{"k = 1\n", "energy = 1\n"},
                                  {"2*k", "2*energy"},
                                  {"stiffness = \"k\"", "stiffness = \"energy\""},
                                  {"mark = { k = [0.5] }\n", ""},
                                  {"parameter = \"k\"", "parameter = \"energy\""}})
    text = replaced(text, old, with);
  EXPECT_THAT(messages(text),
              ElementsAre(testing::HasSubstr("two quantities are called \"energy\": rename a body, "
                                             "chain, joint or parameter")));
}

TEST_F(CriticalMessages, WantPlotsInAPlaneOfTheParametersOfTheirStudies) {
  const std::string plot =
      critical_strut + "[[plot]]\nname = \"f\"\nx = \"parameter.k\"\ny = \"parameter.c\"\n";
  EXPECT_THAT(messages(plot + "curves = [{ study = \"a\" }]\n"), ElementsAre());
  EXPECT_THAT(
      messages(replaced(plot, "parameter.c", "parameter.cc") + "curves = [{ study = \"a\" }]\n"),
      ElementsAre(testing::HasSubstr("plot[1].y: got \"parameter.cc\", need a parameter of "
                                     "the case, did you mean \"parameter.c\"?")));
  EXPECT_THAT(
      messages(replaced(plot, "parameter.c", "parameter.k") + "curves = [{ study = \"a\" }]\n"),
      ElementsAre(testing::HasSubstr("need another parameter than x")));
  const std::string other = replaced(plot, "parameter = \"k\", range = [0.1, 2] }",
                                     "parameter = \"d\", range = [0.1, 2] }");
  EXPECT_THAT(
      messages(
          replaced(replaced(other, "mark = { k = [0.5] }\n", ""), "k = 1\n", "k = 1\nd = 1\n") +
          "curves = [{ study = \"a\" }]\n"),
      ElementsAre(testing::HasSubstr("study \"a\" does not fit, need one of kind threshold or "
                                     "critical_curve whose parameter is x or y")));
}

TEST_F(CriticalMessages, ShadeLoadsOnlyWhereAStudyKnowsWhichComesFirst) {
  EXPECT_THAT(
      messages(critical_strut + "[[plot]]\nname = \"f\"\nx = \"k\"\ny = \"lambda\"\n"
                                "shade = true\ncurves = [{ study = \"a\" }]\n"),
      ElementsAre(testing::HasSubstr("plot[1].shade: got true, need y = \"lambda\" over the "
                                     "parameter of a study of kind critical_load")));
}

class FurtherCurveMessages : public CaseFiles {
 protected:
  std::vector<std::string> with_second(const std::string& keys) const {
    return messages(critical_strut + "[[study]]\nname = \"b\"\nkind = \"critical_curve\"\n" + keys);
  }
  std::vector<std::string> with_row(const std::string& of) const {
    return with_second("critical_curve = { of = \"" + of + "\", parameter = \"c\" }\n");
  }
};

TEST_F(FurtherCurveMessages, AreNoneForARowOfAnotherStudyWhereverThatStands) {
  EXPECT_THAT(with_row("a/UZ1"), ElementsAre());
  const std::string first = critical_strut.substr(0, critical_strut.find("[[study]]"));
  EXPECT_THAT(messages(first +
                       "[[study]]\nname = \"b\"\nkind = \"critical_curve\"\nmark = { k = [1] }\n"
                       "critical_curve = { of = \"a/UZ1\", parameter = \"c\" }\n" +
                       critical_strut.substr(first.size())),
              ElementsAre());
}

TEST_F(FurtherCurveMessages, WantAStudyWithACriticalCurve) {
  EXPECT_THAT(with_row("aa/UZ1"),
              ElementsAre(testing::HasSubstr(
                  "study[2].critical_curve.of: got \"aa/UZ1\", need \"STUDY/ROW\" with the name of "
                  "another study, did you mean \"a\"?")));
  EXPECT_THAT(with_row("b/UZ1"), ElementsAre(testing::HasSubstr("the study itself, need")));
  EXPECT_THAT(
      messages(critical_strut + "[[study]]\nname = \"e\"\nkind = \"equilibrium\"\n"
                                "[[study]]\nname = \"b\"\nkind = \"critical_curve\"\n"
                                "critical_curve = { of = \"e/LP1\", parameter = \"c\" }\n"),
      ElementsAre(testing::HasSubstr("study[3].critical_curve.of: study \"e\" is of kind "
                                     "\"equilibrium\", need one of kind \"critical_curve\"")));
}

TEST_F(FurtherCurveMessages, WantARowThatIsResolved) {
  EXPECT_THAT(with_row("a/row"), ElementsAre(testing::HasSubstr("need the label of a row")));
  EXPECT_THAT(
      with_row("a/UR1"),
      ElementsAre(testing::HasSubstr("where that curve is not resolved, need another row")));
}

TEST_F(FurtherCurveMessages, TellACircleOnce) {
  EXPECT_THAT(with_second("critical_curve = { of = \"d/UZ1\", parameter = \"c\" }\n"
                          "[[study]]\nname = \"d\"\nkind = \"critical_curve\"\n"
                          "critical_curve = { of = \"b/UZ1\", parameter = \"c\" }\n"),
              ElementsAre(testing::HasSubstr("studies begin at each other's curves in a circle")));
}

TEST_F(FurtherCurveMessages, WantTheCurveOfTheOtherStudy) {
  EXPECT_THAT(with_second("control = \"load\"\ndirection = [-1, 0]\n"
                          "critical_curve = { of = \"a/UZ1\", parameter = \"c\" }\n"),
              ElementsAre());
  EXPECT_THAT(with_second("direction = [-2, 0]\nset = { c = 3 }\n"
                          "critical_curve = { of = \"a/UZ1\", parameter = \"c\" }\n"),
              ElementsAre(testing::HasSubstr("study[2].direction: study \"a\", at whose curve it "
                                             "begins, has another one, need the same as there, or "
                                             "leave it out"),
                          testing::HasSubstr("study[2].set: study \"a\", at whose curve it begins, "
                                             "has none, need the same as there")));
  EXPECT_THAT(messages(replaced(critical_strut, "[0.1, 2] }", "[0.1, 2], tied = false }") +
                       "[[study]]\nname = \"b\"\nkind = \"critical_curve\"\n"
                       "critical_curve = { of = \"a/UZ1\", parameter = \"c\", tied = true }\n"),
              ElementsAre(testing::HasSubstr("study[2].critical_curve.tied: study \"a\", at whose "
                                             "curve it begins, keeps its commands")));
}

}  // namespace
}  // namespace springfold::io
