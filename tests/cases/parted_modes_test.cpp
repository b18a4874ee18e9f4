// Branch points of several modes at once, and parameters that part them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A bar on a universal joint, K = diag(c1 - lambda, c2 - lambda): branch points at c1 and at c2, at 1 both at once.
std::string bar_on_universal_joint(const std::string& study) {
  return "[parameters]\nc1 = 1\nc2 = 1\nc = 1\n[[body]]\nname = \"tip\"\ntask_space = "
         "\"xyz\"\npose = [0, 0, "
         "1]\n[[chain]]\nname = \"bar\"\nelements = [ { joint = \"revolute\", axis = \"x\", name = "
         "\"a\", role = "
         "\"preloaded\", spring = { law = \"linear\", stiffness = \"c*c1\" } }, { joint = "
         "\"revolute\", axis = "
         "\"y\", name = \"b\", role = \"preloaded\", spring = { law = \"linear\", stiffness = "
         "\"c*c2\" } }, { "
         "rigid = [0, 0, 1] } ]\n[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = [0, 0, "
         "-1]\nuntil = { "
         "lambda = [-0.1, 3] }\n" +
         study;
}

TEST(PartedModes, HaveNoCurveOfTheirMeanLoad) {
  const analysis::StudyResult result =
      run(bar_on_universal_joint("kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", "
                                 "parameter = \"c1\", range = [0.5, 2] }\n"))
          .of("s");
  EXPECT_FALSE(complete(result));
  for (const auto& branch : result.branches) {
    EXPECT_THAT(branch.forward.reason, testing::HasSubstr("parts the modes"));
    for (const auto& sample : branch.samples)
      EXPECT_NEAR(sample.values[column(result, "lambda")], 1, 1e-9);
  }
}

TEST(PartedModes, StayTogetherInAParameterThatMovesBoth) {
  const analysis::StudyResult result =
      run(bar_on_universal_joint("kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", "
                                 "parameter = \"c\", range = [0.5, 2] }\n"))
          .of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  for (const auto& sample : samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], sample.values[column(result, "c")], 1e-10);
}

TEST(PartedModes, AreOneValueOfTheFirstCriticalLoadThatIsSampledAmongOthers) {
  const auto ran = run(bar_on_universal_joint(
      "kind = \"critical_load\"\ncritical_load = { of = \"loss_of_stability\", "
      "parameter = \"c2\", range = [0.5, 1.5], values = 5 }\n"));
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  ASSERT_EQ(result.branches.size(), 2u);
  for (const auto& branch : result.branches)
    for (const auto& sample : branch.samples)
      EXPECT_NEAR(sample.values[column(result, "lambda")],
                  std::min(1.0, sample.values[column(result, "c2")]), 1e-10);
  EXPECT_NEAR(result.branches[0].samples.back().values[column(result, "c2")], 1, 1e-9);
  EXPECT_NEAR(result.branches[1].samples.front().values[column(result, "c2")], 1, 1e-9);
}

/// Both loads have to grow: the least of them alone has no derivative where they are equal, at the case and at the
/// answer.
TEST(PartedModes, OfADesignAreMadeSafeTogether) {
  const auto ran = run(bar_on_universal_joint(
      "kind = \"design\"\ndesign.parameters = { c1 = [0.5, 2], c2 = [0.5, 2] }\n"
      "design.critical_load = { at_least = 1.2, of = \"loss_of_stability\" }\n"));
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_TRUE(result.design);
  EXPECT_TRUE(result.design->verified);
  ASSERT_EQ(result.design->parameters.size(), 2u);
  for (const auto& parameter : result.design->parameters) EXPECT_NEAR(parameter.after, 1.2, 1e-8);
  EXPECT_LT(result.design->designs, 100);
}

