// Limit points that meet the points of a measured law, where its curvature jumps and nothing switches: over a parameter
// they go on, with a kink.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

const char* const measured_link = R"toml(
[parameters]
c = 0.1
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "table", points = [[-0.5, -0.5], [0, 0], [0.1, 0.1], [0.2, 0.19], [0.3, 0.22], [0.4, 0.29], [0.5, 0.33], [0.8, 0.5]], free = "c" } },
  { rigid = [1, 0] },
]
)toml";

std::string table_study(const std::string& kind, const std::string& rest) {
  return "[[study]]\nname = \"" + kind + "\"\nkind = \"" + kind +
         "\"\ncontrol = \"load\"\ndirection = [-1, 0]\n"
         "until = { lambda = [-0.01, 5], c.h = [-2, 2] }\n" +
         rest + "\n";
}

TEST(BendingLaws, AreFollowedThroughTheirPoints) {
  const StudyResult result =
      run(measured_link +
          table_study("critical_load",
                      "critical_load = { of = \"loss_of_stability\", parameter = \"c\", range = "
                      "[0.01, 0.3], values = 25 }"))
          .of("critical_load");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1u);
  const auto& rows = result.branches[0].samples;
  EXPECT_NEAR(rows.front().values.back(), 0.01, 1e-12);
  EXPECT_NEAR(rows.back().values.back(), 0.3, 1e-12);
  const auto load = column(result, "lambda");
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_LT(rows[i].values[load], rows[i - 1].values[load]) << "at c = " << rows[i].values.back();
}

TEST(BendingLaws, KeepLimitPointsThatNoValueRemoves) {
  const StudyResult result =
      run(measured_link +
          table_study("threshold",
                      "threshold = { of = \"loss_of_stability\", parameter = \"c\", range = "
                      "[0.01, 0.3] }"))
          .of("threshold");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_TRUE(result.threshold);
  EXPECT_FALSE(result.threshold->found);
}

/// A bar on a hinge with torque T(u) = u - 2 u^3 up to u = 0.3 and straight beyond, u = angle - c: pressed along the
/// axis it has limit points where tan(angle) = T/T', at the load sqrt(T^2 + T'^2). Up to 0.3 they lie at growing c,
/// beyond at falling c again.
const char* const softening_link = R"toml(
[parameters]
c = 0.1
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 1, 0, -2], range = [-0.3, 0.3], falling = true, free = "c" } },
  { rigid = [1, 0] },
]
)toml";

double torque_of_softening(double u) {
  return u < 0.3 ? u - 2 * u * u * u : 0.246 + 0.46 * (u - 0.3);
}
double slope_of_softening(double u) { return u < 0.3 ? 1 - 6 * u * u : 0.46; }

TEST(BendingLaws, MergeLimitPointsWhereTheirRangeEnds) {
  const StudyResult result =
      run(softening_link +
          table_study("threshold",
                      "threshold = { of = \"loss_of_stability\", parameter = \"c\", range = "
                      "[0.05, 0.4] }"))
          .of("threshold");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, std::atan(0.246 / 0.46) - 0.3, 1e-9);
  EXPECT_EQ(result.threshold->decides, "cusp");
}

TEST(BendingLaws, LeadLimitPointsThereAndBackInOneCurve) {
  const StudyResult result =
      run(softening_link + table_study("force_deflection", "") +
          table_study("critical_curve",
                      "critical_curve = { of = \"LP1\", parameter = \"c\", range = [0.05, 0.4] }"))
          .of("critical_curve");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  const auto& rows = result.branches.at(0).samples;
  int inside = 0, beyond = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double angle = value(result, row, "c.h"), u = angle - rows[row].values.back();
    const double torque = torque_of_softening(u), slope = slope_of_softening(u);
    ++(u < 0.3 ? inside : beyond);
    EXPECT_NEAR(std::tan(angle), torque / slope, 1e-9) << u;
    EXPECT_NEAR(value(result, row, "lambda"), std::hypot(torque, slope), 1e-9) << u;
  }
  EXPECT_GT(inside, 5);
  EXPECT_GT(beyond, 5);
}

