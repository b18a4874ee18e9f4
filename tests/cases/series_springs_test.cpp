// Springs in series between points, in bars and of shapes, run.
#include <gmock/gmock.h>

#include <cmath>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

constexpr const char* falling =
    "{ law = \"polynomial\", coefficients = [0, 2.5, -3, 1], falling = true }";
constexpr const char* soft = "{ law = \"linear\", stiffness = 0.3, free = 1 }";

/// A point that is driven away from the base along x. @param spring  between both, its keys but the ends
std::string driven(const std::string& spring, const std::string& control = "load") {
  return R"toml([[node]]
name = "tool"
at = [1, 0]
fixed = ["y"]
)toml" + spring +
         "[[study]]\nname = \"pull\"\nbody = \"tool\"\ncontrol = \"" + control +
         "\"\ndirection = [1, 0]\nuntil = { tool.x = [0.8, 5.5] }\n";
}

std::string as_spring(const std::string& first, const std::string& second) {
  return "[[spring]]\nname = \"rope\"\nto = \"tool\"\nseries = [" + first + ", " + second + "]\n";
}

std::vector<double> values_of(const StudyResult& result, EventKind kind,
                              const std::string& column) {
  std::vector<double> list;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == kind) list.push_back(value(result, event.row, column));
  return list;
}

MATCHER_P(Near, by, "") { return std::abs(std::get<0>(arg) - std::get<1>(arg)) <= by; }

/// f(u) = u^3 - 3 u^2 + 2.5 u behind k = 0.3, which is 1 long: U = 1 + u + f/k turns back where f' = -k.
const std::vector<double> fold_ways{3.7814217288, 3.5519116046};
const std::vector<double> fold_forces{0.6118861856, 0.3881138144};

/// Of the four limit points the outer two are extrema of the force; between them the driven way turns.
std::vector<double> turns_of_the_way(const StudyResult& result, const std::string& column) {
  const std::vector<double> all = values_of(result, EventKind::limit_point, column);
  if (all.size() != 4) return all;
  return {all[1], all[2]};
}

TEST(SpringsInSeries, FoldBetweenPointsInEitherOrder) {
  for (const auto& [first, second] : {std::pair{falling, soft}, {soft, falling}}) {
    const StudyResult result = run(driven(as_spring(first, second), "mixed")).results[0];
    EXPECT_TRUE(analysis::complete(result));
    EXPECT_THAT(turns_of_the_way(result, "rope.length"), Pointwise(Near(1e-9), fold_ways));
    EXPECT_THAT(turns_of_the_way(result, "rope.force"), Pointwise(Near(1e-9), fold_forces));
  }
}

TEST(SpringsInSeries, HaveCoordinatesThatAddUpAndOneForce) {
  const StudyResult result = run(driven(as_spring(falling, soft), "mixed")).results[0];
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double u = value(result, row, "rope.1"), v = value(result, row, "rope.2");
    EXPECT_NEAR(u + v, value(result, row, "tool.x"), 1e-12);
    EXPECT_NEAR(u * (2.5 + u * (-3 + u)), 0.3 * (v - 1), 1e-11);
    EXPECT_NEAR(value(result, row, "rope.force"), 0.3 * (v - 1), 1e-12);
    EXPECT_NEAR(value(result, row, "energy"),
                u * u * (1.25 + u * (-1 + u / 4)) + 0.15 * (v - 1) * (v - 1), 1e-11);
  }
}

