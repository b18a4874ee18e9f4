// Closed curves of equilibria that shrink to a point.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

TEST(Isola, ShrinksToItsCentreWhereTheDrivenPathHasNoStart) {
  // q^3 - 2.9 q = cos(phi)/2 + b, driven by phi: around phi = pi the least b at q = -sqrt(2.9/3) ends in an isola
  // centre. The start of the path, at phi = 2.725, meets its own limit point before.
  const auto result = run(R"(
[parameters]
phi = 2.725
b = 2.35
[[node]]
name = "m"
at = [-0.93, 0]
fixed = ["y"]
[[chain]]
name = "c"
to = "m"
elements = [{ joint = "prismatic", axis = "x", name = "q", role = "preloaded", initial = -0.93, spring = { law = "polynomial", coefficients = [0, -2.9, 0, 1], falling = true } }]
[[study]]
name = "curve"
kind = "critical_curve"
body = "m"
control = "parameter"
parameter = "phi"
load = ["0.5*cos(phi) + b", 0]
direction = [1, 0]
start = { pose = [-0.93, 0] }
until = { lambda = [0.5, 6] }
critical_curve = { of = "LP1", parameter = "b", range = [1.7, 2.7] }
)")
                          .of("curve");
  EXPECT_TRUE(complete(result));
  int centres = 0;
  for (const auto& event : result.branches.at(0).events) {
    if (event.kind != EventKind::isola_centre) continue;
    ++centres;
    const double q = -std::sqrt(2.9 / 3);
    EXPECT_NEAR(value(result, event.row, "b"), q * q * q - 2.9 * q + 0.5, 1e-9);
    EXPECT_NEAR(value(result, event.row, "lambda"), std::numbers::pi, 1e-9);
  }
  EXPECT_EQ(centres, 1);
}

}  // namespace
}  // namespace springfold::io
