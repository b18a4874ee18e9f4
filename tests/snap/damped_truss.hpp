// A truss with a mass at its apex and dampers under it, along and across the way of the apex.
#pragma once

#include <string>

namespace springfold::analysis {

/// @param direction  of the load  @param until, damping  as in a case file, without their braces
inline std::string damped_truss(const std::string& direction, const std::string& until,
                                const std::string& damping) {
  return R"toml(
[[body]]
name = "apex"
task_space = "xy"
pose = [0, 1]
mass = 1

[[chain]]
name = "left"
from_at = [-1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "pi/4" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = 1 },
  { rigid = ["sqrt(2)", 0] },
]

[[chain]]
name = "right"
from_at = [1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "3*pi/4" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = 1 },
  { rigid = ["sqrt(2)", 0] },
]

[[chain]]
name = "damper"
elements = [
  { joint = "prismatic", axis = "x", name = "across" },
  { joint = "prismatic", axis = "y", name = "along", initial = 1 },
]

[[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = )toml" +
         direction + "\nuntil = { " + until + " }\nsnap = { inertia = { damping = { " + damping +
         " } } }\n";
}

}  // namespace springfold::analysis
