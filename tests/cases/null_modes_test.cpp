// Modes in which mechanisms buckle at branch points: null vectors, against closed forms.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>

#include "cases/case_runs.hpp"
#include "small_structures.hpp"
#include "springfold/io/film.hpp"

namespace springfold::io {
namespace {

using analysis::Event;
using analysis::EventKind;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Links of equal length in a row on torsion springs, the foot's twice as stiff, pressed along themselves.
std::string column_of(int links) {
  const std::string n = std::to_string(links);
  return R"toml([[body]]
name = "top"
task_space = "xy"
pose = [)toml" +
         n + R"toml(, 0]
[[chain]]
name = "column"
elements = [{ repeat = { i = [1, )toml" +
         n +
         R"toml(] }, elements = [{ joint = "revolute", axis = "z", name = "h{i}", role = "preloaded", spring = { law = "linear", stiffness = "i == 1 ? 2 : 1" } }, { rigid = [1, 0] }] }]
[[study]]
name = "press"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.1, 4.2], column.h1 = [-1, 1] }
)toml";
}

std::vector<const Event*> branch_points(const analysis::StudyResult& result) {
  std::vector<const Event*> points;
  for (const Event& event : result.branches.at(0).events)
    if (event.kind == EventKind::branch_point) points.push_back(&event);
  return points;
}

/// With p = P l / c the mode (a, b) of two links on springs 2 c and c satisfies (2 - 2 p) a = p b.
TEST(NullModes, OfAColumnOfTwoLinksAreThoseOfItsStabilityMatrix) {
  const auto result = run(column_of(2)).of("press");
  const auto points = branch_points(result);
  ASSERT_THAT(points, SizeIs(2));
  for (const Event* point : points) {
    ASSERT_THAT(point->modes, SizeIs(1));
    const std::vector<double>& mode = point->modes.front();
    const double p = value(result, point->row, "lambda");
    const double a = mode[column(result, "column.h1")], b = mode[column(result, "column.h2")];
    EXPECT_NEAR(b / a, 2 / p - 2, 1e-8);
    EXPECT_EQ(mode[column(result, "lambda")], 0);
    EXPECT_NEAR(mode[column(result, "top.x")], 0, 1e-12);          // sideways only
    EXPECT_NEAR(mode[column(result, "top.y")], 2 * a + b, 1e-12);  // the links are 1 long
  }
}

/// The angles of the links in the first mode are sin((2 i - 1) pi / (4 N)): Hencky's column.
TEST(NullModes, OfALongColumnAreHenckysSines) {
  constexpr int links = 60;
  const auto result = run(column_of(links)).of("press");
  const auto points = branch_points(result);
  ASSERT_FALSE(points.empty());
  ASSERT_THAT(points.front()->modes, SizeIs(1));
  const std::vector<double>& mode = points.front()->modes.front();
  const auto angle = [](int i) { return std::sin((2 * i - 1) * std::numbers::pi / (4 * links)); };
  const double scale = mode[column(result, "column.h1")] / angle(1);
  for (int i = 2; i <= links; ++i)
    EXPECT_NEAR(mode[column(result, "column.h" + std::to_string(i))],
                scale * (angle(i) - angle(i - 1)), 1e-7 * std::abs(scale));
}

TEST(NullModes, OfADoubleBranchPointAreTwoAcrossEachOther) {
  const auto result = run(R"toml([[body]]
name = "top"
task_space = "xyz"
pose = [0, 0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "x", name = "a", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { joint = "revolute", axis = "y", name = "b", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [0, 0, 1] },
]
[[study]]
name = "press"
control = "load"
direction = [0, 0, -1]
until = { lambda = [-0.2, 1.8] }
)toml")
                          .of("press");
  const auto points = branch_points(result);
  ASSERT_THAT(points, SizeIs(1));
  ASSERT_THAT(points.front()->modes, SizeIs(2));
  double dot = 0;
  for (const char* name : {"bar.a", "bar.b"})
    dot += points.front()->modes[0][column(result, name)] *
           points.front()->modes[1][column(result, name)];
  EXPECT_NEAR(dot, 0, 1e-10);
}

TEST(NullModes, LimitPointsHaveNone) {
  const auto result = run(R"toml([[body]]
name = "apex"
task_space = "xy"
pose = [0, 0.5]
[[chain]]
name = "guide"
elements = [{ joint = "prismatic", axis = "y", name = "y", initial = 0.5 }]
[[spring]]
name = "left"
from_at = [-1, 0]
to = "apex"
stiffness = 1
free = 1.118033988749895
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { guide.y = [-0.6, 0.6] }
)toml")
                          .of("press");
  std::size_t limits = 0;
  for (const Event& event : result.branches.at(0).events) {
    EXPECT_THAT(event.modes, IsEmpty());
    limits += event.kind == EventKind::limit_point ? 1 : 0;
  }
  EXPECT_EQ(limits, 2U);
}

TEST(NullModes, CanBeSeenAsAFilm) {
  const Ran ran = run(column_of(2));
  const auto& planned = ran.read.runs.front();
  const auto& result = ran.results.front();
  const auto film = film_of(planned, result, ran.read.units, {.mode = "BP1"});
  ASSERT_EQ(film.problem, "");
  EXPECT_THAT(film.film.frames, SizeIs(24));
  const auto other = film_of(planned, result, ran.read.units, {.mode = "BP1.2"});
  EXPECT_THAT(other.problem, HasSubstr("there are: BP1, BP2"));
}

/// A two-arm plotter with stiff drives: commands along a circle, and a map.
const std::string plotter = R"toml([[body]]
name = "pen"
task_space = "xy"
pose = [0, 1.2]
[[chain]]
name = "left"
from_at = [-0.3, 0]
elements = [
  { joint = "revolute", axis = "z", name = "drive", role = "actuated", value = "120*deg", stiffness = 100 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "elbow", initial = "-80*deg" },
  { rigid = [1, 0] },
]
[[chain]]
name = "right"
from_at = [0.3, 0]
elements = [
  { joint = "revolute", axis = "z", name = "drive", role = "actuated", value = "60*deg", stiffness = 100 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "elbow", initial = "80*deg" },
  { rigid = [1, 0] },
]
[[spring]]
name = "line"
from_at = [0, 2]
to = "pen"
stiffness = 1
)toml";

TEST(CommandFilm, HasADiagramOverThePathOfTheCommands) {
  const Ran ran = run(plotter + R"toml([[study]]
name = "circle"
kind = "control"
circle = { centre = [0, 1.2], radius = 0.3, points = 7 }
)toml");
  const auto outcome = film_of(ran.read.runs.front(), ran.results.front(), ran.read.units, {});
  ASSERT_EQ(outcome.problem, "");
  EXPECT_EQ(outcome.film.diagram.x_name, "path");
  EXPECT_EQ(outcome.film.diagram.y_name, "energy [N·m]");
  for (const auto& point : outcome.film.diagram.points)
    EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
}

TEST(MapFilm, IsRefusedBecauseNodesLieOnNoWay) {
  const Ran ran = run(plotter + R"toml([[study]]
name = "map"
kind = "map"
axes = [{ pose = "x", from = -0.2, to = 0.2, points = 3 }, { pose = "y", from = 1, to = 1.3, points = 3 }]
)toml");
  EXPECT_THAT(film_of(ran.read.runs.front(), ran.results.front(), ran.read.units, {}).problem,
              HasSubstr("lie on no way"));
}

/// A truss above a stop: the stop switches in two rows at one place.
TEST(SwitchingFilm, NamesAPointOnce) {
  const Ran ran = run(supports_and_apex("apex", "0.2") + R"toml([[bar]]
from = "l"
to = "apex"
stiffness = 1
[[bar]]
from = "r"
to = "apex"
stiffness = 1
[[spring]]
name = "stop"
from_at = [0, -1]
to = "apex"
law = { law = "one_sided", stiffness = 3, from = 0.95, side = "below" }
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { apex.y = [-0.4, 0.3] }
)toml");
  const auto outcome = film_of(ran.read.runs.front(), ran.results.front(), ran.read.units, {});
  ASSERT_EQ(outcome.problem, "");
  std::map<std::string, int> times;
  for (const auto& point : outcome.film.diagram.points)
    if (!point.label.empty()) ++times[point.label];
  EXPECT_EQ(times.count("SA1") + times.count("CL1"), 1U);
  for (const auto& [label, count] : times) EXPECT_EQ(count, 1) << label;
}

}  // namespace
}  // namespace springfold::io
