// SIGINT and SIGTERM end everything that takes long within a second, and keep what is finished.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "cli/child.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// A crooked strut that is pressed, and what else is asked of it.
std::string strut(const std::string& press, const std::string& more = "", int bars = 1) {
  std::string chain;
  for (int i = 1; i <= bars; ++i)
    chain += "  { joint = \"revolute\", axis = \"z\", name = \"hinge" + std::to_string(i) +
             "\", role = \"preloaded\", initial = 0.02, spring = { law = \"linear\", stiffness = "
             "1, free = 0.02 } },\n  { rigid = [1, 0] },\n";
  return R"(title = "Crooked strut"
[[body]]
name = "tip"
task_space = "xy"
pose = [)" +
         std::to_string(bars) + R"(, 0]
[[chain]]
name = "strut"
elements = [
)" + chain +
         R"(  { joint = "prismatic", axis = "x", name = "length", role = "virtual", stiffness = 1000 },
]
[[study]]
name = "press"
control = "load"
direction = [-1, 0]
)" + press +
         more;
}

const std::string quick_press = "until = { lambda = [-0.5, 1.8], strut.hinge1 = [-0.2, 2] }\n";

class Interruption : public testing::Test {
 protected:
  /// Starts a case, sends the signal once the run has used so much processor time, and waits.
  int interrupted(const std::string& text, int signal, double after,
                  std::vector<std::string> more = {}) {
    put_text(scratch.path() / "case.toml", text);
    std::vector<std::string> words{"run", "case.toml", "--out", "out", "--no-plots"};
    words.insert(words.end(), more.begin(), more.end());
    Child child{scratch.path(), words};
    child.wait_until_used(after);
    child.send(signal);
    // Within a second of its own; a busy machine gives it less than all of that.
    return child.wait(allowed);
  }

  json summary() const { return json::parse(text_in(scratch.path() / "out" / "summary.json")); }
  std::string messages() const { return text_in(scratch.path() / "err.txt"); }

  void expect_consistent() const {
    const json manifest = json::parse(text_in(scratch.path() / "out" / "manifest.json"));
    EXPECT_EQ(manifest["state"], "interrupted");
    for (const auto& file : manifest["files"])
      EXPECT_TRUE(fs::exists(scratch.path() / "out" / file["path"].get<std::string>()));
    EXPECT_FALSE(fs::exists(scratch.path() / "out" / ".springfold.lock"));
    EXPECT_EQ(summary()["complete"], false);
  }

  static constexpr double allowed = 4;
  ScratchFolder scratch;
};

TEST_F(Interruption, OfASearchKeepsTheStudyBeforeAndWhatWasFound) {
  const std::string search =
      "[[study]]\nname = \"all\"\nkind = \"equilibria\"\nsearch = { starts = 500000 }\n";
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(interrupted(strut(quick_press, search), signal, 1), 128 + signal);
    expect_consistent();
    EXPECT_THAT(messages(), HasSubstr("all, run 1: interrupted"));
    EXPECT_THAT(messages(), HasSubstr("1 of 2 runs are complete"));
    EXPECT_EQ(summary()["runs"][0]["complete"], true);
    EXPECT_EQ(summary()["runs"][1]["complete"], false);
    EXPECT_THAT(summary()["runs"][1]["doubts"].dump(),
                HasSubstr("interrupted: the search ended after"));
    EXPECT_GE(summary()["runs"][1]["equilibria"]["list"].size(), 1u);
  }
}

TEST_F(Interruption, OfACurveKeepsItsPoints) {
  const std::string slow =
      quick_press +
      "trace = { maximum_step = 1e-5, initial_step = 1e-5, maximum_points = 1000000 }\n";
  // Not for long: what has to be written grows with it, and a busy machine has no second for it.
  EXPECT_EQ(interrupted(strut(slow), SIGINT, 0.6), 130);
  expect_consistent();
  EXPECT_THAT(messages(), HasSubstr("press, run 1: interrupted"));
  // On a busy machine there is no time for the table, which is said then.
  const fs::path table = scratch.path() / "out/branches/press-1.csv";
  if (fs::exists(table))
    EXPECT_GE(text_in(table).size(), 1000u);
  else
    EXPECT_THAT(messages(), HasSubstr("there was no time to write"));
}

