// `repeat`, `use` and `with`: what is written once is read as if it were written out.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_files.hpp"
#include "io/bindings.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string ring = R"toml([parameters]
R = 2
[[node]]
repeat = { i = [0, 3] }
name = "n{i}"
at = ["R*cos(i*90*deg)", "R*sin(i*90*deg)"]
[[node]]
name = "hub"
at = [0, 0]
fixed = true
[[bar]]
repeat = { i = [0, 3] }
from = "n{i}"
to = "n{(i+1)%4}"
stiffness = "1 + i"
[[bar]]
repeat = { i = [0, 3] }
from = "hub"
to = "n{i}"
stiffness = 1
[[study]]
name = "a"
body = "n0"
kind = "equilibrium"
)toml";

class Repetition : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& old, const std::string& with) const {
    return messages(replaced(ring, old, with));
  }
};

TEST_F(Repetition, CopiesATableForEveryIndexInNamesAndFormulas) {
  const model::Mechanism mechanism = load(ring).runs.front().mechanism;
  ASSERT_EQ(mechanism.bodies.size(), 4U);
  EXPECT_EQ(mechanism.bodies[3].name, "n3");
  EXPECT_DOUBLE_EQ(mechanism.bodies[1].pose[1], 2);
  ASSERT_EQ(mechanism.line_springs.size(), 8U);
  EXPECT_EQ(mechanism.line_springs[3].name, "n3-n0");
  EXPECT_EQ(mechanism.line_springs[3].stiffness, 4);
}

TEST_F(Repetition, RunsThroughSeveralIndicesTheLastOneFastest) {
  std::string text = replaced(ring, "{ i = [0, 3] }\nname = \"n{i}\"",
                              "{ i = [0, 2, 2], j = [-1, 0] }\nname = \"n{i-j}\"");
  text = replaced(text, "[\"R*cos(i*90*deg)\", \"R*sin(i*90*deg)\"]",
                  "[\"R*cos((i+j)*90*deg)\", \"R*sin((i+j)*90*deg)\"]");
  const model::Mechanism mechanism = load(text).runs.front().mechanism;
  std::vector<std::string> names;
  for (const model::Body& body : mechanism.bodies) names.push_back(body.name);
  EXPECT_THAT(names, ElementsAre("n1", "n0", "n3", "n2"));
}

const std::string arms = R"toml(
[template.leg]
with = { angle = 0, side = "left", k = 1 }
elements = [
  { joint = "revolute", axis = "z", name = "{side}_foot", initial = "angle" },
  { repeat = { s = [1, 2] }, elements = [
    { joint = "prismatic", axis = "x", name = "l{s}", role = "virtual", stiffness = "k*s" }, { rigid = ["R/2", 0] } ] },
]
[parameters]
R = 2
[[body]]
name = "top"
task_space = "xy"
pose = [0, 2]
[[chain]]
use = "leg"
name = "a"
with = { angle = "R*45*deg" }
[[chain]]
repeat = { i = [1, 2] }
use = "leg"
name = "b{i}"
with = { angle = "i*45*deg", side = "right", k = 7 }
[[study]]
name = "a"
kind = "equilibrium"
)toml";

TEST_F(Repetition, TemplatesGiveChainsTheirElementsWithOtherNumbers) {
  const model::Mechanism mechanism = load(arms).runs.front().mechanism;
  ASSERT_EQ(mechanism.chains.size(), 3U);
  const model::Chain& a = mechanism.chains[0];
  const model::Chain& b = mechanism.chains[2];
  ASSERT_EQ(b.elements.size(), 5U);
  EXPECT_DOUBLE_EQ(std::get<model::Joint>(a.elements[0]).initial, std::atan2(1, 0));
  EXPECT_EQ(std::get<model::Joint>(a.elements[0]).name, "left_foot");
  EXPECT_EQ(std::get<model::Joint>(b.elements[0]).name, "right_foot");
  EXPECT_DOUBLE_EQ(std::get<model::Joint>(b.elements[0]).initial, std::atan2(1, 0));
  const auto& second = std::get<model::Joint>(b.elements[3]);
  EXPECT_EQ(second.name, "l2");
  EXPECT_EQ(std::get<model::LinearSpring>(*second.spring).stiffness, 14);
}

