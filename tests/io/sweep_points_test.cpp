// Special points of the runs of a study over the parameter that it varies.
#include "io/sweep_points.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "case_files.hpp"
#include "cli/small_case.hpp"
#include "io/figure.hpp"
#include "io/sample_results.hpp"
#include "io/scratch_folder.hpp"
#include "io/sweep_tables.hpp"
#include "springfold/io/plots.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text{line + ","};
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The Orthoglide pushed along its diagonal, in closed form: two limit points for little preload, none for much.
class SweepPointsTest : public testing::Test {
 protected:
  void add_run(double k) {
    const int run = static_cast<int>(results.size()) + 1;
    PlannedRun planned = sample::planned("push", run, "");
    planned.varied = {"Kv"};
    planned.parameters["Kv"] = k;
    the_case.runs.push_back(planned);
    results.push_back(sample::result("push", run, "", {.k = k}, 0.37, 0.9));
  }
  std::vector<SweepPoints> sweeps() const { return sweep_points_of(the_case, results); }
  std::vector<std::vector<std::string>> table() const {
    std::vector<std::vector<std::string>> rows;
    std::istringstream text{sweep_points_csv(sweeps().at(0))};
    for (std::string line; std::getline(text, line);) rows.push_back(cells_of(line));
    return rows;
  }
  /// The number in the row of a run, below a title.
  double entry(std::size_t run, const std::string& title) const {
    const auto rows = table();
    const auto column = std::find(rows[0].begin(), rows[0].end(), title) - rows[0].begin();
    return std::stod(rows.at(run).at(static_cast<std::size_t>(column)));
  }
  Figure figure(PlotSpec spec) const {
    spec.name = "points";
    spec.curves = {{.study = "push"}};
    Figure drawn;
    add_sweep_points(the_case, spec, results, drawn);
    return drawn;
  }

  Case the_case{};
  std::vector<analysis::StudyResult> results{};
};

TEST_F(SweepPointsTest, TellsInWordsWhatTheColumnsOfATableRunThrough) {
  const SweepTable sweep{.study = "push", .parameters = {"Kv"}, .columns = {"F", "none"}};
  const double nan = std::nan("");
  for (const double force : {0.25, nan, 0.125}) {
    add_run(0.01);
    analysis::SweepRow row;
    row.values = {force, nan};
    results.back().row = std::make_shared<const analysis::SweepRow>(row);
  }
  EXPECT_THAT(sweep_words(the_case, sweep, results),
              ElementsAre("F from 0.125 to 0.25, in 2 of 3 runs", "none in none of the runs"));
}

TEST_F(SweepPointsTest, SaysThatRoundingIsZero) {
  add_run(0.01);
  add_run(0.011);
  for (analysis::StudyResult& result : results) {
    const auto force = std::find_if(result.quantities.begin(), result.quantities.end(),
                                    [](const auto& quantity) { return quantity.name == "force"; });
    const auto column = static_cast<std::size_t>(force - result.quantities.begin());
    analysis::Branch& branch = result.branches.at(0);
    for (const analysis::Event& event : branch.events)
      if (event.label == "LP1") branch.samples[event.row].values[column] = 3e-17;
  }
  EXPECT_THAT(sweep_points_lines(sweeps().at(0), "points.csv"), Not(HasSubstr("e-17")));
}

TEST_F(SweepPointsTest, HaveARowForEveryRunWithItsParameterAndItsPoints) {
  for (const double k : {0.0, 0.01}) add_run(k);
  EXPECT_THAT(table().at(0),
              ElementsAre("run", "parameter.Kv", "LP1.lambda", "LP1.deflection", "LP1.force",
                          "LP2.lambda", "LP2.deflection", "LP2.force", "status"));
  EXPECT_EQ(entry(2, "parameter.Kv"), 0.01);
  const sample::Diagonal diagonal{.k = 0.01};
  const double c = entry(2, "LP1.deflection") / std::sqrt(2.0) + diagonal.p;
  EXPECT_NEAR(diagonal.stiffness(c), 0, 1e-6) << "at a limit point the stiffness is zero";
  EXPECT_NEAR(entry(2, "LP1.force"), diagonal.force(c), 1e-12);
  EXPECT_EQ(table()[2].back(), "complete");
}

