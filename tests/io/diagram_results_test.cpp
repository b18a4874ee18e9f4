// What files, tables and figures say about a run with several branches.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "io/figure.hpp"
#include "io/label_layout.hpp"
#include "io/result_access.hpp"
#include "io/result_tables.hpp"
#include "io/sample_results.hpp"
#include "io/summary_line.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

Case one_run() {
  Case the_case = sample::two_runs();
  the_case.runs.resize(1);
  return the_case;
}

/// Two more branches, which begin at a branch point in the middle of the first and look alike.
StudyResult forked() {
  StudyResult result = sample::two_results().front();
  auto& trunk = result.branches.front();
  const std::size_t row = trunk.samples.size() / 2;
  const analysis::Event fork{
      .kind = EventKind::branch_point, .label = "BP1", .detail = "branch point", .row = row};
  analysis::Branch twig;
  twig.depth = 1;
  twig.origin = "BP1";
  twig.origin_branch = 1;
  twig.backward = {.reason = "begins at BP1 of branch 1"};
  twig.forward = {.reason = "goes on along branch 1"};
  twig.events = {fork};
  twig.events.front().row = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    twig.samples.push_back(trunk.samples[row]);
    twig.samples.back().values[2] += 0.01 * static_cast<double>(i);
  }
  trunk.events.insert(trunk.events.begin(), fork);
  result.branches.push_back(twig);
  result.branches.push_back(twig);
  result.junctions = {{.label = "BP1", .branch = 1, .ways = {1, 1, 2, 3}}};
  return result;
}

TEST(SummaryOfADiagram, ClaimsNothingAboutBranchesThatAreNotConnectedUnlessASearchWasRun) {
  StudyResult result = forked();
  EXPECT_THAT(summary_table(one_run(), {result}),
              HasSubstr("nothing is claimed about branches that are not connected to the start"));
  result.searches = {{.lambda = 0.5, .starts = 64}};
  const std::string table = summary_table(one_run(), {result});
  EXPECT_THAT(table, Not(HasSubstr("nothing is claimed")));
  EXPECT_THAT(table, HasSubstr("search at lambda = 0.5: no other equilibrium found in 64 starts"));
}

TEST(SummaryOfADiagram, SaysHowManyEquilibriaWereFoundAndTraced) {
  StudyResult result = forked();
  result.searches = {{.lambda = 0.5, .starts = 64, .found = 2, .traced = 2},
                     {.lambda = 1, .starts = 9, .found = 3, .traced = 1, .out_of_range = 4}};
  result.branches[2].origin.clear();
  result.branches[2].start = 3;
  const std::string table = summary_table(one_run(), {result});
  EXPECT_THAT(table, HasSubstr("lambda = 0.5: at least 2 other equilibria found, all traced"));
  EXPECT_THAT(table, HasSubstr("lambda = 1: at least 3 other equilibria found, 1 traced; 4 "
                               "further out\n                  of range, not traced"));
  EXPECT_THAT(table, HasSubstr("branch 3      found by the search at lambda = 1"));
}

TEST(SummaryLine, GoesOnBelowItsTextWhereATerminalHasNoRoom) {
  std::string words;
  for (int i = 0; i < 40; ++i) words += "word" + std::to_string(i) + " ";
  const std::string text = summary_line("label", words);
  std::istringstream lines{text};
  std::string together;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_LE(line.size(), table_width);
    const std::size_t lead = summary_indent + summary_label_width;
    EXPECT_EQ(line.substr(0, lead), count == 0 ? "    label         " : std::string(lead, ' '));
    together += line.substr(lead) + " ";
  }
  EXPECT_GT(count, 1);
  EXPECT_EQ(together, words);
}

TEST(SummaryOfADiagram, SaysWhereBranchesBeginAndWhatIsLeftOut) {
  StudyResult result = forked();
  result.junctions.push_back(
      {.kind = EventKind::branching_kink, .label = "KB1", .ways = {1, 0, 0}});
  const std::string table = summary_table(one_run(), {result});
  EXPECT_THAT(table, HasSubstr("branches 2 and 3 alike; begins at BP1 of branch 1"));
  EXPECT_THAT(table, HasSubstr("last row      goes on along branch 1"));
  EXPECT_THAT(table, HasSubstr("not followed, beyond branches.depth or .maximum: 2 ways at KB1"));
  EXPECT_TRUE(complete(result));
}

TEST(SummaryOfADiagram, SaysOfAnInterruptedOneWhyBranchesAreMissing) {
  StudyResult result = forked();
  result.junctions.push_back(
      {.kind = EventKind::branching_kink, .label = "KB1", .ways = {1, 0, 0}});
  result.doubts = {"interrupted: 2 branches were not traced"};
  const std::string table = summary_table(one_run(), {result});
  EXPECT_THAT(table, HasSubstr("not followed, interrupted: 2 ways at KB1"));
  EXPECT_THAT(table, testing::Not(HasSubstr("branches.depth")));
}

TEST(SummaryOfADiagram, SaysWhatIsNotFollowedWithoutBranching) {
  StudyResult result = forked();
  result.branches.resize(1);
  result.junctions.clear();
  EXPECT_THAT(summary_table(one_run(), {result}),
              HasSubstr("not followed, branches.depth = 0: what crosses at BP1"));
}

