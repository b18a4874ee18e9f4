// First critical loads of symmetric domes over the tilt of the load: a double branch point where it presses straight
// down, limit points of imperfect domes beside, whose loads fall with the tilt to the power of 2/3. And over their
// height: shallow ones snap, steep ones sway before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

struct Dome {
  double h = 0;        ///< its height
  double towards = 0;  ///< where the load is tilted to
};

/// Four bars of stiffness 1 from a square with half diagonals of 1 to an apex, and their first critical load over a
/// parameter.
std::string dome(const Dome& of, const std::string& over) {
  const auto& [h, towards] = of;
  std::string text = "[parameters]\ntilt = 0\nh = " + number(h) +
                     "\n[[body]]\nname = \"apex\"\ntask_space = \"xyz\"\npose = [0, 0, \"h\"]\n";
  int bars = 0;
  for (const std::string foot : {"1, 0", "0, 1", "-1, 0", "0, -1"})
    text += "[[spring]]\nname = \"bar" + std::to_string(++bars) + "\"\nfrom_at = [" + foot +
            ", 0]\nto = \"apex\"\nstiffness = 1\nfree = \"sqrt(1 + h^2)\"\n";
  const auto part = [](double share) { return "\"sin(tilt)*" + number(share) + "\", "; };
  return text + "[[study]]\nname = \"first\"\nkind = \"critical_load\"\ncontrol = \"load\"\n" +
         "direction = [" + part(std::cos(towards)) + part(std::sin(towards)) +
         "\"-cos(tilt)\"]\nuntil = { apex.z = [\"-0.9*h\", \"1.3*h\"], lambda = [-1, 20] }\n" +
         "critical_load = { of = \"loss_of_stability\", " + over + " }\n";
}

/// Straight down the load is 4 (l0/l - 1) z, l the length of the bars and z = sqrt(l^2 - 1). It is largest where
/// l^3 = l0. The apex sways where 4 (1 - l0/l) + 2 l0/l^3 = 0.
double load_at(double h, double l) { return 4 * (std::hypot(1, h) / l - 1) * std::sqrt(l * l - 1); }
double length_of_snap(double h) { return std::cbrt(std::hypot(1, h)); }
double length_of_sway(double h) {
  const double free = std::hypot(1, h);
  double low = 2 * free / 3,
         high = free;  // the least value of what has to be zero, and a positive one
  const auto stiffness = [free](double l) { return 4 * l * l * (l - free) + 2 * free; };
  if (stiffness(low) > 0) return 0;  // none
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (stiffness(middle) < 0 ? low : high) = middle;
  }
  return high;
}

TEST(DomeDirections, TheFirstCriticalLoadComesToThatOfSwayFromBothSidesWithoutAJump) {
  for (const Dome& of : {Dome{2.26, 0.55}, Dome{1.62, 0.61}, Dome{2.01, 0.36}}) {
    SCOPED_TRACE(of.h);
    const StudyResult result =
        run(dome(of, "parameter = \"tilt\", range = [-0.4, 0.4], values = 17")).of("first");
    EXPECT_TRUE(complete(result));
    ASSERT_EQ(result.branches.size(), 2u);
    for (const auto& branch : result.branches)
      for (const auto& event : branch.events) EXPECT_NE(event.kind, EventKind::jump);
    const auto &below = result.branches[0].samples.back(),
               &above = result.branches[1].samples.front();
    for (const auto* end : {&below, &above}) {
      EXPECT_NEAR(end->values.back(), 0, 1e-9);
      EXPECT_NEAR(end->values[column(result, "lambda")], load_at(of.h, length_of_sway(of.h)), 1e-5);
    }
  }
}

/// The longer of both lengths comes first.
TEST(DomeHeights, ShallowDomesSnapAndSteepOnesSwayBefore) {
  const StudyResult result =
      run(dome({1, 0}, "parameter = \"h\", range = [0.2, 2.5], values = 6")).of("first");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  double reached = 0.2;
  for (const auto& branch : result.branches) {
    EXPECT_NEAR(branch.samples.front().values.back(), reached, 1e-6);
    for (const auto& sample : branch.samples) {
      reached = sample.values.back();
      const double load =
          load_at(reached, std::max(length_of_snap(reached), length_of_sway(reached)));
      EXPECT_NEAR(sample.values[column(result, "lambda")], load, 1e-7) << "height " << reached;
    }
  }
  EXPECT_NEAR(reached, 2.5, 1e-12);
}

}  // namespace
}  // namespace springfold::io