TEST_F(Repetition, NamesTheIndexInMessagesAtThePlaceOfTheTextOnceForAllCopies) {
  EXPECT_THAT(after("stiffness = \"1 + i\"", "stiffness = \"1 - i\""),
              ElementsAre("case.toml:15:13: bar[1, i = 2].stiffness: got \"1 - i\" = -1, need a "
                          "number >= 0 [N/m]",
                          "case.toml:15:13: bar[1, i = 3].stiffness: got \"1 - i\" = -2, need a "
                          "number >= 0 [N/m]"));
  EXPECT_THAT(after("stiffness = \"1 + i\"", "stiffness = \"1 + ii\""),
              ElementsAre(testing::StartsWith("case.toml:15:13: bar[1, i = 0].stiffness: got \"1 + "
                                              "ii\", need a number >= 0 [N/m] or a formula: ")));
}

TEST_F(Repetition, WantsRangesThatCanBeCounted) {
  EXPECT_THAT(
      after("{ i = [0, 3] }", "4"),
      ElementsAre("case.toml:4:10: node[1].repeat: got 4, need a table such as { i = [0, 5] "
                  "}: the first and the last index"));
  EXPECT_THAT(
      after("[0, 3]", "[0, 3.5]"),
      ElementsAre("case.toml:4:16: node[1].repeat.i: got a list of 2, need [first, last] or "
                  "[first, last, step], whole numbers from -1000000 to 1000000"));
  EXPECT_THAT(after("[0, 3]", "[3, 0]"),
              ElementsAre("case.toml:4:16: node[1].repeat.i: got [3, 0], need first <= last"));
  EXPECT_THAT(after("[0, 3]", "[0, 3, 0]"),
              ElementsAre("case.toml:4:16: node[1].repeat.i: need a step of at least 1"));
  EXPECT_THAT(after("{ i = [0, 3] }", "{ R = [0, 3] }"),
              ElementsAre("case.toml:4:12: node[1].repeat.R: is the name of a parameter or of an "
                          "index already, need another"));
  EXPECT_THAT(
      after("{ i = [0, 3] }", "{ i = [0, 999], j = [0, 999] }"),
      ElementsAre("case.toml:4:10: node[1].repeat: got more than 10000 copies, need at most "
                  "as many"));
}

TEST_F(Repetition, IsBoundedInAllTogether) {
  std::string text = ring;
  for (int i = 0; i < 20; ++i)
    text += "[[load]]\nrepeat = { i = [1, 9999] }\non = \"n0\"\nforce = [1, 0]\n";
  EXPECT_THAT(
      messages(text),
      ElementsAre(testing::HasSubstr("more than 500000 keys and values with all repetitions")));
}

TEST_F(Repetition, WantsBracesThatCanBeRead) {
  EXPECT_THAT(
      after("\"n{i}\"", "\"n{i\""),
      testing::Contains("case.toml:5:8: node[1, i = 0].name: got \"n{i\": a '{' without its "
                        "'}'"));
  EXPECT_THAT(
      after("n{(i+1)%4}", "n{(j+1)%4}"),
      ElementsAre("case.toml:14:6: bar[1, i = 0].to: got \"n{(j+1)%4}\": \"j\" in { } is no "
                  "index here; known here: i"));
  EXPECT_THAT(
      after("n{(i+1)%4}", "n{i/2}"),
      ElementsAre("case.toml:14:6: bar[1, i = 0].to: got \"n{i/2}\": cannot read {i/2}, need "
                  "whole numbers and indices with + - * % and parentheses"));
}

TEST_F(Repetition, WantsTemplatesAndTheirNamesToExist) {
  const auto changed = [this](const std::string& old, const std::string& with) {
    return messages(replaced(arms, old, with));
  };
  EXPECT_THAT(changed("use = \"leg\"\nname = \"a\"", "use = \"log\"\nname = \"a\""),
              ElementsAre(testing::HasSubstr("chain[1].use: got \"log\", need the name of a "
                                             "[template.name], did you mean \"leg\"?")));
  EXPECT_THAT(
      changed("with = { angle = \"R", "with = { angel = \"R"),
      ElementsAre(testing::HasSubstr("chain[1].with.angel: no such name in the template, did "
                                     "you mean \"angle\"?")));
  EXPECT_THAT(changed("use = \"leg\"\nname = \"a\"", "name = \"a\""),
              ElementsAre(testing::HasSubstr("chain[1].with: goes with use, need use = \"...\"")));
  EXPECT_THAT(changed("[template.leg]\n", "[template.leg]\nuse = \"leg\"\n"),
              ElementsAre(testing::HasSubstr("chain[1]: templates that use each other in a circle"),
                          testing::HasSubstr("chain[2, i = 1]")));
}

