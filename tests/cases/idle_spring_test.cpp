// A spring without stiffness, or all but without, changes nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A truss of two bars of stiffness 1 that snaps, and below y = 0.2 a spring.
std::string truss(const std::string& stiffness, const std::string& height,
                  const std::string& study) {
  return "[parameters]\nh = " + height +
         "\ng = 0.2\n"
         "[[node]]\nname = \"a\"\nat = [0, \"h\"]\n"
         "[[node]]\nname = \"l\"\nat = [-1, 0]\nfixed = true\n"
         "[[node]]\nname = \"r\"\nat = [1, 0]\nfixed = true\n"
         "[[bar]]\nfrom = \"l\"\nto = \"a\"\nstiffness = 1\n"
         "[[bar]]\nfrom = \"r\"\nto = \"a\"\nstiffness = 1\n"
         "[[spring]]\nname = \"s\"\nshape = \"line\"\nof = [\"a\", { on = \"base\", at = [0, 0] }, "
         "{ on = \"base\", at = [1, 0] }]\n"
         "law = { law = \"one_sided\", stiffness = " +
         stiffness +
         ", from = \"g\", side = \"below\" }\n"
         "[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = [0, -1]\n"
         "until = { a.y = [-4, 4] }\n" +
         study + "\n";
}

double first_load(double rise) {  // P(y) = 2 y (L / sqrt(1 + y^2) - 1) at 1 + y^2 = L^(2/3)
  const double y = std::sqrt(std::cbrt(1 + rise * rise) - 1);
  return 2 * y * y * y;
}

/// Limit points come first, and branch points from the rise on at which a pair of them is born.
TEST(IdleSpring, FirstCriticalLoadsArePiecesWithoutGaps) {
  for (const std::string stiffness : {"0", "1e-9"}) {
    const auto ran = run(truss(stiffness, "0.8",
                               "kind = \"critical_load\"\ncritical_load = { of = "
                               "\"loss_of_stability\", parameter = \"h\", range = [0.3, 3], values "
                               "= 10 }"));
    const analysis::StudyResult& result = ran.of("s");
    EXPECT_TRUE(result.doubts.empty()) << stiffness << ": " << result.doubts.front();
    const std::size_t last = result.quantities.size() - 1;
    double reached = 0.3;
    for (const analysis::Branch& branch : result.branches) {
      EXPECT_NEAR(branch.samples.front().values[last], reached, 1e-4) << stiffness;
      reached = branch.samples.back().values[last];
    }
    EXPECT_NEAR(reached, 3, 1e-9) << stiffness;
  }
}

TEST(IdleSpring, LimitPointsGoOnBehindItsThreshold) {
  const auto ran =
      run(truss("0", "0.3",
                "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter "
                "= \"h\", range = [0.1, 1] }"));
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
  ASSERT_EQ(result.branches.size(), 2U);
  const std::vector<double>& end = result.branches.back().samples.back().values;
  EXPECT_NEAR(end.back(), 1, 1e-9);
  EXPECT_NEAR(end[1], first_load(1), 1e-9);
}

/// Beyond g = 0.8 the spring acts at the start already. The limit point does not mind: it lies on the segment where it
/// acts.
TEST(SwitchingStart, DoesNotEndACriticalCurve) {
  const std::string curve =
      "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter = \"g\", range = "
      "[0.1, 1.2] }";
  const auto ran = run(truss("0.05", "0.8", curve));
  const analysis::StudyResult& result = ran.of("s");
  ASSERT_FALSE(result.branches.empty());
  EXPECT_TRUE(result.branches.back().forward.complete);
  const auto& end = result.branches.back().samples.back().values;
  EXPECT_NEAR(end[column(result, "g")], 1.2, 1e-12);
  std::string at_the_end = truss("0.05", "0.8", "");
  at_the_end.replace(at_the_end.find("g = 0.2"), 7, "g = 1.2");
  const auto direct = run(at_the_end);
  const auto& branch = direct.of("s").branches.front();
  for (const auto& event : branch.events)
    if (event.label == "LP1") {
      EXPECT_NEAR(branch.samples[event.row].values[column(direct.of("s"), "lambda")],
                  end[column(result, "lambda")], 1e-10);
    }
}

}  // namespace
}  // namespace springfold::io
