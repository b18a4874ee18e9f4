// What happened, in words.
#include "io/outline.hpp"

#include <gmock/gmock.h>

#include "io/fitted_table.hpp"
#include "io/outline_kinds.hpp"
#include "io/result_access.hpp"
#include "io/sample_results.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/results.hpp"
#include "springfold/io/summary_detail.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Outline, SaysAtWhichPointsStabilityChangesAndWithWhichForce) {
  const Case the_case = sample::two_runs();
  const auto results = sample::two_results();
  std::string text;
  for (const std::string& line : outline_of(the_case, results[1])) text += line + " ";
  EXPECT_THAT(text, testing::MatchesRegex("forward: stable up to LP1 at 0.02701 N, where it snaps; "
                                          "unstable up to LP2 at [0-9.e-]+ N; stable again to the "
                                          "end backward: stable to the end "));
}

std::size_t times(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

TEST(StudyOutline, TellsRunsWithTheSameStoryTogetherAndWithoutValues) {
  const Case the_case = sample::two_runs();
  const auto results = sample::two_results();
  const auto lines = study_outline(the_case, {&results[0], &results[1]});
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : " ") + line;
  EXPECT_EQ(text,
            "runs 1 and 2 (Kv = 0 to Kv = 0.01): forward: stable up to LP1, where it snaps; "
            "unstable up to LP2; stable again to the end; backward: stable to the end");
  EXPECT_LE(lines.size(), 3U);
  EXPECT_EQ(times(summary_table(the_case, results), "where it snaps"), 1U);
  EXPECT_EQ(times(outline_text(the_case, results), "where it snaps"), 1U);
  EXPECT_EQ(times(detailed_summary_table(the_case, results), "where it snaps"), 2U);
}

TEST(StudyOutline, HasThreeLinesHoweverManyStoriesThereAre) {
  Case the_case = sample::two_runs();
  the_case.runs.clear();
  std::vector<analysis::StudyResult> results;
  for (int run = 1; run <= 5; ++run) {
    the_case.runs.push_back(sample::planned("push from Q2", run, ""));
    results.push_back(sample::two_results()[0]);
    results.back().run = run;
    results.back().branches.resize(static_cast<std::size_t>(run), results.back().branches[0]);
  }
  std::vector<const analysis::StudyResult*> runs;
  for (const auto& result : results) runs.push_back(&result);
  const auto lines = study_outline(the_case, runs);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[0], testing::StartsWith("run 1 (Kv = 0): forward: stable up to LP1"));
  EXPECT_EQ(lines[1], "otherwise in 3 runs: see below");
  EXPECT_THAT(lines[2], testing::StartsWith("run 5 (Kv = 0): forward: "));
  for (const std::string& line : lines) EXPECT_LE(line.size(), table_width);
}

TEST(StudyOutline, SaysWhichRunsHaveNoStart) {
  auto results = sample::two_results();
  results[1].start.found = false;
  const auto lines = study_outline(sample::two_runs(), {&results[0], &results[1]});
  EXPECT_EQ(lines.back(), "run 2 (Kv = 0.01): no start point was found");
}

/// A study of jumps that found none.
std::string jumps_of(analysis::StudyResult result) {
  result.snap = std::make_shared<analysis::SnapReport>();
  return summary_table(sample::two_runs(), {result});
}

TEST(JumpLines, ClaimNothingOfWhatWasNotFollowed) {
  auto result = sample::two_results()[0];
  EXPECT_THAT(jumps_of(result), HasSubstr("none: stability is nowhere lost to a jump"));
  result.branches[0].forward = {.reason = "step too small", .complete = false};
  EXPECT_THAT(jumps_of(result), Not(HasSubstr("nowhere lost")));
  EXPECT_THAT(jumps_of(result), HasSubstr("none on what was followed, which is not all"));
  auto& branch = result.branches[0];
  branch.samples.resize(1);
  branch.events.clear();
  branch.start_row = 0;
  EXPECT_THAT(jumps_of(result), Not(HasSubstr("    jumps  "))) << "nothing was followed";
}

TEST(Outline, ClaimsNothingWithoutAStart) {
  auto result = sample::two_results()[0];
  result.start.found = false;
  EXPECT_THAT(outline_of(sample::two_runs(), result), IsEmpty());
}

