// Branch points of several modes at once, and parameters that part them.
#include <gmock/gmock.h>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A bar on a universal joint, K = diag(c1 - lambda, c2 - lambda): branch points at c1 and at c2, at 1 both at once.
std::string bar_on_universal_joint(const std::string& study) {
  return "[parameters]\nc1 = 1\nc2 = 1\nc = 1\n[[body]]\nname = \"tip\"\ntask_space = "
         "\"xyz\"\npose = [0, 0, "
         "1]\n[[chain]]\nname = \"bar\"\nelements = [ { joint = \"revolute\", axis = \"x\", name = "
         "\"a\", role = "
         "\"preloaded\", spring = { law = \"linear\", stiffness = \"c*c1\" } }, { joint = "
         "\"revolute\", axis = "
         "\"y\", name = \"b\", role = \"preloaded\", spring = { law = \"linear\", stiffness = "
         "\"c*c2\" } }, { "
         "rigid = [0, 0, 1] } ]\n[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = [0, 0, "
         "-1]\nuntil = { "
         "lambda = [-0.1, 3] }\n" +
         study;
}

TEST(PartedModes, HaveNoCurveOfTheirMeanLoad) {
  const analysis::StudyResult result =
      run(bar_on_universal_joint("kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", "
                                 "parameter = \"c1\", range = [0.5, 2] }\n"))
          .of("s");
  EXPECT_FALSE(complete(result));
  for (const auto& branch : result.branches) {
    EXPECT_THAT(branch.forward.reason, testing::HasSubstr("parts the modes"));
    for (const auto& sample : branch.samples)
      EXPECT_NEAR(sample.values[column(result, "lambda")], 1, 1e-9);
  }
}

TEST(PartedModes, StayTogetherInAParameterThatMovesBoth) {
  const analysis::StudyResult result =
      run(bar_on_universal_joint("kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", "
                                 "parameter = \"c\", range = [0.5, 2] }\n"))
          .of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  for (const auto& sample : samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], sample.values[column(result, "c")], 1e-10);
}

}  // namespace
}  // namespace springfold::io
