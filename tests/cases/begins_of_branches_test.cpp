// Where branches begin: they leave their junction once, and have no row of another branch beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "case_runs.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

/// Special points of the same kind nearer than this, in the engine's arc length, are one.
constexpr double same_place = 1e-6;

void expect_no_row_beside_begins(const StudyResult& result) {
  for (const analysis::Branch& branch : result.branches) {
    if (branch.samples.size() < 2 || branch.start_row != 0) continue;
    const double gone = branch.samples[1].values.at(0) - branch.samples[0].values.at(0);
    EXPECT_TRUE(gone > same_place || !branch.samples[1].event.empty()) << gone;
  }
}

TEST(BeginsOfBranches, OfAParallelogramHaveNoRowOfTheBranchThatTheyLeave) {
  const Case read = load_case(SPRINGFOLD_SOURCE_DIR "/cases/rigid-loops/case.toml");
  for (const PlannedRun& planned : read.runs)
    expect_no_row_beside_begins(
        analysis::run_study_after(planned.history, planned.mechanism, planned.plan,
                                  planned.family ? &*planned.family : nullptr));
}

/// Three links between guys, begun anew where the first half-branch leaves: the way back down is no closed curve.
TEST(BeginsOfBranches, AtAKinkLeadToTheEndsOfTheRange) {
  const StudyResult result = run(R"toml(
[[body]]
name = "top"
task_space = "xy"
pose = [0, 3.112]
[[chain]]
name = "col"
elements = [
  { joint = "revolute", axis = "-z", name = "h0", role = "preloaded", spring = { law = "linear", stiffness = 0.0512 } },
  { rigid = [0, 0.926] },
  { joint = "revolute", axis = "-z", name = "h1", role = "preloaded", spring = { law = "linear", stiffness = 0.4278 } },
  { rigid = [0, 1.379] },
  { point = "p1" },
  { joint = "revolute", axis = "-z", name = "h2", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [0], stiffnesses = [13.62, 16.487] } },
  { rigid = [0, 0.807] },
  { point = "p2" },
]
[[spring]]
name = "c0"
from_at = [1.501, "3.112 + 1.269"]
to = "col.p2"
law = { law = "one_sided", stiffness = 3.156, from = "sqrt(1.501^2 + 1.269^2)" }
[[spring]]
name = "c1"
from_at = [0.612, "2.305 - 0.262"]
to = "col.p1"
law = { law = "one_sided", stiffness = 10.1, from = "1.01*sqrt(0.612^2 + 0.262^2)" }
[[spring]]
name = "c2"
from_at = [-0.612, "2.305 - 0.262"]
to = "col.p1"
law = { law = "one_sided", stiffness = 10.1, from = "1.01*sqrt(0.612^2 + 0.262^2)" }
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { lambda = [-4, 12], col.h0 = [-0.6, 0.6], col.h1 = [-0.6, 0.6], col.h2 = [-0.6, 0.6] }
[[study]]
name = "again"
control = "load"
direction = [0, -1]
start = { from = "press", at = "KB1" }
until = { lambda = [-4, 12], col.h0 = [-0.6, 0.6], col.h1 = [-0.6, 0.6], col.h2 = [-0.6, 0.6] }
branches = { depth = 0 }
)toml")
                                 .of("again");
  EXPECT_TRUE(complete(result));
  ASSERT_EQ(result.branches.size(), 3u);
  double lowest = 0, highest = 0;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples) {
      lowest = std::min(lowest, row.values.at(1));
      highest = std::max(highest, row.values.at(1));
    }
  EXPECT_NEAR(lowest, -4, 1e-9);
  EXPECT_NEAR(highest, 12, 1e-9);
}

}  // namespace
}  // namespace springfold::io
