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
