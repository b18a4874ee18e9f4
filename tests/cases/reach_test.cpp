// Where a leg is stretched out a driven displacement has an end that no limit of the case names.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

/// A 3-RRR platform: feet at the radius 0.5, plate of radius 0.12, links of 0.3, stiff drives and soft flexures.
std::string platform() {
  const double degree = std::numbers::pi / 180, reach = 0.5 - 0.12;
  const double bend = std::acos(reach / 0.6);  // of both links against the line from foot to plate
  std::string text = "[[body]]\nname = \"top\"\ntask_space = \"planar\"\npose = [0, 0, 0]\n";
  for (int leg = 0; leg < 3; ++leg) {
    const double at = (90 + 120 * leg) * degree, inwards = at + std::numbers::pi;
    const std::string flexure =
        ", role = \"preloaded\", spring = { law = \"linear\", stiffness = 4, origin = \"start\" }, "
        "initial = ";
    text += "[[chain]]\nname = \"leg" + std::to_string(leg) + "\"\nfrom_at = [" +
            number(0.5 * std::cos(at)) + ", " + number(0.5 * std::sin(at)) + "]\nto_at = [" +
            number(0.12 * std::cos(at)) + ", " + number(0.12 * std::sin(at)) +
            "]\nelements = [{ joint = \"revolute\", axis = \"z\", role = \"actuated\", value = " +
            number(inwards + bend) + ", stiffness = 20000 }, { rigid = [0.3, 0] }, " +
            "{ joint = \"revolute\", axis = \"z\"" + flexure + number(-2 * bend) +
            " }, { rigid = [0.3, 0] }, { joint = \"revolute\", axis = \"z\"" + flexure +
            number(bend - inwards) + " }]\n";
  }
  return text;
}

TEST(Reach, OfAStretchedLegEndsADrivenCurve) {
  // Leg 0 is straight when the plate has gone down by 0.6 - 0.38; its force grows without bound there.
  const auto result =
      run(platform() +
          "[[study]]\nname = \"push\"\ncontrol = \"mixed\"\ndirection = [0, -1, 0]\n"
          "until = { lambda = [-0.3, 0.3] }\n")
          .of("push");
  EXPECT_TRUE(complete(result));
  const auto& branch = result.branches.front();
  EXPECT_EQ(branch.forward.reason.rfind("end of the reach: chain leg0 is stretched out", 0), 0u)
      << branch.forward.reason;
  EXPECT_NEAR(branch.samples.back().values[1], 0.22, 1e-9);
}

}  // namespace
}  // namespace springfold::io
