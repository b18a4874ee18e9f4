// Diagrams whose branches must not depend on the length of the steps.
#include <gmock/gmock.h>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A platform on six springs, loaded from above. At its second branch point the twist about the vertical axis makes
/// branches along which the load hardly changes.
std::string platform_on_six_springs(double step) {
  std::string text = R"toml(
[parameters]
r = 0.6
h0 = 0.8
beta = "8*deg"
d = "sqrt(1 + r^2 - 2*r*cos(beta))"
l0 = "sqrt(d^2 + h0^2)"
yaw = "atan2(r*sin(beta), r*cos(beta) - 1)"
[[body]]
name = "platform"
task_space = "spatial"
pose = [0, 0, "h0", 0, 0, 0]
[[chain]]
name = "leg1"
from_at = { at = [1, 0, 0], rotate = { axis = "z", angle = "yaw" } }
to_at = { at = ["r*cos(beta)", "r*sin(beta)", 0], rotate = { axis = "z", angle = "yaw" } }
elements = [
  { joint = "universal", axes = ["-y", "z"], name = "foot", initial = ["atan2(h0, d)", 0] },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = "l0", spring = { law = "linear", stiffness = 1, free = "l0" } },
  { joint = "spherical", axes = ["y", "z", "x"], name = "head", initial = ["atan2(h0, d)", 0, 0] },
]
)toml";
  for (int leg = 2; leg <= 6; ++leg) {
    const std::string foot = std::to_string(60 * (leg - 1)) + "*deg",
                      head = foot + (leg % 2 == 1 ? " + beta" : " - beta");
    text += "[[spring]]\nname = \"leg" + std::to_string(leg) + "\"\nfrom_at = [\"cos(" + foot +
            ")\", \"sin(" + foot + ")\", 0]\nto = \"platform\"\nto_at = [\"r*cos(" + head +
            ")\", \"r*sin(" + head + ")\", 0]\nstiffness = 1\nfree = \"l0\"\n";
  }
  text += R"toml(
[[study]]
name = "press"
control = "load"
direction = [0, 0, -1, 0, 0, 0]
until = { lambda = [-0.2, 1.5], platform.z = [0.1, 0.9], platform.x = [-0.6, 0.6], platform.y = [-0.6, 0.6], platform.rz = [-1.5, 1.5] }
branches = { depth = 1, maximum = 60 }
)toml";
  return text + "trace = { maximum_step = " + std::to_string(step) +
         ", initial_step = " + std::to_string(step / 5) + ", maximum_points = 40000 }\n";
}

TEST(PlatformOnSixSprings, HasFifteenBranchesWithoutADoubtAtShortAndAtLongSteps) {
  for (const double step : {0.2, 0.0125}) {
    const Ran ran = run(platform_on_six_springs(step));
    EXPECT_THAT(ran.of("press").doubts, IsEmpty()) << step;
    EXPECT_THAT(ran.of("press").branches, SizeIs(15)) << step;
  }
}

}  // namespace
}  // namespace springfold::io