/// A slider on a table whose maximum is one of its points, with a spring e beside it: at e = 0 the limit point of the
/// force lies on that point, whatever the table does beside it.
TEST(BendingLaws, LeadLimitPointsOfADrivenForceOverThePointsOfATable) {
  for (const std::string control : {"mixed", "pose", "load"})
    for (const std::string begin : {"-0.1", "0", "0.1"}) {
      SCOPED_TRACE(control + " " + begin);
      const StudyResult result = run("[parameters]\ne = " + begin + R"toml(
[[body]]
name = "t"
task_space = "xy"
[[chain]]
name = "g"
elements = [
  { joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "table", points = [[-1, -1], [0, 0], [1, 1], [2, 0.5], [3, 1.5]], falling = true } },
  { joint = "prismatic", axis = "y", name = "y", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
]
[[chain]]
name = "o"
elements = [
  { joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "linear", stiffness = "e", falling = true } },
  { joint = "prismatic", axis = "y", name = "y" },
]
[[study]]
name = "s"
kind = "critical_curve"
direction = [1, 0]
until = { t.x = [-0.9, 3.5] }
critical_curve = { of = "LP1", parameter = "e", range = [-0.2, 0.2] }
control = ")toml" + control + "\"\n")
                                     .of("s");
      EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
      const auto& rows = result.branches.at(0).samples;
      EXPECT_NEAR(rows.front().values.back(), -0.2, 1e-12);
      EXPECT_NEAR(rows.back().values.back(), 0.2, 1e-12);
      for (std::size_t row = 0; row < rows.size(); ++row) {
        // Slopes of the table at its points 0, 1 and 2 are 1, 0 and 0 (Fritsch and Butland): its cubics give those
        // between. The slope of the force is that of the table and e.
        const double x = value(result, row, "t.x"), e = rows[row].values.back(), d = x - 1;
        const double slope = d < 0 ? -4 * d - 3 * d * d : 3 * d * d - 3 * d;
        EXPECT_NEAR(slope, -e, 1e-9) << x;
      }
    }
}

/// Two steep bars with torque T(u) = u + 3 u^3 down to u = -0.11 and straight beyond: their apex sways at l T'/T =
/// 1 - l^2, l their length there. Where this is at u = -0.11 the cubic term of the branch jumps, and its sign changes.
TEST(BendingLaws, MakeABranchBendTheOtherWay) {
  std::string text = "[parameters]\nh = 7\n";
  for (const std::string foot : {"-1", "1"})
    text += "[[node]]\nname = \"f" + foot + "\"\nat = [" + foot + ", 0]\nfixed = true\n";
  text += "[[node]]\nname = \"apex\"\nat = [0, \"h\"]\n";
  for (const std::string foot : {"-1", "1"})
    text += "[[spring]]\nname = \"s" + foot + "\"\nfrom = \"f" + foot +
            "\"\nto = \"apex\"\nlaw = { law = \"polynomial\", coefficients = [0, 1, 0, 3], range = "
            "[-0.11, 0.11], falling = true, free = \"sqrt(1 + h^2)\" }\n";
  const StudyResult result =
      run(text +
          "[[study]]\nname = \"s\"\nkind = \"critical_curve\"\ncontrol = \"load\"\ndirection = [0, "
          "-1]\nuntil = { apex.y = [0, 30] }\ncritical_curve = { of = \"BP1\", parameter = \"h\", "
          "range "
          "= [3, 14] }\n")
          .of("s");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  const double steep = (1 + 9 * 0.11 * 0.11) / (0.11 + 3 * 0.11 * 0.11 * 0.11);
  const double length = steep / 2 + std::sqrt(steep * steep / 4 + 1) + 0.11;
  std::vector<double> found;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == analysis::EventKind::bends_other_way)
      found.push_back(result.branches[0].samples[event.row].values.back());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], std::sqrt(length * length - 1), 1e-9);
}

/// Two bars of stiffness 1 under a weight: from a height of 0.4402 down it falls through without any load, and from
/// there no load has anything to lose.
TEST(DesignOfACollapse, IsToldWhereTheStartOfTheCaseVanishesOnTheWay) {
  std::string text = "[parameters]\nh = 1\nw = 0.03\n[[node]]\nname = \"t\"\nat = [0, \"h\"]\n";
  for (const std::string side : {"-1", "1"}) {
    const std::string foot = "foot" + std::string(side == "1" ? "r" : "l");
    text += "[[node]]\nname = \"" + foot + "\"\nat = [" + side +
            ", 0]\nfixed = true\n[[bar]]\nfrom = \"" + foot +
            "\"\nto = \"t\"\nstiffness = 1\nfree = \"sqrt(1 + h^2)\"\n";
  }
  const StudyResult result =
      run(text +
          "[[load]]\non = \"t\"\nforce = [0, \"-w\"]\n[[study]]\nname = \"d\"\nkind = "
          "\"design\"\nbody "
          "= \"t\"\ncontrol = \"load\"\ndirection = [0, -1]\nuntil = { lambda = [-0.01, 6], t.y = "
          "[-3, 3], t.x = [-3, 3] }\ndesign = { parameters = { h = [0.2, 1.2] }, critical_load = { "
          "at_least = 1, of = \"loss_of_stability\" } }\n")
          .of("d");
  ASSERT_TRUE(result.design);
  const bool is_met = result.design->status == analysis::DesignStatus::met;
  EXPECT_TRUE(!is_met || !result.doubts.empty()) << result.design->message;
}

}  // namespace
}  // namespace springfold::io