TEST_F(SweepPointsTest, LeaveTheCellsOfARunWithoutSuchAPointEmpty) {
  for (const double k : {0.01, 1.0}) add_run(k);
  EXPECT_THAT(table().at(2), ElementsAre("2", "1", "", "", "", "", "", "", "complete"));
}

TEST_F(SweepPointsTest, AreOrderedByCodeAndNumberAndHaveNoEndsOfRanges) {
  for (const double k : {0.0, 0.01}) add_run(k);
  auto& events = results[1].branches[0].events;
  events.push_back({.kind = analysis::EventKind::branch_point, .label = "BP1"});
  events.push_back({.kind = analysis::EventKind::limit_point, .label = "LP10"});
  EXPECT_THAT(sweeps().at(0).labels, ElementsAre("LP1", "LP2", "LP10", "BP1"));
}

TEST_F(SweepPointsTest, AreOfStudiesThatVarySomething) {
  for (const double k : {0.0, 0.01}) add_run(k);
  for (PlannedRun& planned : the_case.runs) planned.varied.clear();
  EXPECT_THAT(sweeps(), IsEmpty());
}

TEST_F(SweepPointsTest, FitTheTerminal) {
  for (const double k : {0.0, 0.01}) add_run(k);
  for (int n = 3; n < 25; ++n)
    results[0].branches[0].events.push_back(
        {.kind = analysis::EventKind::limit_point, .label = "LP" + std::to_string(n)});
  std::istringstream text{sweep_points_lines(sweeps().at(0), "sweeps/push-points.csv")};
  int lines = 0;
  for (std::string line; std::getline(text, line); ++lines) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_GT(lines, 6) << "several blocks";
}

TEST_F(SweepPointsTest, OfVeryManyRunsAreInTheFileOnly) {
  for (int n = 0; n < 41; ++n) add_run(0.0002 * n);
  EXPECT_EQ(sweep_points_lines(sweeps().at(0), "sweeps/push-points.csv"),
            "push, special points over Kv\n    table         sweeps/push-points.csv\n");
  EXPECT_THAT(table(), SizeIs(42));
}

