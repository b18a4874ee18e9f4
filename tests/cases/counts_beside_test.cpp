// The number of unstable modes beside special points stands in the files, not on the screen alone.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case_runs.hpp"
#include "io/result_access.hpp"
#include "io/result_tables.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;

/// A rigid strut on a torsion spring under a dead load: one mode becomes unstable at the branch point lambda = 1.
const std::string pressed_strut =
    "[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = \"strut\"\n"
    "elements = [ { joint = \"revolute\", axis = \"z\", name = \"foot\", role = \"preloaded\", "
    "initial = \"90*deg\", spring = { law = \"linear\", stiffness = 1, free = \"90*deg\" } }, { "
    "rigid = [1, 0] } ]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\n"
    "until = { lambda = [-0.5, 1.5] }\n";

TEST(CountsBesideSpecialPoints, StandInTheSummaryAndInTheTableOfEvents) {
  const auto ran = run(pressed_strut);
  const auto summary = nlohmann::json::parse(summary_json(ran.read, ran.results));
  int points = 0;
  for (const auto& event : summary["runs"][0]["branches"][0]["events"]) {
    if (event["code"] != "BP") continue;
    ++points;
    EXPECT_EQ(event["counts_before"]["index"], 0);
    EXPECT_EQ(event["counts_after"]["index"], 1);
    EXPECT_EQ(event["counts_before"]["index_force"], 0);
    EXPECT_EQ(event["counts_after"]["index_force"], 1);
  }
  EXPECT_EQ(points, 1);
  const std::string table = events_csv(ran.read, ran.results);
  EXPECT_THAT(table, HasSubstr(",index_before,index_after,"));
}

/// A mast on a universal joint, pressed upright: one axis has a spring with a kink, two cables rest at its top. The
/// pieces' eigenvalues pass zero one by one, outside of their cones too, where nothing happens to the mast.
const std::string mast_with_cables_at_rest = R"(
[[body]]
name = "top"
task_space = "xyz"
pose = [0, 0, 1.0]
[[chain]]
name = "m"
elements = [
{ joint = "revolute", axis = "x", name = "j0", role = "preloaded", spring = { law = "linear", stiffness = 2000.0 } },
{ joint = "revolute", axis = "y", name = "j1", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [0], stiffnesses = [1500.0, 2500.0] } },
{ rigid = [0, 0, 1.0] }, { point = "p0" },
]
[[spring]]
name = "c0"
from_at = [-0.8805257853912482, -0.47399825027221937, 0]
to = "m.p0"
law = { law = "one_sided", stiffness = 1000.0, from = 1.4142135623730951 }
[[spring]]
name = "c1"
from_at = [0.4899417871163775, -0.8717551521139466, 0]
to = "m.p0"
law = { law = "one_sided", stiffness = 300.0, from = 1.4142135623730951 }
[[study]]
name = "press"
control = "load"
direction = [0, 0, -1]
until = { lambda = [-600, 3400] }
)";

TEST(CountsBesideSpecialPoints, OfSpringsAtRestAreAtLeastOneAndTheFilesHaveTheCountsOfThePieces) {
  const auto ran = run(mast_with_cables_at_rest);
  const analysis::StudyResult& result = ran.of("press");
  const analysis::Branch& branch = result.branches.at(0);
  const auto index = *column_of(result, "index");
  // It falls where j1 is negative and c1 is stretched: stiffnesses of both axes with that of the cable, 300/2 along (q,
  // p).
  const double p = 0.4899417871163775, q = 0.8717551521139466, a = 2000 + 150 * q * q,
               b = 1500 + 150 * p * p;
  const double falls = (a + b) / 2 - std::hypot((a - b) / 2, 150 * p * q);
  for (const analysis::Sample& row : branch.samples) {
    EXPECT_TRUE(row.rests);
    if (!row.event.empty()) continue;
    EXPECT_EQ(row.values[index] > 0, row.values[1] > falls) << row.values[1];
  }
  const std::string table = summary_table(ran.read, ran.results);
  EXPECT_THAT(table, HasSubstr("0 > >= 1"));
  const auto line =
      table.substr(table.find("EP2 "), table.find('\n', table.find("EP2 ")) - table.find("EP2 "));
  EXPECT_THAT(line, HasSubstr(">= 1"));
  EXPECT_THAT(branch_csv(result, branch), HasSubstr("index_largest,piece,event"));
  const auto summary = nlohmann::json::parse(summary_json(ran.read, ran.results));
  int largest = 0;
  for (const auto& rows : summary["runs"][0]["branches"][0]["resting"])
    largest = std::max(largest, rows["most_unstable"].get<int>());
  EXPECT_EQ(largest, 2);
}

}  // namespace
}  // namespace springfold::io
