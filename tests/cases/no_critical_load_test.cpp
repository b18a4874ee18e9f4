// Paths on which no load is critical, whatever the parameter: that is an answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "case_runs.hpp"
#include "io/outline.hpp"

namespace springfold::io {
namespace {

TEST(NoCriticalLoad, IsToldWhereEveryPathComesToItsEndWithoutOne) {
  // A strut that is pushed aside: k t = P L sin(t + psi) has no fold before t + psi = pi.
  const Ran ran = run(R"toml(
[parameters]
psi = 0.3
[[body]]
name = "tip"
task_space = "xy"
pose = [1.3, 0]
[[chain]]
name = "s"
elements = [{ joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "linear", stiffness = 0.9 } }, { rigid = [1.3, 0] }]
[[study]]
name = "s"
kind = "critical_load"
control = "load"
direction = ["-cos(psi)", "-sin(psi)"]
until = { lambda = [-0.1, 8], s.h = [-6, 6] }
critical_load = { of = "limit_point", parameter = "psi", range = ["10*deg", "60*deg"], values = 6 }
)toml");
  EXPECT_THAT(outline_of(ran.read, ran.of("s")),
              testing::ElementsAre("no limit point on the path from the start at any of 6 values "
                                   "of psi over the range"));
}

}  // namespace
}  // namespace springfold::io
