#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/outcome.hpp"
#include "cli/run_command.hpp"
#include "cli/run_main.hpp"
#include "cli/selection.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;
using nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// What a run of the program left behind.
/// A folder with the small case; the program's results go to "out" in it.
class Program : public testing::Test {
 protected:
  Program() { put_case(); }
  void put_case(const std::string& first = "", const std::string& last = "") {
    put_text(case_file(), small_case(first, last));
  }
  fs::path case_file() const { return scratch.path() / "case.toml"; }
  fs::path folder() const { return scratch.path() / "out"; }

  /// The whole program in this process.
  Outcome run(std::vector<std::string> words) const {
    words.insert(words.begin(), "springfold");
    std::vector<const char*> argv;
    for (const auto& word : words) argv.push_back(word.c_str());
    std::ostringstream out, err;
    const int code = run_main(static_cast<int>(argv.size()), argv.data(), out, err);
    return {code, out.str(), err.str()};
  }

  Outcome run_case(std::vector<std::string> more = {"--no-plots"}) const {
    std::vector<std::string> words = {"run", case_file().string(), "--out", folder().string()};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  /// The run command with another engine.
  Outcome run_with(
      const RunStudy& engine, std::function<int()> signal = [] { return 0; },
      bool shows_progress = false) const {
    std::ostringstream out, err;
    const Session session{.out = out,
                          .err = err,
                          .shows_progress = shows_progress,
                          .signal = std::move(signal),
                          .run_study = engine};
    const int code =
        run_command({.case_file = case_file(), .folder = folder(), .draws_plots = false}, session);
    return {code, out.str(), err.str()};
  }

  json summary() const { return json::parse(text_in(folder() / "summary.json")); }

  ScratchFolder scratch{};
};

/// A result with one branch of one point.
StudyResult good_result() {
  StudyResult result;
  result.start.found = true;
  result.quantities = {{"s"}, {"index"}};
  analysis::Branch branch;
  branch.samples = {{.values = {0, 0}}};
  branch.forward.reason = branch.backward.reason = "single point";
  result.branches = {branch};
  return result;
}

StudyResult stopped_result(const std::string& reason) {
  StudyResult result = good_result();
  result.branches[0].forward = {.reason = reason, .complete = false};
  return result;
}

TEST_F(Program, RunsACaseAndWritesCompleteResults) {
  const Outcome outcome = run_case();
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("A point on two springs\n\npush, run 1\n"));
  EXPECT_THAT(outcome.out, HasSubstr("rest, run 1"));
  EXPECT_THAT(outcome.err, StartsWith("springfold: curves in " + folder().string()));
  EXPECT_EQ(summary()["complete"], true);
  EXPECT_TRUE(fs::exists(folder() / "branches" / "push-1.csv"));
  EXPECT_TRUE(fs::exists(folder() / "branches" / "rest-1.csv"));
}

TEST_F(Program, PrintsExactlyTheSummaryFileAsJson) {
  const Outcome outcome = run_case({"--no-plots", "--json"});
  EXPECT_EQ(outcome.out, text_in(folder() / "summary.json"));
}

TEST_F(Program, RunsOnlyTheWantedStudies) {
  const Outcome outcome = run_case({"--no-plots", "--study", "rest"});
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_EQ(summary()["runs"].size(), 1u);
  EXPECT_EQ(summary()["complete"], true);
}

TEST_F(Program, TakesParameterValuesFromTheCommandLine) {
  EXPECT_EQ(run_case({"--no-plots", "--set", "K=3*2"}).code, all_done);
  EXPECT_EQ(summary()["runs"][0]["start"]["stiffness"][0][0], 6.0);
  EXPECT_EQ(json::parse(text_in(folder() / "manifest.json"))["overrides"]["K"], "3*2");
}

TEST_F(Program, ReportsMistakesInTheCaseAndWritesNothing) {
  put_case("", "[[study]]\nname = \"x\"\nkind = \"flight\"\ncolour = 3\n");
  const Outcome outcome = run_case();
  EXPECT_EQ(outcome.code, wrong_case_file);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr(case_file().string() + ":"));
  EXPECT_THAT(outcome.err, HasSubstr("colour"));
  EXPECT_THAT(outcome.err, HasSubstr("flight"));
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Program, ReportsWrongUsage) {
  const Outcome outcome = run({"run"});
  EXPECT_EQ(outcome.code, wrong_usage);
  EXPECT_THAT(outcome.err, StartsWith("springfold: "));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST_F(Program, NamesTheNearestStudyWhenThereIsNoSuch) {
  const Outcome outcome = run_case({"--study", "pusch"});
  EXPECT_EQ(outcome.code, wrong_usage);
  EXPECT_EQ(outcome.err,
            "springfold: there is no study \"pusch\", did you mean \"push\"? Studies of this case: "
            "\"push\", \"rest\"\n");
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Program, PrintsHelpAndVersionOnStandardOutput) {
  EXPECT_THAT(run({"--help"}).out, HasSubstr("Examples:"));
  EXPECT_EQ(run({"--help"}).code, all_done);
  EXPECT_THAT(run({"--version"}).out, StartsWith("springfold "));
}

TEST_F(Program, ChecksACaseWithoutWritingAnything) {
  const Outcome outcome = run({"check", case_file().string()});
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("body      tool (xy)"));
  EXPECT_THAT(outcome.out, HasSubstr("leg: base to tool, 0 rigid links"));
  EXPECT_THAT(outcome.out, HasSubstr("slide (prismatic, virtual)"));
  EXPECT_THAT(outcome.out, HasSubstr("2 degrees of freedom"));
  EXPECT_THAT(outcome.out, HasSubstr("push (force_deflection, control mixed), 1 run"));
  EXPECT_EQ(count_files(scratch.path()), 1);
  EXPECT_EQ(run({"check", case_file().string(), "--set", "Q=1"}).code, wrong_case_file);
}

