// Pressures among the loads of studies.
#include <gmock/gmock.h>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::DoubleNear;
using testing::ElementsAre;

/// A roof of 30 degrees between fixed nodes at -w and w; its largest pressure for bars and a half span of 1 is
/// 0.0638559806.
std::string roof_between(const std::string& nodes, const std::string& loads) {
  return "[parameters]\nw = 1\n" + nodes + R"toml(
[[node]]
name = "top"
at = [0, "tan(30*deg)"]
[[bar]]
from = "left"
to = "top"
stiffness = 1
[[bar]]
from = "right"
to = "top"
stiffness = 1
[[study]]
name = "press"
control = "load"
body = "top"
until = { top.y = [0.01, 0.7] }
)toml" + loads;
}

constexpr const char* left = "[[node]]\nname = \"left\"\nat = [\"-w\", 0]\nfixed = true\n";
constexpr const char* right = "[[node]]\nname = \"right\"\nat = [\"w\", 0]\nfixed = true\n";

TEST(PressureOfAStudy, ActsBetweenFixedNodesInWhateverOrderTheyAre) {
  const std::string load =
      R"(loads = [{ shape = "area", of = ["left", "right", "top"], pressure = -1, scale = "lambda" }])";
  for (const std::string& nodes : {std::string{left} + right, std::string{right} + left})
    EXPECT_THAT(lambdas(run(roof_between(nodes, load)).of("press"), EventKind::limit_point),
                ElementsAre(DoubleNear(0.0638559806, 1e-10)));
}

TEST(PressureOfAStudy, FollowsFixedNodesThatAParameterMoves) {
  const std::string varied = "vary = { parameter = \"w\", values = [1, 2] }\n";
  const std::string own = varied + R"(
loads = [{ shape = "area", of = ["left", { on = "right" }, "top"], pressure = -1, scale = "lambda" }]
)";
  const std::string of_all = varied + R"(
[[load]]
shape = "area"
of = ["left", "right", "top"]
pressure = -1
scale = "lambda"
)";
  const Ran a = run(roof_between(std::string{right} + left, own));
  const Ran b = run(roof_between(std::string{right} + left, of_all));
  for (const std::size_t i : {0U, 1U})
    EXPECT_EQ(lambdas(a.results.at(i), EventKind::limit_point),
              lambdas(b.results.at(i), EventKind::limit_point));
  EXPECT_NE(lambdas(a.results[0], EventKind::limit_point),
            lambdas(a.results[1], EventKind::limit_point));
}

}  // namespace
}  // namespace springfold::io
