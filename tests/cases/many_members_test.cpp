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
