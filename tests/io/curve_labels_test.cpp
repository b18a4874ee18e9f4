// Names of curves, and colours of the runs of a sweep.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "io/canvas.hpp"
#include "io/figure.hpp"
#include "io/label_layout.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {
namespace {

/// The nearest way from a label's text to a curve.
double way_to(const PlacedLabel& label, const Figure& figure, const FigureCurve& curve) {
  double nearest = 1e9;
  const double half = 4.5 * static_cast<double>(label.text.text.size());
  for (const CurvePart& part : curve.parts)
    for (const PlotPoint& at : part.line) {
      const PlotPoint p = in_pixels(figure, {}, at);
      nearest =
          std::min(nearest, std::hypot(std::max(0.0, std::abs(p.first - label.at.first) - half),
                                       std::max(0.0, std::abs(p.second - label.at.second) - 8.5)));
    }
  return nearest;
}

/// Curves y = a + b x (1 - x), close together, and all of them on one way where a is the same.
FigureCurve arch(const std::string& name, double a, double b) {
  FigureCurve curve{.label = {name}, .parts = {CurvePart{}}};
  for (int i = 0; i <= 400; ++i) {
    const double x = i / 400.0;
    curve.parts[0].line.emplace_back(x, a + b * x * (1 - x));
  }
  return curve;
}

TEST(PlaceLabels, OfCurvesStandAtNoOtherCurveThanTheirOwn) {
  Figure figure{.low = {-0.1, -0.1}, .high = {1.1, 1.1}};
  for (int i = 0; i < 14; ++i)
    figure.curves.push_back(arch("curve " + std::to_string(i), 0.02 * i, 0.2 + 0.15 * i));
  const auto labels = place_labels(figure, {});
  EXPECT_GE(labels.size(), 12U);
  for (const PlacedLabel& label : labels) {
    const auto own = static_cast<std::size_t>(std::stoi(label.text.text.substr(6)));
    const double to_own = way_to(label, figure, figure.curves[own]);
    double to_others = 1e9, from_dot = 1e9;
    PlacedLabel dot;
    dot.at = label.leader_from;
    for (std::size_t i = 0; i < figure.curves.size(); ++i) {
      if (i == own) continue;
      to_others = std::min(to_others, way_to(label, figure, figure.curves[i]));
      from_dot = std::min(from_dot, way_to(dot, figure, figure.curves[i]));
    }
    if (label.has_leader) {
      EXPECT_LT(way_to(dot, figure, figure.curves[own]), from_dot) << label.text.text;
    } else {
      EXPECT_LT(to_own, to_others) << label.text.text;
    }
  }
}

double from_line(const PlotPoint& at, const PlacedLabel& label) {
  const double x = label.leader_to.first - label.leader_from.first;
  const double y = label.leader_to.second - label.leader_from.second;
  const double u = at.first - label.leader_from.first, v = at.second - label.leader_from.second;
  const double t = std::clamp((u * x + v * y) / (x * x + y * y), 0.0, 1.0);
  return std::hypot(u - t * x, v - t * y);
}

TEST(PlaceLabels, LeadNoLineThroughTheDotOfAnother) {
  Figure figure{.low = {-0.1, -0.1}, .high = {1.1, 1.1}};
  for (int i = 0; i < 12; ++i)
    figure.curves.push_back(arch("a long name " + std::to_string(i), 0.3 + 0.03 * i, 0.1));
  std::vector<PlacedLabel> led;
  for (const PlacedLabel& label : place_labels(figure, {}))
    if (label.has_leader) led.push_back(label);
  ASSERT_GE(led.size(), 3U);
  for (const PlacedLabel& one : led)
    for (const PlacedLabel& other : led) {
      if (one.text.text == other.text.text) continue;
      EXPECT_GT(from_line(one.leader_from, other), 3) << one.text.text << ", " << other.text.text;
    }
}

TEST(PlaceLabels, NameCurvesThatLieOnEachOtherTogether) {
  Figure figure{.low = {-0.1, -0.1}, .high = {1.1, 1.1}};
  figure.curves = {arch("soft", 0, 2), arch("hard", 0.5, 2), arch("also soft", 0, 2)};
  std::vector<std::string> texts;
  for (const PlacedLabel& label : place_labels(figure, {})) texts.push_back(label.text.text);
  EXPECT_THAT(texts, testing::UnorderedElementsAre("soft, also soft", "hard"));
}

/// A sweep's runs, each with one curve.
std::vector<RunCurves> sweep_of(const std::vector<PlannedRun>& planned, Figure& figure) {
  std::vector<RunCurves> runs;
  for (const PlannedRun& run : planned) {
    runs.push_back({&run, figure.curves.size(), 1});
    figure.curves.push_back({.label = {run.label}});
  }
  return runs;
}

std::vector<PlannedRun> grid_runs(std::initializer_list<std::pair<double, double>> values) {
  std::vector<PlannedRun> planned;
  for (const auto& [k, L] : values) {
    PlannedRun run{.study = "grid", .run = static_cast<int>(planned.size()) + 1};
    run.label = "run " + std::to_string(run.run);
    run.parameters = {{"k", k}, {"L", L}};
    run.varied = {"k", "L"};
    planned.push_back(run);
  }
  return planned;
}

TEST(SweepColours, OfSeveralParametersAreThoseOfOneThatTellsAllRunsApart) {
  const auto planned = grid_runs({{1, 2}, {1, 3}, {2, 4}, {2, 6}, {3, 8}, {3, 9}, {4, 12}});
  Figure figure;
  colour_by_value(sweep_of(planned, figure), {.parameters = {{"L", "m"}}}, figure);
  ASSERT_TRUE(figure.bar);
  EXPECT_EQ(figure.bar->title, "L [m]");
  EXPECT_EQ(figure.bar->low, 2);
  EXPECT_EQ(figure.bar->high, 12);
  EXPECT_EQ(figure.curves[3].colour, sweep_colour(0.4));
}

TEST(SweepColours, OfAGridAreThoseOfTheParameterWithMostValuesAndNumbersTellTheRest) {
  const auto planned =
      grid_runs({{1, 2}, {2, 2}, {3, 2}, {1, 4}, {2, 4}, {3, 4}, {1, 8}, {2, 8}, {3, 8}});
  Figure figure;
  colour_by_value(sweep_of(planned, figure), {}, figure);
  ASSERT_TRUE(figure.bar);
  EXPECT_EQ(figure.bar->title, "k; numbers: runs over k, L");  // of as many the first
  for (std::size_t run : {0U, 3U, 6U}) EXPECT_EQ(figure.curves[run].colour, sweep_colour(0));
  for (std::size_t run : {1U, 4U, 7U}) EXPECT_EQ(figure.curves[run].colour, sweep_colour(0.5));
  for (std::size_t run : {2U, 5U, 8U}) EXPECT_EQ(figure.curves[run].colour, sweep_colour(1));
  EXPECT_EQ(figure.curves[4].label.text, "5");
}

TEST(SweepColours, OfFewRunsHaveABarTooAndKeepTheirLabels) {
  const auto planned = grid_runs({{1, 2}, {1, 4}, {1, 6}, {1, 10}});
  Figure figure;
  colour_by_value(sweep_of(planned, figure), {}, figure);
  ASSERT_TRUE(figure.bar);
  EXPECT_EQ(figure.bar->title, "L");
  EXPECT_EQ(figure.curves[1].colour, sweep_colour(0.25));
  EXPECT_EQ(figure.curves[1].label.text, "run 2");
}

TEST(SweepColours, LeaveTheLabelsThatTheFigureGives) {
  const auto planned = grid_runs({{1, 2}, {2, 2}, {3, 2}, {4, 2}, {5, 2}, {6, 2}, {7, 2}, {8, 2}});
  Figure figure;
  auto runs = sweep_of(planned, figure);
  runs[2].is_named = true;
  colour_by_value(runs, {}, figure);
  EXPECT_EQ(figure.bar->title, "k");
  EXPECT_EQ(figure.curves[2].label.text, "run 3");
  EXPECT_EQ(figure.curves[3].label.text, "4");
}

}  // namespace
}  // namespace springfold::io
