// Spring laws in case files: what they become, and what is said about mistakes in them.
#include <gmock/gmock.h>

#include "case_files.hpp"
#include "springfold/model/spring_law.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SpringLaws : public CaseFiles {
 protected:
  static std::string with(const std::string& spring) {
    return replaced(orthoglide_text(), "{ law = \"linear\", stiffness = \"Kv\" }",
                    "{ " + spring + " }");
  }
  static const model::Joint& knee(const Case& c, std::size_t element = 1) {
    return std::get<model::Joint>(c.runs[0].mechanism.chains[0].elements[element]);
  }
  model::CompiledSpring law(const std::string& spring) const {
    return model::compile(*knee(load(with(spring))).spring);
  }
  std::vector<std::string> about(const std::string& spring) const { return messages(with(spring)); }
};

TEST_F(SpringLaws, PolynomialsAndFormulasMayNameParameters) {
  const auto polynomial =
      law("law = \"polynomial\", coefficients = [0, \"2*K\", 0, 3], free = 0.5");
  const auto formula = law("law = \"formula\", formula = \"2*K*u + 3*u^3\", free = \"L/2\"");
  for (const double c : {-0.3, 0.5, 1.2}) {
    const double u = c - 0.5;
    EXPECT_NEAR(polynomial.torque(0, c), 2 * u + 3 * u * u * u, 1e-14);
    EXPECT_NEAR(formula.torque(0, c), 2 * u + 3 * u * u * u, 1e-14);
    EXPECT_NEAR(formula.stiffness(0, c), 2 + 9 * u * u, 1e-14);
  }
}

TEST_F(SpringLaws, LogarithmsAndPowers) {
  EXPECT_NEAR(law("law = \"logarithmic\", stiffness = 2, length = 3, free = 3").torque(0, 4.0),
              6 * std::log(4 / 3.0), 1e-14);
  const auto contact =
      law("law = \"power\", force = 50, exponent = 3, from = 0.1, depth = 2, side = \"below\"");
  EXPECT_NEAR(contact.torque(0, -0.1), -50 * 1e-3, 1e-15);
  EXPECT_EQ(contact.torque(1, 0.2), 0);
}

TEST_F(SpringLaws, TablesComeFromAListOrAFile) {
  write("law.csv", "angle, torque\n-1, -4\n\n0, 0  # rest\n+0.5, 5e-1\r\n1, 2\n");
  const auto list = law("law = \"table\", points = [[-1, -4], [0, 0], [0.5, \"L/2\"], [1, 2]]");
  const auto file = law("law = \"table\", file = \"law.csv\"");
  const auto straight =
      law("law = \"table\", file = \"law.csv\", interpolation = \"straight\", free = 0.25");
  EXPECT_THAT(list.breakpoints, IsEmpty());
  for (const double c : {-2.0, -0.5, 0.3, 0.7, 3.0})
    EXPECT_EQ(list.torque(0, c), file.torque(0, c)) << c;
  EXPECT_THAT(straight.breakpoints, ElementsAre(0.25, 0.75));
  const auto torque = [&](double u) {
    return straight.torque(straight.segment_at(0.25 + u), 0.25 + u);
  };
  EXPECT_NEAR(torque(-2), -8, 1e-14);
  EXPECT_NEAR(torque(-0.5), -2, 1e-14);
  EXPECT_NEAR(torque(0.75), 1.25, 1e-14);
  EXPECT_NEAR(torque(2), 5, 1e-14);
  EXPECT_NEAR(straight.energy(straight.segment_at(0.25), 0.25), 0, 1e-15);
}

TEST_F(SpringLaws, TheFileOfATableIsPartOfTheFingerprint) {
  const std::string text = with("law = \"table\", file = \"law.csv\"");
  write("law.csv", "0, 0\n1, 1\n");
  const std::string before = load(text).hash;
  write("law.csv", "0, 0\n1, 2\n");
  EXPECT_NE(load(text).hash, before);
}

