// Thresholds whose range begins at a value that alone has a critical point: a perfect strut among tilted ones.
#include <gtest/gtest.h>

#include <string>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

/// The torque of the hinge is q + d q^3; upright the strut branches at lambda = 1.
analysis::StudyResult tilts_without_loss(const std::string& d, const std::string& range) {
  return run(strut_on_hinge("{ law = \"polynomial\", coefficients = [0, 1, 0, " + d +
                            "], falling = true }") +
             R"toml([[study]]
name = "s"
kind = "threshold"
control = "load"
direction = ["sin(e)", "-cos(e)"]
until = { lambda = [-0.2, 1.4], s.q = [-1.5, 1.5] }
threshold = { of = "loss_of_stability", parameter = "e", )toml" +
             range + " }\n")
      .of("s");
}

TEST(ThresholdsAtOneValue, AreThatValueWhereTheBranchPointIsSupercritical) {
  for (const std::string range : {"range = [0, 0.1]", "range = [-0.1, 0], value = \"largest\""}) {
    SCOPED_TRACE(range);
    const auto result = tilts_without_loss("1", range);
    ASSERT_TRUE(result.threshold && result.threshold->found);
    EXPECT_EQ(result.threshold->value, 0);
    EXPECT_TRUE(result.threshold->verified);
    EXPECT_TRUE(result.doubts.empty());
    ASSERT_EQ(result.branches.size(), 1U);
    EXPECT_NEAR(value(result, 0, "lambda"), 1, 1e-12);
  }
}

}  // namespace
}  // namespace springfold::io