/// The same elements as the joint that they stand for: the same special points, the same counts of unstable modes.
TEST(SpringsInSeries, AreThoseOfAJoint) {
  const std::string joint = std::string{R"toml(
[[body]]
name = "tool"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "rope"
elements = [{ joint = "prismatic", axis = "x", name = "rod", role = "preloaded", initial = [0, 1], spring = { series = [)toml"} +
                            falling + ", " + soft + R"toml(] } }]
[[study]]
name = "pull"
body = "tool"
control = "mixed"
direction = [1, 0]
until = { tool.x = [0.8, 5.5] }
)toml";
  const StudyResult a = run(joint).results[0];
  const StudyResult b = run(driven(as_spring(falling, soft), "mixed")).results[0];
  EXPECT_THAT(values_of(a, EventKind::limit_point, "tool.x"),
              Pointwise(Near(1e-11), values_of(b, EventKind::limit_point, "tool.x")));
  const auto index_at = [](const StudyResult& result, double x) {
    for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row)
      if (value(result, row, "tool.x") > x) return value(result, row, "index_pose");
    return -1.0;
  };
  for (const double x : {1.5, 3.0, 4.5}) EXPECT_EQ(index_at(a, x), index_at(b, x)) << x;
}

/// Two linear bars one behind the other are one of k1 k2/(k1 + k2).
TEST(SpringsInSeries, OfBarsCountTheElongation) {
  const auto roof = [](const std::string& bar) {
    std::string text = "[[node]]\nname = \"apex\"\nat = [0, 0.6]\n";
    for (const std::string at : {"-1", "1"})
      text += "[[node]]\nname = \"foot" + at + "\"\nat = [" + at + ", 0]\nfixed = true\n" +
              "[[bar]]\nname = \"b" + at + "\"\nfrom = \"foot" + at + "\"\nto = \"apex\"\n" + bar;
    return run(text + R"toml([[study]]
name = "press"
body = "apex"
control = "load"
direction = [0, -1]
until = { apex.y = [-0.7, 0.7] }
)toml")
        .results[0];
  };
  const StudyResult one = roof("stiffness = 1.2\n");
  const StudyResult two =
      roof("series = [{ law = \"linear\", stiffness = 3 }, { law = \"linear\", stiffness = 2 }]\n");
  for (const EventKind kind : {EventKind::limit_point, EventKind::branch_point})
    EXPECT_THAT(lambdas(two, kind), Pointwise(Near(1e-12), lambdas(one, kind)));
  EXPECT_THAT(lambdas(one, EventKind::limit_point), testing::SizeIs(2));
  const std::size_t row = two.branches[0].events[0].row;
  EXPECT_NEAR(3 * value(two, row, "b1.1"), value(two, row, "b1.force"), 1e-12);
  EXPECT_NEAR(value(two, row, "b1.1") + value(two, row, "b1.2"),
              value(two, row, "b1.length") - std::hypot(1, 0.6), 1e-12);
}

/// A cable behind a spring is taut where the spring is relaxed and the length is the sum of both free ones, whichever
/// comes first.
TEST(SpringsInSeries, SwitchInEveryPlace) {
  const std::string cable = "{ law = \"one_sided\", stiffness = 2, from = 0.5 }";
  const std::string spring = "{ law = \"linear\", stiffness = 3, free = 0.7 }";
  for (const auto& [first, second] : {std::pair{cable, spring}, {spring, cable}}) {
    const StudyResult result = run(driven(as_spring(first, second), "mixed")).results[0];
    ASSERT_EQ(values_of(result, EventKind::switching, "tool.x").size(), 1u);
    EXPECT_NEAR(values_of(result, EventKind::switching, "tool.x")[0], 1.2, 1e-10);
    for (const auto& event : result.branches[0].events)
      if (event.kind == EventKind::switching) {
        EXPECT_THAT(event.detail, HasSubstr("spring rope"));
      }
    const std::size_t last = result.branches[0].samples.size() - 1;
    EXPECT_NEAR(value(result, last, "rope.force"), 1.2 * (5.5 - 1.2), 1e-11);
  }
}

/// Of an angle and of an area: the moment and the pressure of two laws in series.
TEST(SpringsInSeries, ActInOtherShapesToo) {
  const std::string text = R"toml(
[[node]]
name = "a"
at = [0, 0]
fixed = true
[[node]]
name = "b"
at = [1, 0]
fixed = true
[[node]]
name = "c"
at = [0, 1]
fixed = ["x"]
[[spring]]
name = "corner"
shape = "angle"
of = ["b", "c", "a"]
near = 0.8
series = [{ law = "formula", formula = "2*u + u^3" }, { law = "linear", stiffness = 5, free = 0.1 }]
[[spring]]
name = "skin"
shape = "area"
of = ["a", "b", "c"]
series = [{ law = "linear", stiffness = 4 }, { law = "linear", stiffness = 6, free = 0.25 }]
[[study]]
name = "lift"
body = "c"
control = "mixed"
direction = [0, 1]
until = { c.y = [0.5, 2] }
)toml";
  const StudyResult result = run(text).results[0];
  ASSERT_TRUE(analysis::complete(result));
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double u = value(result, row, "corner.1"), moment = value(result, row, "corner.moment");
    EXPECT_NEAR(moment, 2 * u + u * u * u, 1e-11);
    EXPECT_NEAR(moment, 5 * (value(result, row, "corner.angle") - u - 0.1), 1e-11);
    const double area = value(result, row, "c.y") / 2;
    EXPECT_NEAR(value(result, row, "skin.pressure"), -2.4 * (area - 0.25), 1e-11);
    EXPECT_NEAR(value(result, row, "skin.1"), 0.6 * (area - 0.25), 1e-12);
  }
}

