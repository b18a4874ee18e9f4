#include "springfold/io/results.hpp"

#include <gmock/gmock.h>

#include <clocale>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/result_tables.hpp"
#include "io/sample_results.hpp"
#include "io/scratch_folder.hpp"
#include "io/sha256.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream{text};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// All files below the folder but timings.json, by path.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator{folder})
    if (entry.is_regular_file() && entry.path().filename() != "timings.json")
      files[entry.path().lexically_relative(folder).string()] = text_in(entry.path());
  return files;
}

TEST(BranchCsv, HasOneRowPerPointAndEmptyFieldsForUndefinedValues) {
  const StudyResult result = sample::two_results().front();
  const auto lines = lines_of(branch_csv(result, result.branches.front()));
  ASSERT_EQ(lines.size(), result.branches.front().samples.size() + 1);
  EXPECT_EQ(lines.front(),
            "s,lambda,deflection,force,stiffness,point.x,point.y,leg_x.drive.rho,index,energy,"
            "piece,event");
  EXPECT_THAT(lines.back(), testing::EndsWith(",0,,,EP1"));  // index, energy, piece, event
}

TEST(BranchFiles, AreDifferentForStudiesWhoseNamesLookAlike) {
  StudyResult a{.study = "push x", .run = 1}, b{.study = "push/x", .run = 1};
  a.branches.resize(2);
  b.branches.resize(1);
  EXPECT_THAT(branch_files({a, b}),
              ElementsAre(ElementsAre("branches/push_x-1.csv", "branches/push_x-1-2.csv"),
                          ElementsAre("branches/push_x-1_2.csv")));
}

TEST(EventsCsv, HasTheQuantitiesOfAllRunsAndLeavesForeignOnesEmpty) {
  auto results = sample::two_results();
  results[1].quantities[8].name = "other";
  const auto lines = lines_of(events_csv(sample::two_runs(), results));
  EXPECT_THAT(lines.front(), StartsWith("study,run,label,branch,event,code,detail,row,s,lambda"));
  EXPECT_THAT(lines.front(), testing::EndsWith(",index,energy,other,index_before,index_after"));
  EXPECT_THAT(lines[1], StartsWith("push from Q2,1,Kv = 0,1,LP1,LP,lambda turns back,"));
  EXPECT_THAT(lines[1], testing::HasSubstr(",,,"));  // no energy, no "other"
}

TEST(StepsCsv, QuotesWordsWithCommas) {
  EXPECT_EQ(lines_of(steps_csv(sample::two_results()))[1],
            "push from Q2,1,Kv = 0,1,0.1,0.05,\"no convergence, \"\"too long\"\"\"");
}

TEST(WriteResults, ListsEveryFileWithTheHashOfItsBytes) {
  const ScratchFolder scratch;
  const auto written = write_results(scratch.path(), sample::two_runs(), sample::two_results());
  EXPECT_EQ(static_cast<int>(written.size()), count_files(scratch.path()));
  const json manifest = json::parse(text_in(scratch.path() / "manifest.json"));
  EXPECT_EQ(manifest["state"], "whole");
  EXPECT_EQ(manifest["case"]["file"], "case.toml");
  EXPECT_EQ(manifest["overrides"]["Kv"], "0.01");
  EXPECT_EQ(manifest["runs"][1]["parameters"]["Kv"], 0.01);
  EXPECT_EQ(manifest["runs"][0]["options_given"], (json{"control", "direction"}));
  EXPECT_EQ(manifest["runs"][0]["options_used"]["trace.maximum_step"], 0.05);
  EXPECT_EQ(manifest["numerics"]["promised_place"], 1e-10);
  EXPECT_EQ(manifest["files"].size() + 1, written.size());  // all but itself
  for (const auto& file : manifest["files"]) {
    const std::string bytes = text_in(scratch.path() / file["path"]);
    if (file["path"] == "timings.json")
      EXPECT_FALSE(file.contains("sha256"));
    else
      EXPECT_EQ(file["sha256"], sha256(bytes)) << file["path"];
  }
}

TEST(WriteResults, GivesTheSameBytesTwiceWhateverTheLocaleAndTheTime) {
  const ScratchFolder first, second;
  auto results = sample::two_results();
  write_results(first.path(), sample::two_runs(), results);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // does nothing where it is not installed
  results[0].seconds = 17;
  write_results(second.path(), sample::two_runs(), results);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(contents(first.path()), contents(second.path()));
}

