// Designs of two equal units that lose their stiffness together: the limit point of their load is a branch point, too.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "number_text.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

/// Two units in a row, each with the force u^3 - 3 h u^2 + (2 h^2 + 0.25) u. Its slope is least where u = h, and 0.25 -
/// h^2 there: limit points merge at h = 0.5, a length. Up to h = 0.9 all limit loads are less than 0.4.
const std::string two_units = R"toml(
[parameters]
h = 0.8
[[node]]
repeat = { i = [0, 1] }
name = "n{i}"
at = ["1 + i", 0]
fixed = ["y"]
[[bar]]
from = "base"
to = "n0"
law = { law = "polynomial", coefficients = [0, "0.25 + 2*h^2", "-3*h", 1], falling = true }
[[bar]]
from = "n0"
to = "n1"
law = { law = "polynomial", coefficients = [0, "0.25 + 2*h^2", "-3*h", 1], falling = true }
[[study]]
name = "s"
kind = "design"
body = "n1"
direction = [1, 0]
until = { n1.x = [2, 7] }
)toml";

/// The largest force before the slope is zero, at u = h - ((h^2 - 0.25)/3)^(1/2).
double limit_load(double h) {
  const double u = h - std::sqrt((h * h - 0.25) / 3);
  return u * (2 * h * h + 0.25 + u * (u - 3 * h));
}

analysis::StudyResult design_of_units(const std::string& control, const std::string& range,
                                      const std::string& wanted) {
  return run(two_units + "control = \"" + control +
             "\"\n[study.design]\nparameters = { h = " + range + " }\n" + wanted + "\n")
      .of("s");
}

TEST(EqualUnitsDesign, HasNoLimitPointBeforeALoadThatNoLimitPointReachesWhereThoseMerge) {
  // Such designs are one part in forty of the range.
  for (const std::string control : {"load", "mixed"})
    for (
        const std::string wanted :
        {R"(critical_load = { at_least = 0.6, index = "dead_load", quantity = "force" })",
         R"(critical_load = { at_least = 0.6, of = "loss_of_stability", index = "dead_load", quantity = "force" })",
         R"(no_limit_point = { up_to = 0.6, index = "dead_load", quantity = "force" })"}) {
      SCOPED_TRACE(control + ": " + wanted);
      const auto result = design_of_units(control, "[0.49, 0.9]", wanted);
      ASSERT_TRUE(result.design);
      EXPECT_EQ(result.design->status, analysis::DesignStatus::met) << result.design->message;
      EXPECT_NEAR(result.design->parameters[0].after, 0.5, 1e-9);
      EXPECT_TRUE(result.design->verified);
      EXPECT_TRUE(result.doubts.empty());
    }
}

TEST(EqualUnitsDesign, RaisesTheLimitLoadWhereThatIsNearer) {
  const auto result = design_of_units(
      "load", "[0.49, 0.9]", "critical_load = { at_least = " + number(limit_load(0.85)) + " }");
  ASSERT_TRUE(result.design);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met) << result.design->message;
  EXPECT_NEAR(result.design->parameters[0].after, 0.85, 1e-9);
  EXPECT_TRUE(result.design->verified);
}

TEST(EqualUnitsDesign, CannotBeMetWhereNeitherTheLoadNorTheMergingIsWithinTheBounds) {
  const auto result = design_of_units("load", "[0.51, 0.9]", "critical_load = { at_least = 0.6 }");
  ASSERT_TRUE(result.design);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::cannot_be_met);
  EXPECT_NEAR(result.design->parameters[0].after, 0.9, 1e-9);
}

TEST(EqualUnitsDesign, IsMetAtTheStartWhereTheDrivenDisplacementAloneMayNotTurnBack) {
  const auto result = design_of_units("mixed", "[0.6, 0.9]", "no_limit_point = {}");
  ASSERT_TRUE(result.design);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met_at_start) << result.design->message;
  EXPECT_TRUE(result.design->verified);
}

}  // namespace
}  // namespace springfold::io
