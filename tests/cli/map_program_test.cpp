// Maps by the program: threads, interruption and going on.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <csignal>
#include <sstream>

#include "cli/run_command.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

int shell(const std::string& line) {
  const std::string command = "SPRINGFOLD='" SPRINGFOLD_PROGRAM "'; " + line;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// A point on two sliders with elastic drives.
std::string map_case(int points) {
  return R"([[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "a"
elements = [ { joint = "prismatic", axis = "x", name = "d", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "-z", name = "k", role = "preloaded", spring = { law = "one_sided", stiffness = 0.5, from = 0.2 } }, { rigid = [-1, 0] } ]
[[chain]]
name = "b"
elements = [ { joint = "prismatic", axis = "y", name = "d", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "k" }, { rigid = [0, -1] } ]
[[study]]
name = "m"
kind = "map"
axes = [ { pose = "x", from = -0.6, to = 1.1, points = )" +
         std::to_string(points) + R"( }, { pose = "y", from = -0.6, to = 1.1, points = )" +
         std::to_string(points) + R"( } ]
critical = { direction = [1, 1], up_to = 0.1 }
)";
}

class MapProgram : public testing::Test {
 protected:
  int run(const std::string& options, const std::string& more = "") const {
    return shell("cd '" + scratch.path().string() + "' && " + more +
                 "\"$SPRINGFOLD\" run case.toml --no-plots " + options + " > out.txt 2> err.txt");
  }
  std::string table(const std::string& folder) const {
    return text_in(scratch.path() / folder / "branches/m-1.csv");
  }
  ScratchFolder scratch{};
};

TEST_F(MapProgram, WritesTheSameBytesWithAnyNumberOfThreads) {
  put_text(scratch.path() / "case.toml", map_case(12));
  ASSERT_EQ(run("--out one --threads 1"), 0);
  ASSERT_EQ(run("--out two --threads 2"), 0);
  ASSERT_EQ(run("--out eight --threads 8"), 0);
  const std::string one = table("one");
  EXPECT_GT(one.size(), 10000u);
  EXPECT_EQ(one, table("two"));
  EXPECT_EQ(one, table("eight"));
  EXPECT_EQ(text_in(scratch.path() / "one/summary.json"),
            text_in(scratch.path() / "eight/summary.json"));
}

TEST_F(MapProgram, InterruptedKeepsWhatIsDoneAndResumesToTheSameBytes) {
  put_text(scratch.path() / "case.toml", map_case(24));
  ASSERT_EQ(run("--out whole"), 0);
  // The signal comes when the first nodes are done, however fast the machine is.
  bool interrupted = false;
  const RunMap until_some_are_done = [&](const io::PlannedRun& planned,
                                         const analysis::Observer& observe,
                                         const analysis::RunOptions& options) {
    const auto watch = [&](int point, double done) {
      interrupted = done > 0;
      return observe(point, done);
    };
    return analysis::run_study(planned.mechanism, planned.plan, nullptr, watch, options);
  };
  std::ostringstream out, err;
  const Session session{.out = out,
                        .err = err,
                        .signal = [&] { return interrupted ? SIGINT : 0; },
                        .run_map = until_some_are_done};
  const Arguments arguments{.case_file = scratch.path() / "case.toml",
                            .folder = scratch.path() / "part",
                            .threads = 1,
                            .draws_plots = false};
  ASSERT_EQ(run_command(arguments, session), 128 + SIGINT) << err.str();
  EXPECT_THAT(table("part"), testing::HasSubstr("not computed"));
  EXPECT_NE(table("part"), table("whole"));
  ASSERT_EQ(run("--out part --resume"), 0);
  EXPECT_EQ(table("part"), table("whole"));
  EXPECT_THAT(text_in(scratch.path() / "err.txt"), testing::HasSubstr("nodes are known already"));
}

TEST_F(MapProgram, RefusesAThreadCountOfZero) {
  put_text(scratch.path() / "case.toml", map_case(3));
  EXPECT_EQ(run("--threads 0"), 2);
}

}  // namespace
}  // namespace springfold::cli
