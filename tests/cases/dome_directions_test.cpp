// First critical loads of symmetric domes over the tilt of the load: a double branch point where it presses straight
// down, limit points of imperfect domes beside, whose loads fall with the tilt to the power of 2/3.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// Four bars of stiffness 1 from a square with half diagonals of 1 to an apex at height h.
std::string dome(double h, double towards) {
  std::string text =
      "[parameters]\ntilt = 0.1\n[[body]]\nname = \"apex\"\ntask_space = \"xyz\"\npose = [0, 0, " +
      number(h) + "]\n";
  int bars = 0;
  for (const std::string foot : {"1, 0", "0, 1", "-1, 0", "0, -1"})
    text += "[[spring]]\nname = \"bar" + std::to_string(++bars) + "\"\nfrom_at = [" + foot +
            ", 0]\nto = \"apex\"\nstiffness = 1\nfree = " + number(std::hypot(1, h)) + "\n";
  const std::string along = number(std::cos(towards)), across = number(std::sin(towards));
  return text + R"toml([[study]]
name = "first"
kind = "critical_load"
control = "load"
direction = ["sin(tilt)*)toml" +
         along + R"toml(", "sin(tilt)*)toml" + across + R"toml(", "-cos(tilt)"]
until = { apex.z = [)toml" +
         number(-0.9 * h) + ", " + number(1.3 * h) + R"toml(], lambda = [-1, 20] }
critical_load = { of = "loss_of_stability", parameter = "tilt", range = [-0.4, 0.4], values = 17 }
)toml";
}

/// Straight down the apex sways where 4 (1 - l0/l) + 2 l0/l^3 = 0, l the length of the bars: then the load is
/// 4 (l0/l - 1) z at its height z.
double load_of_sway(double h) {
  const double free = std::hypot(1, h);
  double l = free;
  for (int i = 0; i < 50; ++i)
    l -= (4 * l * l * l - 4 * free * l * l + 2 * free) / (12 * l * l - 8 * free * l);
  return 4 * (free / l - 1) * std::sqrt(l * l - 1);
}

TEST(DomeDirections, TheFirstCriticalLoadComesToThatOfSwayFromBothSidesWithoutAJump) {
  struct Dome {
    double h = 0, towards = 0;
  };
  for (const auto& [h, towards] : {Dome{2.26, 0.55}, Dome{1.62, 0.61}, Dome{2.01, 0.36}}) {
    SCOPED_TRACE(h);
    const StudyResult result = run(dome(h, towards)).of("first");
    EXPECT_TRUE(complete(result));
    ASSERT_EQ(result.branches.size(), 2u);
    for (const auto& branch : result.branches)
      for (const auto& event : branch.events) EXPECT_NE(event.kind, EventKind::jump);
    const auto &below = result.branches[0].samples.back(),
               &above = result.branches[1].samples.front();
    for (const auto* end : {&below, &above}) {
      EXPECT_NEAR(end->values.back(), 0, 1e-9);
      EXPECT_NEAR(end->values[column(result, "lambda")], load_of_sway(h), 1e-5);
    }
  }
}

}  // namespace
}  // namespace springfold::io
