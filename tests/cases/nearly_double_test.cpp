// Two modes that become critical at nearly the same load.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A mast of length 1.1 on a universal joint with springs k1 about x and k2 = r k1 about y, pressed from above. It
/// bends about either axis from k/L on; where it is bent about the stiffer one by a, a / tan a = r, it may swing about
/// the other. Nine branches.
TEST(NearlyDouble, CriticalLoadsLeaveAllBranchesWithoutADoubt) {
  for (const char* ratio : {"1 - 1e-3", "1 - 1e-4", "1 - 1e-6"}) {
    const auto result = run(std::string("[parameters]\nk1 = 1.7\nk2 = \"k1*(") + ratio + R"toml()"
[[body]]
name = "tip"
task_space = "xyz"
pose = [0, 0, 1.1]
[[chain]]
name = "m"
elements = [ { joint = "universal", axes = ["x", "y"], name = "u", role = "preloaded", spring = [ { law = "linear", stiffness = "k1" }, { law = "linear", stiffness = "k2" } ] }, { rigid = [0, 0, 1.1] } ]
[[study]]
name = "p"
control = "load"
direction = [0, 0, -1]
until = { lambda = [0, 3], m.u.1 = [-1.4, 1.4], m.u.2 = [-1.4, 1.4] }
branches = { depth = 2 }
)toml")
                            .of("p");
    EXPECT_TRUE(analysis::complete(result)) << ratio;
    EXPECT_EQ(result.branches.size(), 9u) << ratio;
  }
}

}  // namespace
}  // namespace springfold::io
