// Structures of so many members that their matrices are treated as sparse ones: what is known of them.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// Pinned column of n bars by nodes and angles: EI = L = 1, hinges EI/l, bars k = 1e4/l.
std::string column(int n) {
  return "[parameters]\nn = " + std::to_string(n) +
         "\n"
         R"toml(l = "1/n"
[[node]]
name = "n0"
at = [0, 0]
fixed = true
[[node]]
repeat = { i = [1, )toml" +
         std::to_string(n - 1) + R"toml(] }
name = "n{i}"
at = ["i*l", 0]
[[node]]
name = "end"
at = [1, 0]
fixed = ["y"]
[[bar]]
repeat = { i = [1, )toml" +
         std::to_string(n - 1) + R"toml(] }
from = "n{i-1}"
to = "n{i}"
stiffness = "1e4/l"
[[bar]]
from = "n)toml" +
         std::to_string(n - 1) + R"toml("
to = "end"
stiffness = "1e4/l"
[[spring]]
repeat = { i = [1, )toml" +
         std::to_string(n - 2) + R"toml(] }
name = "a{i}"
shape = "angle"
of = ["n{i-1}", "n{i}", "n{i+1}"]
stiffness = "1/l"
free = "pi"
[[spring]]
name = "last"
shape = "angle"
of = ["n)toml" +
         std::to_string(n - 2) + "\", \"n" + std::to_string(n - 1) + R"toml(", "end"]
stiffness = "1/l"
free = "pi"
[[study]]
name = "press"
body = "end"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 50] }
)toml";
}

/// P (l - P/k) = 2 c (1 - cos(j pi/n)): the load of mode j.
double buckling_load(int n, int mode) {
  const double l = 1.0 / n, k = 1e4 / l, c = 1 / l;
  const double q = 2 * c * (1 - std::cos(mode * std::numbers::pi / n));
  return 2 * q / (l + std::sqrt(l * l - 4 * q / k));
}

/// A shallow net of 7 x 7 nodes in a fixed rim, pressed in its middle, and a plate that hangs on it by eight springs.
std::string net(const std::string& control) {
  constexpr int rim = 8;
  const auto name = [](int i, int j) { return "n" + std::to_string(i) + "_" + std::to_string(j); };
  const auto is_rim = [](int i, int j) { return i % rim == 0 || j % rim == 0; };
  std::string text;
  for (int i = 0; i <= rim; ++i)
    for (int j = 0; j <= rim; ++j) {
      const double u = i / 4.0 - 1, v = j / 4.0 - 1, z = 1.5 * (1 - u * u) * (1 - v * v);
      text += "[[node]]\nname = \"" + name(i, j) + "\"\nat = [" + std::to_string(i) + ", " +
              std::to_string(j) + ", " + std::to_string(z) + "]\n" +
              (is_rim(i, j) ? "fixed = true\n" : "");
    }
  for (int i = 0; i <= rim; ++i)
    for (int j = 0; j <= rim; ++j)
      for (const auto& [k, l] : {std::pair{i + 1, j}, {i, j + 1}, {i + 1, j - 1}})
        if (k <= rim && l >= 0 && l <= rim && !(is_rim(i, j) && is_rim(k, l)))
          text += "[[bar]]\nfrom = \"" + name(i, j) + "\"\nto = \"" + name(k, l) + "\"\nEA = 10\n";
  text +=
      "[[body]]\nname = \"plate\"\ntask_space = \"spatial\"\npose = [4, 4, 0, 0.1, -0.2, 0.3]\n";
  for (const int i : {3, 5})
    for (const int j : {3, 5})
      for (const int z : {-1, 1})
        text += "[[spring]]\nname = \"hanger" + std::to_string(100 * i + 10 * j + z + 1) +
                "\"\nfrom = \"" + name(i, j) + "\"\nto = \"plate\"\nto_at = [" +
                std::to_string(0.5 * (i - 4) + 0.1 * z) + ", " + std::to_string(0.5 * (j - 4)) +
                ", " + std::to_string(0.3 * z) + "]\nstiffness = 1\nfree = 0.5\n";
  return text + "[[study]]\nname = \"press\"\nbody = \"n4_4\"\ndirection = [0, 0, -1]\n" + control;
}

TEST(ManyMembers, ANetCarriesTheSameLoadWhetherItIsPushedOrDriven) {
  const auto by_load =
      run(net("control = \"load\"\nuntil = { deflection = [0, 0.05] }\n")).of("press");
  const auto driven = run(net("control = \"mixed\"\nuntil = { lambda = [0, 0.05] }\n")).of("press");
  for (const auto& result : {by_load, driven}) {
    ASSERT_TRUE(result.start.found) << result.start.message;
    ASSERT_TRUE(complete(result));
  }
  const std::size_t at = by_load.branches[0].samples.size() - 1;
  const std::size_t there = driven.branches[0].samples.size() - 1;
  EXPECT_GT(value(by_load, at, "force"), 0);
  for (const char* name : {"force", "deflection", "n2_3.z", "plate.z", "plate.rx", "plate.rz"})
    EXPECT_NEAR(value(by_load, at, name), value(driven, there, name), 1e-9) << name;
}

TEST(ManyMembers, AColumnByAnglesBucklesAtItsClosedFormLoads) {
  // The first one in dense arithmetic, the second one in sparse arithmetic.
  for (const int n : {12, 80}) {
    const Ran ran = run(column(n));
    const auto& result = ran.results[0];
    ASSERT_TRUE(result.start.found) << result.start.message;
    EXPECT_THAT(lambdas(result, EventKind::branch_point),
                testing::ElementsAre(testing::DoubleNear(buckling_load(n, 1), 1e-8),
                                     testing::DoubleNear(buckling_load(n, 2), 1e-8)))
        << n;
    // One mode after the other becomes unstable; K_eig are the lowest eigenvalues.
    const auto& rows = result.branches[0].samples;
    EXPECT_EQ(value(result, 0, "index"), 0);
    EXPECT_EQ(value(result, rows.size() - 1, "index"), 2);
    EXPECT_EQ(value(result, rows.size() - 1, "index_force"), 2);
    EXPECT_LT(value(result, rows.size() - 1, "K_eig2"), 0);
    EXPECT_GT(value(result, rows.size() - 1, "K_eig3"), 0);
  }
}

// The straight column is n springs k one behind the other, whatever the load.
TEST(ManyMembers, TheStraightColumnGivesWayAlongItself) {
  for (const int n : {12, 80}) {
    const Ran ran = run(column(n));
    EXPECT_NEAR(value(ran.results[0], 0, "stiffness"), 1e4, 1e-6) << n;
  }
}

}  // namespace
}  // namespace springfold::io