TEST(Outline, DoesNotCallAnEndWhereTracingStoppedEarly) {
  auto result = sample::two_results()[1];
  result.branches[0].forward = {.reason = "step too small", .complete = false};
  std::string text;
  for (const std::string& line : outline_of(sample::two_runs(), result)) text += line + " ";
  EXPECT_THAT(text, HasSubstr("stable again to where it stopped early"));
  EXPECT_THAT(text, HasSubstr("backward: stable to the end"));
}

TEST(Outline, ClaimsNoStabilityUnderLoadsWithoutPotential) {
  auto result = sample::two_results()[0];
  result.non_conservative = {"load 1"};
  EXPECT_THAT(outline_of(sample::two_runs(), result),
              ElementsAre("followed from end to end, stability not known; special points: 2 LP"));
}

TEST(Outline, HasThreeLinesAtMost) {
  auto result = sample::two_results()[0];
  analysis::Branch& branch = result.branches[0];
  const auto index =
      static_cast<std::size_t>(std::find_if(result.quantities.begin(), result.quantities.end(),
                                            [](const auto& q) { return q.name == "index"; }) -
                               result.quantities.begin());
  branch.events.clear();
  for (std::size_t row = 0; row < branch.samples.size(); ++row) {
    branch.samples[row].event.clear();
    branch.samples[row].values[index] = static_cast<double>(row / 3 % 2);  // changes all the time
  }
  const auto lines = outline_of(sample::two_runs(), result);
  EXPECT_LE(lines.size(), 3U);
  for (const std::string& line : lines) EXPECT_LE(line.size(), table_width);
  EXPECT_THAT(lines.front(), HasSubstr("; and so on, "));
}

TEST(AlikeBranches, AreThoseWhoseSpecialPointsAgree) {
  auto result = sample::two_results()[0];
  result.branches.push_back(result.branches[0]);
  result.branches.push_back(sample::two_results()[1].branches[0]);
  EXPECT_THAT(alike_branches(result), ElementsAre(ElementsAre(1, 2), ElementsAre(3)));
  EXPECT_THAT(summary_table(sample::two_runs(), {result}), HasSubstr("branches 1 and 2"));
}

TEST(AlikeBranches, MayEndAtOppositeLimitsWhichIsSaid) {
  auto result = sample::two_results()[0];
  result.branches.push_back(result.branches[0]);
  result.branches[0].forward.reason = "hinge reaches its upper limit";
  result.branches[1].forward.reason = "hinge reaches its lower limit";
  EXPECT_THAT(alike_branches(result), ElementsAre(ElementsAre(1, 2)));
  const std::string table = summary_table(sample::two_runs(), {result});
  EXPECT_THAT(table, HasSubstr("last row      hinge reaches its upper limit\n"));
  EXPECT_THAT(table, HasSubstr("of branch 2: hinge reaches its lower limit\n"));
}

TEST(AlikeBranches, MayEndAtMirroredJointsWhichIsSaid) {
  auto result = sample::two_results()[0];
  result.branches.push_back(result.branches[0]);
  result.branches[0].forward.reason = "left.knee reaches its upper limit";
  result.branches[1].forward.reason = "right.knee reaches its upper limit";
  EXPECT_THAT(alike_branches(result), ElementsAre(ElementsAre(1, 2)));
  const std::string table = summary_table(sample::two_runs(), {result});
  EXPECT_THAT(table, HasSubstr("last row      left.knee reaches its upper limit\n"));
  EXPECT_THAT(table, HasSubstr("of branch 2: right.knee reaches its upper limit\n"));
}

TEST(AlikeBranches, DoNotEndAtOtherEnergies) {
  auto result = sample::two_results()[0];
  result.branches.push_back(result.branches[0]);
  const auto energy = std::find_if(result.quantities.begin(), result.quantities.end(),
                                   [](const auto& quantity) { return quantity.name == "energy"; });
  ASSERT_NE(energy, result.quantities.end());
  const auto column = static_cast<std::size_t>(energy - result.quantities.begin());
  result.branches[0].samples.back().values[column] = 0.2;
  result.branches[1].samples.back().values[column] = 0.3;
  EXPECT_THAT(alike_branches(result), ElementsAre(ElementsAre(1), ElementsAre(2)));
}

