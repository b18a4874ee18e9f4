// A study that asks for it has its arcs tested: how much of every branch is shown to be one curve.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A rigid strut on a torsion spring under a dead load: the straight branch passes the branch point lambda = 1.
std::string strut(const std::string& trace) {
  return "[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [0, 1]\n"
         "[[chain]]\nname = \"strut\"\nelements = [{ joint = \"revolute\", axis = \"z\", name = "
         "\"foot\", "
         "role = \"preloaded\", initial = \"90*deg\", spring = { law = \"linear\", stiffness = 1, "
         "free = "
         "\"90*deg\" } }, { rigid = [1, 0] }]\n"
         "[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\nuntil = { lambda = "
         "[-0.5, 1.5] }\n" +
         trace;
}

TEST(VerifiedArcs, OfAStudyCoverItsBranchThroughTheBranchPoint) {
  const auto ran = run(strut("trace = { verify_arcs = true }\n"));
  const analysis::Branch& branch = ran.of("press").branches.at(0);
  ASSERT_TRUE(branch.arcs);
  EXPECT_NEAR(
      branch.arcs->length,
      value(ran.of("press"), branch.samples.size() - 1, "s") - value(ran.of("press"), 0, "s"),
      1e-9);
  EXPECT_GT(branch.arcs->share(), 0.99);
  EXPECT_THAT(summary_table(ran.read, ran.results), HasSubstr("verified as one curve"));
  EXPECT_THAT(summary_json(ran.read, ran.results), HasSubstr("\"verified\""));
}

TEST(VerifiedArcs, AreNotTestedUnlessTheStudyAsks) {
  const auto ran = run(strut(""));
  EXPECT_FALSE(ran.of("press").branches.at(0).arcs);
  EXPECT_THAT(summary_table(ran.read, ran.results), Not(HasSubstr("verified as one curve")));
}

/// Two bistable units in a row: the graph of their stable states.
constexpr const char* two_units = R"([[body]]
name = "end"
task_space = "xy"
pose = [-2.4, 0]
[[chain]]
name = "row"
elements = [
  { point = "p0" },
  { joint = "prismatic", axis = "x", name = "u1", role = "virtual", initial = -1.2, spring = { law = "linear", stiffness = 0.3, free = 0.1 } },
  { point = "p1" },
  { joint = "prismatic", axis = "x", name = "u2", role = "virtual", initial = -1.2, spring = { law = "linear", stiffness = 0.3, free = -0.1 } },
  { point = "p2" },
]
[[spring]]
name = "o1"
from = "row.p0"
from_at = [0, 1]
to = "row.p1"
stiffness = 1
free = 1.9
[[spring]]
name = "o2"
from = "row.p1"
from_at = [0, 1]
to = "row.p2"
stiffness = 1
free = 2.1
[[study]]
name = "pull"
kind = "transitions"
control = "load"
direction = [1, 0]
until = { lambda = [-0.6, 0.6] }
trace = { verify_arcs = true }
transitions = { search_at = [0] }
)";

TEST(VerifiedArcs, AreThoseOfStableStretchesTooWhichEndWhereTheyLoseTheirStability) {
  const auto ran = run(two_units);
  const auto& branches = ran.of("pull").branches;
  ASSERT_GE(branches.size(), 4u);
  for (const analysis::Branch& branch : branches) {
    ASSERT_TRUE(branch.arcs);
    EXPECT_GT(branch.arcs->share(), 0.95);
  }
}

TEST(VerifiedArcs, ChangeNothingElse) {
  const auto plain = run(strut("")), verified = run(strut("trace = { verify_arcs = true }\n"));
  const auto &a = plain.of("press").branches.at(0), &b = verified.of("press").branches.at(0);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    for (std::size_t k = 0; k < a.samples[i].values.size(); ++k)
      if (!std::isnan(a.samples[i].values[k])) {
        EXPECT_EQ(a.samples[i].values[k], b.samples[i].values[k]);
      }
}

}  // namespace
}  // namespace springfold::io
