// springfold verify: many cases at once.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/exit_code.hpp"
#include "cli/outcome.hpp"
#include "cli/run_main.hpp"
#include "cli/small_case.hpp"
#include "cli/verify_command.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder of two cases whose stiffness along x is K = 2.
class Verify : public testing::Test {
 protected:
  Verify() {
    add("one", "2");
    add("two", "2");
  }
  void add(const std::string& name, const std::string& stiffness) {
    fs::create_directories(scratch.path() / name);
    put_text(scratch.path() / name / "case.toml", small_case());
    put_text(scratch.path() / name / "expected.toml",
             "[[value]]\nname = \"K\"\nstudy = \"push\"\nquantity = \"stiffness\"\nexpected = " +
                 stiffness + "\ntolerance = 1e-9\nsource = \"by hand\"\n");
  }
  Outcome run(std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {"springfold", "verify", scratch.path().string()});
    std::vector<const char*> argv;
    for (const auto& word : words) argv.push_back(word.c_str());
    std::ostringstream out, err;
    const int code = run_main(static_cast<int>(argv.size()), argv.data(), out, err);
    return {code, out.str(), err.str()};
  }
  ScratchFolder scratch{};
};

TEST_F(Verify, PrintsOneTableOfAllCasesAndWritesNothing) {
  const Outcome outcome = run();
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 of 2 cases hold, 2 of 2 values"));
  EXPECT_THAT(outcome.out, HasSubstr("by hand"));
  EXPECT_EQ(std::distance(fs::directory_iterator{scratch.path() / "one"}, {}), 2);
}

TEST_F(Verify, EndsWithFiveIfOneValueOfOneCaseDoesNotHold) {
  add("two", "2.1");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.code, partial);
  EXPECT_THAT(outcome.out, HasSubstr("1 of 2 cases hold, 1 of 2 values"));
  EXPECT_THAT(outcome.out, HasSubstr("NOT OK"));
}

TEST_F(Verify, EndsWithFiveIfACaseExpectsNothing) {
  fs::remove(scratch.path() / "two" / "expected.toml");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.code, partial);
  EXPECT_THAT(outcome.out, HasSubstr("NOT OK  two: has no expected values"));
}

TEST_F(Verify, GivesTheSameWhateverTheNumberOfJobs) {
  EXPECT_EQ(run({"--jobs", "1", "--csv"}).out, run({"--jobs", "3", "--csv"}).out);
}

TEST_F(Verify, PrintsJsonForOtherPrograms) {
  const auto printed = nlohmann::json::parse(run({"--json"}).out);
  EXPECT_EQ(printed["holds"], true);
  EXPECT_EQ(printed["cases"][1]["case"], "two");
  EXPECT_EQ(printed["cases"][1]["comparisons"][0]["reference"], 2);
}

TEST_F(Verify, ReportsMistakesOfAllCasesAndRunsNone) {
  for (const char* name : {"one", "two"})
    put_text(scratch.path() / name / "case.toml", small_case("titel = 1\n"));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.code, wrong_case_file);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("one/case.toml:1:1: titel: unknown key"));
  EXPECT_THAT(outcome.err, HasSubstr("two/case.toml:1:1: titel: unknown key"));
}

TEST_F(Verify, SaysWhenThereIsNoCaseOrNoSuchFolder) {
  fs::remove_all(scratch.path() / "one");
  fs::remove_all(scratch.path() / "two");
  EXPECT_EQ(run().code, wrong_usage);
  std::ostringstream out, err;
  const char* words[] = {"springfold", "verify", "/nowhere/case.toml"};
  EXPECT_EQ(run_main(3, words, out, err), wrong_case_file) << err.str();
}

TEST_F(Verify, TakesEveryCaseFileOfAFolderInTheOrderOfTheNames) {
  put_text(scratch.path() / "one" / "case-b.toml", small_case());
  put_text(scratch.path() / "one" / "notes.toml", "");
  EXPECT_THAT(case_files_of({scratch.path()}), ElementsAre(scratch.path() / "one" / "case-b.toml",
                                                           scratch.path() / "one" / "case.toml",
                                                           scratch.path() / "two" / "case.toml"));
}

TEST_F(Verify, UnderstandsItsOptions) {
  EXPECT_EQ(run({"--jobs", "0"}).code, wrong_usage);
  EXPECT_EQ(run({"--json", "--csv"}).code, wrong_usage);
}

}  // namespace
}  // namespace springfold::cli
