// Nodes, bars and repetition: what they stand for, run.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// All numbers of all rows, bit by bit.
std::string bytes_of(const analysis::StudyResult& result) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const auto& quantity : result.quantities) text << quantity.name << ",";
  for (const auto& branch : result.branches)
    for (const auto& sample : branch.samples) {
      for (const double value : sample.values) text << value << ",";
      text << sample.event << "\n";
    }
  return text.str();
}

std::string truss(const std::string& bars) {
  return R"toml([parameters]
a = 1
[[node]]
name = "n0"
at = ["-a", 0]
fixed = true
[[node]]
name = "n1"
at = [0, "a/2"]
[[node]]
name = "n2"
at = ["a", 0]
fixed = true
)toml" + bars +
         R"toml([[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { n1.y = [-1, 1] }
)toml";
}

TEST(RepeatedTables, GiveTheSameBytesAsWrittenOut) {
  const Ran repeated = run(truss(R"toml([[bar]]
repeat = { i = [0, 1] }
from = "n{2*i}"
to = "n1"
EA = "2 + i"
)toml"));
  const Ran by_hand = run(truss(R"toml([[bar]]
from = "n0"
to = "n1"
EA = "2 + 0"
[[bar]]
from = "n2"
to = "n1"
EA = "2 + 1"
)toml"));
  EXPECT_EQ(bytes_of(repeated.results[0]), bytes_of(by_hand.results[0]));
  EXPECT_GT(repeated.results[0].branches.at(0).samples.size(), 20U);
}

// F = 2 k (L0/l - 1) y turns back at l^3 = L0 a^2.
TEST(Bars, GiveTheLimitLoadsOfTheSameTrussOfChains) {
  const Ran bars =
      run(truss("[[bar]]\nrepeat = { i = [0, 2, 2] }\nfrom = \"n{i}\"\nto = "
                "\"n1\"\nstiffness = 3\n"));
  const Ran chains = run(R"toml([[body]]
name = "n1"
task_space = "xy"
pose = [0, 0.5]
[[chain]]
repeat = { i = [0, 1] }
name = "bar{i}"
from_at = ["2*i - 1", 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "atan2(0.5, 1 - 2*i)" },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", stiffness = 3 },
  { rigid = ["sqrt(1.25)", 0] },
]
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { n1.y = [-1, 1] }
)toml");
  const double L0 = std::sqrt(1.25), l = std::cbrt(L0), y = std::sqrt(l * l - 1);
  const double P = 2 * 3 * (L0 / l - 1) * y;
  for (const Ran* ran : {&bars, &chains})
    EXPECT_THAT(lambdas(ran->results[0], EventKind::limit_point),
                testing::UnorderedElementsAre(testing::DoubleNear(P, 1e-12),
                                              testing::DoubleNear(-P, 1e-12)));
}

// Along the axis of symmetry nothing moves but what is driven: F(y) = 2 k (L0/l - 1) y.
TEST(Bars, CanBeDrivenAlongAnAxisOfSymmetryWhereNothingAnswers) {
  std::string text = truss(
      "[[bar]]\nrepeat = { i = [0, 2, 2] }\nfrom = \"n{i}\"\nto = "
      "\"n1\"\nstiffness = 3\n");
  const Ran driven = run(text.replace(text.find("\"load\""), 6, "\"mixed\""));
  const analysis::StudyResult& result = driven.results[0];
  ASSERT_TRUE(analysis::complete(result)) << result.start.message;
  const std::size_t rows = result.branches[0].samples.size();
  EXPECT_GT(rows, 10U);
  for (std::size_t row = 0; row < rows; ++row) {
    const double y = value(result, row, "n1.y"), l = std::hypot(1, y);
    EXPECT_NEAR(value(result, row, "force"), 6 * (std::sqrt(1.25) / l - 1) * y, 1e-13);
  }
}

// A body on four springs as it is drawn: K_phi = sum k (u x r)^2, no chain at all.
TEST(ABodyHeldBySpringsAlone, HasTheStiffnessOfItsSprings) {
  const Ran ran = run(R"toml([[body]]
name = "plate"
task_space = "planar"
pose = [0, 0, 0]
[[bar]]
repeat = { i = [0, 3] }
name = "s{i}"
from = "base"
from_at = ["3*cos(i*90*deg + 20*deg)", "3*sin(i*90*deg + 20*deg)"]
to = "plate"
to_at = ["cos(i*90*deg)", "sin(i*90*deg)"]
stiffness = 2
[[study]]
name = "turn"
control = "mixed"
direction = [0, 0, 1]
until = { deflection = [-1, 1] }
)toml");
  const analysis::StudyResult& result = ran.results[0];
  ASSERT_TRUE(analysis::complete(result)) << result.start.message;
  const double c = std::cos(20 * std::acos(-1.0) / 180), s = std::sin(20 * std::acos(-1.0) / 180);
  const double length2 = 10 - 6 * c, lever2 = 9 * s * s / length2;
  EXPECT_NEAR(result.start.stiffness(2, 2), 4 * 2 * lever2, 1e-12);
  EXPECT_NEAR(result.start.stiffness(0, 0), 4 * 2 * 0.5, 1e-12);
  // Turned by q the springs have the length sqrt(10 - 6 cos(20 deg - q)).
  const std::size_t last = result.branches[0].samples.size() - 1;
  const double q = value(result, last, "deflection");
  const double L = std::sqrt(10 - 6 * std::cos(20 * std::acos(-1.0) / 180 - q));
  const double torque =
      -4 * 2 * (1 - std::sqrt(length2) / L) * 3 * std::sin(20 * std::acos(-1.0) / 180 - q);
  EXPECT_NEAR(value(result, last, "force"), torque, 1e-11);
}

std::size_t lines_of(const std::string& name) {
  std::ifstream file{SPRINGFOLD_SOURCE_DIR "/cases/short-files/" + name};
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) ++count;
  return count;
}

