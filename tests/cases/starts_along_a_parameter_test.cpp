// Starts of the values of a parameter belong to each other as far as they can be followed; paths that leave a point that is
// followed just before it vanishes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// An arm of length L on a spring of three slopes, the middle one of which falls, and a strut at its tip that pushes below `fr`.
std::string arm(const std::string& parameters, const std::string& study) {
  return "[parameters]\n" + parameters + R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = ["L*cos(t0)", "L*sin(t0)"]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "t", initial = "t0", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = ["t0-b2", "t0-b1"], stiffnesses = ["kd", "kb", "ka"], free = "t0", falling = true } },
  { rigid = ["L", 0] } ]
[[spring]]
name = "c"
from_at = ["x0", "y0"]
to = "tip"
law = { law = "one_sided", stiffness = "ks", from = "fr", side = "below" }
[[study]]
name = "s"
control = "load"
direction = ["cos(psi)", "sin(psi)"]
)toml" + study;
}

const std::string first_arm = R"toml(L = 1.8057
psi = 5.2056
t0 = 0.8717
kb = 0.4272
kd = 1.3774
b1 = 0.4687
b2 = 1.4855
x0 = 1.7732
y0 = 2.0202
ks = 0.5295
fr = 1.4511
)toml";

/// At zero load the strut turns the arm to one stable angle, which moves smoothly with `ka`.
TEST(StartsAlongAParameter, GiveTheSameFirstLoadsWhateverTheCaseBeginsWith) {
  const std::string study = R"toml(kind = "critical_load"
until = { lambda = [-6.53, 6.53], arm.t = [-1.989, 3.811] }
critical_load = { of = "loss_of_stability", parameter = "ka", range = [0.9912, 5.2038], values = 13 }
)toml";
  for (const char* ka : {"ka = 2.478\n", "ka = 1.4\n"}) {
    const auto result = run(arm(ka + first_arm, study)).of("s");
    EXPECT_TRUE(result.doubts.empty()) << ka << result.doubts.front();
    ASSERT_EQ(result.branches.size(), 1u) << ka;
    const analysis::Branch& branch = result.branches.front();
    EXPECT_NEAR(branch.samples.front().values.back(), 0.9912, 1e-12) << ka;
    EXPECT_NEAR(value(result, 0, "lambda"), 0.05076701321, 1e-9) << ka;
    EXPECT_NEAR(branch.samples.back().values.back(), 1.670046013, 1e-8) << ka;
  }
}

/// Where the load acts along the arm at its start the straight path has a branch point: on one side of that direction the arm turns
/// to its limit point, on the other one away from it.
TEST(Threshold, IsTheDirectionInWhichThePathLeavesItsLimitPoint) {
  const auto result = run(arm(R"toml(L = 1.3337
psi = 5.0754
t0 = 2.4097
ka = 2.6759
kb = 0.6022
kd = 3.204
b1 = 0.4664
b2 = 1.6216
x0 = 0.2818
y0 = 1.7628
ks = 1.5669
fr = 0.93
)toml",
                              R"toml(kind = "threshold"
until = { lambda = [-6.171, 6.171], arm.t = [-0.4903, 5.3097] }
threshold = { of = "limit_point", parameter = "psi", range = [3.8754, 6.3754], value = "largest" }
)toml"))
                          .of("s");
  ASSERT_TRUE(result.threshold.has_value());
  EXPECT_TRUE(result.threshold->found);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_NEAR(result.threshold->value, 2.4097 + std::numbers::pi, 1e-9);
  EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
}

}  // namespace
}  // namespace springfold::io
