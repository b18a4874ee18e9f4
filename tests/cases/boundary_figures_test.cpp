// Figures of critical loads and of boundaries, from case files with closed forms, and what is named in them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "io/figure.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// The planar Orthoglide with one-sided springs in its knees, K = L = 1, p = 0.454.
const std::string one_sided = R"([parameters]
Kv = 0.01
a0 = 0.65
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { law = "one_sided", stiffness = "Kv", from = "a0" } },
  { rigid = [-1, 0] },
]
[[chain]]
name = "leg_y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "one_sided", stiffness = "Kv", from = "a0" } },
  { rigid = [0, -1] },
]
[[study]]
name = "least stiffness"
kind = "threshold"
control = "load"
direction = [1, 1]
start = { pose = [0.454, 0.454], solve = "actuators" }
until = { deflection = [-0.05, 0.6] }
threshold = { of = "limit_point", parameter = "Kv", range = [0, 0.3] }
vary = { parameter = "a0", values = [0.1, 0.3, 0.5, 0.6, 0.62, 0.7] }
[[study]]
name = "wall"
kind = "critical_curve"
control = "load"
direction = [1, 1]
start = { pose = [0.454, 0.454], solve = "actuators" }
until = { deflection = [-0.05, 0.6] }
critical_curve = { of = "LP1", parameter = "a0", range = [0.5, 0.7] }
vary = { parameter = "Kv", values = [0.12, 0.16] }
[[plot]]
name = "boundary"
x = "parameter.a0"
y = "parameter.Kv"
curves = [{ study = "least stiffness" }, { study = "wall" }]
)";

/// The same with linear springs: the first critical load over their stiffness.
const std::string linear = R"([parameters]
Kv = 0.01
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } },
  { rigid = [-1, 0] },
]
[[chain]]
name = "leg_y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } },
  { rigid = [0, -1] },
]
[[study]]
name = "first"
kind = "critical_load"
control = "load"
direction = [1, 1]
start = { pose = [0.454, 0.454], solve = "actuators" }
until = { deflection = [-0.05, 0.6] }
critical_load = { of = "loss_of_stability", parameter = "Kv", range = [0, 0.05], values = 6 }
)";

Figure only_figure(const Ran& ran) {
  std::vector<std::string> problems;
  std::vector<Figure> figures = figures_of(ran.read, ran.results, problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_THAT(figures, SizeIs(1));
  return figures.at(0);
}

std::pair<double, double> across(const Polyline& outline) {
  const auto [low, high] = std::minmax_element(outline.begin(), outline.end());
  return {low->first, high->first};
}

/// A shallow truss on a post, pushed at an angle psi: mirrored about 90 degrees. Its first critical point is one curve
/// over the whole range, whose ends are no round numbers.
TEST(CriticalLoads, HaveNoPieceOfNoLengthAtTheEndOfTheRange) {
  const std::string truss = R"toml([parameters]
psi = "90*deg"
)toml" + supports_and_apex("apex", "0.2") +
                            R"toml([[bar]]
from = "l"
to = "apex"
stiffness = 1
[[bar]]
from = "r"
to = "apex"
stiffness = 1
[[spring]]
name = "post"
from_at = [0, -1]
to = "apex"
stiffness = 0.02
free = 1.2
[[study]]
name = "directions"
kind = "critical_load"
control = "load"
direction = ["cos(psi)", "-sin(psi)"]
until = { apex.y = [-0.3, 0.44], lambda = [0, 1] }
critical_load = { of = "loss_of_stability", parameter = "psi", range = ["30*deg", "150*deg"], values = 25 }
)toml";
  const Ran ran = run(truss);
  const analysis::StudyResult& result = ran.results.at(0);
  ASSERT_THAT(result.branches, SizeIs(1));
  const auto& samples = result.branches[0].samples;
  constexpr double degree = 0.017453292519943295;
  EXPECT_NEAR(value(result, 0, "psi"), 30 * degree, 1e-12);
  EXPECT_NEAR(value(result, samples.size() - 1, "psi"), 150 * degree, 1e-12);
}