TEST(ShortFiles, AreShort) {
  EXPECT_LE(lines_of("case.toml"), 25U);
  EXPECT_LE(lines_of("case-platform.toml"), 20U);
  EXPECT_LE(lines_of("case-column.toml"), 12U);
}

/// A crank that turns a node round its foot, several times; a spiral spring between it and a fixed point.
std::string crank(const std::string& spiral) {
  return R"toml([[node]]
name = "foot"
at = [0.5, 0]
fixed = true
[[node]]
name = "east"
at = [2, 0]
fixed = true
[[node]]
name = "tip"
at = [0.5, 1]
[[chain]]
name = "crank"
from_at = [0.5, 0]
elements = [{ joint = "revolute", axis = "z", name = "drive", role = "actuated", value = "90*deg" }, { rigid = [1, 0] }]
[[spring]]
name = "spiral"
shape = "angle"
stiffness = 0.3
)toml" + spiral +
         R"toml([[study]]
name = "wind"
body = "tip"
control = "actuator"
actuators = { crank.drive = 1 }
until = { lambda = [-20, 20] }
)toml";
}

TEST(AnglesOfNodes, CountWholeTurnsWhereTheyAreToldTo) {
  const std::string ahead = "of = [\"east\", \"foot\", \"tip\"]\nnear = 0\nturns = true\n";
  const std::string behind = "of = [\"tip\", \"foot\", \"east\"]\nnear = 0\nturns = true\n";
  for (const auto& [points, sign] : {std::pair{ahead, 1.0}, {behind, -1.0}}) {
    const analysis::StudyResult result = run(crank(points)).results[0];
    ASSERT_TRUE(analysis::complete(result));
    for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
      const double angle = sign * value(result, row, "crank.drive.rho");
      EXPECT_NEAR(value(result, row, "spiral.angle"), angle, 1e-12);
      EXPECT_NEAR(value(result, row, "spiral.moment"), 0.3 * angle, 1e-12);
    }
  }
}

TEST(AnglesOfNodes, EndHalfATurnFromNearWhereTheyAreNot) {
  const analysis::StudyResult result =
      run(crank("of = [\"east\", \"foot\", \"tip\"]\nnear = 0\n")).results[0];
  EXPECT_FALSE(analysis::complete(result));
}

// A tool that is pressed on the deck between two roofs, whose line moves and turns. The truths: the energy of the four
// coordinates of the roofs, with gradients by complex steps and Newton on fold and touch in 40 digits, written apart
// from the program.
TEST(ContactsWithMovingLines, HaveTheTouchAndLimitPointsOfTheirEnergy) {
  const auto pressed = [](const std::string& exponent) {
    return run(R"toml([[node]]
repeat = { i = [0, 1] }
name = "p{i}"
at = ["2*i", "0.5 + 0.1*i"]
[[bar]]
repeat = { i = [0, 1], s = [-1, 1, 2] }
name = "b{i}{(s + 1) % 4}"
from = "p{i}"
to = "base"
to_at = ["2*i + s", 0]
stiffness = 10
[[bar]]
name = "deck"
from = "p0"
to = "p1"
stiffness = 5
[[node]]
name = "tool"
at = [0.7, 1]
fixed = ["x"]
[[spring]]
name = "touch"
shape = "line"
of = ["tool", "p0", "p1"]
law = { law = "power", force = 4, depth = 0.2, exponent = )toml" +
               exponent + R"toml(, from = 0.05, side = "below" }
[[study]]
name = "push"
body = "tool"
control = "mixed"
direction = [0, -1]
until = { lambda = [0, 2.2] }
)toml");
  };
  const auto first = [](const Ran& ran, EventKind kind, const std::string& quantity) {
    for (const auto& event : ran.results[0].branches.at(0).events)
      if (event.kind == kind) return analysis::value(ran.results[0], event.row, quantity);
    return std::nan("");
  };
  constexpr double digits = 1e-11;
  const Ran cubic = pressed("3");
  EXPECT_NEAR(first(cubic, EventKind::switching, "lambda"), 0.41493753901375, digits);
  const auto limits = lambdas(cubic.results[0], EventKind::limit_point);
  ASSERT_EQ(limits.size(), 2U) << "where the contact lets go, the force falls to zero and stays";
  EXPECT_NEAR(limits[0], 0.69078681507761, digits) << "of the force";
  EXPECT_NEAR(first(cubic, EventKind::limit_point, "force"), 0.66457784799880, digits);
  EXPECT_NEAR(limits[1], 0.81042913768846, digits) << "of the way";
  EXPECT_EQ(lambdas(pressed("2").results[0], EventKind::limit_point).size(), 2U);
  const Ran of_power_one = pressed("1");
  EXPECT_NEAR(first(of_power_one, EventKind::limit_point, "lambda"), 0.61451109634302, digits);
  EXPECT_NEAR(first(of_power_one, EventKind::limit_point, "force"), 0.66986628653641, digits);
}

}  // namespace
}  // namespace springfold::io