TEST_F(Repetition, WantsNamesGivenToTemplatesToStandInThem) {
  EXPECT_THAT(
      messages(replaced(arms, "side = \"left\", k = 1 }", "side = \"left\", k = 1, kk = 2 }")),
      ElementsAre("case.toml:3:43: template.leg.with.kk: stands nowhere in the template, need a "
                  "formula or braces that name it"));
  const std::string without = replaced(arms, "with = { angle = 0, side = \"left\", k = 1 }\n", "");
  EXPECT_THAT(
      messages(replaced(replaced(without, "{side}_foot", "foot"), "with = { angle = \"R*45*deg\" }",
                        "with = { angle = \"R*45*deg\", k = 1, kk = 2 }")),
      testing::Contains(testing::HasSubstr(
          "chain[1].with.kk: stands nowhere in the template, need a name that it uses")));
}

TEST_F(Repetition, HintsAtTemplatesThatNothingUses) {
  EXPECT_TRUE(load(arms).hints.empty());
  EXPECT_THAT(load(arms + "[template.log]\nelemnts = 3\n").hints,
              ElementsAre(testing::HasSubstr("template.log: nothing uses it")));
}

const std::string turned = R"toml([parameters]
R = 2
[[node]]
pattern = { i = [0, 3], angle = "90*deg" }
name = "n{i}"
at = ["R", 0]
[[node]]
name = "hub"
at = [0, 0]
fixed = true
[[bar]]
repeat = { i = [0, 3] }
from = "hub"
to = "n{i}"
stiffness = 1
[[load]]
pattern = { i = [0, 3], angle = "90*deg", axis = "-z" }
on = "n{i}"
force = ["1 + i", 0]
[[study]]
name = "a"
body = "n0"
kind = "equilibrium"
)toml";

TEST_F(Repetition, PatternsTurnPlacesAndForcesAboutAnAxis) {
  const model::Mechanism mechanism = load(turned).runs.front().mechanism;
  ASSERT_EQ(mechanism.bodies.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    const double c = std::cos(i * 90 * std::numbers::pi / 180);
    const double s = std::sin(i * 90 * std::numbers::pi / 180);
    const auto k = static_cast<std::size_t>(i);
    EXPECT_DOUBLE_EQ(mechanism.bodies[k].pose[0], 2 * c);
    EXPECT_DOUBLE_EQ(mechanism.bodies[k].pose[1], 2 * s);
    EXPECT_DOUBLE_EQ(mechanism.loads[k].vector[0], (1 + i) * c);
    EXPECT_DOUBLE_EQ(mechanism.loads[k].vector[1], -(1 + i) * s);
  }
}

TEST_F(Repetition, PatternsTurnAboutAnyPointAndAnyAxis) {
  const std::string about =
      replaced(turned, "angle = \"90*deg\" }\nname", "angle = \"90*deg\", about = [1, 0] }\nname");
  const model::Mechanism flat = load(about).runs.front().mechanism;
  EXPECT_DOUBLE_EQ(flat.bodies[1].pose[0], 1 + std::cos(std::numbers::pi / 2));
  EXPECT_DOUBLE_EQ(flat.bodies[1].pose[1], 1);
  std::string text = replaced(turned, "\"90*deg\" }\nname", "\"90*deg\", axis = \"x\" }\nname");
  text = replaced(replaced(text, "[\"R\", 0]", "[3, \"R\", 1]"), "at = [0, 0]", "at = [0, 0, 0]");
  text = replaced(text, "[\"1 + i\", 0]", "[\"1 + i\", 0, 0]");
  const model::Mechanism space = load(text).runs.front().mechanism;
  const Vector& pose = space.bodies[1].pose;  // y -> z, z -> -y
  EXPECT_DOUBLE_EQ(pose[0], 3);
  EXPECT_NEAR(pose[1], -1, 1e-15);
  EXPECT_NEAR(pose[2], 2, 1e-15);
}

