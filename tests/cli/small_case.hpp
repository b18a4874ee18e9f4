// A small case on disk, made for tests of the program.
#pragma once

#include <string>

namespace springfold::cli {

/// Two springs at right angles hold a point; pushing it along x is a straight line.
/// @param first  further text at the beginning
/// @param last   further text at the end
inline std::string small_case(const std::string& first = "", const std::string& last = "") {
  return first + R"(title = "A point on two springs"
[parameters]
K = 2
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg"
to = "tool"
elements = [
  { joint = "prismatic", axis = "x", name = "slide", role = "virtual", stiffness = "K" },
  { joint = "prismatic", axis = "y", name = "lift", role = "virtual", stiffness = 1 },
]
[[study]]
name = "push"
kind = "force_deflection"
control = "mixed"
direction = [1, 0]
until = { deflection = [-0.1, 0.3] }
[[study]]
name = "rest"
kind = "equilibrium"
)" + last;
}

/// A bar of length 1 that is to reach a point 5 away.
inline std::string too_short() {
  return R"(
[[body]]
name = "tool"
task_space = "xy"
pose = [5, 0]
[[chain]]
name = "arm"
elements = [ { joint = "revolute", axis = "z", name = "hinge" }, { rigid = [1, 0] } ]
[[study]]
name = "hold"
kind = "equilibrium"
start = { solve = "wrench", attempts = 2 }
)";
}

}  // namespace springfold::cli