TEST(WriteResults, RemovesFilesOfTheEarlierSetAndNoOthers) {
  const ScratchFolder scratch;
  auto results = sample::two_results();
  write_results(scratch.path(), sample::two_runs(), results);
  put_text(scratch.path() / "branches" / "mine.csv", "keep");
  put_text(scratch.path() / "notes.txt", "keep");
  results.pop_back();
  write_results(scratch.path(), sample::two_runs(), results);
  EXPECT_TRUE(fs::exists(scratch.path() / "branches/push_from_Q2-1.csv"));
  EXPECT_FALSE(fs::exists(scratch.path() / "branches/push_from_Q2-2.csv"));
  EXPECT_TRUE(fs::exists(scratch.path() / "branches" / "mine.csv"));
  EXPECT_TRUE(fs::exists(scratch.path() / "notes.txt"));
}

TEST(WriteResults, LeavesOutTablesForWhichThereIsNoTimeAndSaysWhich) {
  const ScratchFolder scratch;
  const auto results = sample::two_results();
  write_results(scratch.path(), sample::two_runs(), results);
  Deadline deadline{.is_over = [] { return true; }};
  const auto written =
      write_results(scratch.path(), sample::two_runs(), results, SetState::whole, false, &deadline);
  EXPECT_EQ(deadline.unwritten, (std::vector<std::string>{"branches/push_from_Q2-1.csv",
                                                          "branches/push_from_Q2-2.csv"}));
  for (const std::string& file : deadline.unwritten)
    EXPECT_FALSE(fs::exists(scratch.path() / file)) << "that of the run before is not this one's";
  EXPECT_EQ(static_cast<int>(written.size()), count_files(scratch.path()));
  const json manifest = json::parse(text_in(scratch.path() / "manifest.json"));
  EXPECT_EQ(manifest["state"], "interrupted");
  EXPECT_EQ(manifest["pending"], json(deadline.unwritten));
  for (const auto& file : manifest["files"])
    EXPECT_TRUE(fs::exists(scratch.path() / file["path"])) << file["path"];
  EXPECT_TRUE(fs::exists(scratch.path() / "summary.json"));
}

TEST(WriteResults, WritesShortTablesBeforeLongOnes) {
  const ScratchFolder scratch;
  auto results = sample::two_results();
  auto& samples = results[0].branches[0].samples;
  while (samples.size() < 5000) samples.insert(samples.end(), samples.begin(), samples.end());
  int asked = 0;
  Deadline deadline{.is_over = [&asked] { return ++asked > 3; }};
  write_results(scratch.path(), sample::two_runs(), results, SetState::whole, false, &deadline);
  EXPECT_EQ(deadline.unwritten, std::vector<std::string>{"branches/push_from_Q2-1.csv"});
}

TEST(WriteResults, RemovesTablesOfEquilibriaOfTheEarlierSet) {
  const ScratchFolder scratch;
  auto results = sample::two_results();
  results.front().equilibria.emplace();
  write_results(scratch.path(), sample::two_runs(), results);
  const fs::path table = scratch.path() / "equilibria" / "push_from_Q2-1.csv";
  ASSERT_TRUE(fs::exists(table));
  write_results(scratch.path(), sample::two_runs(), sample::two_results());
  EXPECT_FALSE(fs::exists(table));
}

TEST(WriteResults, RemovesGraphsOfTheEarlierSet) {
  const ScratchFolder scratch;
  put_text(scratch.path() / "graphs/push.gv", "digraph {}");
  put_text(scratch.path() / "manifest.json",
           R"({"program": "springfold", "files": [{"path": "graphs/push.gv"}]})");
  write_results(scratch.path(), sample::two_runs(), sample::two_results());
  EXPECT_FALSE(fs::exists(scratch.path() / "graphs/push.gv"));
}

TEST(WriteResults, RemovesNothingOutsideItsFolderWhateverTheOldManifestSays) {
  const ScratchFolder scratch;
  put_text(scratch.path() / "outside.txt", "keep");
  put_text(scratch.path() / "out" / "deep" / "er" / "a", "keep");
  put_text(scratch.path() / "out" / "manifest.json",
           R"({"program": "springfold", "files": [{"path": "../outside.txt"}, {"path": 3}, 7,
               {"path": "deep/er/a"}, {"path": "branches/../../outside.txt"}]})");
  write_results(scratch.path() / "out", sample::two_runs(), sample::two_results());
  EXPECT_TRUE(fs::exists(scratch.path() / "outside.txt"));
  EXPECT_TRUE(fs::exists(scratch.path() / "out" / "deep" / "er" / "a"));
}

