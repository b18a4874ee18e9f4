// Two bars to an apex, and guys level with it that just rest as drawn: bars of unequal stiffness push it against one of
// them at first, by so much that rounding hides it, and the sinking apex takes it away again.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

constexpr double apex_height = 0.8;

std::string truss_bar(const std::string& name, double x, double y, double stiffness,
                      bool is_strut) {
  const double length = std::hypot(x, apex_height - y);
  return "[[node]]\nname = \"foot-" + name + "\"\nat = [" + number(x) + ", " + number(y) +
         "]\nfixed = true\n[[bar]]\nname = \"" + name + "\"\nfrom = \"foot-" + name +
         "\"\nto = \"apex\"\nfree = " + number(length) + "\nstiffness = " + number(stiffness) +
         (is_strut ? "\ncompression_only = true\n" : "\n");
}

/// Without the guys, which are slack all along: load where the length of both bars is (1 + apex_height^2)^(1/6).
double limit_load(double mean_stiffness) {
  const double free = std::hypot(1, apex_height), length = std::cbrt(free);
  return 2 * mean_stiffness * std::sqrt(length * length - 1) * (free / length - 1);
}

TEST(GuysOfATruss, ThatItLeavesAtOnceAreNoObstacleHoweverLittleTheyActBefore) {
  for (const double unequal : {1e-5, 1e-6, 1e-7})
    for (const double stiffness : {1e3, 1.0, 1e-3}) {
      SCOPED_TRACE(number(unequal) + ", " + number(stiffness));
      const auto result =
          run("[[node]]\nname = \"apex\"\nat = [0, " + number(apex_height) + "]\n" +
              truss_bar("left", -1, 0, 1, false) + truss_bar("right", 1, 0, 1 + unequal, false) +
              truss_bar("right-guy", 2, apex_height, stiffness, true) +
              truss_bar("left-guy", -2, apex_height, stiffness, true) +
              "[[study]]\nname = \"press\"\nbody = \"apex\"\ncontrol = \"load\"\n"
              "direction = [0, -1]\nuntil = { apex.x = [-1.5, 1.5], apex.y = [-1.6, 1.4] }\n")
              .of("press");
      EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
      const double load = limit_load(1 + unequal / 2);
      EXPECT_EQ(lambdas(result, analysis::EventKind::switching).size(), 3u);
      const auto found = lambdas(result, analysis::EventKind::limit_point);
      ASSERT_EQ(found.size(), 2u);
      EXPECT_NEAR(found[0], load, 1e-11);
      EXPECT_NEAR(found[1], -load, 1e-11);
    }
}

}  // namespace
}  // namespace springfold::io