TEST_F(SpringLaws, InSeriesAreJointsAlongTheSameAxis) {
  const std::string text = with(
      "series = [{ law = \"linear\", stiffness = 2 }, "
      "{ law = \"one_sided\", stiffness = 3, from = 0 }]");
  const Case c = load(replaced(text, "\"leg_x.knee\" =", "\"leg_x.knee.1\" ="));
  EXPECT_EQ(knee(c, 1).name, "knee.1");
  EXPECT_EQ(knee(c, 2).name, "knee.2");
  EXPECT_EQ(knee(c, 1).axis, knee(c, 2).axis);
  EXPECT_EQ(knee(c, 2).role, model::JointRole::preloaded);
  EXPECT_EQ(std::get<model::LinearSpring>(*knee(c, 1).spring).stiffness, 2);
  EXPECT_EQ(std::get<model::OneSidedSpring>(*knee(c, 2).spring).stiffness, 3);
}

TEST_F(SpringLaws, InSeriesBehindADriveAreVirtual) {
  const Case c = load(replaced(orthoglide_text(), "value = \"L\", stiffness = \"K\"",
                               "value = \"L\", spring = { series = [{ law = \"linear\", stiffness "
                               "= 2 }, { law = \"linear\", stiffness = 3 }] }"));
  EXPECT_EQ(knee(c, 0).role, model::JointRole::actuated);
  EXPECT_EQ(knee(c, 0).command, 1);
  EXPECT_EQ(knee(c, 1).role, model::JointRole::compliant);
  EXPECT_EQ(knee(c, 1).name, "drive.2");
}

TEST_F(SpringLaws, ThatFallAreRefusedWithAHint) {
  const std::string falls = "need a law that rises; give falling = true";
  EXPECT_THAT(about("law = \"polynomial\", coefficients = [0, 1, 0, -20]"),
              ElementsAre(HasSubstr(falls)));
  EXPECT_THAT(about("law = \"formula\", formula = \"u - 20*u^3\""), ElementsAre(HasSubstr(falls)));
  EXPECT_THAT(about("law = \"formula\", formula = \"-K*u\""), ElementsAre(HasSubstr(falls)));
  EXPECT_THAT(about("law = \"table\", points = [[0, 0], [1, 2], [2, 1]]"),
              ElementsAre(HasSubstr("case.toml:17:129: chain[1].elements[2].spring.points[3][2]: "
                                    "the torque falls from the point before it to this one, need "
                                    "torques that rise, or falling = true")));
  EXPECT_THAT(about("law = \"linear\", stiffness = -1"),
              ElementsAre(HasSubstr("need a number >= 0 [N*mm/rad], or falling = true")));
}

TEST_F(SpringLaws, ThatFallAreAcceptedWhereTheySaySo) {
  for (const std::string spring :
       {"law = \"polynomial\", coefficients = [0, 1, 0, -20], falling = true",
        "law = \"polynomial\", coefficients = [0, 1, 0, -20], range = [-0.1, 0.1]",
        "law = \"formula\", formula = \"u - 20*u^3\", falling = true",
        "law = \"formula\", formula = \"u - 20*u^3\", range = [-0.1, 0.1]",
        "law = \"table\", points = [[0, 0], [1, 2], [2, 1]], falling = true",
        "law = \"linear\", stiffness = -1, falling = true",
        "law = \"piecewise_linear\", breakpoints = [0], stiffnesses = [1, -1], falling = true"})
    EXPECT_THAT(about(spring), IsEmpty()) << spring;
}

