// The number of unstable modes beside special points stands in the files, not on the screen alone.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "case_runs.hpp"
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

}  // namespace
}  // namespace springfold::io
