// A link pressed by a force that follows it: nothing answers to the load, which sets no unit then.
#include <gtest/gtest.h>

#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

/// The tangent stiffness does not know the load: the straight way is the only one, whatever length and stiffness.
TEST(FollowerLoad, AlongTheLinkOfASpringHingeHasNoCriticalPoint) {
  for (const double length : {0.7, 1.0, 1.13, 1.25, 1.3})
    for (const double stiffness : {1e-6, 0.428, 1e6}) {
      SCOPED_TRACE(testing::Message() << length << " " << stiffness);
      const std::string l = number(length), load = number(4 * stiffness);
      const auto result =
          run("[[body]]\nname = \"tip\"\ntask_space = \"planar\"\npose = [0, " + l +
              ", 0]\n[[chain]]\nname = \"c\"\nelements = [{ joint = \"revolute\", axis = \"-z\", "
              "name = \"h\", role = \"preloaded\", spring = { law = \"linear\", stiffness = " +
              number(stiffness) + " } }, { rigid = [0, " + l +
              "] }]\n[[study]]\nname = \"s\"\ncontrol = \"load\"\nloads = [{ on = \"tip\", force = "
              "[0, -1], follows = true, scale = \"lambda\" }]\nuntil = { lambda = [-" +
              load + ", " + load + "] }\n")
              .of("s");
      EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
      ASSERT_EQ(result.branches.size(), 1u);
      for (const auto& event : result.branches[0].events)
        EXPECT_EQ(event.kind, analysis::EventKind::end_of_range);
      for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row)
        EXPECT_NEAR(value(result, row, "c.h"), 0, 1e-12);
    }
}

}  // namespace
}  // namespace springfold::io