TEST(BoundaryFigure, HasALineForEveryPieceNamedByWhatDecidesThere) {
  const Figure figure = only_figure(run(one_sided));
  ASSERT_THAT(figure.curves, SizeIs(3));
  EXPECT_EQ(figure.curves[0].label.text, "cusp, springs at the start 1.1");
  EXPECT_EQ(figure.curves[1].label.text, "cusp, springs at the start 0.0");
  EXPECT_EQ(figure.curves[2].label.text, "fold meets activation");
  // Closed form: maxima of Kv(s) = -F0'/G' along the diagonal, Newton with 34 digits.
  const Polyline& preloaded = figure.curves[0].parts.at(0).line;
  ASSERT_THAT(preloaded, SizeIs(2));
  EXPECT_NEAR(preloaded[0].second, 0.03392141201780, 1e-9);
  EXPECT_NEAR(preloaded[1].second, 0.04801222866083, 1e-9);
  const Polyline& slack = figure.curves[1].parts.at(0).line;
  EXPECT_NEAR(slack.front().second, 0.0761782013797, 1e-9);
  EXPECT_NEAR(slack.back().second, 0.0825880020616, 1e-9);
  for (const PlotPoint& at : figure.curves[2].parts.at(0).line)
    EXPECT_NEAR(at.first, 0.6128694882106, 1e-9);
}

TEST(BoundaryFigure, ShadesWhereNothingHappensAndFromTheWallOnWhereNoValueRemovesIt) {
  const Figure figure = only_figure(run(one_sided));
  ASSERT_THAT(figure.regions, SizeIs(2));
  EXPECT_EQ(figure.regions[0].name, "no limit point");
  EXPECT_THAT(figure.regions[0].parts, SizeIs(2)) << "one over each of the pieces";
  EXPECT_EQ(figure.regions[1].name, "no value of Kv removes it");
  ASSERT_THAT(figure.regions[1].parts, SizeIs(1));
  const auto [low, high] = across(figure.regions[1].parts[0]);
  EXPECT_NEAR(low, 0.6128694882106, 1e-9) << "not at the first run without an answer";
  EXPECT_EQ(high, 0.7);
  for (const FigureRegion& region : figure.regions)
    for (const Polyline& outline : region.parts)
      for (const PlotPoint& corner : outline) {
        EXPECT_GE(corner.second, figure.low.second);
        EXPECT_LE(corner.second, figure.high.second);
      }
}

TEST(BoundaryFigure, BreaksItsLinesAtRunsWithoutAnAnswer) {
  Ran ran = run(one_sided);
  analysis::StudyResult& doubtful = ran.results.at(1);
  doubtful.branches.clear();
  doubtful.threshold->found = false;
  doubtful.doubts.emplace_back("nobody knows");
  const Figure figure = only_figure(ran);
  EXPECT_THAT(figure.curves, SizeIs(2)) << "the preloaded piece is a single point now";
  ASSERT_THAT(figure.regions, SizeIs(2));
  EXPECT_THAT(figure.regions[1].parts, SizeIs(1)) << "not resolved is not 'no value'";
}

TEST(ShadedLoads, EndAtTheFirstCriticalLoadAndNowhereBeyondTheCusp) {
  const Figure figure = only_figure(run(linear));
  EXPECT_EQ(figure.x_title.text, "Kv");
  EXPECT_TRUE(figure.is_of_points);
  ASSERT_THAT(figure.regions, SizeIs(1));
  ASSERT_THAT(figure.regions[0].parts, SizeIs(2));
  // Truths: the force at Kv = 0, and the cusp.
  const auto [low, cusp] = across(figure.regions[0].parts[0]);
  EXPECT_EQ(low, 0);
  EXPECT_NEAR(cusp, 0.02958068452556, 1e-9);
  EXPECT_NEAR(figure.regions[0].parts[0].front().second, 0.020238288956394, 1e-9);
  EXPECT_EQ(figure.regions[0].parts[0].back().second, 0) << "the load at the start";
  const auto [behind, high] = across(figure.regions[0].parts[1]);
  EXPECT_NEAR(behind, 0.02958068452556, 1e-9);
  EXPECT_DOUBLE_EQ(high, 0.05);
  EXPECT_EQ(figure.regions[0].parts[1][1].second, figure.high.second) << "up to the edge";
}

TEST(ShadedLoads, SayNothingOfValuesAtWhichThePathIsNotResolved) {
  Ran ran = run(linear);
  ran.results.at(0).doubts.emplace_back("nobody knows");
  EXPECT_THAT(only_figure(ran).regions.at(0).parts, SizeIs(1)) << "only where the load is known";
}

std::string pushed_knees(const std::string& study) {
  return "include = \"" SPRINGFOLD_SOURCE_DIR
         "/cases/orthoglide-planar/mechanism.toml\"\n"
         "[parameters]\nL = 1\nK = 1\nKv = 0.01\np = 0.454\n[[study]]\nname = \"s\"\n"
         "direction = [1, 1]\nstart = { pose = [\"p\", \"p\"], solve = \"actuators\" }\n" +
         study;
}

