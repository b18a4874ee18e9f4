// Starts from which Newton's method lets a bar shrink to no length, where its stiffness grows without bound.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A net of twelve bars on three nodes, found by random drawing.
const std::string net = R"toml(
node = [
  { name = "s0", at = [1.198, -0.149], fixed = true },
  { name = "s1", at = [-0.563, -0.182], fixed = true },
  { name = "s2", at = [-0.724, -0.83], fixed = true },
  { name = "n0", at = [0.295, 0.053] },
  { name = "n1", at = [-0.09, -0.267] },
  { name = "n2", at = [-0.044, 0.28] } ]
bar = [
  { from = "s0", to = "n0", free = 1.0326546461077877, law = {law="gap",stiffness=0.559,low=-0.0427,high=0.0427} },
  { from = "s1", to = "n0", free = 0.961658110364073, stiffness = 2.725, compression_only = true },
  { from = "s2", to = "n0", free = 1.3389123886386292, law = {law="piecewise_linear",breakpoints=[-0.0315, 0.063],stiffnesses=[0.498, 0.332, 0.09960000000000001]} },
  { from = "s0", to = "n1", free = 1.297274166786651, stiffness = 74.538, tension_only = true },
  { from = "s1", to = "n1", free = 0.4527032861113336, stiffness = 4.627 },
  { from = "s2", to = "n1", free = 0.7987165728216736, law = {law="piecewise_linear",breakpoints=[-0.0136, 0.0272],stiffnesses=[0.7605, 0.507, 0.15209999999999999]} },
  { from = "n0", to = "n1", free = 0.47058713327076845, law = {law="piecewise_linear",breakpoints=[-0.0163, 0.0326],stiffnesses=[21.18, 14.12, 4.236]} },
  { from = "s0", to = "n2", free = 1.2128251609547849, stiffness = 20.662 },
  { from = "s1", to = "n2", free = 0.7163818015590568, stiffness = 44.918, compression_only = true },
  { from = "s2", to = "n2", free = 1.4345060397223848, stiffness = 24.303, compression_only = true },
  { from = "n0", to = "n2", free = 0.38799168348045815, law = {law="piecewise_linear",breakpoints=[-0.0078, 0.0156],stiffnesses=[0.501, 0.334, 0.1002]} },
  { from = "n1", to = "n2", free = 0.5269735477232231, stiffness = 38.611, tension_only = true } ]
spring = [
  { name = "soft0", from_at = [0.0, 2.0], to = "n0", stiffness = 0.2, free = 0.5 },
  { name = "sof0", from_at = [2.0, 0.0], to = "n0", stiffness = 0.13, free = 0.4 },
  { name = "soft1", from_at = [0.0, 2.0], to = "n1", stiffness = 0.2, free = 0.5 },
  { name = "sof1", from_at = [2.3, 0.0], to = "n1", stiffness = 0.13, free = 0.4 },
  { name = "soft2", from_at = [0.0, 2.0], to = "n2", stiffness = 0.2, free = 0.5 },
  { name = "sof2", from_at = [2.6, 0.0], to = "n2", stiffness = 0.13, free = 0.4 } ]
[[study]]
name = "eq"
kind = "equilibrium"
body = "n0"
)toml";

TEST(ShrunkBars, AreNoEquilibriumWhereOtherNodesAreNotBalanced) {
  const auto result = run(net).of("eq");
  EXPECT_TRUE(analysis::complete(result));
  const double length = std::hypot(value(result, 0, "n0.x") - value(result, 0, "n2.x"),
                                   value(result, 0, "n0.y") - value(result, 0, "n2.y"));
  EXPECT_GT(length, 0.1);
  EXPECT_EQ(value(result, 0, "index"), 0);
}

}  // namespace
}  // namespace springfold::io
