// Thresholds of paths whose start vanishes, or leaves the limits, at a value of the parameter.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "case_runs.hpp"
#include "number_text.hpp"
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

/// Two nodes on bars, drawn at random. The start has several sheets over p.
const std::string start_of_three_sheets = R"toml([[node]]
name = "n0"
at = [-0.585, 0.087]
[[node]]
name = "n1"
at = [0.249, -0.097]
[[bar]]
name = "b0"
from = "base"
from_at = [0.354, 0.459]
to = "n0"
stiffness = 1.491
free = 0.956
[[bar]]
name = "b1"
from = "base"
from_at = [1.235, -0.514]
to = "n0"
stiffness = 0.664
free = "p"
[[bar]]
name = "b2"
from = "base"
from_at = [0.944, 0.156]
to = "n1"
stiffness = 0.928
free = 0.845
[[bar]]
name = "b3"
from = "base"
from_at = [-0.344, 0.775]
to = "n1"
stiffness = 0.608
free = 0.963
[[bar]]
name = "b4"
from = "n0"
to = "n1"
stiffness = 1.972
free = 0.837
[[spring]]
name = "b5"
from = "base"
from_at = [0.314, 0.045]
to = "n0"
stiffness = 0.085
free = 0
[[spring]]
name = "b6"
from = "base"
from_at = [0.310, 0.348]
to = "n1"
stiffness = 0.057
free = 0
)toml";

/// The same; between 1.682 and 1.741 nothing is lost, for the path leaves its limits before.
const std::string window_without_loss = R"toml([[node]]
name = "n0"
at = [-0.676, -0.067]
[[node]]
name = "n1"
at = [0.338, -0.058]
[[bar]]
name = "b0"
from = "base"
from_at = [0.095, 1.140]
to = "n0"
stiffness = 1.710
free = 1.538
[[bar]]
name = "b1"
from = "base"
from_at = [0.322, 1.107]
to = "n0"
stiffness = 0.970
free = "p"
[[bar]]
name = "b2"
from = "base"
from_at = [-1.060, -0.182]
to = "n1"
stiffness = 0.790
free = 1.432
[[bar]]
name = "b3"
from = "base"
from_at = [1.178, 0.660]
to = "n1"
stiffness = 1.971
free = 0.892
[[bar]]
name = "b4"
from = "n0"
to = "n1"
stiffness = 1.065
free = 0.928
[[spring]]
name = "b5"
from = "base"
from_at = [0.180, 0.368]
to = "n0"
stiffness = 0.063
free = 0
[[spring]]
name = "b6"
from = "base"
from_at = [0.026, 0.382]
to = "n1"
stiffness = 0.057
free = 0
)toml";

std::string pulled(const std::string& p, const std::string& network, const std::string& direction) {
  return "[parameters]\np = " + p + "\n" + network +
         "[[study]]\nname = \"s\"\nbody = \"n0\"\ncontrol = \"load\"\ndirection = " + direction +
         "\nuntil = { n0.x = [-1.6, 1.6], n0.y = [-1.6, 1.6], lambda = [-1e-9, 5] }\n";
}

bool has_limit_point(double p, const std::string& network, const std::string& direction) {
  const Ran runs = run(pulled(number(p), network, direction));
  const auto loads = lambdas(runs.of("s"), analysis::EventKind::limit_point);
  return std::any_of(loads.begin(), loads.end(), [](double lambda) { return lambda > 0; });
}

TEST(FoldingStarts, AThresholdAgreesWithRunsAtSingleValues) {
  const std::pair<std::string, std::string> nets[]{{start_of_three_sheets, "[-0.711, -0.703]"},
                                                   {window_without_loss, "[0.377, 0.926]"}};
  for (const auto& [network, direction] : nets) {
    const Ran runs = run(pulled("1.75", network, direction) + R"toml(kind = "threshold"
threshold = { of = "loss_of_stability", parameter = "p", range = [0.7, 3.5], value = "largest" }
)toml");
    const auto& threshold = runs.of("s").threshold;
    ASSERT_TRUE(threshold && threshold->found) << direction;
    EXPECT_TRUE(threshold->verified);
    EXPECT_TRUE(has_limit_point(threshold->value + 1e-4, network, direction)) << direction;
    EXPECT_FALSE(has_limit_point(threshold->value - 1e-4, network, direction)) << direction;
  }
}

TEST(FoldingStarts, AThresholdIsWhereFirstCriticalLoadsBegin) {
  const std::pair<std::string, std::string> nets[]{{start_of_three_sheets, "[-0.711, -0.703]"},
                                                   {window_without_loss, "[0.377, 0.926]"}};
  for (const auto& [network, direction] : nets) {
    const std::string range = "of = \"loss_of_stability\", parameter = \"p\", range = [0.7, 3.5]";
    const Ran one =
        run(pulled("1.75", network, direction) + "kind = \"threshold\"\nthreshold = { " + range +
            ", value = \"largest\" }\n");
    const Ran all =
        run(pulled("1.75", network, direction) + "kind = \"critical_load\"\ncritical_load = { " +
            range + ", values = 15 }\n");
    EXPECT_TRUE(complete(all.of("s")));
    double nearest = 1;
    for (const analysis::Branch& branch : all.of("s").branches)
      for (const auto* end : {&branch.samples.front(), &branch.samples.back()})
        nearest = std::min(nearest, std::abs(end->values.back() - one.of("s").threshold->value));
    EXPECT_LT(nearest, 1e-8) << direction;
  }
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