TEST(NamedDegeneracies, ExtremaOfTheForceMergeInACuspAsLimitPointsDo) {
  const auto found =
      run(pushed_knees("kind = \"threshold\"\ncontrol = \"mixed\"\n"
                       "until = { deflection = [\"-0.05*L\", \"0.5*L\"] }\n"
                       "threshold = { of = \"limit_point\", parameter = \"Kv\", range = [0, 0.3], "
                       "index = \"dead_load\" }\n"))
          .of("s");
  ASSERT_TRUE(found.threshold);
  EXPECT_EQ(found.threshold->decides, "cusp");
  EXPECT_NEAR(found.threshold->value, 0.0295806845255585, 1e-12);
  const auto curve =
      run(pushed_knees(
              "kind = \"critical_curve\"\ncontrol = \"mixed\"\n"
              "until = { deflection = [\"-0.05*L\", \"0.5*L\"] }\n"
              "critical_curve = { of = \"LP1\", parameter = \"Kv\", range = [0, 0.06] }\n"))
          .of("s");
  bool any = false;
  for (const analysis::Event& event : curve.branches.at(0).events) {
    if (event.kind != analysis::EventKind::cusp) continue;
    any = true;
    EXPECT_EQ(event.detail, "cusp");
  }
  EXPECT_TRUE(any);
}

TEST(NamedDegeneracies, AThresholdThatAMovingLimitDecidesNamesTheLimit) {
  const auto result =
      run(pushed_knees("kind = \"threshold\"\ncontrol = \"load\"\n"
                       "until = { deflection = [\"-0.05*L\", \"0.3*L - 5*Kv\"] }\n"
                       "threshold = { of = \"limit_point\", parameter = \"Kv\", range = [0, 0.025] "
                       "}\n"))
          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_EQ(result.threshold->decides, "deflection reaches its upper limit");
  EXPECT_TRUE(result.threshold->verified);
  // Force along the diagonal, commands that balance (p, p): the limit point lies on the limit.
  const double Kv = result.threshold->value, p = 0.454;
  const double q = p + (0.3 - 5 * Kv) / std::sqrt(2.0), a = std::asin(q), at = std::asin(p);
  const double drive =
      q + std::cos(a) - p - std::cos(at) - Kv * at / (std::cos(at) * (1 - std::tan(at)));
  const double c = std::cos(a), t = std::tan(a);
  EXPECT_NEAR((1 - t) * (1 - t) - drive / (c * c * c) + Kv / (c * c) * (1 + a * t), 0, 1e-9);
}

class CornerOfAToggle : public testing::Test {
 protected:
  const Case read = load_case(SPRINGFOLD_SOURCE_DIR "/cases/critical-curves/case-stop.toml");
  const analysis::StudyResult result = [this] {
    auto all = analysis::run_study(read.runs.at(0).mechanism, read.runs[0].plan);
    all.study = read.runs[0].study;
    return all;
  }();
};

/// In front of the stop the toggle is unstable beyond its fold, on the stop between the places where the corner
/// has no reversal.
TEST_F(CornerOfAToggle, HasAnotherUnstableModeWhereBothSidesAreUnstable) {
  const analysis::Branch& branch = result.branches.at(0);
  std::size_t rows = 0;
  for (std::size_t i = 0; i < branch.samples.size(); ++i) {
    const double gap = value(result, i, "gap");
    if (std::abs(gap - 0.51089188251234) < 1e-6 || std::abs(gap - 0.90332167986075) < 1e-6)
      continue;
    const bool both = gap > 0.51089188251234 && gap < 0.90332167986075;
    EXPECT_EQ(value(result, i, "index"), both ? 1 : 0) << gap;
    EXPECT_EQ(value(result, i, "index_force"), both ? 1 : 0) << gap;
    ++rows;
  }
  EXPECT_GT(rows, 20U);
}

TEST_F(CornerOfAToggle, IsDrawnInLinesThatTheKeyExplains) {
  std::vector<std::string> problems;
  const auto figures = figures_of(read, {result}, problems);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_TRUE(figures[0].is_of_points);
  EXPECT_TRUE(figures[0].tells_stability);
  std::vector<Stability> parts;
  for (const CurvePart& part : figures[0].curves.at(0).parts) parts.push_back(part.stability);
  EXPECT_THAT(parts, ElementsAre(Stability::stable, Stability::unstable, Stability::stable));
}

}  // namespace
}  // namespace springfold::io