/// The same with springs c u - 0.3 u^3, pushed under an angle psi: two limit points meet at the branch point of psi =
/// 0.
TEST(PartedModes, OfThePerfectStructureLieOnTheCurveOfItsImperfectOnes) {
  const auto ran = run(R"toml(
[parameters]
psi = 0
[[body]]
name = "tip"
task_space = "xyz"
pose = [0, 0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "x", name = "a", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 1, 0, -0.3], falling = true } },
  { joint = "revolute", axis = "y", name = "b", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 1, 0, -0.3], falling = true } },
  { rigid = [0, 0, 1] },
]
[[study]]
name = "s"
kind = "critical_load"
control = "load"
direction = ["sin(psi)", 0, "-cos(psi)"]
until = { lambda = [-0.1, 3], bar.a = [-1.2, 1.2], bar.b = [-1.2, 1.2] }
critical_load = { of = "loss_of_stability", parameter = "psi", range = [-0.3, 0.3], values = 3 }
)toml");
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1u);
  // In the plane of psi: b - 0.3 b^3 = lambda sin(b + psi), whose load is stationary in b.
  const auto limit_load = [](double psi) {
    const auto load = [psi](double b) { return (b - 0.3 * b * b * b) / std::sin(b + psi); };
    double low = 1e-3, high = 1;
    for (int i = 0; i < 100; ++i) {
      const double third = (high - low) / 3;
      if (load(low + third) < load(high - third))
        low += third;
      else
        high -= third;
    }
    return load(low);
  };
  bool at_zero = false;
  for (const auto& event : result.branches[0].events) {
    const auto& values = result.branches[0].samples[event.row].values;
    const double psi = values[column(result, "psi")], lambda = values[column(result, "lambda")];
    if (event.kind == analysis::EventKind::end_of_range) {
      EXPECT_NEAR(lambda, limit_load(std::abs(psi)), 1e-10);
    }
    if (event.kind != analysis::EventKind::extremum) continue;
    EXPECT_NEAR(psi, 0, 1e-9);
    EXPECT_NEAR(lambda, 1, 1e-9);
    at_zero = true;
  }
  EXPECT_TRUE(at_zero);
}

/// K = diag(1 - lambda, 1 + e - lambda), and the branch points of the straight bar.
std::vector<analysis::Event> branch_points_of(const std::string& e, analysis::StudyResult& result) {
  std::string text = bar_on_universal_joint(
      "kind = \"sensitivity\"\nsensitivity = { parameters = [\"e\", \"c\"] }\n");
  text.replace(text.find("c = 1\n"), 6, "c = 1\ne = " + e + "\n");
  text.replace(text.find("c*c2"), 4, "c*c2*(1 + e)");
  result = run(text).of("s");
  std::vector<analysis::Event> points;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == analysis::EventKind::branch_point) points.push_back(event);
  return points;
}

/// Equal loads are one point, and no mean of 0 and 1 is the rate of either.
TEST(PartedModes, HaveNoRateByAParameterThatPartsThem) {
  analysis::StudyResult result;
  const auto points = branch_points_of("0", result);
  ASSERT_EQ(points.size(), 1u);
  const auto& values = result.branches[0].samples[points[0].row].values;
  EXPECT_TRUE(std::isnan(values[column(result, "d(lambda)/d(e)")]));
  EXPECT_NEAR(values[column(result, "d(lambda)/d(c)")], 1, 1e-8);
  EXPECT_THAT(points[0].detail, testing::HasSubstr("no rate by e"));
}

TEST(PartedModes,
     AreTwoPointsWithRatesOfTheirOwnWhereAParameterPartsThemByMoreThanPlacesArePromised) {
  for (const std::string e : {"4e-10", "1e-8", "1e-6", "1e-4"}) {
    analysis::StudyResult result;
    const auto points = branch_points_of(e, result);
    ASSERT_EQ(points.size(), 2u) << e;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& values = result.branches[0].samples[points[i].row].values;
      const double load = i == 0 ? 1 : 1 + std::stod(e);
      EXPECT_NEAR(values[column(result, "lambda")], load, 1e-12) << e;
      EXPECT_NEAR(values[column(result, "d(lambda)/d(e)")], static_cast<double>(i), 1e-7) << e;
      EXPECT_NEAR(values[column(result, "d(lambda)/d(c)")], load, 1e-7) << e;
    }
  }
}

}  // namespace
}  // namespace springfold::io
