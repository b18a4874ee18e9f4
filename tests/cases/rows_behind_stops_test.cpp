// Rows that lie behind the threshold of a stiff spring by less than places are promised to: a bar of length 1 on a foot
// between stops, under a dead load P,
//     M(q) = P sin q,   K = M'(q) - P cos q.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;

/// Stiffness 1 between the stops.
StudyResult bar_between_stops(double stiffness, double angle, double last_load) {
  return run("[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = "
             "\"mast\"\nelements = [{ joint = \"revolute\", axis = \"z\", name = \"foot\", role = "
             "\"preloaded\", spring = { law = \"stops\", stiffness = 1, stop_stiffness = " +
             number(stiffness) + ", low = " + number(-angle) + ", high = " + number(angle) +
             " } }, { rigid = [0, 1] }]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\n"
             "direction = [0, -1]\nuntil = { lambda = [-1, " +
             number(last_load) + "] }\nbranches = { depth = 1 }\n")
      .of("press");
}

TEST(RowsBehindStiffStops, HaveTheIndexOfThePieceInWhichTheStopActs) {
  struct Stop {
    double stiffness = 0, angle = 0, last_load = 0;
  };
  // Behind the stop the bar turns by (P - 1) angle / stiffness: all of these are less than 1e-10 on the last ways.
  for (const Stop& stop : {Stop{1e5, 1e-5, 2.5}, Stop{1e5, 1e-5, 1.9}, Stop{1e3, 1e-6, 1.05},
                           Stop{1e5, 1e-4, 1.05}, Stop{3e5, 1e-4, 1.2}}) {
    SCOPED_TRACE(testing::Message() << stop.stiffness << ", " << stop.angle);
    const StudyResult result = bar_between_stops(stop.stiffness, stop.angle, stop.last_load);
    EXPECT_TRUE(complete(result));
    ASSERT_EQ(result.branches.size(), 3u);
    for (std::size_t b = 1; b < 3; ++b) {
      const Branch& bent = result.branches[b];
      const auto at_stop = std::find_if(bent.events.begin(), bent.events.end(), [](const auto& e) {
        return e.kind == EventKind::switching;
      });
      ASSERT_NE(at_stop, bent.events.end());
      // Before it the bar stands in a supercritical pitchfork, stable; behind it K = stiffness - P cos q + 1.
      for (std::size_t i = 0; i < bent.samples.size(); ++i)
        for (const char* count : {"index", "index_force", "index_driven"})
          EXPECT_EQ(value(result, bent, i, count), 0) << count << " in row " << i;
    }
  }
}

TEST(RowsBehindStiffStops, AreThoseOfTautCablesWhereCablesWereSlackByAMillionth) {
  // Cables that act behind their thresholds only hold the bent bar: 0 in all rows of the bent branches.
  std::string text =
      "[[body]]\nname = \"n\"\ntask_space = \"planar\"\npose = [0, 1, 0]\n[[chain]]\nname = "
      "\"mast\"\nto = \"n\"\nelements = [{ joint = \"revolute\", axis = \"z\", role = "
      "\"preloaded\", name = \"foot\", spring = { law = \"linear\", stiffness = 1 } }, { rigid = "
      "[0, 1] }]\n";
  for (const double side : {-1.0, 1.0})
    text += "[[spring]]\nname = \"" + std::string(side < 0 ? "left" : "right") + "\"\nfrom_at = [" +
            number(side) +
            ", 0]\nto = \"n\"\nlaw = { law = \"one_sided\", stiffness = 1e4, from = " +
            number(std::sqrt(2.0) * (1 + 1e-6)) + " }\n";
  const StudyResult result =
      run(text +
          "[[study]]\nname = \"press\"\nbody = \"n\"\ncontrol = \"load\"\ndirection = [0, "
          "-1, 0]\nuntil = { lambda = [0, 2] }\nbranches = { depth = 1 }\n")
          .of("press");
  ASSERT_EQ(result.branches.size(), 3u);
  for (std::size_t i = 0; i < result.branches[0].samples.size(); ++i) {
    const double load = value(result, i, "lambda");
    if (std::abs(load - 1) < 1e-9) continue;
    EXPECT_EQ(value(result, i, "index"), load < 1 ? 0 : 1) << "row " << i;
  }
  for (std::size_t b = 1; b < 3; ++b)
    for (std::size_t i = 0; i < result.branches[b].samples.size(); ++i)
      EXPECT_EQ(value(result, result.branches[b], i, "index"), 0)
          << "row " << i << " of branch " << b + 1;
}

}  // namespace
}  // namespace springfold::io
