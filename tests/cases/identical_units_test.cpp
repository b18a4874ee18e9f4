// Equal bistable units in series: branches on which units stand in different states, and what is constant along them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// Three of them, each with the force u^3 - 3 u^2 + 2.5 u + more u^4.
std::string three_units(const std::string& more, const std::string& study) {
  return R"toml(
[[node]]
repeat = { i = [0, 2] }
name = "n{i}"
at = ["1 + i", 0]
fixed = ["y"]
[[bar]]
name = "b0"
from = "base"
to = "n0"
law = { law = "polynomial", coefficients = [0, 2.5, -3, 1, )toml" +
         more + R"toml(], falling = true }
[[bar]]
repeat = { i = [1, 2] }
name = "b{i}"
from = "n{i-1}"
to = "n{i}"
law = { law = "polynomial", coefficients = [0, 2.5, -3, 1, )toml" +
         more + R"toml(], falling = true }
[[study]]
name = "s"
body = "n2"
direction = [1, 0]
until = { n2.x = [2.1, 9.6] }
)toml" + study;
}

double slope(double u, double more) { return 2.5 + u * (-6 + u * (3 + 4 * more * u)); }

/// Units with a falling force in a row: so many modes are unstable under dead load in a chain.
int falling_units(const analysis::StudyResult& result, const analysis::Branch& branch,
                  std::size_t row, double more) {
  const auto at = [&](const char* name) {
    return branch.samples[row].values[column(result, name)];
  };
  const double u[] = {at("n0.x") - 1, at("n1.x") - at("n0.x") - 1, at("n2.x") - at("n1.x") - 1};
  return static_cast<int>(std::count_if(std::begin(u), std::end(u),
                                        [&](double each) { return slope(each, more) < 0; }));
}

TEST(IdenticalUnits, ChangeTheirStabilityUnderDeadLoadOnTheirOwnBranches) {
  constexpr double more = 0.05;
  const auto result =
      run(three_units("0.05", "control = \"mixed\"\nbranches = { depth = 1 }\n")).of("s");
  ASSERT_GT(result.branches.size(), 3u);
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Event& event : branch.events) {
      if (event.kind != analysis::EventKind::stability_change) continue;
      // The state belongs to the branch: not all three units are stretched alike on one that has left the first.
      EXPECT_EQ(branch.samples[event.row].values[column(result, "index_force")],
                falling_units(result, branch, event.row, more));
      EXPECT_NE(&branch, &result.branches[1]) << event.detail;
    }
}

TEST(IdenticalUnits, OnTheThreeRootsOfTheirLawTheDeflectionIsConstantAndTurnsNowhere) {
  const auto result =
      run(three_units("0", "control = \"load\"\nbranches = { depth = 2 }\n")).of("s");
  std::size_t constant = 0;
  for (const analysis::Branch& branch : result.branches) {
    const auto& first = branch.samples.front().values;
    const auto x = column(result, "n2.x");
    const auto same = [&](const analysis::Sample& row) {
      return std::abs(row.values[x] - first[x]) < 1e-9;
    };
    if (branch.samples.size() < 3 ||
        !std::all_of(branch.samples.begin(), branch.samples.end(), same))
      continue;
    ++constant;
    for (const analysis::Event& event : branch.events)
      EXPECT_NE(event.kind, analysis::EventKind::stability_change) << event.detail;
  }
  EXPECT_GT(constant, 0u);
}

}  // namespace
}  // namespace springfold::io