TEST_F(SweepPointsTest, AreWrittenAndRemovedByTheNextRun) {
  for (const double k : {0.0, 0.01}) add_run(k);
  const ScratchFolder scratch;
  write_results(scratch.path(), the_case, results);
  const auto file = scratch.path() / "sweeps/push-points.csv";
  EXPECT_EQ(text_in(file), sweep_points_csv(sweeps().at(0)));
  for (PlannedRun& planned : the_case.runs) planned.varied.clear();
  write_results(scratch.path(), the_case, results);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(SweepPointsTest, HaveAFileBesideTheTableOfASweepOfThatName) {
  for (const double k : {0.0, 0.01}) add_run(k);
  the_case.sweeps.push_back({.study = "push-points"});
  EXPECT_THAT(sweep_points_files(the_case, sweeps()), ElementsAre("sweeps/push-points_2.csv"));
}

TEST_F(SweepPointsTest, AreDrawnInTheOrderOfTheParameter) {
  for (const double k : {0.01, 0.0, 0.005}) add_run(k);
  const Figure drawn = figure({.x = "parameter.Kv", .x_factor = 10, .y_factor = 2});
  ASSERT_THAT(drawn.curves, SizeIs(2));
  EXPECT_EQ(drawn.curves[0].label.text, "LP1");
  ASSERT_THAT(drawn.curves[0].parts, SizeIs(1));
  const Polyline& line = drawn.curves[0].parts[0].line;
  ASSERT_THAT(line, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(line[i].first, 0.05 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(line[i].second, 2 * entry(i == 0 ? 2 : i == 1 ? 3 : 1, "LP1.force"));
  }
  EXPECT_EQ(drawn.x_title.text, "10 · Kv");
  EXPECT_EQ(drawn.y_title.text, "2 · force [N]");
  the_case.units.parameters["Kv"] = "N*m/rad";
  EXPECT_EQ(figure({.x = "parameter.Kv"}).x_title.text, "Kv [N*m/rad]");
}

TEST_F(SweepPointsTest, AreNotJoinedAcrossARunWithoutThem) {
  for (const double k : {0.0, 0.005, 0.01, 0.015}) add_run(k);
  std::erase_if(results[1].branches[0].events, [](const auto& e) { return e.label == "LP1"; });
  const Figure drawn = figure({.x = "parameter.Kv"});
  const auto behind = std::find_if(drawn.curves.begin(), drawn.curves.end(),
                                   [](const FigureCurve& c) { return c.label.text == "LP1"; });
  ASSERT_NE(behind, drawn.curves.end());
  ASSERT_THAT(behind->parts, SizeIs(1));
  EXPECT_EQ(behind->parts[0].line.front().first, 0.01);
  EXPECT_EQ(std::count_if(drawn.marks.begin(), drawn.marks.end(),
                          [](const FigureMark& mark) { return mark.code == "LP"; }),
            3 + 4);
}

TEST_F(SweepPointsTest, AreNotJoinedWhereSomethingElseVariesToo) {
  for (const double k : {0.0, 0.01}) add_run(k);
  for (PlannedRun& planned : the_case.runs) planned.varied = {"Kv", "L"};
  const Figure drawn = figure({.x = "parameter.Kv"});
  EXPECT_THAT(drawn.curves, IsEmpty());
  EXPECT_THAT(drawn.marks, SizeIs(4));
}

/// Points on the lines lambda = line(k): a run has those with a line, labelled in their order.
class SweepTracks : public SweepPointsTest {
 protected:
  void add_lines(double k, const std::vector<double>& lambdas) {
    add_run(k);
    analysis::StudyResult& result = results.back();
    analysis::Branch& branch = result.branches[0];
    branch.events.clear();
    for (std::size_t i = 0; i < lambdas.size(); ++i) {
      branch.events.push_back({.kind = analysis::EventKind::limit_point,
                               .label = "LP" + std::to_string(i + 1),
                               .row = i});
      for (const std::size_t column : {1u, 2u, 3u}) branch.samples[i].values[column] = lambdas[i];
    }
  }
};

TEST_F(SweepTracks, APointKeepsItsLineWhereAPairAppearsBeforeIt) {
  add_lines(0.0, {5.0});
  add_lines(0.1, {5.1});
  add_lines(0.2, {1.0, 1.4, 5.2});
  add_lines(0.3, {0.8, 1.6, 5.3});
  const Figure drawn = figure({.x = "parameter.Kv", .y = "lambda"});
  ASSERT_THAT(drawn.curves, SizeIs(3));
  EXPECT_EQ(drawn.curves[0].label.text, "LP1/LP3");
  EXPECT_THAT(drawn.curves[0].parts.at(0).line,
              ElementsAre(PlotPoint{0.0, 5.0}, PlotPoint{0.1, 5.1}, PlotPoint{0.2, 5.2},
                          PlotPoint{0.3, 5.3}));
  EXPECT_EQ(drawn.curves[1].label.text, "LP1");
  EXPECT_THAT(drawn.curves[1].parts.at(0).line,
              ElementsAre(PlotPoint{0.2, 1.0}, PlotPoint{0.3, 0.8}));
}

TEST_F(SweepTracks, APointKeepsItsLineWhereAPairBeforeItVanishes) {
  add_lines(0.0, {1.0, 1.4, 5.0, 7.0});
  add_lines(0.1, {5.1, 7.1});
  const Figure drawn = figure({.x = "parameter.Kv", .y = "lambda"});
  ASSERT_THAT(drawn.curves, SizeIs(2));
  EXPECT_EQ(drawn.curves[0].label.text, "LP3/LP1");
  EXPECT_EQ(drawn.curves[1].label.text, "LP4/LP2");
  EXPECT_THAT(drawn.marks, SizeIs(6)) << "the pair has marks and no line";
}

TEST_F(SweepPointsTest, AreInTheSummaryWithAllColumns) {
  for (const double k : {0.0, 0.01}) add_run(k);
  const auto summary = nlohmann::json::parse(summary_json(the_case, results));
  const auto& runs = summary["sweep_points"][0]["runs"];
  EXPECT_EQ(runs[1]["parameters"]["Kv"], 0.01);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& row = results[i].branches[0].samples[results[i].branches[0].events[0].row];
    ASSERT_EQ(results[i].branches[0].events[0].label, "LP1");
    EXPECT_EQ(runs[i]["points"]["LP1"].size(), results[i].quantities.size());
    EXPECT_EQ(runs[i]["points"]["LP1"]["force"], row.values[3]);
  }
}

TEST_F(SweepPointsTest, ThatLieOnEachOtherShareALine) {
  for (const double k : {0.0, 0.01}) add_run(k);
  for (auto& result : results) {
    auto& events = result.branches[0].events;
    const auto first = std::find_if(events.begin(), events.end(),
                                    [](const auto& event) { return event.label == "LP1"; });
    for (auto& event : events)
      if (event.label == "LP2") event.row = first->row;
  }
  const Figure drawn = figure({.x = "parameter.Kv"});
  ASSERT_THAT(drawn.curves, SizeIs(1));
  EXPECT_EQ(drawn.curves[0].label.text, "LP1, LP2");
}

TEST_F(SweepPointsTest, HaveAFigureOfTheirOwnWhoseKeyCallsNoLineStable) {
  for (const double k : {0.0, 0.01}) add_run(k);
  const ScratchFolder scratch;
  draw_plots(scratch.path(), the_case, results, {.gnuplot = "/nowhere/gnuplot"});
  const std::string script = text_in(scratch.path() / "plots/push-points.gp");
  EXPECT_THAT(script, HasSubstr("curve_parts = 'stable_1 stable_2'"));
  EXPECT_THAT(script, HasSubstr("first_parts = ''"));
  EXPECT_THAT(text_in(scratch.path() / "plots/push.gp"), Not(HasSubstr("first_parts = ''")));
}

class ParameterPlot : public CaseFiles {
 protected:
  std::vector<std::string> of(const std::string& keys, const std::string& curve = "") const {
    const std::string text = replaced(cli::small_case(), "[[study]]\nname = \"rest\"",
                                      "vary = { parameter = \"K\", values = [1, 2] }\n"
                                      "[[study]]\nname = \"rest\"");
    return messages(text + "[[plot]]\nname = \"a\"\n" + keys + "\ncurves = [{ study = \"push\"" +
                    curve + " }]\n");
  }
};

TEST_F(ParameterPlot, WantsAParameterThatTheStudyVaries) {
  EXPECT_THAT(of("x = \"parameter.K\""), IsEmpty());
  EXPECT_THAT(of("x = \"parameter.k2\""),
              ElementsAre(HasSubstr("plot[1].x: got \"parameter.k2\", need a parameter that study "
                                    "\"push\" varies, did you mean \"parameter.K\"?")));
}

TEST_F(ParameterPlot, HasNoLabelsOfRunsAndIsNotPolar) {
  EXPECT_THAT(of("x = \"parameter.K\"", ", labels = [\"a\", \"b\"]"),
              ElementsAre(HasSubstr("plot[1].curves: labels name runs, need none")));
  EXPECT_THAT(of("x = \"parameter.K\"\npolar = true"),
              ElementsAre(HasSubstr("plot[1].polar: got true, need false")));
}

}  // namespace
}  // namespace springfold::io
