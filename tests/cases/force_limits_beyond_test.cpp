// Limit points of the force beyond the threshold of a spring: under a driven displacement they are those under the
// load.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// A planar Orthoglide whose second knee has another stiffness from the angle a0 on.
const char* const two_knees = R"toml(
[parameters]
a0 = 0.58
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "leg_x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 0.9, stiffness = 1 },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 0.0289, 0, 0.026], falling = true } },
  { rigid = [-0.9, 0] },
]
[[chain]]
name = "leg_y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 0.9, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = ["a0"], stiffnesses = [0.0289, 0.018] } },
  { rigid = [0, -0.9] },
]
)toml";

StudyResult limit_points(const std::string& control) {
  return run(two_knees +
             ("[[study]]\nname = \"s\"\nkind = \"critical_curve\"\ncontrol = \"" + control +
              "\"\ndirection = [\"cos(57.5*deg)\", \"sin(57.5*deg)\"]\n"
              "start = { pose = [0.24, 0.222], solve = \"actuators\" }\n"
              "until = { deflection = [-0.2, 0.39] }\n"
              "critical_curve = { of = \"LP1\", parameter = \"a0\", range = [0.45, 0.65] }\n"))
      .of("s");
}

TEST(ForceLimitsBeyond, TheThresholdOfASpringAreThoseUnderTheLoad) {
  const StudyResult driven = limit_points("mixed"), loaded = limit_points("load");
  EXPECT_TRUE(complete(driven)) << testing::PrintToString(driven.doubts);
  ASSERT_EQ(driven.branches.size(), loaded.branches.size());
  ASSERT_EQ(driven.branches.size(), 3u);
  for (std::size_t b = 0; b < 3; ++b) {
    const auto &a = driven.branches[b], &other = loaded.branches[b];
    ASSERT_EQ(a.events.size(), other.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      const auto &here = a.samples[a.events[i].row].values,
                 &there = other.samples[other.events[i].row].values;
      EXPECT_EQ(a.events[i].kind, other.events[i].kind);
      EXPECT_NEAR(here.back(), there.back(), 1e-9) << a.events[i].label;
      EXPECT_NEAR(here[column(driven, "force")], there[column(loaded, "force")], 1e-9);
    }
  }
}

TEST(ForceLimitsBeyond, HaveNoExtremumWhereNothingChanges) {
  // Up to the threshold the knee's other stiffness is nothing to the limit point.
  for (const std::string control : {"mixed", "load"})
    for (const auto& branch : limit_points(control).branches)
      for (const auto& event : branch.events)
        EXPECT_NE(event.kind, EventKind::extremum) << control << " " << event.label;
}

}  // namespace
}  // namespace springfold::io
