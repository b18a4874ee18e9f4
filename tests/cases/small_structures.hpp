// Structures of a few parts that several tests of critical points ask different questions of.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "cases/number_text.hpp"

namespace springfold::io {

/// A strut of length 1 on a hinge with this spring, loaded along ["sin(e)", "-cos(e)"] as studies say: e tilts the
/// load.
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

/// A strut of length 1 on a hinge with this spring, at the angle t0 from the vertical, a parameter of the case, that
/// gives way along itself. @param along its stiffness, a number or the name of a parameter in quotation marks
inline std::string strut_that_gives(const std::string& hinge, const std::string& along) {
  return R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = ["sin(t0)", "cos(t0)"]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "-z", name = "hinge", role = "preloaded", initial = "t0", spring = )toml" +
         hinge +
         R"toml( },
  { joint = "prismatic", axis = "y", name = "along", role = "virtual", stiffness = )toml" +
         along + R"toml( },
  { rigid = [0, 1] },
]
)toml";
}

/// Nodes l at (-1, 0) and r at (1, 0), which are fixed, and one above the middle between them. What follows may say
/// more of that one. @param height a number, or a formula in quotation marks
inline std::string supports_and_apex(const std::string& apex, const std::string& height) {
  std::string text;
  for (const auto& [name, x] : {std::pair{"l", "-1"}, std::pair{"r", "1"}})
    text += std::string{"[[node]]\nname = \""} + name + "\"\nat = [" + x + ", 0]\nfixed = true\n";
  return text + "[[node]]\nname = \"" + apex + "\"\nat = [0, " + height + "]\n";
}

/// A flat truss of half span 1 and height 0.5; kv, a parameter of the case, is the stiffness of a vertical spring at
/// its top.
inline const std::string truss_with_vertical_spring = supports_and_apex("t", "0.5") + R"toml([[bar]]
from = "l"
to = "t"
stiffness = 1
[[bar]]
from = "r"
to = "t"
stiffness = 1
[[spring]]
name = "v"
shape = "line"
of = ["t", { on = "base", at = [0, 0.5] }, { on = "base", at = [1, 0.5] }]
stiffness = "kv"
)toml";

/// The same between two equal springs that push until its top is at the height 0.2, which they leave at once. A load
/// along ["sin(psi)", "-cos(psi)"] makes one the first.
inline const std::string truss_between_springs = R"toml(
[parameters]
psi = 0
kv = 0.02
)toml" + truss_with_vertical_spring + R"toml(
[[spring]]
repeat = { i = [0, 1] }
name = "s{i}"
from_at = ["0.8*(2*i-1)", -0.5]
to = "t"
law = { law = "one_sided", stiffness = 0.4, from = "sqrt(0.64 + 0.49)" }
)toml";

struct Foot {
  double x = 0, y = 0;
};

/// A straight spring from a foot on the base to a body or node. @param free  its free length, a number or formula
inline std::string spring_from(const std::string& name, const Foot& foot, const std::string& to,
                               double stiffness, const std::string& free) {
  return "[[spring]]\nname = \"" + name + "\"\nfrom_at = [" + number(foot.x) + ", " +
         number(foot.y) + "]\nto = \"" + to + "\"\nstiffness = " + number(stiffness) +
         "\nfree = \"" + free + "\"\n";
}

/// A body m at the top of two bars of stiffness 1 and half span 1.
inline std::string two_bars_of_height(int height) {
  const std::string free = "sqrt(" + std::to_string(1 + height * height) + ")";
  return "[[body]]\nname = \"m\"\ntask_space = \"xy\"\npose = [0, " + std::to_string(height) +
         "]\n" + spring_from("l", {-1, 0}, "m", 1, free) + spring_from("r", {1, 0}, "m", 1, free);
}

/// Two bodies P and Q at the ends of crank and rocker, and the coupler between them; joints stand at these angles.
struct FourBar {
  double crank = 0.3, base = 1, rocker = 0.8, coupler = 1;
  double at_crank = 0, at_rocker = 0, at_coupler = 0;
  std::string crank_spring{};  ///< keys of the crank's joint
};

inline std::string four_bar(const FourBar& of) {
  const auto point = [](double x, double y) { return "[" + number(x) + ", " + number(y) + "]"; };
  const auto body = [&](const char* name, double x, double y) {
    return std::string{"[[body]]\nname = \""} + name +
           "\"\ntask_space = \"xy\"\npose = " + point(x, y) + "\n";
  };
  const auto link = [&](double at, const std::string& keys, double length) {
    return "elements = [ { joint = \"revolute\", axis = \"z\", name = \"a\", initial = " +
           number(at) + keys + " }, { rigid = " + point(length, 0) + " } ]\n";
  };
  return body("P", of.crank * std::cos(of.at_crank), of.crank * std::sin(of.at_crank)) +
         body("Q", of.base + of.rocker * std::cos(of.at_rocker),
              of.rocker * std::sin(of.at_rocker)) +
         "[[chain]]\nname = \"crank\"\nto = \"P\"\n" +
         link(of.at_crank, of.crank_spring, of.crank) +
         "[[chain]]\nname = \"rock\"\nfrom_at = " + point(of.base, 0) + "\nto = \"Q\"\n" +
         link(of.at_rocker, "", of.rocker) +
         "[[chain]]\nname = \"coup\"\nfrom = \"P\"\nto = \"Q\"\n" +
         link(of.at_coupler, "", of.coupler);
}

}  // namespace springfold::io
