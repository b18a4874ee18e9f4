// The program on cases that ask for more than one branch: words and exit codes.
#include <gmock/gmock.h>

#include <sstream>

#include "cli/exit_code.hpp"
#include "cli/outcome.hpp"
#include "cli/run_main.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Two links on two hinge springs under an axial load: two branch points.
std::string column(const std::string& last) {
  return R"([[body]]
name = "tip"
task_space = "xy"
pose = [2, 0]
[[chain]]
name = "column"
elements = [
  { joint = "revolute", axis = "z", name = "a", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "b", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.2, 3], column.a = [-1, 1] }
)" + last;
}

class DiagramProgram : public testing::Test {
 protected:
  Outcome run(const std::string& text) const {
    put_text(scratch.path() / "case.toml", text);
    const std::string file = (scratch.path() / "case.toml").string();
    const std::string folder = (scratch.path() / "out").string();
    const std::vector<const char*> argv{"springfold", "run",          file.c_str(),
                                        "--out",      folder.c_str(), "--no-plots"};
    std::ostringstream out, err;
    const int code = run_main(static_cast<int>(argv.size()), argv.data(), out, err);
    return {code, out.str(), err.str()};
  }

  ScratchFolder scratch{};
};

TEST_F(DiagramProgram, WithoutBranchesSaysWhatItDidNotFollow) {
  const Outcome outcome = run(column(""));
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("not followed, branches.depth = 0: what crosses at BP1, BP2"));
  EXPECT_THAT(outcome.out, HasSubstr("nothing is claimed about branches that are not connected"));
}

TEST_F(DiagramProgram, WritesOneTableForEveryBranch) {
  const Outcome outcome = run(column("branches = { depth = 1 }\n"));
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("begins at BP2 of branch 1"));
  EXPECT_TRUE(fs::exists(scratch.path() / "out/branches/press-1.csv"));
  EXPECT_TRUE(fs::exists(scratch.path() / "out/branches/press-1-5.csv"));
  EXPECT_FALSE(fs::exists(scratch.path() / "out/branches/press-1-6.csv"));
}

TEST_F(DiagramProgram, SaysWhatItsSearchFound) {
  const Outcome outcome = run(column("branches = { depth = 1, search_at = [0.1] }\n"));
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("search at lambda = 0.1: "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("nothing is claimed")));
}

TEST_F(DiagramProgram, EndsWithFourWhenTheStartMovesTooFar) {
  const Outcome outcome = run(column("load = [0, 0.05]\nstart = { maximum_move = 0.01 }\n"));
  EXPECT_EQ(outcome.code, no_start_point);
  EXPECT_THAT(outcome.err, HasSubstr("farther than start.maximum_move = 0.01"));
}

TEST_F(DiagramProgram, SaysHowFarTheStartMoved) {
  const Outcome outcome = run(column("load = [0, 0.05]\n"));
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(") from the guess, whose residual is 0.0"));
}

TEST_F(DiagramProgram, FollowsAllWaysFromAStartOnABranchPoint) {
  // The straight column under its first critical load, (3 - sqrt(5))/2.
  const Outcome outcome = run(column("load = [\"-(3 - sqrt(5))/2\", 0]\n"));
  EXPECT_EQ(outcome.code, all_done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the start is a branch point: 4 ways"));
  EXPECT_THAT(outcome.out, HasSubstr("begins at BP1 of branch 1"));
}

TEST_F(DiagramProgram, ChecksACaseAndSaysWhatItWillTrace) {
  put_text(scratch.path() / "case.toml", column("branches = { depth = 2, search_at = [0.1] }\n"));
  const std::string file = (scratch.path() / "case.toml").string();
  const std::vector<const char*> argv{"springfold", "check", file.c_str()};
  std::ostringstream out, err;
  EXPECT_EQ(run_main(static_cast<int>(argv.size()), argv.data(), out, err), all_done);
  EXPECT_THAT(out.str(), HasSubstr("press (force_deflection, control load, branches to depth 2, "
                                   "searches at 1 value of lambda), 1 run"));
}

TEST_F(DiagramProgram, GivesTheSameBytesTwice) {
  const std::string text = column("branches = { depth = 2, search_at = [0.1, 1] }\n");
  run(text);
  const std::string first = text_in(scratch.path() / "out/summary.json");
  run(text);
  EXPECT_EQ(first, text_in(scratch.path() / "out/summary.json"));
}

}  // namespace
}  // namespace springfold::cli