TEST_F(Program, NamesAnElasticLinkOnceInACheck) {
  const auto file =
      std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "cases/segmented-column/case.toml";
  const Outcome outcome = run({"check", file.string(), "--set", "N=2"});
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("joints: link (elastic in Tx Ty Tz Rx Ry Rz)\n"));
}

TEST_F(Program, FindsAnUnwritableFolderBeforeItComputes) {
  for (const std::string& bad : {case_file().string(), std::string{"/proc/nothing/here"}}) {
    bool was_run = false;
    std::ostringstream out, err;
    const Session session{.out = out,
                          .err = err,
                          .signal = [] { return 0; },
                          .run_study =
                              [&](const auto&, const auto&) {
                                was_run = true;
                                return good_result();
                              }};
    EXPECT_EQ(run_command({.case_file = case_file(), .folder = bad}, session), input_output);
    EXPECT_FALSE(was_run);
    EXPECT_THAT(err.str(), HasSubstr("springfold: cannot create folder " + bad));
  }
}

TEST_F(Program, SaysSoWhenStandardOutputDoesNotTakeTheTables) {
  std::ostringstream err;
  std::ostream out{nullptr};  // every write fails
  const Session session{.out = out,
                        .err = err,
                        .signal = [] { return 0; },
                        .run_study = [](const auto&, const auto&) { return good_result(); }};
  const Arguments arguments{.case_file = case_file(), .folder = folder(), .draws_plots = false};
  EXPECT_EQ(run_command(arguments, session), input_output);
  EXPECT_THAT(err.str(), HasSubstr("cannot write to standard output"));
  EXPECT_EQ(summary()["runs"].size(), 2u) << "results are on disk all the same";
}

TEST_F(Program, KeepsResultsAndTellsWhenARunStoppedEarly) {
  const Outcome outcome =
      run_with([](const auto&, const auto&) { return stopped_result("step too small"); });
  EXPECT_EQ(outcome.code, partial);
  EXPECT_THAT(outcome.err, HasSubstr("springfold: push, run 1: stopped early: step too small"));
  EXPECT_EQ(summary()["complete"], false);
}

TEST_F(Program, RunsAllStudiesAndReturnsTheWorstCode) {
  int runs = 0;
  const Outcome outcome = run_with([&](const auto&, const auto&) {
    if (++runs == 2) return stopped_result("step too small");
    StudyResult result;
    result.start.message = "nothing near the guess";
    return result;
  });
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(outcome.code, no_start_point);
  EXPECT_THAT(outcome.err, HasSubstr("no trustworthy start point: nothing near the guess"));
}

TEST_F(Program, CountsAnUnresolvedPointAsPartial) {
  const Outcome outcome = run_with([](const auto&, const auto&) {
    StudyResult result = good_result();
    result.branches[0].events = {{.kind = analysis::EventKind::unresolved, .label = "UR1"}};
    return result;
  });
  EXPECT_EQ(outcome.code, partial);
  EXPECT_THAT(outcome.out, HasSubstr("UNRESOLVED"));
}

TEST_F(Program, TellsWhenAComparedValueDoesNotHold) {
  put_text(scratch.path() / "expected.toml",
           "[[value]]\nname = \"energy\"\nstudy = \"rest\"\nquantity = \"energy\"\n"
           "expected = 1\ntolerance = 0.1\nsource = \"none\"\n");
  put_case("expected = \"expected.toml\"\n");
  const Outcome outcome = run_case();
  EXPECT_EQ(outcome.code, partial) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("NOT OK"));
  EXPECT_THAT(outcome.err, HasSubstr("1 of 1 compared values do not hold"));
}

TEST_F(Program, SaysTheSameOfAStartOutsideOfItsLimitsBeforeAndAfterTheRun) {
  std::string text = small_case();
  const std::string limits = "deflection = [-0.1, 0.3]";
  text.replace(text.find(limits), limits.size(), "deflection = [0.1, 0.3]");
  put_text(case_file(), text);
  EXPECT_EQ(run({"check", case_file().string()}).code, no_start_point);
  const Outcome outcome = run_case();
  EXPECT_EQ(outcome.code, no_start_point);
  EXPECT_THAT(outcome.err, HasSubstr("nothing was traced"));
}

