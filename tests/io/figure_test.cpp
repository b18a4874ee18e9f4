#include "io/figure.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "io/label_layout.hpp"
#include "io/sample_results.hpp"
#include "io/stability_parts.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A branch whose rows have these indices (under control, under dead load).
struct IndexedBranch {
  explicit IndexedBranch(const std::vector<std::pair<double, double>>& indices) {
    result.quantities = {{"index"}, {"index_force"}};
    for (const auto& [index, index_force] : indices)
      branch.samples.push_back({.values = {index, index_force}});
  }
  void add(EventKind kind, std::size_t row) { branch.events.push_back({.kind = kind, .row = row}); }
  std::vector<Stability> steps() const { return stability_of_steps(result, branch); }

  analysis::StudyResult result{};
  analysis::Branch branch{};
};

constexpr auto stable_part = Stability::stable;
constexpr auto driven = Stability::driven;
constexpr auto unstable_part = Stability::unstable;

TEST(StabilityOfSteps, ChangesExactlyAtALimitPointWhicheverIndexItHas) {
  for (const double at_fold : {0.0, 1.0}) {
    IndexedBranch b{{{0, 0}, {0, 0}, {at_fold, at_fold}, {1, 1}}};
    b.add(EventKind::limit_point, 2);
    EXPECT_THAT(b.steps(), ElementsAre(stable_part, stable_part, unstable_part));
  }
}

TEST(StabilityOfSteps, UsesBothSidesOfASwitchingSpring) {
  IndexedBranch b{{{0, 0}, {0, 0}, {1, 1}, {1, 1}}};
  b.add(EventKind::switching, 1);
  const auto steps = b.steps();
  EXPECT_EQ(steps.front(), stable_part);
  EXPECT_EQ(steps.back(), unstable_part);
}

TEST(StabilityOfSteps, TellsDrivenFromStable) {
  IndexedBranch b{{{0, 0}, {0, 1}, {0, 1}, {0, 0}}};
  b.add(EventKind::limit_point, 1);
  EXPECT_THAT(b.steps(), ElementsAre(stable_part, driven, driven));
}

TEST(StabilityOfSteps, CallsWhatIsNotCountedNeitherStableNorUnstable) {
  EXPECT_THAT((IndexedBranch{{{0, 0}, {nan, nan}, {nan, nan}, {0, 0}}}.steps()),
              ElementsAre(stable_part, Stability::unknown, stable_part));
}

TEST(PartsOf, ShareTheirCommonPointAndStopAtGaps) {
  const std::vector<PlotPoint> points = {{0, 0}, {1, 1}, {2, 2}, {nan, 3}, {4, 4}, {5, 5}};
  const auto parts =
      parts_of(points, {stable_part, unstable_part, unstable_part, unstable_part, unstable_part});
  ASSERT_THAT(parts, SizeIs(3));
  EXPECT_THAT(parts[0].line, ElementsAre(PlotPoint{0, 0}, PlotPoint{1, 1}));
  EXPECT_THAT(parts[1].line, ElementsAre(PlotPoint{1, 1}, PlotPoint{2, 2}));
  EXPECT_THAT(parts[2].line, ElementsAre(PlotPoint{4, 4}, PlotPoint{5, 5}));
}

TEST(PartsOf, SkipTheStepBetweenBothSidesOfASwitchingSpring) {
  const auto parts =
      parts_of({{0, 0}, {1, 1}, {1, 1}, {2, 2}}, {stable_part, unstable_part, stable_part});
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_THAT(parts[0].line, SizeIs(3));
}

TEST(FiguresOf, ShowOneFigurePerStudyWhenTheCaseAsksForNone) {
  std::vector<std::string> problems;
  const auto figures = figures_of(sample::two_runs(), sample::two_results(), problems);
  ASSERT_THAT(figures, SizeIs(1));
  EXPECT_THAT(problems, IsEmpty());
  const Figure& figure = figures.front();
  EXPECT_EQ(figure.name, "push_from_Q2");
  EXPECT_EQ(figure.x_title.text, "deflection [m]");
  EXPECT_EQ(figure.y_title.text, "force [N]");
  ASSERT_THAT(figure.curves, SizeIs(2));
  EXPECT_EQ(figure.curves[1].label.text, "Kv = 0.01");
  ASSERT_THAT(figure.curves[0].parts, SizeIs(3))
      << "stable, unstable_part between the folds, stable_part";
  EXPECT_EQ(figure.curves[0].parts[1].stability, unstable_part);
  EXPECT_THAT(figure.marks, SizeIs(5)) << "two folds each and the start of both, no ends";
}

TEST(FiguresOf, SayThatValuesOfTheSizeOfRoundingAreZero) {
  auto results = sample::two_results();
  results.resize(1);
  double sign = 1;
  for (analysis::Sample& row : results[0].branches[0].samples) {
    row.values[5] = 1;                       // point.x [m]: the size of lengths
    row.values[6] = (sign = -sign) * 1e-17;  // point.y [m]
  }
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .x = "deflection", .y = "point.y"}};
  the_case.plots[0].curves = {{.study = "push from Q2", .runs = {1}}};
  std::vector<std::string> problems;
  const auto figures = figures_of(the_case, results, problems);
  ASSERT_THAT(figures, SizeIs(1));
  for (const CurvePart& part : figures[0].curves[0].parts)
    for (const PlotPoint& at : part.line) EXPECT_EQ(at.second, 0);
  EXPECT_EQ(figures[0].low.second, -1);
  EXPECT_EQ(figures[0].high.second, 1);
}

