// Slips that many make are told as what they are: units in numbers, degrees for radians, axes out of the plane,
// steps given alone, coupled springs, expected values of another case.
#include <gmock/gmock.h>

#include "case_files.hpp"
#include "io/unit_text.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(UnitProblem, TellsNumbersWithUnitsFromFormulas) {
  const std::vector<std::string> known{"L", "sin", "pi"};
  for (const char* text : {"5 mm", "5mm", "3e4 N/m", "-2 N*m/rad", "0.2 µm"})
    EXPECT_THAT(unit_problem(text, known), HasSubstr("units do not belong into numbers")) << text;
  EXPECT_EQ(unit_problem("20 deg", known), "angles are in radians; of degrees write \"20*deg\"");
  EXPECT_THAT(unit_problem("-7.5°", known), HasSubstr("\"-7.5*deg\""));
  for (const char* text : {"5", "2*L", "2 L", "5*mm", "3 sin(1)", "2 pi", "mm", "1e5", "1/2"})
    EXPECT_THAT(unit_problem(text, known), IsEmpty()) << text;
}

class PlainWords : public CaseFiles {
 protected:
  std::vector<std::string> after(const std::string& from, const std::string& to) const {
    return messages(replaced(orthoglide_text(), from, to));
  }
};

TEST_F(PlainWords, SayThatUnitsDoNotBelongIntoNumbers) {
  EXPECT_THAT(
      after("L = 1\n", "L = \"5 mm\"\n"),
      ElementsAre(HasSubstr("parameters.L: got \"5 mm\", need a number or a formula: units do "
                            "not belong into numbers: write 5 alone")));
}

TEST_F(PlainWords, GiveAnExampleThatWorksForAListOfCurves) {
  EXPECT_THAT(
      after("curves = [{ study = \"Q2\", runs = [1, 2], labels = [\"one\", \"two\"] }]",
            "curves = \"Q2\""),
      ElementsAre(HasSubstr("plot[1].curves: got \"Q2\", need a list of tables such as curves = "
                            "[{ study = \"Q2\" }]")));
}

TEST_F(PlainWords, LetStepsFollowTheOneThatIsGiven) {
  const std::string all =
      "initial_step = 0.02, minimum_step = 1e-7, maximum_step = 0.04, maximum_points = 99";
  const Case small = load(replaced(orthoglide_text(), all, "maximum_step = 0.005"));
  EXPECT_EQ(small.runs[0].plan.trace.initial_step, 0.005);
  const Case large = load(replaced(orthoglide_text(), all, "initial_step = 0.2"));
  EXPECT_EQ(large.runs[0].plan.trace.maximum_step, 0.2);
  EXPECT_THAT(
      messages(replaced(orthoglide_text(), all, "initial_step = 0.02, maximum_step = 0.01")),
      testing::Contains(
          HasSubstr("trace.initial_step: got 0.02, need at most maximum_step, 0.01")));
}

TEST_F(PlainWords, RefuseAnAxisThatLeadsOutOfThePlane) {
  EXPECT_THAT(
      after("axis = \"-z\"", "axis = \"x\""),
      testing::Contains(HasSubstr("chain[1].elements[2]: joint \"knee\" leads out of the plane "
                                  "in which chain \"leg_x\" closes, need an axis along z")));
}

TEST_F(PlainWords, HintAtDegreesForRadiansAndAtCranksWithoutLength) {
  const Case turned =
      load(replaced(orthoglide_text(), "\"-80*deg\", \"80*deg\"", "\"-80*deg\", \"80*deg\""));
  EXPECT_THAT(turned.hints, IsEmpty());
  const Case degrees = load(
      replaced(orthoglide_text(), "name = \"knee\", role", "name = \"knee\", initial = 20, role"));
  EXPECT_THAT(degrees.hints,
              ElementsAre(HasSubstr("elements[2].initial: 20 rad is more than 3 full "
                                    "turns; if degrees are meant write \"20*deg\"")));
  const Case limits =
      load(replaced(orthoglide_text(), "\"-80*deg\", \"80*deg\"", "-80, \"80*deg\""));
  EXPECT_THAT(limits.hints,
              ElementsAre(HasSubstr("until.leg_x.knee[1]: -80 rad is more than 12 full "
                                    "turns; if degrees are meant write \"-80*deg\"")));
  const Case marks = load(replaced(orthoglide_text(), "mark = { deflection = [0.1, 0.2] }",
                                   "mark = { \"leg_y.knee\" = 45, \"tool.x\" = 45 }"));
  EXPECT_THAT(marks.hints,
              ElementsAre(HasSubstr("mark.leg_y.knee: 45 rad is more than 7 full turns")))
      << "a length has no turns";
  const Case crank =
      load(replaced(orthoglide_text(), "{ rigid = [\"-L\", 0] }",
                    "{ joint = \"revolute\", axis = \"z\", name = \"pin\" }, { rigid = "
                    "[\"-L\", 0] }"));
  EXPECT_THAT(crank.hints,
              ElementsAre(HasSubstr("joints \"knee\" and \"pin\" turn about one line")));
}

