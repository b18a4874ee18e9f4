// Thresholds of paths whose start vanishes, or leaves the limits, at a value of the parameter.
#include <gmock/gmock.h>

#include <string>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;

/// A stable start folds where p is 2.5375; the one that the case has beyond is sprung already.
const std::string two_nodes_whose_start_folds = R"toml([[node]]
name = "n0"
at = [0.1, 0]
[[node]]
name = "n1"
at = [0.6, -0.2]
[[bar]]
name = "b0"
from = "base"
from_at = [-0.4, 0.6]
to = "n0"
stiffness = 1.8
free = 0.9
[[bar]]
name = "b2"
from = "base"
from_at = [-1.1, -0.4]
to = "n0"
stiffness = 0.8
free = 1.2
compression_only = true
[[bar]]
name = "b3"
from = "base"
from_at = [-1, 0.4]
to = "n1"
stiffness = 1.9
free = "p"
[[bar]]
name = "b4"
from = "base"
from_at = [1, -0.3]
to = "n1"
stiffness = 0.3
free = 0.4
[[bar]]
name = "b5"
from = "n0"
to = "n1"
stiffness = 1.5
free = 0.5
[[spring]]
name = "b6"
from = "base"
from_at = [0.4, -0.1]
to = "n0"
stiffness = 0.1
free = 0
[[spring]]
name = "b7"
from = "base"
from_at = [-0.5, -0.3]
to = "n1"
stiffness = 0.1
free = 0
)toml";

const std::string pushed_over = R"toml(body = "n0"
control = "load"
direction = [-0.9, 0.5]
until = { n0.x = [-1.6, 1.6], n0.y = [-1.6, 1.6], lambda = [-0.001, 5] }
)toml";

TEST(FoldingStarts, AThresholdIsWhereThePathBeginsAtAStartFromWhichNothingIsLost) {
  const Ran runs =
      run("[parameters]\np = 1.9\n" + two_nodes_whose_start_folds +
          "[[study]]\nname = \"threshold\"\nkind = \"threshold\"\n" + pushed_over +
          R"toml(threshold = { of = "loss_of_stability", parameter = "p", range = [0.8, 3.5] }
[[study]]
name = "starts"
body = "n0"
control = "parameter"
parameter = "p"
until = { lambda = [1.9, 3.5] }
)toml");
  const auto folds = lambdas(runs.of("starts"), analysis::EventKind::limit_point);
  ASSERT_EQ(folds.size(), 1U);
  const double fold = folds.front();
  ASSERT_NEAR(fold, 2.5375, 1e-4);  // followed by a program of its own
  const auto& found = runs.of("threshold").threshold;
  ASSERT_TRUE(found && found->found);
  EXPECT_NEAR(found->value, fold, 1e-8);
  EXPECT_TRUE(found->verified);
  EXPECT_THAT(found->message, HasSubstr("the start vanishes there"));
}

TEST(FoldingStarts, AThresholdThatTheLimitsHideIsUnresolvedWhereTheyBegin) {
  // The apex of a truss of the height h is pressed down: it snaps whatever h is, but starts above 1 lie outside.
  const auto result =
      run("[parameters]\nh = 0.5\n" + supports_and_apex("apex", "\"h\"") + R"toml([[bar]]
from = "l"
to = "apex"
stiffness = 1
[[bar]]
from = "r"
to = "apex"
stiffness = 1
[[study]]
name = "s"
kind = "threshold"
body = "apex"
control = "load"
direction = [0, -1]
until = { apex.y = [-2, 1] }
threshold = { of = "limit_point", parameter = "h", range = [0.3, 1.3] }
)toml")
          .of("s");
  ASSERT_TRUE(result.threshold);
  EXPECT_FALSE(result.threshold->found);
  EXPECT_THAT(result.threshold->message,
              HasSubstr("unresolved at h = 1: apex.y is 1 at the start"));
  EXPECT_FALSE(complete(result));
}

}  // namespace
}  // namespace springfold::io
