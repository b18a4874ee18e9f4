// A point that is led straight through the end of a spring: its force has no direction there, and the path ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "analysis/column.hpp"
#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// Feet of the springs beside the way and of the one on it, and what they are made of.
constexpr struct {
  double beside = 0.5, lower = 0.2, stiffness = 2;
  double depth = 0.8, of_low = 1.5;
} springs_led_to{};

/// A point between two springs of free length on both sides, and one from straight below, led down.
StudyResult led_down(double to, double step) {
  const std::string free = number(std::hypot(springs_led_to.beside, springs_led_to.lower));
  std::string text = "[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [0, 0]\n";
  for (const double x : {springs_led_to.beside, -springs_led_to.beside})
    text += spring_from(x > 0 ? "right" : "left", {x, -springs_led_to.lower}, "tip",
                        springs_led_to.stiffness, free);
  text += spring_from("low", {0, -springs_led_to.depth}, "tip", springs_led_to.of_low,
                      number(springs_led_to.depth));
  return run(text + "[[study]]\nname = \"down\"\ncontrol = \"pose\"\ndirection = [0, -1]\n" +
             "until = { deflection = [0, " + number(to) + "], force = [-30, 30] }\n" +
             "trace = { maximum_step = " + number(step) + " }\n")
      .of("down");
}

/// Sideways, at a depth, nothing holds where 2 k (1 - l0/l + l0 a^2/l^3) + k3 (1 - l30/l3) is zero.
double depth_of_sway() {
  const auto stiffness = [](double d) {
    const double l0 = std::hypot(springs_led_to.beside, springs_led_to.lower),
                 l = std::hypot(springs_led_to.beside, d - springs_led_to.lower);
    return 2 * springs_led_to.stiffness *
               (1 - l0 / l + l0 * springs_led_to.beside * springs_led_to.beside / (l * l * l)) +
           springs_led_to.of_low * (1 - springs_led_to.depth / (springs_led_to.depth - d));
  };
  double low = 0.3, high = 0.75;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (stiffness(middle) > 0 ? low : high) = middle;
  }
  return low;
}

TEST(LengthZero, EndsThePathAndLeavesTheChangeOfStabilityBefore) {
  for (const double to : {0.79, 1.2}) {
    const StudyResult result = led_down(to, 0.05);
    const auto changes = lambdas(result, EventKind::stability_change);
    ASSERT_EQ(changes.size(), 1u) << "down to " << to;
    EXPECT_NEAR(changes[0], depth_of_sway(), 1e-9);
  }
}

TEST(LengthZero, IsNotPassedInAStepThatTheRangeCuts) {
  for (const double step : {0.05, 0.3, 0.5}) {
    SCOPED_TRACE(step);
    const StudyResult result = led_down(0.85, step);
    const auto& branch = result.branches.at(0);
    EXPECT_LE(value(result, branch.samples.size() - 1, "deflection"), springs_led_to.depth);
    EXPECT_FALSE(branch.forward.complete);
    EXPECT_THAT(branch.forward.reason, testing::HasSubstr("the length 0"));
  }
}

/// Newton's method ends on the anchor of a spring which is not at its free length, where rounding alone balances the
/// point: the start is looked for elsewhere.
TEST(LengthZero, OfASpringWithForceMakesNoEquilibrium) {
  const StudyResult result = run("[[node]]\nname = \"p\"\nat = [1.037, 0.402]\n" +
                                 spring_from("s0", {-0.369, 0.218}, "p", 3.71, "1.083") +
                                 spring_from("s1", {0.462, -0.334}, "p", 3.11, "1.827") +
                                 spring_from("s2", {-0.699, -0.973}, "p", 4.55, "1.693") +
                                 spring_from("s3", {0.967, 0.441}, "p", 0.941, "1.135") +
                                 R"toml([[study]]
name = "e"
kind = "equilibrium"
body = "p"
load = [-0.016, -0.294]
)toml")
                                 .of("e");
  ASSERT_TRUE(result.start.found);
  const double x = analysis::value(result, 0, "p.x"), y = analysis::value(result, 0, "p.y");
  struct Spring {
    double x, y, stiffness, free;
  };
  double force_x = -0.016, force_y = -0.294;
  for (const Spring& s :
       {Spring{-0.369, 0.218, 3.71, 1.083}, Spring{0.462, -0.334, 3.11, 1.827},
        Spring{-0.699, -0.973, 4.55, 1.693}, Spring{0.967, 0.441, 0.941, 1.135}}) {
    const double length = std::hypot(x - s.x, y - s.y);
    EXPECT_GT(length, 1e-3);
    force_x -= s.stiffness * (1 - s.free / length) * (x - s.x);
    force_y -= s.stiffness * (1 - s.free / length) * (y - s.y);
  }
  EXPECT_NEAR(force_x, 0, 1e-10);
  EXPECT_NEAR(force_y, 0, 1e-10);
}

}  // namespace
}  // namespace springfold::io
