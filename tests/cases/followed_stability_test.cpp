// Changes of stability under dead load, while the pose is held: followed over a parameter as other special points are.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "small_structures.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

/// Two bars of stiffness 1, half span 1, height 3, and a spring kh that holds the apex sideways; driven in x and y.
std::string driven_truss(const std::string& kh, const std::string& study) {
  return "[parameters]\nkh = " + kh + "\n" + two_bars_of_height(3) + R"toml([[chain]]
name = "sway"
elements = [
  { joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "linear", stiffness = "kh" } },
  { joint = "prismatic", axis = "y", name = "y", initial = 3 },
]
[[study]]
name = "s"
control = "pose"
direction = [0, -1]
until = { lambda = [-0.05, 2.9] }
)toml" + study;
}

/// At the height y: r^2 = 1 + y^2, the force 2 y (l/r - 1), and the stiffness sideways 2 (1 - l/r + l/r^3) + kh is 0.
struct Sway {
  double y = 0;
  double r() const { return std::hypot(1, y); }
  double force() const { return 2 * y * (std::sqrt(10.0) / r() - 1); }
  double stiffness() const {
    const double l = std::sqrt(10.0);
    return -2 * (1 - l / r() + l / (r() * r() * r()));
  }
};

/// The height, on the way down from 3, at which the function falls below zero.
template <class Function>
double height_where(const Function& below, double low) {
  double high = 3;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (below(Sway{middle}) ? low : high) = middle;
  }
  return low;
}

TEST(FollowedStability, OfAHeldPoseIsACurveOverTheSpringThatHoldsItSideways) {
  const StudyResult result =
      run(driven_truss("0.1",
                       "kind = \"critical_curve\"\ncritical_curve = { of = \"SC1\", "
                       "parameter = \"kh\", range = [0.02, 0.4] }\n"))
          .of("s");
  EXPECT_TRUE(complete(result));
  const analysis::Branch& branch = result.branches.at(0);
  ASSERT_GT(branch.samples.size(), 4u);
  for (std::size_t row = 0; row < branch.samples.size(); ++row) {
    const Sway at{3 - value(result, row, "lambda")};
    EXPECT_NEAR(at.stiffness(), value(result, row, "kh"), 1e-9);
    EXPECT_NEAR(at.force(), value(result, row, "force"), 1e-9);
  }
}

TEST(FollowedStability, OfAHeldPoseMeetsADesign) {
  const double wanted = 1.6;
  const Sway there{height_where([&](const Sway& at) { return at.force() > wanted; }, 2)};
  const StudyResult result =
      run(driven_truss("0.1",
                       "kind = \"design\"\ndesign = { parameters = { kh = [0.05, 2] }, "
                       "critical_load = { at_least = 1.6, of = \"loss_of_stability\", index "
                       "= \"dead_load\", quantity = \"force\" } }\n"))
          .of("s");
  EXPECT_TRUE(complete(result));
  ASSERT_TRUE(result.design);
  EXPECT_NEAR(analysis::design_value(*result.design, "design.kh").value_or(NAN), there.stiffness(),
              1e-8);
}

/// Bars alone, driven: nothing is unknown. Straight down the force turns back at r^3 = l.
TEST(FollowedStability, IsAskedForWhereNothingIsUnknown) {
  const StudyResult result =
      run("[parameters]\npsi = \"-90*deg\"\n" + two_bars_of_height(1) + R"toml([[study]]
name = "loads"
kind = "critical_load"
control = "pose"
direction = ["cos(psi)", "sin(psi)"]
until = { lambda = [-0.05, 2.4] }
critical_load = { of = "limit_point", index = "dead_load", parameter = "psi", range = ["-120*deg", "-60*deg"], values = 5 }
)toml")
          .of("loads");
  bool is_there = false;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples)
      if (std::abs(row.values.back() + std::acos(0.0)) < 1e-12) {
        is_there = true;
        EXPECT_NEAR(row.values.at(1), 1 - std::sqrt(std::cbrt(2.0) - 1), 1e-9);
      }
  EXPECT_TRUE(is_there);
}

}  // namespace
}  // namespace springfold::io