/// Energies of thousandths of a millionth are no rounding where forces and lengths are as small.
TEST(AlikeBranches, DoNotEndAtOtherEnergiesInAnyUnits) {
  auto result = sample::two_results()[0];
  for (analysis::Sample& sample : result.branches[0].samples)
    for (std::size_t i = 0; i < result.quantities.size(); ++i)
      if (result.quantities[i].unit != analysis::Unit::none &&
          result.quantities[i].unit != analysis::Unit::angle)
        sample.values[i] *= 1e-9;
  result.branches.push_back(result.branches[0]);
  const auto energy = std::find_if(result.quantities.begin(), result.quantities.end(),
                                   [](const auto& quantity) { return quantity.name == "energy"; });
  ASSERT_NE(energy, result.quantities.end());
  const auto column = static_cast<std::size_t>(energy - result.quantities.begin());
  result.branches[0].samples.back().values[column] = 0.2e-9;
  result.branches[1].samples.back().values[column] = 0.3e-9;
  EXPECT_THAT(alike_branches(result), ElementsAre(ElementsAre(1), ElementsAre(2)));
}

TEST(Outline, SaysThatRoundingIsZero) {
  const Case the_case = sample::two_runs();
  auto results = sample::two_results();
  analysis::Branch& branch = results[1].branches[0];
  const auto force = std::find_if(results[1].quantities.begin(), results[1].quantities.end(),
                                  [](const auto& quantity) { return quantity.name == "force"; });
  const auto column = static_cast<std::size_t>(force - results[1].quantities.begin());
  for (const analysis::Event& event : branch.events)
    if (event.label == "LP1") branch.samples[event.row].values[column] = -7e-17;
  std::string text;
  for (const std::string& line : outline_of(the_case, results[1])) text += line + " ";
  EXPECT_THAT(text, HasSubstr("stable up to LP1 at 0 N"));
}

TEST(PointTables, SayThatRoundingIsZero) {
  auto result = sample::two_results()[0];
  auto& values = result.branches[0].samples[result.branches[0].events[0].row].values;
  values[2] = 3e-17;  // deflection [m], beside lengths about 1
  const std::string table = summary_table(sample::two_runs(), {result});
  EXPECT_THAT(table, testing::Not(HasSubstr("e-17")));
}

TEST(ShownMatrix, HasNoRoundingButSmallStiffnessesOfOtherUnits) {
  Matrix K(3, 3);
  K << 2.2e-16, 1e-17, 0,  //
      1e-17, 4.8, 3e-18,   //
      0, 3e-18, 2e-9;      // [N m/rad]
  const Matrix shown = shown_matrix(K);
  EXPECT_EQ(shown(0, 0), 0);
  EXPECT_EQ(shown(0, 1), 0);
  EXPECT_EQ(shown(1, 2), 0) << "beside the root of 4.8 times 2e-9";
  EXPECT_EQ(shown(1, 1), 4.8);
  EXPECT_EQ(shown(2, 2), 2e-9);
}

TEST(OutlineOfKind, SaysThatACurveBeginsAtZeroNotAtItsRounding) {
  Case the_case = sample::two_runs();
  PlannedRun& planned = the_case.runs.front();
  planned.plan.kind = analysis::StudyKind::critical_load;
  planned.plan.critical.parameter = "kt";
  analysis::StudyResult result;
  result.quantities = {{"lambda", analysis::Unit::force}, {"kt", analysis::Unit::none}};
  result.branches.resize(1);
  for (const double kt : {1.6e-15, 50.0, 100.0})
    result.branches[0].samples.push_back({.values = {2 + 0.01 * kt, kt}});
  EXPECT_THAT(outline_of_kind(the_case, planned, result), ElementsAre(HasSubstr("at kt = 0 to 3")));
}

TEST(FittedTable, HasNoLineBeyondTheTerminalAndKeepsEveryCell) {
  std::vector<std::vector<std::string>> rows{{"name"}, {"one"}};
  std::vector<Align> align{Align::left};
  for (int i = 0; i < 12; ++i) {
    rows[0].push_back("column" + std::to_string(i));
    rows[1].push_back(std::to_string(i) + ".123456789");
    align.push_back(Align::right);
  }
  rows[1].push_back(
      "a sentence that says so much about this row that it needs more than one line of a "
      "table");
  const std::string text = fitted(rows, align, 4);
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    EXPECT_LE(end - begin, table_width);
    begin = end + 1;
  }
  for (int i = 0; i < 12; ++i) EXPECT_THAT(text, HasSubstr(std::to_string(i) + ".123456789"));
  for (const char* word : {"sentence", "table", "needs"}) EXPECT_THAT(text, HasSubstr(word));
}

}  // namespace
}  // namespace springfold::io