TEST(FiguresOf, ApplyFactorsLabelsAndTheChoiceOfRuns) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a b", .title = "T", .x_label = "x", .x_factor = 2, .y_factor = -1}};
  the_case.plots[0].curves = {{.study = "push from Q2", .runs = {2}, .labels = {"(2)"}}};
  std::vector<std::string> problems;
  const auto figures = figures_of(the_case, sample::two_results(), problems);
  ASSERT_THAT(figures, SizeIs(1));
  EXPECT_EQ(figures[0].name, "a_b");
  EXPECT_EQ(figures[0].x_title.text, "x");
  EXPECT_EQ(figures[0].y_title.text, "-1 · force [N]");
  ASSERT_THAT(figures[0].curves, SizeIs(1));
  EXPECT_EQ(figures[0].curves[0].label.text, "(2)");
  ASSERT_EQ(figures[0].marks[0].label, "LP1");
  EXPECT_NEAR(figures[0].marks[0].at.first, 2 * 0.20587635, 1e-7);
  EXPECT_NEAR(figures[0].marks[0].at.second, -0.027008033908, 1e-11);
}

TEST(FiguresOf, ThatArePolarHaveAnglesAndDistancesAsTheyAre) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .x = "point.x", .y = "deflection", .x_factor = 3, .polar = true}};
  the_case.plots[0].curves = {{.study = "push from Q2", .runs = {2}}};
  const auto results = sample::two_results();
  std::vector<std::string> problems;
  const auto figures = figures_of(the_case, results, problems);
  ASSERT_THAT(figures, SizeIs(1));
  const Figure& figure = figures[0];
  const auto& samples = results[1].branches[0].samples;  // deflection and point.x: columns 2 and 5
  const PlotPoint first = figure.curves.at(0).parts.at(0).line.at(0);
  EXPECT_NEAR(first.first, samples[0].values[2] * std::cos(3 * samples[0].values[5]), 1e-12);
  EXPECT_NEAR(first.second, samples[0].values[2] * std::sin(3 * samples[0].values[5]), 1e-12);
  EXPECT_LT(figure.low.first * figure.high.first, 0) << "the origin is seen";
  EXPECT_LT(figure.low.second * figure.high.second, 0);
  const Canvas canvas;
  EXPECT_NEAR((figure.high.first - figure.low.first) / (canvas.right - canvas.left),
              (figure.high.second - figure.low.second) / (canvas.top - canvas.bottom), 1e-12)
      << "a unit is as long along both axes";
}

TEST(FiguresOf, KeepTheLabelsOfTheirRunsWhenOneIsMissing) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a"}};
  the_case.plots[0].curves = {{.study = "push from Q2", .runs = {1, 2}, .labels = {"(1)", "(2)"}}};
  auto results = sample::two_results();
  results.erase(results.begin());
  std::vector<std::string> problems;
  EXPECT_EQ(figures_of(the_case, results, problems).at(0).curves.at(0).label.text, "(2)");
}

TEST(FiguresOf, SayWhichQuantityDoesNotExist) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .x = "nothing", .curves = {{.study = "push from Q2"}}}};
  std::vector<std::string> problems;
  EXPECT_THAT(figures_of(the_case, sample::two_results(), problems), IsEmpty());
  ASSERT_FALSE(problems.empty());
  EXPECT_THAT(problems[0], HasSubstr("has no quantity 'nothing'"));
}

TEST(FiguresOf, LeaveOutFiguresOfStudiesThatWereNotRun) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .curves = {{.study = "another"}}}};
  std::vector<std::string> problems;
  EXPECT_THAT(figures_of(the_case, sample::two_results(), problems), IsEmpty());
  EXPECT_THAT(problems, IsEmpty());
}

TEST(FiguresOf, GiveASinglePointRoomAroundIt) {
  auto results = sample::two_results();
  results.resize(1);
  auto& branch = results[0].branches[0];
  branch.samples = {branch.samples[branch.start_row]};
  branch.start_row = 0;
  branch.events.clear();
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .curves = {{.study = "push from Q2"}}}};
  std::vector<std::string> problems;
  const auto figures = figures_of(the_case, results, problems);
  ASSERT_THAT(figures, SizeIs(1));
  EXPECT_LT(figures[0].low.first, figures[0].high.first);
  EXPECT_LT(figures[0].low.second, figures[0].high.second);
}

/// Rough size of a label, as the layout counts.
bool overlap(const PlacedLabel& a, const PlacedLabel& b) {
  const auto half = [](const PlacedLabel& label) {
    return 4.5 * static_cast<double>(label.text.text.size());
  };
  return std::abs(a.at.first - b.at.first) < half(a) + half(b) &&
         std::abs(a.at.second - b.at.second) < 17;
}

