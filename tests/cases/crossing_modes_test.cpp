// First critical loads of columns on an elastic foundation, of which another mode is the first on either side of a
// value.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A pinned column of n rigid links of length 1, joints of stiffness c between them, springs of stiffness kf from them
/// to the straight line. Mode m has y_i = sin(m pi i / n), and with s = 2 - 2 cos(m pi / n) the load c s + kf / s.
std::string column_on_springs(int n, double kf, const std::string& study) {
  std::string text =
      "[parameters]\nc = 1\nkf = " + std::to_string(kf) +
      "\n[[body]]\nname = \"end\"\ntask_space = \"xy\"\npose = [" + std::to_string(n) +
      ", 0]\n[[chain]]\nname = \"g\"\nelements = [{ joint = \"prismatic\", axis = "
      "\"x\", initial = " +
      std::to_string(n) +
      " }]\n[[chain]]\nname = \"a\"\nelements = [{ joint = \"revolute\", axis = \"z\" "
      "}, { rigid = [1, 0] },\n";
  std::string springs;
  for (int i = 1; i < n; ++i) {
    const std::string point = "n" + std::to_string(i);
    text += "{ point = \"" + point +
            "\" }, { joint = \"revolute\", axis = \"z\", role = \"preloaded\", spring = { law = "
            "\"linear\", stiffness = \"c\" } }, { rigid = [1, 0] },\n";
    springs += "[[spring]]\nname = \"f" + point + "\"\nshape = \"line\"\nof = [\"a." + point +
               "\", { on = \"base\", at = [0, 0] }, { on = \"base\", at = [1, 0] }]\nstiffness = "
               "\"kf\"\nfree = 0\n";
  }
  return text + "]\n" + springs +
         "[[study]]\nname = \"s\"\ncontrol = \"load\"\nbody = \"end\"\ndirection = [-1, 0]\n" +
         study;
}

double load_of_mode(int n, int m, double c, double kf) {
  const double s = 2 - 2 * std::cos(m * std::numbers::pi / n);
  return c * s + kf / s;
}

TEST(FirstCriticalLoads, GoOnWithAnotherModeWhereTwoLoadsCross) {
  struct Column {
    int n;
    double kf;
  };
  for (const auto& [n, kf] : {Column{4, 0.5}, Column{6, 0.127}}) {
    SCOPED_TRACE(n);
    const double s1 = 2 - 2 * std::cos(std::numbers::pi / n),
                 s2 = 2 - 2 * std::cos(2 * std::numbers::pi / n);
    const double crossing = kf * (1 / s1 - 1 / s2) / (s2 - s1);
    const auto result =
        run(column_on_springs(n, kf,
                              "kind = \"critical_load\"\nuntil = { lambda = [-0.01, 30] }\n"
                              "critical_load = { of = \"loss_of_stability\", parameter = \"c\", "
                              "range = [0.3, 3], values = 9 }\n"))
            .of("s");
    EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
    const std::size_t lambda = analysis::column(result, "lambda");
    double from = 0.3;
    for (const analysis::Branch& branch : result.branches) {
      EXPECT_TRUE(branch.forward.complete && branch.backward.complete);
      EXPECT_NEAR(branch.samples.front().values.back(), from, 1e-9);
      from = branch.samples.back().values.back();
      for (const auto& row : branch.samples) {
        const double c = row.values.back();
        double first = load_of_mode(n, 1, c, kf);
        for (int m = 2; m < n; ++m) first = std::min(first, load_of_mode(n, m, c, kf));
        EXPECT_NEAR(row.values[lambda], first, 1e-9) << c;
      }
    }
    EXPECT_NEAR(from, 3, 1e-9);
    if (crossing > 0.3 && crossing < 3) {
      ASSERT_EQ(result.branches.size(), 2U);
      EXPECT_NEAR(result.branches.front().samples.back().values.back(), crossing, 1e-9);
    }
  }
}

}  // namespace
}  // namespace springfold::io
