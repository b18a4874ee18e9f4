// States and rows that belong to a curve which is known: told once, and on it.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

/// Two nodes on three bars and three cables. At both ends of a stretch of lambda two states, bent this way and that,
/// meet in a straight one, which hands back to both: four states in all.
const std::string bent_twice = R"(
[[node]]
name = "n0"
at = [-0.31,0.09]
[[node]]
name = "n1"
at = [0.4,0.35]
[[node]]
name = "f0"
at = [-1.0,0.0]
fixed = true
[[node]]
name = "f1"
at = [1.0,0.19]
fixed = true
[[node]]
name = "f2"
at = [-0.19,1.04]
fixed = true
[[node]]
name = "f3"
at = [0.28,-1.12]
fixed = true
[[bar]]
name = "b0"
from = "f0"
to = "n0"
free = 0.7
stiffness = 2.08
[[bar]]
name = "b1"
from = "n0"
to = "n1"
free = 0.8
stiffness = 1.01
[[bar]]
name = "b2"
from = "n1"
to = "f1"
free = 0.65
stiffness = 1.12
[[bar]]
name = "b3"
from = "n0"
to = "f2"
free = 0.75
stiffness = 0.23
tension_only = true
[[bar]]
name = "b4"
from = "n0"
to = "f3"
free = 1.22
stiffness = 0.31
tension_only = true
[[bar]]
name = "b6"
from = "n1"
to = "f3"
free = 1.46
stiffness = 1.65
tension_only = true
[[study]]
name = "tr"
kind = "transitions"
body = "n0"
control = "load"
direction = [0.1,-1]
until = {lambda=[-0.42,0.42],n0.x=[-2.5,2.5],n0.y=[-2.5,2.5],n1.x=[-2.5,2.5],n1.y=[-2.5,2.5]}
)";

TEST(GraphOfStates, KnowsAStateAgainBesideThePointWhereItIsHandedBack) {
  const auto result = run(bent_twice).of("tr");
  ASSERT_TRUE(complete(result));
  ASSERT_TRUE(result.snap && result.snap->transitions);
  const auto& states = result.snap->transitions->states;
  EXPECT_EQ(states.size(), 4u);
  EXPECT_EQ(result.snap->transitions->transitions.size(), 8u);
  EXPECT_TRUE(result.snap->jumps.empty());
}

/// Two nodes on four bars, three of which act on one side alone. Towards the end of its range a bar becomes so short
/// that its direction turns within a step, and what is interpolated between its ends is poor.
const std::string shrinking = R"(
[[node]]
name = "n0"
at = [-0.3463,0.6198]
[[node]]
name = "n1"
at = [0.1171,0.1876]
[[node]]
name = "f0"
at = [-1.0,0.0]
fixed = true
[[node]]
name = "f1"
at = [1.0,-0.0815]
fixed = true
[[node]]
name = "f2"
at = [-0.2805,1.2769]
fixed = true
[[node]]
name = "f3"
at = [0.1151,-1.2334]
fixed = true
[[bar]]
name = "b0"
from = "f0"
to = "n0"
free = 0.8985
stiffness = 0.9441
[[bar]]
name = "b1"
from = "n0"
to = "n1"
free = 0.6311
stiffness = 0.7036
[[bar]]
name = "b2"
from = "n1"
to = "f1"
free = 0.9223
stiffness = 2.2621
[[bar]]
name = "b3"
from = "n0"
to = "f2"
free = 0.5864
stiffness = 0.0375
[[bar]]
name = "b4"
from = "n0"
to = "f3"
free = 1.8355
stiffness = 1.2556
compression_only = true
[[bar]]
name = "b5"
from = "n1"
to = "f2"
free = 0.9845
stiffness = 0.043
compression_only = true
[[bar]]
name = "b6"
from = "n1"
to = "f3"
free = 1.4202
stiffness = 1.0895
tension_only = true
[[study]]
name = "s"
body = "n0"
control = "load"
direction = [-0.3187,-0.9478]
until = {b0.length=[0.0001,inf],lambda=[-1.5,1.5],n0.x=[-2,2],n0.y=[-2,2],n1.x=[-2,2],n1.y=[-2,2]}
trace = { spacing = 0.002 }
)";

TEST(RowsBetween, LieOnTheirStepWhereABarBecomesShort) {
  const auto result = run(shrinking).of("s");
  ASSERT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  const auto s = static_cast<std::size_t>(column(result, "s"));
  int rows = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double way = samples[i].values[s] - samples[i - 1].values[s];
    ++rows;
    EXPECT_GE(way, 0);
    EXPECT_LT(way, 0.0021) << "a row is missing before s = " << samples[i].values[s];
    for (const char* place : {"n0.x", "n0.y", "n1.x", "n1.y"}) {
      const auto k = static_cast<std::size_t>(column(result, place));
      EXPECT_LT(std::abs(samples[i].values[k] - samples[i - 1].values[k]), 4 * way + 1e-9)
          << place << " at s = " << samples[i].values[s];
    }
  }
  EXPECT_GT(rows, 1000);
}

}  // namespace
}  // namespace springfold::io
