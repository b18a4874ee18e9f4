// Structures of a few parts that several tests of critical points ask different questions of.
#pragma once

#include <string>

namespace springfold::io {

/// A strut of length 1 on a hinge with this spring, loaded along ["sin(e)", "-cos(e)"] as studies say: e tilts the load.
inline std::string strut_on_hinge(const std::string& spring) {
  return R"toml(
[parameters]
e = 0
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "s"
elements = [
  { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = )toml" +
         spring + R"toml( },
  { rigid = [0, 1] },
]
)toml";
}

/// A flat truss of half span 1 and height 0.5 between two equal springs that push until its top is at the height 0.2, which they
/// leave at once; kv is the stiffness of a vertical spring there. A load along ["sin(psi)", "-cos(psi)"] makes one the first.
inline const std::string truss_between_springs = R"toml(
[parameters]
psi = 0
kv = 0.02
[[node]]
name = "l"
at = [-1, 0]
fixed = true
[[node]]
name = "r"
at = [1, 0]
fixed = true
[[node]]
name = "t"
at = [0, 0.5]
[[bar]]
from = "l"
to = "t"
stiffness = 1
[[bar]]
from = "r"
to = "t"
stiffness = 1
[[spring]]
repeat = { i = [0, 1] }
name = "s{i}"
from_at = ["0.8*(2*i-1)", -0.5]
to = "t"
law = { law = "one_sided", stiffness = 0.4, from = "sqrt(0.64 + 0.49)" }
[[spring]]
name = "v"
shape = "line"
of = ["t", { on = "base", at = [0, 0.5] }, { on = "base", at = [1, 0.5] }]
stiffness = "kv"
)toml";

}  // namespace springfold::io