TEST_F(Program, ClosesCleanlyWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const InterruptGuard guard;
    const auto engine = [&](const io::PlannedRun&, const analysis::Observer& observer) {
      EXPECT_TRUE(observer(1, 0.0));
      std::raise(signal);
      EXPECT_FALSE(observer(2, 0.1));
      return stopped_result("stopped on request");
    };
    const Outcome outcome = run_with(engine, InterruptGuard::signal);
    EXPECT_EQ(outcome.code, 128 + signal);
    EXPECT_THAT(outcome.err, HasSubstr("0 of 2 runs are complete"));
    EXPECT_EQ(summary()["complete"], false);
    EXPECT_EQ(summary()["runs"].size(), 1u);
    EXPECT_EQ(summary()["missing_runs"][0]["study"], "rest");
    EXPECT_EQ(json::parse(text_in(folder() / "manifest.json"))["state"], "interrupted");
  }
}

TEST_F(Program, SaysOfAnInterruptedRunThatItsValuesWereNotComputed) {
  put_text(scratch.path() / "expected.toml",
           "[[value]]\nname = \"energy\"\nstudy = \"rest\"\nquantity = \"energy\"\n"
           "expected = 1\ntolerance = 0.1\nsource = \"none\"\n");
  put_case("expected = \"expected.toml\"\n");
  const InterruptGuard guard;
  const auto engine = [&](const io::PlannedRun&, const analysis::Observer&) {
    std::raise(SIGINT);
    return stopped_result("stopped on request");
  };
  const Outcome outcome = run_with(engine, InterruptGuard::signal);
  EXPECT_EQ(outcome.code, 128 + SIGINT);
  EXPECT_THAT(outcome.err, HasSubstr("1 of 1 compared values were not computed (interrupted)"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("do not hold")));
  EXPECT_THAT(outcome.out, HasSubstr("not computed"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("NOT OK")));
}

TEST_F(Program, ShowsProgressOnTerminalsOnly) {
  const auto engine = [](const io::PlannedRun&, const analysis::Observer& observer) {
    for (int points = 1; points <= 40; ++points) observer(points, 0.0);
    return good_result();
  };
  const auto nothing = [] { return 0; };
  EXPECT_THAT(run_with(engine, nothing, false).err, Not(HasSubstr("\r")));
  const std::string shown = run_with(engine, nothing, true).err;
  EXPECT_THAT(shown, HasSubstr("\r\033[K1/2 push: 40 points"));
  EXPECT_THAT(shown, HasSubstr("\r\033[Kspringfold: curves in")) << "the line is gone at the end";
}

TEST_F(Program, TurnsUnexpectedExceptionsIntoAnInternalError) {
  std::ostringstream err;
  std::ostream out{nullptr};
  EXPECT_THROW(out.exceptions(std::ios::badbit), std::ios_base::failure);  // and from now on
  const char* argv[] = {"springfold", "--help"};
  EXPECT_EQ(run_main(2, argv, out, err), internal_error);
  EXPECT_THAT(err.str(), StartsWith("springfold: internal error: "));
}

TEST_F(Program, GivesTheSameFilesFromAnyWorkingFolder) {
  run_case();
  const std::string first = text_in(folder() / "manifest.json");
  const fs::path here = fs::current_path();
  fs::current_path(scratch.path());
  EXPECT_EQ(run({"run", "case.toml", "--out", "out", "--no-plots"}).code, all_done);
  fs::current_path(here);
  EXPECT_EQ(text_in(folder() / "manifest.json"), first);
}

TEST(DefaultFolder, IsNamedAfterTheCase) {
  EXPECT_EQ(default_folder("/a/orthoglide/case.toml"), "results/orthoglide");
  EXPECT_EQ(default_folder("/a/b/strut.toml"), "results/strut");
  EXPECT_EQ(default_folder("/case.toml"), "results/case");
}

TEST(WithStudies, KeepsFiguresAndExpectedValuesOfTheseStudiesOnly) {
  io::Case the_case;
  the_case.runs = {{.study = "a"}, {.study = "b"}, {.study = "a", .run = 2}};
  the_case.plots = {{.name = "both", .curves = {{.study = "a"}, {.study = "b"}}},
                    {.name = "b only", .curves = {{.study = "b"}}}};
  the_case.expected.values = {{.study = "b"}};
  the_case.expected.notes = {"about b"};
  const io::Case chosen = with_studies(the_case, {"a"});
  EXPECT_EQ(chosen.runs.size(), 2u);
  ASSERT_EQ(chosen.plots.size(), 1u);
  EXPECT_EQ(chosen.plots[0].curves.size(), 1u);
  EXPECT_THAT(chosen.expected.values, IsEmpty());
  EXPECT_THAT(chosen.expected.notes, IsEmpty());
  EXPECT_EQ(with_studies(the_case, {}).runs.size(), 3u);
}

}  // namespace
}  // namespace springfold::cli
