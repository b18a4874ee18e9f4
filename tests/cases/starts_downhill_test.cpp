// A guess at which nothing is stiff, and that its load lets sink onto supports beside it.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

/// A rocking mast of height 1 on two supports that push from 0.01 below on; given within their gap.
std::string mast_in_gaps(double weight) {
  const auto support = [](const char* name, const char* point) {
    return std::string{"[[spring]]\nname = \""} + name + "\"\nshape = \"line\"\nof = [\"m." +
           point +
           "\", { on = \"base\", at = [-5, 0] }, { on = \"base\", at = [5, 0] }]\n"
           "law = { law = \"gap\", stiffness = 1, low = -0.01, high = 0.03 }\n";
  };
  return "[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = \"m\"\n"
         "elements = [ { joint = \"prismatic\", axis = \"y\", name = \"y\" }, { joint = "
         "\"revolute\", axis = \"z\", name = \"t\", role = \"preloaded\", spring = { law = "
         "\"linear\", stiffness = 0 } }, { point = \"p0\", at = [-0.4, 0] }, { point = \"p1\", at "
         "= [0.4, 0] }, { rigid = [0, 1] } ]\n" +
         support("s0", "p0") + support("s1", "p1") +
         "[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\nload = [0, " +
         number(-weight) + "]\nuntil = { lambda = [0, 3], m.t = [-1.2, 1.3], m.y = [-3, 2] }\n";
}

TEST(StartsDownhill, AreThereWhereTheWeightLetsAMastSinkOntoItsSupports) {
  for (const double weight : {1e-4, 1e-3, 1e-2}) {
    const auto result = run(mast_in_gaps(weight)).of("press");
    ASSERT_TRUE(complete(result)) << weight;
    EXPECT_THAT(result.start.method, testing::HasSubstr("from where the loads let the guess sink"));
    const std::size_t start = result.branches.at(0).start_row;
    EXPECT_NEAR(value(result, start, "m.y"), -0.01 - weight / 2, 1e-10);
    EXPECT_NEAR(value(result, start, "m.t"), 0, 1e-10);
    // Upright it stands as long as the supports turn it back: 2 * 0.4^2 against weight and load.
    const auto lost = lambdas(result, analysis::EventKind::branch_point);
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_NEAR(lost.front(), 0.32 - weight, 1e-9);
  }
}

}  // namespace
}  // namespace springfold::io