/// A later study starts where the first one ended, on the same piece of the folded curve.
TEST(SpringsInSeries, KeepTheirCoordinatesInLoadSteps) {
  const Ran ran = run(driven(as_spring(falling, soft), "mixed") + R"toml([[study]]
name = "on"
body = "tool"
control = "load"
direction = [1, 0]
start = { from = "pull", at = "LP2" }
until = { tool.x = [3, 5] }
)toml");
  EXPECT_LT(ran.results[1].start.moved, 1e-9);
  const auto& first = ran.results[1].branches[0];
  EXPECT_NEAR(value(ran.results[1], first.start_row, "rope.1"),
              values_of(ran.results[0], EventKind::limit_point, "rope.1")[1], 1e-9);
}

/// Units by a power of two change no digit.
TEST(SpringsInSeries, DoNotDependOnUnits) {
  const auto in_units = [](const std::string& L) {
    return run("[parameters]\nL = " + L + R"toml(
[[node]]
name = "tool"
at = ["L", "0.5*L"]
[[spring]]
name = "rope"
to = "tool"
series = [
  { law = "polynomial", coefficients = [0, "2.5/L", "-3/L^2", "1/L^3"], falling = true },
  { law = "linear", stiffness = "0.3/L", free = "0.5*L" },
]
initial = "0.2*L"
[[spring]]
name = "side"
from_at = [0, "2*L"]
to = "tool"
stiffness = "0.1/L"
free = "L"
[[study]]
name = "pull"
body = "tool"
control = "load"
direction = [1, 0.3]
until = { tool.x = ["0.3*L", "3*L"] }
)toml")
        .results[0];
  };
  const StudyResult one = in_units("1"), other = in_units("1024");
  ASSERT_EQ(one.branches[0].samples.size(), other.branches[0].samples.size());
  for (std::size_t row = 0; row < one.branches[0].samples.size(); ++row)
    for (const char* column : {"rope.1", "rope.2", "tool.x", "rope.length"})
      EXPECT_EQ(1024 * value(one, row, column), value(other, row, column)) << column;
}

/// Within both dead bands the slack is shared in any way: no curve leads on, and the coordinate that is free is named.
TEST(SpringsInSeries, NameTheCoordinateThatTwoDeadBandsLeaveFree) {
  const StudyResult result = run(R"toml([[node]]
name = "tool"
at = [2.5, 0]
fixed = ["y"]
[[spring]]
name = "rope"
to = "tool"
series = [
  { law = "gap", stiffness = 1, low = -0.1, high = 0.1 },
  { law = "gap", stiffness = 2, low = -0.2, high = 0.2 },
  { law = "linear", stiffness = 0.3, free = 2 },
]
[[study]]
name = "pull"
body = "tool"
control = "mixed"
direction = [1, 0]
until = { tool.x = [1, 4.5] }
)toml")
                                 .of("pull");
  EXPECT_FALSE(analysis::complete(result));
  int told = 0;
  for (const analysis::Branch& branch : result.branches) {
    if (branch.forward.complete) continue;
    ++told;
    EXPECT_THAT(branch.forward.reason, HasSubstr("nothing resists a motion of rope."));
  }
  EXPECT_GT(told, 0);
}

}  // namespace
}  // namespace springfold::io
