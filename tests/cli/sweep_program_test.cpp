// Many runs by the program: one table on all cores, and going on after the program was killed.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cmath>
#include <sstream>
#include <thread>

#include "cli/child.hpp"
#include "cli/ranks.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A strut of length 1 on a hinge spring k, with c along itself: it buckles at c/2 (1 - sqrt(1 - 4 k/c)).
std::string varied_strut(const std::string& vary, const std::string& more = "",
                         double limit = 1.5) {
  return R"([parameters]
k = 1
c = 10
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "foot", role = "virtual", stiffness = "k" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = "c" },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.1, ")" +
         std::to_string(limit) + R"(*k"] }
)" + more +
         "vary = { " + vary + " }\n";
}

const std::string table =
    R"(table = [{ name = "P", at = "BP1", quantity = "lambda" }, { quantity = "count.BP" }])";
const std::string grid = "grid = { k = { from = 1, to = 2, points = 6 }, c = [12, 16, 20] }, ";

class SweepProgram : public testing::Test {
 protected:
  void put(const std::string& text) const { put_text(scratch.path() / "case.toml", text); }
  int run(const std::string& options) const {
    const std::string line = "cd '" + scratch.path().string() +
                             "' && '" SPRINGFOLD_PROGRAM "' run case.toml --no-plots " + options +
                             " > out.txt 2> err.txt";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string text(const std::string& file) const { return text_in(scratch.path() / file); }
  /// All files of a folder of results but times, with their names.
  std::string bytes(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(scratch.path() / folder))
      if (entry.is_regular_file() && entry.path().filename() != "timings.json")
        files[fs::relative(entry.path(), scratch.path() / folder).string()] = text_in(entry.path());
    std::string all;
    for (const auto& [name, content] : files) all += name + "\n" + content;
    return all;
  }
  ScratchFolder scratch{};
};

/// Fields of the lines of a CSV table without quotes, the header left out.
std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines{csv};
  for (std::string line; std::getline(lines, line);) {
    auto& row = rows.emplace_back();
    std::istringstream fields{line};
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

TEST_F(SweepProgram, HasTheCriticalLoadOfEveryRunInOneTable) {
  put(varied_strut(grid + table + ", curves = false"));
  ASSERT_EQ(run("--out out"), 0) << text("err.txt");
  const auto rows = rows_of(text("out/sweeps/press.csv"));
  ASSERT_EQ(rows.size(), 18U);
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 6U);
    const double k = std::stod(row[1]), c = std::stod(row[2]);
    EXPECT_NEAR(std::stod(row[3]), c / 2 * (1 - std::sqrt(1 - 4 * k / c)), 1e-9 * k);
    EXPECT_EQ(row[4], "1");
    EXPECT_EQ(row[5], "complete");
  }
  EXPECT_TRUE(fs::is_empty(scratch.path() / "out/branches"));
  EXPECT_THAT(text("out.txt"), HasSubstr("press, 18 runs over k, c"));
  EXPECT_THAT(text("out.txt"), HasSubstr("18 of 18, table sweeps/press.csv"));
}

TEST_F(SweepProgram, SaysThatASetValueIsNotUsedWhereTheStudyVariesIt) {
  put(varied_strut(R"(parameter = "k", values = [1, 2])"));
  ASSERT_EQ(run("--out out --quiet --set k=3"), 0) << text("err.txt");
  EXPECT_THAT(text("err.txt"),
              HasSubstr("--set k=3 has no effect in \"press\": the study's own values of k"));
  ASSERT_EQ(run("--out out --quiet --set c=12"), 0);
  EXPECT_EQ(text("err.txt"), "");
  put(varied_strut(R"(parameter = "k", values = [1, 2])", "set = { c = 11 }\n"));
  ASSERT_EQ(run("--out out --quiet --set c=12"), 0) << text("err.txt");
  EXPECT_THAT(text("err.txt"), HasSubstr("--set c=12 has no effect in \"press\""));
}

TEST_F(SweepProgram, WritesTheSameBytesWithAnyNumberOfThreads) {
  put(varied_strut(grid + table));
  ASSERT_EQ(run("--out one --threads 1"), 0);
  ASSERT_EQ(run("--out eight --threads 8"), 0);
  EXPECT_EQ(bytes("one"), bytes("eight"));
}

TEST_F(SweepProgram, HasTheSameTableWithAndWithoutCurves) {
  put(varied_strut(grid + table));
  ASSERT_EQ(run("--out with"), 0);
  put(varied_strut(grid + table + ", curves = false"));
  ASSERT_EQ(run("--out without"), 0);
  EXPECT_EQ(text("with/sweeps/press.csv"), text("without/sweeps/press.csv"));
  EXPECT_TRUE(fs::exists(scratch.path() / "with/branches/press-18.csv"));
}

TEST_F(SweepProgram, KilledGoesOnToTheSameBytes) {
  // Small steps, so that there is time to kill it.
  put(varied_strut("grid = { k = { from = 1, to = 2, points = 20 }, c = [12, 16] }, " + table +
                       ", curves = false",
                   "trace = { initial_step = 1e-3, maximum_step = 1e-3 }\n"));
  ASSERT_EQ(run("--out whole"), 0);
  const fs::path checkpoint = scratch.path() / "part/.checkpoint-press-rows";
  {
    Child child{scratch.path(),
                {"run", "case.toml", "--out", "part", "--no-plots", "--threads", "1"}};
    for (int i = 0; i < 60000 && !fs::exists(checkpoint); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{1});
    child.send(SIGKILL);
    EXPECT_EQ(child.wait(20), 128 + SIGKILL) << "it was over before it was killed";
  }
  ASSERT_TRUE(fs::exists(checkpoint));
  ASSERT_EQ(run("--out part --resume"), 0);
  EXPECT_THAT(text("err.txt"),
              testing::ContainsRegex("press: [0-9]+ of 40 runs are known already"));
  EXPECT_EQ(bytes("part"), bytes("whole"));
}