TEST(WriteResults, TakesABrokenOldManifestForNone) {
  const ScratchFolder scratch;
  for (const char* text : {"", "{", "[]", "null", R"({"program": "other", "files": []})",
                           R"({"program": "springfold", "files": 3})"}) {
    put_text(scratch.path() / "manifest.json", text);
    write_results(scratch.path(), sample::two_runs(), sample::two_results());
    EXPECT_EQ(json::parse(text_in(scratch.path() / "manifest.json"))["state"], "whole") << text;
  }
}

TEST(WriteResults, NamesTheFileThatCannotBeWritten) {
  const ScratchFolder scratch;
  put_text(scratch.path() / "branches", "a file where a folder is needed");
  try {
    write_results(scratch.path(), sample::two_runs(), sample::two_results());
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr((scratch.path() / "branches").string()));
  }
}

TEST(WriteResults, SaysInTheManifestWhenItDidNotGetToTheEnd) {
  const ScratchFolder scratch;
  fs::create_directories(scratch.path() / "summary.json" / "in_the_way");
  EXPECT_THROW(write_results(scratch.path(), sample::two_runs(), sample::two_results()),
               std::runtime_error);
  EXPECT_EQ(json::parse(text_in(scratch.path() / "manifest.json"))["state"], "being written");
}

TEST(SummaryJson, HasEveryEventWithItsValuesRatesAndStiffness) {
  const json summary = json::parse(summary_json(sample::two_runs(), sample::two_results()));
  EXPECT_EQ(summary["schema_version"], 1);
  EXPECT_EQ(summary["complete"], true);
  const json& run = summary["runs"][0];
  EXPECT_EQ(run["event_counts"]["LP"], 2);
  EXPECT_EQ(run["start"]["stiffness"], json::parse("[[1.25, -1.0], [-1.0, 1.25]]"));
  EXPECT_TRUE(run["start"]["chain_stiffnesses"]["leg_y"].is_null());
  const json& branch = run["branches"][0];
  EXPECT_EQ(branch["file"], "branches/push_from_Q2-1.csv");
  EXPECT_EQ(branch["forward"]["reason"], "deflection reached its upper limit");
  const json& event = branch["events"][0];
  EXPECT_EQ(event["label"], "LP1");
  EXPECT_NEAR(event["values"]["force"].get<double>(), 0.020238288956, 1e-11);
  EXPECT_TRUE(event["values"]["energy"].is_null());
  EXPECT_EQ(event["stiffness"][0][1], -0.5);
  EXPECT_TRUE(event["rates_before"].contains("force"));
}

TEST(SummaryJson, SaysWhichRunsAreMissing) {
  auto results = sample::two_results();
  results.pop_back();
  const json summary = json::parse(summary_json(sample::two_runs(), results));
  EXPECT_EQ(summary["complete"], false);
  EXPECT_EQ(summary["missing_runs"][0]["run"], 2);
}

TEST(SummaryJson, WritesNamesThatAreNotUtf8WithoutFailing) {
  auto results = sample::two_results();
  results[0].start.message = "\xff\xfe";
  EXPECT_TRUE(json::accept(summary_json(sample::two_runs(), results)));
}

TEST(SummaryTable, MarksWhatIsNotAsItShouldBe) {
  auto results = sample::two_results();
  results[0].start = {.message = "no equilibrium near the guess", .attempts = 16};
  results[0].branches.clear();
  auto& branch = results[1].branches.front();
  branch.forward = {.reason = "step too small", .complete = false};
  branch.events.back().kind = analysis::EventKind::unresolved;
  Case the_case = sample::two_runs();
  the_case.runs.push_back(sample::planned("another", 1, ""));
  const std::string table = summary_table(the_case, results);
  EXPECT_THAT(table, HasSubstr("NOT FOUND after 16 attempts: no equilibrium near the guess"));
  EXPECT_THAT(table, HasSubstr("STOPPED EARLY: step too small"));
  EXPECT_THAT(table, HasSubstr("UNRESOLVED: "));
  EXPECT_THAT(table, HasSubstr("another, run 1\n    NOT RUN"));
}