TEST_F(SpringLaws, SayWhatIsWrongWithTheirKeys) {
  const auto one = [](const std::string& text) { return ElementsAre(HasSubstr(text)); };
  EXPECT_THAT(about("law = \"polynomial\""), one("spring.coefficients: missing, need a list"));
  EXPECT_THAT(about("law = \"polynomial\", coefficients = []"), one("need 1 to 100 numbers"));
  EXPECT_THAT(about("law = \"polynomial\", coefficients = [0, 1], range = [1]"),
              one("spring.range: got a list of 1, need a list of two numbers"));
  EXPECT_THAT(about("law = \"polynomial\", coefficients = [0, 1], range = [1, 0]"),
              one("spring.range[2]: got 0, need more than 1 (low < high)"));
  EXPECT_THAT(about("law = \"formula\""), one("spring.formula: missing, need a text such as"));
  EXPECT_THAT(about("law = \"formula\", formula = \"k*u\""), one("no parameter \"k\""));
  EXPECT_THAT(about("law = \"formula\", formula = \"L*u**3\""), one("a power is written ^"));
  EXPECT_THAT(about("law = \"formula\", formula = \"2*abs(u)\""), one("need a smooth law"));
  EXPECT_THAT(about("law = \"formula\", formula = \"ln(u)\""),
              one("need a finite torque at c = free"));
  EXPECT_THAT(about("law = \"logarithmic\", stiffness = 1, length = 0"),
              one("spring.length: got 0, need a number > 0 [rad]"));
  EXPECT_THAT(about("law = \"power\", force = 1, exponent = 0.5"),
              one("spring.exponent: got 0.5, need a number >= 1"));
  EXPECT_THAT(about("law = \"power\", force = -1, exponent = 2"),
              one("spring.force: got -1, need a number >= 0 [N*mm]"));
  EXPECT_THAT(about("law = \"power\", force = 1, exponent = 2, depth = 0"),
              one("spring.depth: got 0, need a number > 0 [rad]"));
  EXPECT_THAT(about("law = \"power\", force = 1, exponent = 2, side = \"left\""),
              one("spring.side: got \"left\", need \"above\" or \"below\""));
}

TEST_F(SpringLaws, SayWhatIsWrongWithTables) {
  const auto one = [](const std::string& text) { return ElementsAre(HasSubstr(text)); };
  EXPECT_THAT(about("law = \"table\""), one("spring.points: missing, need a list of at least two"));
  EXPECT_THAT(about("law = \"table\", points = [[0, 0]]"), one("got 1 point, need 2 to 10000"));
  EXPECT_THAT(about("law = \"table\", points = [[0, 0], [1]]"),
              one("spring.points[2]: got a list of 1, need a pair [deformation"));
  EXPECT_THAT(about("law = \"table\", points = [[0, 0], [0, 1]]"),
              one("spring.points[2][1]: got 0, need more than 0 (deformations increase)"));
  EXPECT_THAT(about("law = \"table\", points = [[0, 0], [1, 1]], interpolation = \"spline\""),
              one("spring.interpolation: got \"spline\", need \"cubic\" or \"straight\""));
  EXPECT_THAT(about("law = \"table\", points = [[0, 0], [1, 1]], file = \"law.csv\""),
              one("either points or file, not both"));
  EXPECT_THAT(about("law = \"table\", file = \"none.csv\""), one("\"none.csv\" cannot be read"));
  write("law.csv", "0, 0\n1; 2\n2, 3, 4\n3, x\n");
  EXPECT_THAT(about("law = \"table\", file = \"law.csv\""),
              ElementsAre(HasSubstr("law.csv:2:1: need two numbers"),
                          HasSubstr("law.csv:3:1: need two numbers"),
                          HasSubstr("law.csv:4:1: need two numbers")));
  write("law.csv", "0, 0\n1, 2\n2, 1\n");
  EXPECT_THAT(about("law = \"table\", file = \"law.csv\""), one("law.csv:3:3: chain[1]"));
}

TEST_F(SpringLaws, SayWhatIsWrongWithSeries) {
  const auto one = [](const std::string& text) { return ElementsAre(HasSubstr(text)); };
  EXPECT_THAT(about("series = [{ law = \"linear\", stiffness = 1 }]"),
              one("spring.series: got a list of 1, need a list of at least two springs"));
  EXPECT_THAT(about("series = 3"), one("spring.series: got 3, need a list"));
  const std::string two =
      "{ law = \"linear\", stiffness = 1 }, { law = \"linear\", stiffness = \"none\" }";
  EXPECT_THAT(about("series = [" + two + "]"), one("spring.series[2].stiffness: got \"none\""));
  EXPECT_THAT(about("series = [{ law = \"gap\", stiffness = 1, low = 0, high = 1 }, { law = "
                    "\"linear\", stiffness = 1 }], free = 1"),
              one("spring.free: unknown key; known here: series"));
}

TEST_F(SpringLaws, OfAParameterNamedUSaySo) {
  const std::string text =
      replaced(with("law = \"formula\", formula = \"u\""), "L = 1\n", "L = 1\nu = 2\n");
  EXPECT_THAT(messages(text), ElementsAre(HasSubstr("u is also a parameter of the case")));
}

}  // namespace
}  // namespace springfold::io
