// Special points in a second parameter do not depend on where on its path a study begins, be it just beside a limit
// point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// Height and load of the limit points of a flat truss of two bars of stiffness 1, half a span of 1, rise 1/2:
/// P(y) = 2 y (L / sqrt(1 + y^2) - 1) has dP/dy = 0 at 1 + y^2 = L^(2/3), and P = 2 y^3 there.
const double limit_height = std::sqrt(std::cbrt(1.25) - 1),
             limit_load = 2 * limit_height * limit_height * limit_height;

/// The truss under a load that it carries at the height y, with one more study.
std::string loaded_truss(double load, double y, const std::string& kind,
                         const std::string& settings) {
  std::ostringstream text;
  text << std::setprecision(17)
       << "[parameters]\nk = 1\n"
          "[[node]]\nname = \"L\"\nat = [-1, 0]\nfixed = true\n"
          "[[node]]\nname = \"R\"\nat = [1, 0]\nfixed = true\n"
          "[[node]]\nname = \"apex\"\nat = [0, 0.5]\n"
          "[[bar]]\nfrom = \"L\"\nto = \"apex\"\nstiffness = \"k\"\n"
          "[[bar]]\nfrom = \"R\"\nto = \"apex\"\nstiffness = 1\n"
          "[[study]]\nname = \"s\"\nkind = \""
       << kind << "\"\nbody = \"apex\"\ncontrol = \"load\"\ndirection = [0, -1]\nload = [0, "
       << -load << "]\nuntil = { apex.y = [-0.8, 0.8] }\nstart = { pose = [0, " << y << "] }\n"
       << settings << "\n";
  return text.str();
}

/// The same, loaded up to `remaining` below its limit load.
std::string truss(double remaining, const std::string& kind, const std::string& settings) {
  return loaded_truss(limit_load - remaining, limit_height + std::sqrt(remaining / 3), kind,
                      settings);
}

const std::vector<double> loads_remaining{1e-2, 1e-4, 1e-5, 3e-6, 1e-6};

/// By symmetry each bar has half of dP/dk, and P is proportional to both stiffnesses together.
TEST(BesideALimitPoint, RatesOfTheLimitLoadsAreTheirs) {
  for (const double remaining : loads_remaining) {
    const auto ran = run(truss(remaining, "sensitivity", "sensitivity = { parameters = [\"k\"] }"));
    int found = 0;
    for (const analysis::Event& event : ran.of("s").branches.at(0).events) {
      if (event.kind != analysis::EventKind::limit_point) continue;
      ++found;
      const double sense = value(ran.of("s"), event.row, "lambda") > -limit_load ? 1 : -1;
      const double rate = value(ran.of("s"), event.row, "d(lambda)/d(k)");
      // Too near: the start vanishes within the narrowest differences.
      if (remaining < 1e-4 && std::isnan(rate)) continue;
      EXPECT_NEAR(rate, sense * limit_load / 2, 1e-9) << remaining;
    }
    EXPECT_EQ(found, 2) << remaining;
  }
}

// The unit of lambda in the arc length does not come from the slope there, which is next to none.
TEST(BesideALimitPoint, ACurveHasNoMorePointsThanFromAfarAndBothLimitLoads) {
  for (const double distance : {0.1, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 1e-6, 3e-7, 1e-7, 1e-8, 1e-9})
    for (const double y : {limit_height + distance, limit_height - distance}) {
      const double load = 2 * y * (std::sqrt(1.25) / std::sqrt(1 + y * y) - 1);
      const auto ran = run(loaded_truss(load, y, "force_deflection", ""));
      const analysis::Branch& branch = ran.of("s").branches.at(0);
      EXPECT_TRUE(branch.forward.complete && branch.backward.complete) << distance;
      EXPECT_LT(branch.samples.size(), 60u) << distance;
      std::vector<double> limits;
      for (const analysis::Event& event : branch.events)
        if (event.kind == analysis::EventKind::limit_point)
          limits.push_back(value(ran.of("s"), event.row, "lambda") + load);
      std::sort(limits.begin(), limits.end());
      ASSERT_EQ(limits.size(), 2u) << distance;
      EXPECT_NEAR(limits[0], -limit_load, 1e-10) << distance;
      EXPECT_NEAR(limits[1], limit_load, 1e-10) << distance;
    }
}

TEST(BesideALimitPoint, ItsCriticalCurveIsThatFromAfar) {
  const auto end_of = [](double remaining) {
    const auto ran = run(truss(remaining, "critical_curve",
                               "critical_curve = { of = \"LP2\", parameter = \"k\", range = "
                               "[1, 1.1] }"));
    const analysis::StudyResult& result = ran.of("s");
    if (result.branches.empty()) return std::nan("");
    const analysis::Branch& branch = result.branches.front();
    EXPECT_TRUE(branch.forward.complete) << remaining;
    return value(result, branch.samples.size() - 1, "lambda") - remaining;
  };
  for (const double remaining : loads_remaining)
    EXPECT_NEAR(end_of(remaining), end_of(0.03), 1e-9) << remaining;
}

}  // namespace
}  // namespace springfold::io
