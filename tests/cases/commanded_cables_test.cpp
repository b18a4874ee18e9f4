// Cables and struts beside a commanded mechanism: springs between points that switch on the way.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::HasSubstr;

/// Two drives of stiffness 1 along x and y with arms of length 1, as in the planar Orthoglide, without springs.
const std::string legs = R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_x"
from_at = [-1, 0]
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 0, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "arm" },
  { rigid = [1, 0] },
]
[[chain]]
name = "leg_y"
from_at = [0, -1]
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 0, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "arm" },
  { rigid = [0, 1] },
]
)toml";

/// From (1, 1) to the point, taut where it is longer than 1.
const std::string as_line_spring = R"toml(
[[spring]]
name = "cable"
from_at = [1, 1]
to = "p"
law = { law = "one_sided", stiffness = 0.3, from = 1 }
)toml";

const std::string as_chain = R"toml(
[[chain]]
name = "cable"
from_at = [1, 1]
elements = [
  { joint = "revolute", axis = "z", name = "turn", initial = "-135*deg" },
  { joint = "prismatic", axis = "x", name = "cable", role = "preloaded", initial = "sqrt(2)", spring = { law = "one_sided", stiffness = 0.3, from = 1 } },
]
)toml";

const std::string two_studies = R"toml(
[[study]]
name = "way"
kind = "control"
direction = [1, 1]
targets = [[0.2, 0.2], [0.4, 0.4], [0.4, 0.2]]
[[study]]
name = "map"
kind = "map"
axes = [{ pose = "x", from = -0.4, to = 0.6, points = 6 }, { pose = "y", from = -0.4, to = 0.5, points = 4 }]
directions = [[1, 1]]
critical = { direction = [1, 1], up_to = 0.5 }
)toml";

/// Commands that hold the point against the pull of the cable.
std::pair<double, double> commands_at(double x, double y) {
  const double dx = 1 - x, dy = 1 - y, l = std::hypot(dx, dy);
  const double pull = l > 1 ? 0.3 * (l - 1) : 0;
  const double ca = std::sqrt(1 - y * y), sa = y, cb = std::sqrt(1 - x * x), sb = x;
  // N1 (ca, sa) + N2 (sb, cb) + pull (dx, dy)/l = 0; a drive gives way by N cos.
  const double det = ca * cb - sa * sb, px = -pull * dx / l, py = -pull * dy / l;
  const double n1 = (px * cb - py * sb) / det, n2 = (py * ca - px * sa) / det;
  return {x - ca + 1 + n1 * ca, y - cb + 1 + n2 * cb};
}

TEST(CommandedCables, AreHeldAsTheirForceAsks) {
  const StudyResult way = run(legs + as_line_spring + two_studies).of("way");
  int targets = 0;
  for (std::size_t row = 0; row < way.branches[0].samples.size(); ++row) {
    const auto [first, second] = commands_at(value(way, row, "p.x"), value(way, row, "p.y"));
    EXPECT_NEAR(value(way, row, "leg_x.drive.rho"), first, 1e-11);
    EXPECT_NEAR(value(way, row, "leg_y.drive.rho"), second, 1e-11);
    targets += way.branches[0].samples[row].event.empty() ? 1 : 0;
  }
  EXPECT_EQ(targets, 3);
}

TEST(CommandedCables, GoSlackWhereTheirLengthIsTheFreeOne) {
  const StudyResult way = run(legs + as_line_spring + two_studies).of("way");
  const auto& events = way.branches[0].events;
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, EventKind::switching);
  EXPECT_THAT(events[0].detail, HasSubstr("spring cable passes 1"));
  // (1 - 0.2 - 0.2 t) sqrt(2) = 1 on the first leg; at (0.4, 0.2) the length is hypot(0.6, 0.8) = 1.
  EXPECT_NEAR(value(way, events[0].row, "path"), 1 + (0.8 - 1 / std::sqrt(2.0)) / 0.2, 1e-10);
  EXPECT_EQ(value(way, events[1].row, "path"), 3);
  EXPECT_THAT(events[1].detail, HasSubstr("spring cable"));
  EXPECT_THAT(events[1].detail, HasSubstr("exactly on its threshold at this target"));
}

TEST(CommandedCables, GiveTheSameNumbersAsTheChainThatTheyStandFor) {
  const auto spring = run(legs + as_line_spring + two_studies),
             chain = run(legs + as_chain + two_studies);
  for (const char* study : {"way", "map"}) {
    const StudyResult a = spring.of(study), b = chain.of(study);
    ASSERT_EQ(a.branches[0].samples.size(), b.branches[0].samples.size());
    for (std::size_t row = 0; row < a.branches[0].samples.size(); ++row)
      for (const auto& quantity : a.quantities) {
        const auto same = std::find_if(b.quantities.begin(), b.quantities.end(),
                                       [&](const auto& q) { return q.name == quantity.name; });
        if (same == b.quantities.end() || quantity.name == "iterations") continue;
        const double x = value(a, row, quantity.name), y = value(b, row, quantity.name);
        if (std::isnan(x) && std::isnan(y)) continue;
        EXPECT_TRUE(x == y || std::abs(x - y) <= 1e-9 * std::max(1.0, std::abs(x)))
            << study << ", row " << row << ", " << quantity.name << ": " << x << " and " << y;
      }
  }
}

TEST(CommandedCables, HaveColumnsOfTheirLengthAndForce) {
  const StudyResult way = run(legs + as_line_spring + two_studies).of("way");
  for (std::size_t row = 0; row < way.branches[0].samples.size(); ++row) {
    const double l = std::hypot(1 - value(way, row, "p.x"), 1 - value(way, row, "p.y"));
    EXPECT_NEAR(value(way, row, "cable.length"), l, 1e-14);
    EXPECT_NEAR(value(way, row, "cable.force"), l > 1 ? 0.3 * (l - 1) : 0, 1e-14);
  }
}

/// Towards the other end of a spring and past it on one line: control is lost where the length would be 0.
TEST(CommandedSprings, LoseControlWhereTheyWouldBeLedThroughTheLengthZero) {
  const std::string post = R"toml(
[[spring]]
name = "post"
from_at = [0.3, 0]
to = "p"
stiffness = 0.2
free = 0.1
[[study]]
name = "way"
kind = "control"
targets = [[0.1, 0], [0.6, 0]]
)toml";
  const StudyResult result = run(legs + post).of("way");
  EXPECT_FALSE(analysis::complete(result));
  EXPECT_THAT(result.branches[0].forward.reason, HasSubstr("control is lost at path = 1.39"));
  EXPECT_EQ(result.branches[0].samples.back().status, "not reached along the path");
}

}  // namespace
}  // namespace springfold::io