TEST(PlaceLabels, KeepTextsApartAndInsideTheFrame) {
  std::vector<std::string> problems;
  auto results = sample::two_results();
  results.push_back(sample::result("push from Q2", 3, "Kv = 0.05", {.k = 0.05}, 0.37, 0.9));
  const auto figure = figures_of(sample::two_runs(), results, problems).at(0);
  const Canvas canvas;
  const auto labels = place_labels(figure, canvas);
  EXPECT_THAT(labels, SizeIs(7)) << "four folds and three curves";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_GT(labels[i].at.first, canvas.left);
    EXPECT_LT(labels[i].at.first, canvas.right);
    EXPECT_GT(labels[i].at.second, canvas.bottom);
    EXPECT_LT(labels[i].at.second, canvas.top);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(labels[i], labels[j]))
          << labels[i].text.text << " on " << labels[j].text.text;
  }
}

TEST(Figures, MarkEquilibriaByTheirStability) {
  std::vector<std::string> problems;
  auto results = sample::two_results();
  results[0].branches.clear();
  results.resize(1);
  analysis::EquilibriaReport report;
  for (const double index : {0.0, 1.0}) {
    analysis::Equilibrium e{.label = index == 0 ? "EQ1" : "EQ2"};
    e.sample.values.assign(results[0].quantities.size(), index);
    report.list.push_back(e);
  }
  results[0].equilibria = report;
  Case c = sample::two_runs();
  PlotSpec spec{.name = "places", .x = "point.x", .y = "point.y"};
  spec.curves.push_back({.study = results[0].study});
  c.plots = {spec};
  const auto figure = figures_of(c, results, problems).at(0);
  ASSERT_THAT(figure.marks, SizeIs(2));
  EXPECT_EQ(figure.marks[0].code, "ES");
  EXPECT_EQ(figure.marks[0].label, "EQ1");
  EXPECT_EQ(figure.marks[1].code, "EU");
  EXPECT_EQ(figure.marks[1].at.first, 1);
}

TEST(PlaceLabels, SayTheSameThingAtTheSamePlaceOnce) {
  Figure figure{.low = {0, 0}, .high = {1, 1}};
  figure.marks = {
      {"LP", "LP1", {0.5, 0.5}}, {"LP", "LP1", {0.501, 0.5}}, {"LP", "LP2", {0.5, 0.5}}};
  const auto labels = place_labels(figure, {});
  ASSERT_THAT(labels, SizeIs(1));
  EXPECT_EQ(labels[0].text.text, "LP1, LP2");
}

/// Three pairs of curves that end beside each other, as of a sweep over two parameters: long labels need lines to their
/// ends.
TEST(PlaceLabels, LeadNoLineThroughAnotherText) {
  Figure figure{.low = {-10, -100}, .high = {80, 1250}};
  const auto add = [&](const std::string& label, const Polyline& line) {
    figure.curves.push_back({.label = {label}, .parts = {{Stability::stable, line}}});
  };
  add("h = 10, k = 20", {{0, 0}, {20, 0}, {25, 153.7}});
  add("h = 20, k = 20", {{0, 0}, {30, -6}, {50, 627.8}});
  add("h = 30, k = 20", {{0, 0}, {40, -15.5}, {75, 1136}});
  add("h = 10, k = 40", {{0, 0}, {20, 0}, {25, 157.4}});
  add("h = 20, k = 40", {{0, 0}, {30, -12}, {50, 655.7}});
  add("h = 30, k = 40", {{0, 0}, {40, -31}, {75, 1213}});
  const auto labels = place_labels(figure, {});
  ASSERT_THAT(labels, SizeIs(5)) << "the first and the fourth lie on each other";
  for (const PlacedLabel& a : labels)
    for (const PlacedLabel& b : labels) {
      if (&a == &b || !a.has_leader) continue;
      for (double t = 0; t <= 1; t += 0.01) {
        const double x = a.leader_from.first + t * (a.leader_to.first - a.leader_from.first);
        const double y = a.leader_from.second + t * (a.leader_to.second - a.leader_from.second);
        EXPECT_FALSE(std::abs(x - b.at.first) < 4.5 * static_cast<double>(b.text.text.size()) &&
                     std::abs(y - b.at.second) < 8)
            << "the line of " << a.text.text << " through " << b.text.text;
      }
    }
}

TEST(PlaceLabels, LeaveOutWhatHasNoPlaceButOnAnother) {
  Figure figure{.low = {0, 0}, .high = {1, 1}};
  constexpr int many = 120;
  for (int i = 0; i < many; ++i)
    figure.marks.push_back(
        {"LP", "LP" + std::to_string(100 + i), {0.4 + 0.02 * (i % 12), 0.4 + 0.02 * (i / 12)}});
  const auto labels = place_labels(figure, {});
  EXPECT_GT(labels.size(), 20U);
  EXPECT_LT(labels.size(), static_cast<std::size_t>(many));
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(labels[i], labels[j]))
          << labels[i].text.text << " on " << labels[j].text.text;
}

}  // namespace
}  // namespace springfold::io