TEST(SummaryTable, SaysWhereTheIndexChanges) {
  const std::string table = summary_table(sample::two_runs(), sample::two_results());
  EXPECT_THAT(table, HasSubstr("0.02023828896  0 > 1  lambda turns back"));
  EXPECT_THAT(table, HasSubstr("point.x = 0.454 m"));
  EXPECT_THAT(table, HasSubstr("leg_x.drive.rho = 1.345001684 m"));
}

TEST(SummaryTable, ShowsTheEigenvaluesOfTheTablesUnderTheirName) {
  auto results = sample::two_results();
  for (auto& result : results) {
    result.quantities.push_back({"K_eig1", analysis::Unit::stiffness});
    for (auto& branch : result.branches)
      for (auto& sample : branch.samples) sample.values.push_back(0.25);
  }
  EXPECT_THAT(summary_table(sample::two_runs(), results), HasSubstr("K_eig         0.25\n"));
}

Expectations expectations() {
  const std::string study = "push from Q2";
  return {
      .values =
          {{.name = "command",
            .group = "A",
            .study = study,
            .quantity = "leg_x.drive.rho",
            .expected = 1.345,
            .tolerance = 0.0005},
           {.name = "force",
            .group = "B",
            .study = study,
            .run = 2,
            .at = "LP1",
            .quantity = "force",
            .expected = 27.008033908,
            .tolerance = 1e-6,
            .factor = 1000},
           {.name = "end",
            .group = "A",
            .study = study,
            .at = "end",
            .quantity = "point.x",
            .expected = 0.9,
            .tolerance = 1e-12},
           {.name = "folds", .group = "B", .study = study, .quantity = "count.LP", .expected = 2},
           {.name = "branch points",
            .group = "B",
            .study = study,
            .quantity = "count.BP",
            .expected = 0}},
      .notes = {"A long note. " + std::string(120, 'x') + " and more"}};
}

TEST(Compare, FindsStartEndEventsAndCounts) {
  for (const auto& comparison : compare(expectations(), sample::two_results()))
    EXPECT_TRUE(comparison.holds) << comparison.expected.name << ": " << comparison.ours;
}

TEST(Compare, DoesNotHoldWhatDoesNotExist) {
  Expectations expected = expectations();
  expected.values.resize(4);
  expected.values[0].study = "nothing";
  expected.values[1].at = "LP9";
  expected.values[2].quantity = "nothing";
  expected.values[3].run = 9;
  for (const auto& comparison : compare(expected, sample::two_results())) {
    EXPECT_FALSE(comparison.holds) << comparison.expected.name;
    EXPECT_TRUE(std::isnan(comparison.ours)) << comparison.expected.name;
  }
}

TEST(Compare, CountsNothingWithoutAStartPoint) {
  auto results = sample::two_results();
  results[0].start.found = false;
  results[0].branches.clear();
  const auto comparisons = compare(expectations(), results);
  EXPECT_FALSE(comparisons[4].holds) << "no branch points because there is no branch";
}

TEST(ComparisonTable, GroupsValuesAndWrapsNotes) {
  Expectations expected = expectations();
  expected.values[0].expected = 1.4;
  const auto comparisons = compare(expected, sample::two_results());
  const std::string table = comparison_table(comparisons, expected);
  EXPECT_LT(table.find("  A\n"), table.find("  B\n"));
  EXPECT_LT(table.find("end "), table.find("  B\n")) << "all values of a group together";
  EXPECT_THAT(table, HasSubstr("NOT OK"));
  EXPECT_THAT(table, HasSubstr("\n    and more\n"));
  EXPECT_EQ(comparison_table({}, {}), "");
}

TEST(DataDictionary, HasEveryCodeAndEveryFile) {
  const std::string text = text_in(fs::path{SPRINGFOLD_SOURCE_DIR} / "docs" / "results.md");
  for (int kind = 0; kind <= static_cast<int>(analysis::EventKind::unresolved); ++kind) {
    const std::string code = analysis::code_of(static_cast<analysis::EventKind>(kind));
    EXPECT_THAT(text, HasSubstr("| `" + code + "` |"));
  }
  const ScratchFolder scratch;
  write_results(scratch.path(), sample::two_runs(), sample::two_results());
  for (const auto& entry : fs::directory_iterator{scratch.path()}) {
    if (!entry.is_regular_file()) continue;
    EXPECT_THAT(text, HasSubstr("| `" + entry.path().filename().string() + "` |"));
  }
}

}  // namespace
}  // namespace springfold::io