TEST(SummaryOfADiagram, ListsTheWaysOutOfASpecialStart) {
  StudyResult result = forked();
  result.start.situation = "a branch point";
  result.start.ways = {{.rates = {1, 0.5, 0, 0, 0, -0.25, 1e-17, 0, 0, 0}, .branch = 2},
                       {.rates = {}, .branch = 0}};
  const std::string table = summary_table(one_run(), {result});
  EXPECT_THAT(table, HasSubstr("the start is a branch point: 2 ways"));
  EXPECT_THAT(table, HasSubstr("way 1: branch 2, d/ds lambda 0.5, point.x -0.25, point.y 0"));
  EXPECT_THAT(table, HasSubstr("way 2: not followed"));
}

TEST(SummaryOfADiagram, MarksDoubtsAndIsNotCompleteWithThem) {
  StudyResult result = forked();
  EXPECT_TRUE(complete(result));
  result.doubts = {"branches may be missing: no idea"};
  EXPECT_FALSE(complete(result));
  EXPECT_THAT(summary_table(one_run(), {result}),
              HasSubstr("UNRESOLVED: branches may be missing: no idea"));
}

TEST(SummaryOfADiagram, InJsonHasBranchesJunctionsAndSearches) {
  StudyResult result = forked();
  result.searches = {{.lambda = 0.5, .starts = 64, .found = 1, .traced = 1}};
  const json run = json::parse(summary_json(one_run(), {result}))["runs"][0];
  EXPECT_EQ(run["branches"][1]["origin"], "BP1");
  EXPECT_EQ(run["branches"][1]["origin_branch"], 1);
  EXPECT_EQ(run["branches"][1]["depth"], 1);
  EXPECT_EQ(run["junctions"][0]["ways"], json({1, 1, 2, 3}));
  EXPECT_EQ(run["searches"][0]["found"], 1);
  EXPECT_EQ(run["ways_not_followed"], 0);
  EXPECT_EQ(run["doubts"], json::array());
}

TEST(EventCounts, CountAPointWhereBranchesMeetOnce) {
  EXPECT_EQ(event_counts(forked())["BP"], 1);
  const std::string csv = events_csv({}, {forked()});
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = csv.find(",BP1,", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 3u);
}

TEST(BranchFiles, AreOnePerBranch) {
  EXPECT_THAT(branch_files({forked()}), ElementsAre(ElementsAre("branches/push_from_Q2-1.csv",
                                                                "branches/push_from_Q2-1-2.csv",
                                                                "branches/push_from_Q2-1-3.csv")));
}

TEST(FigureOfADiagram, HasAColourForEveryBranchAndOneNumberForThoseThatLookAlike) {
  std::vector<std::string> problems;
  Case the_case = one_run();
  the_case.plots = {{.name = "a", .curves = {{.study = "push from Q2", .labels = {"soft"}}}}};
  const auto figures = figures_of(the_case, {forked()}, problems);
  ASSERT_THAT(figures, SizeIs(1));
  const auto& curves = figures[0].curves;
  ASSERT_THAT(curves, SizeIs(3));
  EXPECT_EQ(curves[0].label.text, "soft: 1");
  EXPECT_EQ(curves[1].label.text, "2, 3");
  EXPECT_EQ(curves[2].label.text, "");
  EXPECT_EQ(curves[1].hue, 2);
}

TEST(FigureOfADiagram, MarksAPointWhereBranchesMeetOnce) {
  std::vector<std::string> problems;
  const auto figures = figures_of(one_run(), {forked()}, problems);
  ASSERT_THAT(figures, SizeIs(1));
  int marks = 0, labels = 0;
  for (const auto& mark : figures[0].marks) marks += mark.label == "BP1";
  for (const auto& label : place_labels(figures[0], {})) labels += label.text.text == "BP1";
  EXPECT_EQ(marks, 1);
  EXPECT_EQ(labels, 1);
}

TEST(FigureOfADiagram, SaysTheLabelsOfPointsThatLieOnEachOtherTogether) {
  Figure figure;
  figure.high = {1, 1};
  figure.marks = {{"LP", "LP1", {0.5, 0.5}},
                  {"BP", "BP1", {0.5, 0.5}},
                  {"LP", "LP2", {0.5, 0.5}},
                  {"LP", "LP3", {0.8, 0.5}},
                  {"LP", "LP1", {0.5, 0.5}}};
  std::vector<std::string> texts;
  for (const auto& label : place_labels(figure, {})) texts.push_back(label.text.text);
  EXPECT_THAT(texts, ElementsAre("LP1, LP2", "BP1", "LP3"));
}

TEST(FigureOfOneBranch, TellsStabilityByColour) {
  std::vector<std::string> problems;
  const auto figures = figures_of(sample::two_runs(), sample::two_results(), problems);
  ASSERT_THAT(figures, SizeIs(1));
  for (const auto& curve : figures[0].curves) EXPECT_EQ(curve.hue, 0);
}

}  // namespace
}  // namespace springfold::io