TEST_F(SweepProgram, DoesNotTakeRowsOfAnotherCase) {
  put(varied_strut(grid + table + ", curves = false"));
  ASSERT_EQ(run("--out out"), 0);
  put_text(scratch.path() / "out/.checkpoint-press-rows",
           "springfold rows 1 0 0 press\n1\t1\t1\tx\nend\n");
  ASSERT_EQ(run("--out out --resume"), 0);
  EXPECT_THAT(text("err.txt"), testing::Not(HasSubstr("known already")));
}

TEST_F(SweepProgram, SaysHowManyRunsAreNotComplete) {
  put(varied_strut(grid + table + ", curves = false", "trace = { maximum_points = 3 }\n"));
  EXPECT_EQ(run("--out out"), 5);
  EXPECT_THAT(text("err.txt"), HasSubstr("press: 18 runs are not complete: see the column status"));
  const auto rows = rows_of(text("out/sweeps/press.csv"));
  ASSERT_EQ(rows.size(), 18U);
  EXPECT_THAT(text("out/sweeps/press.csv"), HasSubstr("stopped early: "));
  EXPECT_EQ(rows[7][3], "") << "there is no BP1";
}

TEST_F(SweepProgram, ComparesExpectedValuesOfRunsWithoutCurves) {
  put(varied_strut("list = { k = [1, 2], c = [8, 16] }, " + table + ", curves = false"));
  const std::string value =
      "[[value]]\nname = \"P\"\nstudy = \"press\"\nrun = 2\nat = \"BP1\"\nquantity = "
      "\"lambda\"\ntolerance = 1e-9\nexpected = \"c/2*(1 - sqrt(1 - 4*k/c))\"\n";
  put_text(scratch.path() / "expected.toml", value);
  EXPECT_EQ(run("--out out"), 0) << text("out.txt");
  put_text(scratch.path() / "expected.toml", value + "factor = 2\n");
  EXPECT_EQ(run("--out out"), 5);
}

/// Several processes on this machine, as many as it takes, also for root.
const std::string mpirun =
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
    "OMPI_MCA_mpi_yield_when_idle=1 mpirun ";

bool has_mpirun() {
  static const bool works =
      Ranks::are_built_in() && std::system((mpirun + "-n 2 true > /dev/null 2>&1").c_str()) == 0;
  return works;
}

class SweepOfProcesses : public SweepProgram {
 protected:
  void SetUp() override {
    if (!has_mpirun())
      GTEST_SKIP() << "needs a program with MPI, and an mpirun that starts processes";
  }
  int run_many(int processes, const std::string& options) const {
    const std::string line =
        "cd '" + scratch.path().string() + "' && " + mpirun + "-n " + std::to_string(processes) +
        " '" SPRINGFOLD_PROGRAM "' run case.toml --no-plots " + options + " > out.txt 2> err.txt";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

TEST_F(SweepOfProcesses, FourWriteTheSameBytesAsOne) {
  put(varied_strut(grid + table + ", curves = false"));
  ASSERT_EQ(run("--out one"), 0);
  ASSERT_EQ(run_many(4, "--out four"), 0) << text("err.txt");
  EXPECT_EQ(bytes("one"), bytes("four"));
  EXPECT_EQ(rows_of(text("four/sweeps/press.csv")).size(), 18U);
}

TEST_F(SweepOfProcesses, LeaveRunsWithCurvesToOne) {
  put(varied_strut(grid + table));
  ASSERT_EQ(run("--out one"), 0);
  ASSERT_EQ(run_many(3, "--out three"), 0) << text("err.txt");
  EXPECT_EQ(bytes("one"), bytes("three"));
}

TEST_F(SweepOfProcesses, KilledGoOnToTheSameBytesWithAnotherNumber) {
  put(varied_strut("grid = { k = { from = 1, to = 2, points = 20 }, c = [12, 16] }, " + table +
                       ", curves = false",
                   "trace = { initial_step = 1e-3, maximum_step = 1e-3 }\n"));
  ASSERT_EQ(run("--out whole"), 0);
  // As soon as there is a checkpoint all processes are killed: they are the children of mpirun.
  put_text(scratch.path() / "kill.sh",
           mpirun + "-n 3 '" SPRINGFOLD_PROGRAM
                    "' run case.toml --no-plots --out part > out.txt 2> err.txt &\n"
                    "until [ -e part/.checkpoint-press-rows ]; do sleep 0.01; done\n"
                    "kill -KILL $(cat /proc/$!/task/$!/children)\nwait $!\n");
  const std::string line = "cd '" + scratch.path().string() + "' && bash kill.sh 2> /dev/null";
  EXPECT_NE(std::system(line.c_str()), 0);
  ASSERT_TRUE(fs::exists(scratch.path() / "part/.checkpoint-press-rows"));
  ASSERT_EQ(run_many(2, "--out part --resume"), 0) << text("err.txt");
  EXPECT_THAT(text("err.txt"),
              testing::ContainsRegex("press: [0-9]+ of 40 runs are known already"));
  EXPECT_EQ(bytes("part"), bytes("whole"));
}

TEST_F(SweepOfProcesses, SayOnceWhatIsWrongWithTheCase) {
  put(varied_strut("grid = { kk = [1, 2] }, " + table));
  EXPECT_NE(run_many(3, "--out out"), 0);
  const std::string said = text("err.txt");
  const std::string message = "no parameter \"kk\"";
  const std::size_t first = said.find(message);
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find(message, first + 1), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(scratch.path() / "out"));
}

}  // namespace
}  // namespace springfold::cli