TEST_F(PlainWords, HintOnceAtThePatternWhoseAngleLooksLikeDegrees) {
  const auto wheel = [](const std::string& angle, const std::string& pose) {
    return "[parameters]\nstep = 120\n[[body]]\npattern = { i = [0, 4], angle = " + angle +
           " }\nname = \"b{i}\"\ntask_space = \"planar\"\npose = [1, 0.5, " + pose +
           "]\n[[spring]]\npattern = { i = [0, 4], angle = " + angle +
           " }\nname = \"s{i}\"\nfrom_at = [3, 0.4]\nto = \"b{i}\"\nto_at = [0.5, 0.1]\n"
           "stiffness = 3\n[[study]]\nname = \"a\"\nkind = \"equilibrium\"\nbody = \"b0\"\n";
  };
  const auto more = [](const std::string& part) {
    return HasSubstr(part +
                     ".pattern.angle: 120 rad is more than 19 full turns; if degrees are "
                     "meant write \"120*deg\"");
  };
  for (const char* angle : {"120", "\"120\"", "\"step\""})
    EXPECT_THAT(load(wheel(angle, "0")).hints,
                ElementsAre(more("body[1, i = 0]"), more("spring[1, i = 0]")));
  EXPECT_THAT(load(wheel("\"120*deg\"", "0")).hints, IsEmpty());
  EXPECT_THAT(load(wheel("2", "0")).hints, IsEmpty()) << "copy 4 is turned by 8, as it is meant";
  EXPECT_THAT(load(wheel("2", "30")).hints,
              ElementsAre(HasSubstr("body[1, i = 0].pose[3]: 30 rad is more than 4 full turns")));
}

TEST_F(PlainWords, HintAtDegreesInTheBoxOfASearch) {
  const Case found = load(
      "[[body]]\nname = \"b\"\ntask_space = \"planar\"\n[[spring]]\nname = \"s\"\nfrom_at = [3, "
      "0.4]\nto = "
      "\"b\"\n"
      "to_at = [0.5, 0.1]\nstiffness = 3\n[[study]]\nname = \"a\"\nkind = \"equilibria\"\nbody = "
      "\"b\"\nsearch = { box = { b.x = [-90, 90], b.phi = [-90, \"90*deg\"] } }\n");
  EXPECT_THAT(found.hints, ElementsAre(HasSubstr("b.phi[1]: -90 rad is more than 14 full turns")));
}

TEST_F(PlainWords, SayHowANeighbouringFileOfExpectedValuesIsLeftOut) {
  write("expected.toml",
        "value = [{ name = \"a\", study = \"other\", quantity = \"force\", expected = 1, "
        "tolerance = 0 }]\n");
  const auto found = messages(orthoglide_text());
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0],
            "expected.toml: was read because it lies beside case.toml; if it belongs to another "
            "case, write "
            "expected = \"\" at the top of case.toml");
}

TEST_F(PlainWords, TellWhatCoupledSpringsNeed) {
  const std::string knee =
      "role = \"preloaded\", spring = { law = \"linear\", stiffness = \"Kv\" } },\n  { rigid = "
      "[\"-L\", 0] },\n]";
  const auto with = [&](const std::string& elements, const std::string& coupled) {
    return messages(replaced(orthoglide_text(), knee, elements + coupled));
  };
  const std::string two =
      "role = \"preloaded\" },\n  { joint = \"revolute\", axis = \"z\", name = \"pin\", role = "
      "\"preloaded\" },\n  { rigid = [\"-L\", 0] },\n]\n";
  EXPECT_THAT(
      with(two,
           "coupled_springs = [{ joints = [\"knee\", \"pin\"], stiffness = [[2, 1], [1, 2]] }]"),
      IsEmpty());
  EXPECT_THAT(
      with(two,
           "coupled_springs = [{ joints = [\"knee\", \"pin\"], stiffness = [[2, 1], [0, 2]] }]"),
      ElementsAre(HasSubstr("need a symmetric matrix")));
  EXPECT_THAT(
      with(two,
           "coupled_springs = [{ joints = [\"knee\", \"pin\"], stiffness = [[1, 2], [2, 1]] }]"),
      ElementsAre(HasSubstr("need no negative eigenvalue")));
  EXPECT_THAT(
      with(two,
           "coupled_springs = [{ joints = [\"knee\", \"pim\"], stiffness = [[2, 1], [1, 2]] }]"),
      testing::Contains(HasSubstr("no joint \"pim\" in this chain, did you mean \"pin\"?")));
  EXPECT_THAT(
      with(
          "role = \"preloaded\", spring = { law = \"one_sided\", stiffness = 1, from = 0 } },\n  { "
          "joint = \"revolute\", axis = \"z\", name = \"pin\", role = \"preloaded\" },\n  { rigid "
          "= "
          "[\"-L\", 0] },\n]\n",
          "coupled_springs = [{ joints = [\"knee\", \"pin\"], stiffness = [[2, 1], [1, 2]] }]"),
      ElementsAre(HasSubstr("\"knee\" has a spring of law \"one_sided\", which switches")));
}

}  // namespace
}  // namespace springfold::io