// The platform's frame lies on the axis: legs are turned as a whole, at both of their ends.
TEST_F(Repetition, PatternsOfChainsAreThoseWrittenWithTurnedFrames) {
  const auto text = [](const std::string& pattern, const std::string& ends) {
    return "[[body]]\nname = \"p\"\ntask_space = \"planar\"\n[[chain]]\n" + pattern +
           "name = \"c{i}\"\n" + ends +
           "elements = [{ joint = \"revolute\", axis = \"z\" }, { joint = \"prismatic\", axis = "
           "\"x\", role = \"virtual\", stiffness = 1 }, { rigid = [-1, 0] }, { joint = "
           "\"revolute\", axis = \"z\" }]\n[[study]]\nname = \"a\"\nkind = \"equilibrium\"\n";
  };
  const auto one = load(text("pattern = { i = [0, 2], angle = \"120*deg\" }\n",
                             "from_at = [2, 0]\nto_at = [1, 0]\n"));
  const auto other =
      load(text("repeat = { i = [0, 2] }\n",
                "from_at = { at = [\"2*cos(i*120*deg)\", \"2*sin(i*120*deg)\"], rotate = "
                "{ axis = \"z\", angle = \"i*120*deg\" } }\n"
                "to_at = { at = [\"cos(i*120*deg)\", \"sin(i*120*deg)\"], rotate = "
                "{ axis = \"z\", angle = \"i*120*deg\" } }\n"));
  for (std::size_t i = 0; i < 3; ++i) {
    const model::Chain& a = one.runs[0].mechanism.chains[i];
    const model::Chain& b = other.runs[0].mechanism.chains[i];
    EXPECT_TRUE(a.from_attachment.p.isApprox(b.from_attachment.p, 1e-15));
    EXPECT_TRUE(a.from_attachment.R.isApprox(b.from_attachment.R, 1e-15));
    EXPECT_TRUE(a.to_attachment.p.isApprox(b.to_attachment.p, 1e-15));
    EXPECT_TRUE(a.to_attachment.R.isApprox(b.to_attachment.R, 1e-15));
  }
}

TEST_F(Repetition, WantsPatternsThatCanBeTurned) {
  const auto changed = [this](const std::string& old, const std::string& with) {
    return messages(replaced(turned, old, with));
  };
  EXPECT_THAT(changed("{ i = [0, 3], angle = \"90*deg\" }", "{ i = [0, 3] }"),
              testing::Contains("case.toml:4:11: node[1, i = 0].pattern.angle: missing, need the "
                                "angle from one copy to the next [rad]"));
  EXPECT_THAT(changed("angle = \"90*deg\" }\nname", "angle = \"90*deg\", axis = \"x\" }\nname"),
              testing::Contains("case.toml:6:6: node[1, i = 0].pattern.axis: in the plane the axis "
                                "is \"z\""));
  EXPECT_THAT(
      changed("{ i = [0, 3], angle = \"90*deg\" }", "{ angle = \"90*deg\" }"),
      testing::Contains("case.toml:4:11: node[1].pattern: got no index, need a table with one "
                        "index such as { i = [0, 5], angle = \"60*deg\" }, and no other keys but "
                        "axis and about"));
  EXPECT_THAT(changed("angle = \"90*deg\" }\nname", "angle = \"90*deg\", abuot = [1, 0] }\nname"),
              testing::Contains(testing::HasSubstr(
                  "node[1].pattern: got the indices i and abuot, need a table with one index")));
  EXPECT_THAT(changed("at = [\"R\", 0]\n", "at = [\"R\", 0]\nfixed = [\"x\"]\n"),
              testing::Contains(testing::HasSubstr(
                  "node[1, i = 0].fixed: directions are those of the base, which do not turn")));
  EXPECT_THAT(changed("angle = \"90*deg\" }\nname", "angle = \"90*deg\", axis = \"q\" }\nname"),
              testing::Contains(testing::HasSubstr("pattern.axis: got \"q\", need \"x\"")));
}

