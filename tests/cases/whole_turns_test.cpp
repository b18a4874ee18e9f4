// Joints that turn for ever under a constant moment: states that are the same but for whole turns, of different energy.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::SnapVerdict;
using analysis::StudyResult;
using analysis::TransitionReport;
using std::numbers::pi;

std::string pendulum(const std::string& name, double x) {
  return "[[body]]\nname = \"" + name + "\"\ntask_space = \"planar\"\npose = [" +
         std::to_string(x) + ", -1, 0]\nmass = 1\n[[chain]]\nname = \"rod_" + name + "\"\nto = \"" +
         name + "\"\nfrom_at = [" + std::to_string(x) +
         ", 0]\nelements = [ { joint = \"revolute\", axis = \"z\", name = \"pivot\", initial = "
         "\"-90*deg\" }, { rigid = { at = [1, 0], rotate = { axis = \"z\", angle = \"90*deg\" } } "
         "} ]\n";
}

StudyResult under_a_moment(const std::string& mechanism, const std::string& keys) {
  return run("gravity = [0, -1]\n" + mechanism +
             "[[study]]\nname = \"turn\"\nbody = \"a\"\ncontrol = \"load\"\n"
             "direction = [0, 0, 1]\nuntil = { lambda = [-2, 2] }\n" +
             keys)
      .of("turn");
}

/// Pi = -cos a - M a: rests at sin a = M, saddles half a turn farther.
TEST(WholeTurns, OfAPendulumAreOneStateWithABarrierToEachSide) {
  const double M = 0.3, rest = std::asin(M);
  const StudyResult result = under_a_moment(
      pendulum("a", 0), "kind = \"transitions\"\ntransitions = { barriers_at = [0.3] }\n");
  const TransitionReport& report = result.snap->transitions.value();
  ASSERT_EQ(report.states.size(), 1U);
  EXPECT_TRUE(report.energy_counts_turns);
  ASSERT_EQ(report.barriers.size(), 1U);
  EXPECT_EQ(report.barriers[0].first, 1);
  EXPECT_EQ(report.barriers[0].second, 1);
  EXPECT_NEAR(report.barriers[0].from_first, 2 * std::cos(rest) - M * (pi - 2 * rest), 1e-11);
  EXPECT_NEAR(report.barriers[0].from_second, 2 * std::cos(rest) + M * (pi + 2 * rest), 1e-11);
  ASSERT_EQ(report.escapes.size(), 1U);
  EXPECT_NEAR(report.escapes[0].energy, report.barriers[0].from_first, 1e-15);
}

/// At M = 1 the moment is that of the weight once in every turn, and larger everywhere else.
TEST(WholeTurns, AreGoneThroughForEverBeyondTheLimitMoment) {
  const StudyResult result = under_a_moment(pendulum("a", 0), "kind = \"snap_through\"\n");
  ASSERT_EQ(result.snap->jumps.size(), 2U);
  for (const auto& jump : result.snap->jumps) {
    EXPECT_NEAR(std::abs(value(result, result.branches[0].events[0].row, "lambda")), 1, 1e-10);
    EXPECT_EQ(jump.verdict, SnapVerdict::runs_away) << jump.from;
  }
  EXPECT_TRUE(analysis::complete(result));
}

/// A spring joins the bobs weakly: each has its own turns, and the search comes to an end.
TEST(WholeTurns, OfTwoPendulumsJoinedByASpringAreSearchedToAnEnd) {
  const StudyResult result =
      under_a_moment(pendulum("a", 0) + pendulum("b", 1) +
                         "[[spring]]\nname = \"s\"\nfrom = \"a\"\nto = \"b\"\nstiffness = 0.3\n"
                         "free = 0.5\n",
                     "kind = \"transitions\"\ntransitions = { barriers_at = [0.2], starts = 8 }\n");
  const TransitionReport& report = result.snap->transitions.value();
  EXPECT_THAT(report.states.size(), testing::AllOf(testing::Ge(1U), testing::Le(8U)));
  for (const auto& barrier : report.barriers) EXPECT_GT(barrier.from_first, 0);
}

TEST(WholeTurns, GraphsOfAStartOutsideOfTheRangeSaySo) {
  const StudyResult result =
      run("gravity = [0, -1]\n" + pendulum("a", 0) +
          "[[study]]\nname = \"turn\"\nkind = \"transitions\"\ncontrol = \"load\"\n"
          "direction = [0, 0, 1]\nuntil = { lambda = [0.2, 0.5] }\n")
          .of("turn");
  EXPECT_FALSE(result.snap->transitions);
  EXPECT_THAT(result.snap->refusals,
              testing::ElementsAre(testing::HasSubstr("outside of the study's range")));
  EXPECT_FALSE(analysis::complete(result));
}

/// A crank on a spring is turned by a moment: from its limit point on nothing holds it, the limit point itself a turn
/// farther least of all.
TEST(WholeTurns, OfACrankEndAtNoLimitPointATurnFarther) {
  const StudyResult result = run(R"toml(
[[body]]
name = "p"
task_space = "planar"
[[chain]]
name = "c"
to = "p"
elements = [{ joint = "revolute", axis = "z", name = "j" }]
[[spring]]
name = "s"
from = "base"
from_at = [1.04, 0.465]
to = "p"
to_at = [0.592, 0]
law = { law = "linear", stiffness = 4.63, free = 0.51 }
[[study]]
name = "s"
kind = "snap_through"
control = "load"
direction = [0, 0, 1]
until = { lambda = [-20, 20], p.phi = [-7, 7] }
)toml")
                                 .of("s");
  ASSERT_EQ(result.snap->jumps.size(), 2U);
  for (const auto& jump : result.snap->jumps)
    EXPECT_EQ(jump.verdict, SnapVerdict::runs_away) << jump.from;
  EXPECT_TRUE(analysis::complete(result)) << testing::PrintToString(result.doubts);
}

}  // namespace
}  // namespace springfold::io
