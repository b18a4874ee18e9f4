// Special points are followed through values of a parameter at which the study's start meets its own limit point and vanishes.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// x^3 - 3 x = b + lambda: a limit point at x = -1 with lambda = 2 - b; at b = 2 it passes the start, lambda = 0.
std::string cubic(const std::string& study) {
  return "[parameters]\nb = -1\n[[node]]\nname = \"m\"\nat = [-2, 0]\nfixed = [\"y\"]\n[[chain]]\n"
         "name = \"c\"\nto = \"m\"\nelements = [ { joint = \"prismatic\", axis = \"x\", name = "
         "\"q\", role = \"preloaded\", initial = -2, spring = { law = \"polynomial\", coefficients "
         "= [0, -3, 0, 1], falling = true } } ]\n[[study]]\nname = \"s\"\nbody = \"m\"\ncontrol = "
         "\"load\"\ndirection = [1, 0]\nload = [\"b\", 0]\nstart = { pose = [-2, 0] }\n"
         "until = { m.x = [-3, 3], lambda = [-6, 6] }\n" +
         study;
}

TEST(CriticalCurve, GoesOnWhereTheStartOfThePathVanishes) {
  const auto ran = run(cubic(
      "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter = \"b\", range = [-3, "
      "3] }\n"));
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  EXPECT_LT(samples.size(), 100u);
  double low = 0, high = 0;
  for (const auto& sample : samples) {
    const double b = sample.values[column(result, "b")];
    EXPECT_NEAR(sample.values[column(result, "lambda")], 2 - b, 1e-11);
    EXPECT_NEAR(sample.values[column(result, "m.x")], -1, 1e-9);
    low = std::min(low, b);
    high = std::max(high, b);
  }
  EXPECT_NEAR(low, -3, 1e-12);
  EXPECT_NEAR(high, 3, 1e-12);
}

/// A drive with a spring of 1 between command and carriage holds the cubic at x = -2: x^3 - 2 x - rho = b + lambda, rho = -3.
TEST(CriticalCurve, GoesOnWhereTheStartVanishesUnderCommandsThatAreKept) {
  const std::string y = "{ joint = \"prismatic\", axis = \"y\", name = ",
                    drive = "role = \"actuated\", value = 0, stiffness = 1 }";
  const auto ran = run(
      "[parameters]\nb = -1\n[[node]]\nname = \"m\"\nat = [-2, 0]\n[[chain]]\nname = \"c\"\nto = "
      "\"m\"\nelements = [ { joint = \"prismatic\", axis = \"x\", name = \"q\", role = "
      "\"preloaded\", initial = -2, spring = { law = \"polynomial\", coefficients = [0, -3, 0, 1], "
      "falling = true } }, " +
      y +
      "\"u\" } ]\n[[chain]]\nname = \"d\"\nto = \"m\"\nelements = [ { joint = \"prismatic\", "
      "axis = \"x\", name = \"a\", " +
      drive + ", " + y +
      "\"v\" } ]\n[[chain]]\nname = \"e\"\nto = "
      "\"m\"\nelements = [ " +
      y + "\"w\", " + drive +
      ", { joint = \"prismatic\", axis = \"x\", "
      "name = \"z\" } ]\n[[study]]\nname = \"s\"\nbody = \"m\"\ncontrol = \"load\"\ndirection = "
      "[1, 0]\nload = [\"b\", 0]\nstart = { pose = [-2, 0], solve = \"actuators\" }\nuntil = { m.x "
      "= "
      "[-3, 3], lambda = [-9, 9] }\nkind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", "
      "parameter = \"b\", range = [-3, 6], tied = false }\n");
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  EXPECT_LT(samples.size(), 100u);
  const double x = -std::sqrt(2.0 / 3);
  double high = 0;
  for (const auto& sample : samples) {
    const double b = sample.values[column(result, "b")];
    EXPECT_NEAR(sample.values[column(result, "lambda")], x * x * x - 2 * x + 3 - b, 1e-10);
    EXPECT_NEAR(sample.values[column(result, "m.x")], x, 1e-9);
    high = std::max(high, b);
  }
  EXPECT_NEAR(high, 6, 1e-12);
}

}  // namespace
}  // namespace springfold::io