// Numbers that are turned are made of several formulas of the file: each is judged where it stands, alone and once.
TEST_F(Repetition, MistakesInWhatANumberIsMadeOfAreReportedWhereTheyStand) {
  const auto changed = [this](const std::string& old, const std::string& with) {
    return messages(replaced(turned, old, with));
  };
  EXPECT_THAT(
      changed("angle = \"90*deg\" }\nname", "angle = \"90deg\" }\nname"),
      testing::ElementsAre(testing::HasSubstr(
          "case.toml:4:33: node[1, i = 0].pattern.angle: got \"90deg\", need a finite number "
          "[rad] or a formula: angles are in radians")));
  EXPECT_THAT(changed("angle = \"90*deg\" }\nname", "angle = \"90)*(2\" }\nname"),
              testing::ElementsAre(testing::HasSubstr(
                  "case.toml:4:33: node[1, i = 0].pattern.angle: got \"90)*(2\"")))
      << "brackets that close only what they are put into";
  EXPECT_THAT(changed("angle = \"90*deg\" }\nname", "angle = \"1/0\" }\nname"),
              testing::ElementsAre(testing::HasSubstr(
                  "case.toml:4:33: node[1, i = 0].pattern.angle: got \"1/0\", which has no "
                  "finite value, need a finite number [rad]")));
  EXPECT_THAT(
      changed("angle = \"90*deg\" }\nname", "angle = \"90*deg\", about = [0, \"2R\"] }\nname"),
      testing::ElementsAre(testing::HasSubstr(
          "case.toml:4:55: node[1, i = 0].pattern.about[2]: got \"2R\", need a finite")));
  EXPECT_THAT(changed("at = [\"R\", 0]\n", "at = [\"2R\", 0]\n"),
              testing::ElementsAre(testing::HasSubstr(
                  "case.toml:6:7: node[1, i = 0].at[1]: got \"2R\", need a finite number [m]")));
}

TEST_F(Repetition, MistakesInWhatATemplateIsGivenAreReportedWhereTheyStand) {
  const auto with_stiffness = [this](const std::string& k) {
    return messages(
        "[[node]]\nname = \"a\"\nat = [1, 0]\n"
        "[template.t]\nstiffness = \"k + 1\"\n"
        "[[bar]]\nuse = \"t\"\nwith = { k = \"" +
        k +
        "\" }\nfrom = \"base\"\nto = \"a\"\n"
        "[[study]]\nname = \"s\"\nkind = \"equilibrium\"\n");
  };
  EXPECT_THAT(
      with_stiffness("2 3"),
      testing::ElementsAre(testing::HasSubstr(
          "case.toml:8:14: bar[1].with.k: got \"2 3\", need a number >= 0 [N/m] or a formula: ")));
  EXPECT_THAT(
      with_stiffness("2)*(3"),
      testing::ElementsAre(testing::HasSubstr("case.toml:8:14: bar[1].with.k: got \"2)*(3\"")));
  EXPECT_THAT(with_stiffness("1/0"),
              testing::ElementsAre(testing::HasSubstr(
                  "case.toml:8:14: bar[1].with.k: got \"1/0\", which has no finite value")));
}

TEST(Bindings, StandInFormulasForNamesAlone) {
  const Bindings bindings{{{"e", "2", 2}, {"k", "a + b", {}}}};
  EXPECT_EQ(with_bindings("2e3*e + sin(e) + ke + k(1)", bindings),
            "2e3*(2) + sin((2)) + ke + k(1)");
  EXPECT_EQ(with_bindings("-k*1.5e", bindings), "-(a + b)*1.5(2)");
}

TEST(Bindings, CountInBracesWithWholeNumbers) {
  const Bindings bindings{{{"i", "5", 5}, {"j", "-2", -2}, {"w", "left", {}}}};
  EXPECT_EQ(filled("a{i}b{ j }{i*2 + 1}{(j - 1) % 4}{-j}", bindings).text, "a5b-21112");
  EXPECT_EQ(filled("{w}_x", bindings).text, "left_x");
  for (const char* wrong :
       {"{", "}", "{w+1}", "{1000000*1000000}", "{i%0}", "{}", "{i i}", "{((i)}"})
    EXPECT_THAT(filled(wrong, bindings).problem, testing::Not(IsEmpty())) << wrong;
}

}  // namespace
}  // namespace springfold::io
