// Cables that are slack are nearly without stiffness: a net of them hardens by orders of magnitude when they become
// taut.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using std::numbers::pi;

using analysis::EventKind;
using analysis::StudyResult;

struct Cable {
  const char *from, *to;
  double angle;
};

/// A hexagon of six cables between two fixed points, held apart by two springs, pulled at one corner. A cable has the
/// stiffness 1 where it is longer by a thousandth, and `slack` below.
std::string hexagon(double slack) {
  const double x = std::sqrt(7.0) / 4, y = 0.75, h = 0.848062078981481;
  std::string text =
      "[[body]]\nname = \"n1\"\ntask_space = \"xy\"\npose = [" + number(x) + ", 0.75]\n";
  for (const auto& [name, px, py] : {std::tuple{"n2", x + 1, y}, {"n4", x + 1, -y}, {"n5", x, -y}})
    text += std::string("[[body]]\nname = \"") + name + "\"\ntask_space = \"xy\"\npose = [" +
            number(px) + ", " + number(py) + "]\n";
  const std::string end = "end";
  for (const Cable& c : {Cable{"base", "n1", h},
                         {"n1", "n2", 0},
                         {"end", "n2", pi - h},
                         {"end", "n4", h - pi},
                         {"n4", "n5", pi},
                         {"base", "n5", -h}}) {
    const bool far = end == c.from;
    text += std::string("[[chain]]\nname = \"") + c.from + c.to + "\"\nfrom = \"" +
            (far ? "base" : c.from) + "\"\nfrom_at = [" + (far ? number(2 * x + 1) : "0") +
            ", 0]\nto = \"" + c.to +
            "\"\nelements = [{ joint = \"revolute\", axis = \"z\", initial = " + number(c.angle) +
            " }, { joint = \"prismatic\", axis = \"x\", name = \"e\", role = \"virtual\", initial "
            "= 1e-5, "
            "spring = { law = \"piecewise_linear\", breakpoints = [0.001], stiffnesses = [" +
            number(slack) + ", 1] } }, { rigid = [0.99999, 0] }]\n";
  }
  for (const auto& [from, to] : {std::pair{"n1", "n5"}, {"n2", "n4"}})
    text += std::string("[[chain]]\nname = \"") + from + to + "\"\nfrom = \"" + from +
            "\"\nto = \"" + to +
            "\"\nelements = [{ joint = \"revolute\", axis = \"z\", initial = " + number(-pi / 2) +
            " }, { joint = \"prismatic\", axis = \"x\", role = \"virtual\", initial = -1.5e-5, "
            "spring = { law = \"linear\", stiffness = 0.5 } }, { rigid = [1.500015, 0] }]\n";
  return text +
         "[[study]]\nname = \"pull\"\nbody = \"n5\"\ncontrol = \"load\"\ndirection = [1, 0]\n"
         "until = { lambda = [0, 0.1], deflection = [-1, 3] }\n";
}

/// Loads at which the cables become taut, over the stiffness of slack ones.
std::vector<double> activations(double slack) {
  const StudyResult result = run(hexagon(slack)).of("pull");
  EXPECT_TRUE(complete(result));
  const auto& branch = result.branches.front();
  std::vector<double> loads;
  for (const auto& event : branch.events)
    if (event.kind == EventKind::switching)
      loads.push_back(branch.samples[event.row].values[1] / slack);
  EXPECT_LT(branch.samples.size(), 400u);
  return loads;
}

TEST(SlackMembers, OfAnyStiffnessBecomeTautOneAfterTheOther) {
  // Up to the first activation nothing but the slack cables and stiff springs acts: loads are proportional to the
  // stiffness of slack cables, but for what the springs' give.
  const std::vector<double> softest = activations(1e-6);
  ASSERT_EQ(softest.size(), 6u);
  for (const double slack : {1e-3, 1e-4, 1e-5}) {
    const std::vector<double> loads = activations(slack);
    ASSERT_EQ(loads.size(), 6u) << slack;
    for (std::size_t i = 0; i < loads.size(); ++i)
      EXPECT_NEAR(loads[i] / softest[i], 1, slack) << slack << ", cable " << i;
  }
}

}  // namespace
}  // namespace springfold::io
