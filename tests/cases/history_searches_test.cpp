// Studies that change a parameter and start in an equilibrium of a search.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

TEST(HistoryOfASearch, MembersStartInTheEquilibriumThatGoesOnHoweverItIsNumbered) {
  // Mirrored equilibria of a truss on a tie: by symmetry their limit loads have rates of one size, and a small one by
  // k.
  std::string text = R"toml(
[parameters]
k = 100
[[node]]
name = "pin"
at = [0, 0]
fixed = true
[[node]]
name = "foot"
at = ["2*cos(30*deg)", 0]
fixed = ["y"]
[[node]]
name = "apex"
at = ["cos(30*deg)", 0.5]
[[bar]]
from = "pin"
to = "apex"
stiffness = "k"
[[bar]]
from = "apex"
to = "foot"
stiffness = "k"
[[bar]]
from = "pin"
to = "foot"
stiffness = 1
[[study]]
name = "all"
kind = "equilibria"
body = "apex"
load = [0, -0.1]
search = { starts = 60 }
)toml";
  for (const char* label : {"EQ1", "EQ2", "EQ3"})
    text += std::string{"[[study]]\nname = \""} + label +
            "\"\nkind = \"sensitivity\"\nsensitivity = { parameters = [\"k\"] }\nbody = "
            "\"apex\"\ncontrol "
            "= \"load\"\ndirection = [0, -1]\nuntil = { apex.y = [-0.75, 0.75] }\nstart = { from = "
            "\"all\", at "
            "= \"" +
            label + "\", loads = \"own\" }\n";
  const Ran ran = run(text);
  std::vector<double> sizes;
  for (const char* label : {"EQ1", "EQ2", "EQ3"}) {
    const auto& result = ran.of(label);
    for (const analysis::Event& event : result.branches.at(0).events)
      if (event.kind == analysis::EventKind::limit_point)
        sizes.push_back(std::abs(value(result, event.row, "d(lambda)/d(k)")));
  }
  ASSERT_GE(sizes.size(), 3u);
  for (const double size : sizes) {
    EXPECT_NEAR(size, sizes.front(), 1e-9);
    EXPECT_LT(size, 1e-3);  // the bars are stiff
    EXPECT_GT(size, 0);
  }
}

}  // namespace
}  // namespace springfold::io