/// Many stiff point bodies, all joined to one: a matrix that takes seconds to factorise.
std::string large_mechanism(int bodies) {
  std::string text;
  for (int i = 0; i < bodies; ++i) {
    const std::string b = "b" + std::to_string(i);
    text += "[[body]]\nname = \"" + b + "\"\ntask_space = \"xyz\"\n[[chain]]\nname = \"c" +
            std::to_string(i) + "\"\nto = \"" + b + "\"\nelements = [\n";
    for (const char* axis : {"x", "y", "z"})
      text += std::string{"  { joint = \"prismatic\", axis = \""} + axis +
              "\", role = \"virtual\", name = \"" + axis + "\", stiffness = 1 },\n";
    text += "]\n";
  }
  return text +
         "[[study]]\nname = \"push\"\nbody = \"b0\"\ncontrol = \"load\"\ndirection = [1, 0, "
         "0]\nuntil = { lambda = [0, 1] }\n";
}

TEST_F(Interruption, InTheMiddleOfALongStepEndsAllTheSame) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(interrupted(large_mechanism(400), signal, 2), 128 + signal);
    EXPECT_THAT(messages(), HasSubstr("0 of 1 runs are complete"));
    EXPECT_FALSE(fs::exists(scratch.path() / "out" / ".springfold.lock"));
  }
}

TEST_F(Interruption, WhileRowsAreFilledKeepsTheStudyBefore) {
  std::string again = strut(quick_press + "trace = { spacing = 2e-6 }\n");
  again = again.substr(again.find("[[study]]"));
  again.replace(again.find("\"press\""), 7, "\"rows\"");
  EXPECT_EQ(interrupted(strut(quick_press, again), SIGINT, 1.5), 130);
  expect_consistent();
  EXPECT_EQ(summary()["runs"][0]["complete"], true);
  EXPECT_THAT(messages(), HasSubstr("1 of 2 runs are complete"));
}

TEST_F(Interruption, OfACheckThatSolvesForLong) {
  put_text(scratch.path() / "case.toml", large_mechanism(400));
  Child child{scratch.path(), {"check", "case.toml"}};
  child.wait_until_used(1);
  child.send(SIGINT);
  EXPECT_EQ(child.wait(allowed), 130);
}

TEST_F(Interruption, WhileAPipeIsReadWritesNothing) {
  const fs::path pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const char* command : {"run", "check"}) {
    Child child{scratch.path(), {command, "pipe"}};
    child.wait_until_catching(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds{300});
    child.send(SIGINT);
    EXPECT_EQ(child.wait(allowed), 130) << command;
    EXPECT_THAT(messages(), HasSubstr("interrupted while the case was read: nothing was run"));
  }
  EXPECT_FALSE(fs::exists(scratch.path() / "results"));
}

TEST_F(Interruption, WhileSomebodyHoldsAPipeOpenToo) {
  const fs::path pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int writer = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::write(writer, "title = 1\n", 10), 10);
  Child child{scratch.path(), {"check", "pipe"}};
  child.wait_until_catching(SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds{300});
  child.send(SIGTERM);
  EXPECT_EQ(child.wait(allowed), 143);
  ::close(writer);
}

TEST_F(Interruption, NeverComesToAPipeThatIsWritten) {
  ASSERT_EQ(::mkfifo((scratch.path() / "pipe").c_str(), 0600), 0);
  Child child{scratch.path(), {"check", "pipe"}};
  put_text(scratch.path() / "pipe", small_case());
  EXPECT_EQ(child.wait(20), 0) << messages();
}

}  // namespace
}  // namespace springfold::cli
