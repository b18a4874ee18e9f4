// Masts in space with two pairs of cables: one pair just rests, the other one is stretched by a millionth. A
// half-branch meets the slack of a stretched cable a millionth behind its branch point.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// Two opposite cables from +-(x, y, 0) to a height.
struct Pair {
  double x = 0, y = 0, stiffness = 0;
};

/// Two links on universal joints with springs, the pair at rest at the top, the stretched one at the joint between.
struct Mast {
  Vector springs{};  ///< (about x, about y) of the lower joint, then of the upper one
  double lower = 0, upper = 0;
  Pair resting{}, stretched{};
};

constexpr double stretch = 1e-6;

std::string cables(const Pair& pair, double height, const std::string& to, double taut) {
  const double length = std::sqrt(pair.x * pair.x + pair.y * pair.y + height * height);
  std::string text;
  for (const double side : {1.0, -1.0})
    text += "[[spring]]\nname = \"" + std::string{taut > 0 ? "taut" : "rests"} +
            (side > 0 ? "_right" : "_left") + "\"\nfrom_at = [" + number(side * pair.x) + ", " +
            number(side * pair.y) + ", 0]\nto = \"" + to +
            "\"\nlaw = { law = \"one_sided\", stiffness = " + number(pair.stiffness) +
            ", from = " + number(length * (1 - taut)) + " }\n";
  return text;
}

std::string joint(const std::string& name, double about_x, double about_y) {
  const auto spring = [](double k) {
    return "{ law = \"linear\", stiffness = " + number(k) + " }";
  };
  return "{ joint = \"universal\", axes = [\"x\", \"y\"], name = \"" + name +
         "\", role = \"preloaded\", spring = [" + spring(about_x) + ", " + spring(about_y) +
         "] }, ";
}

std::string text_of(const Mast& mast) {
  std::string until;
  for (const std::string angle : {"foot.1", "foot.2", "knee.1", "knee.2"})
    until += ", \"mast." + angle + "\" = [-0.3, 0.3]";
  return "[[body]]\nname = \"top\"\ntask_space = \"xyz\"\npose = [0, 0, " +
         number(mast.lower + mast.upper) + "]\n[[chain]]\nname = \"mast\"\nelements = [" +
         joint("foot", mast.springs[0], mast.springs[1]) + "{ rigid = [0, 0, " +
         number(mast.lower) + "] }, { point = \"middle\" }, " +
         joint("knee", mast.springs[2], mast.springs[3]) + "{ rigid = [0, 0, " +
         number(mast.upper) + "] }]\n" + cables(mast.resting, mast.lower + mast.upper, "top", 0) +
         cables(mast.stretched, mast.lower, "mast.middle", stretch) +
         "[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, 0, -1]\nuntil = { "
         "lambda "
         "= [0, 4]" +
         until + " }\nbranches = { depth = 1 }\n";
}

/// One cable of the resting pair acts whichever way the mast leans, and both of the stretched one: the loads are those
/// of a linear structure, K - P G, in the angles about x and y of both joints.
Vector loads_of(const Mast& mast) {
  const double a = mast.lower, b = mast.upper;
  Matrix middle(2, 4), top(2, 4), K = mast.springs.asDiagonal();
  middle << 0, a, 0, 0, -a, 0, 0, 0;
  top << 0, a + b, 0, b, -(a + b), 0, -b, 0;
  const auto add = [&K](const Pair& pair, double height, const Matrix& moves, double cables) {
    const double length = std::sqrt(pair.x * pair.x + pair.y * pair.y + height * height);
    const Vector u = (moves.transpose() * Vector{{pair.x, pair.y}}) / length;
    K += cables * pair.stiffness * u * u.transpose();
  };
  add(mast.resting, a + b, top, 1);
  add(mast.stretched, a, middle, 2);
  Matrix G(4, 4);
  G << a + b, 0, b, 0, 0, a + b, 0, b, b, 0, b, 0, 0, b, 0, b;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(K, G).eigenvalues();
}

TEST(StretchedBesideRest, TwoHalfBranchesLeaveAtEachLoadAndAreFollowedThroughSlack) {
  const Mast masts[] = {
      {Vector{{0.17, 0.12, 0.1, 0.29}}, 0.9, 0.6, {1.1, 0.5, 2.8}, {1.1, 0.1, 1.1}},
      {Vector{{0.11, 0.21, 0.14, 0.24}}, 1.0, 1.2, {0.6, 0.1, 3.1}, {0.6, 0.2, 2.8}},
      {Vector{{0.04, 0.13, 0.23, 0.1}}, 1.2, 0.7, {1.1, 0.3, 2.8}, {1.0, 0.2, 0.9}},
      {Vector{{0.07, 0.22, 0.23, 0.24}}, 0.6, 1.2, {0.6, 0.3, 0.8}, {1.0, 0.4, 3.2}}};
  for (const Mast& mast : masts) {
    SCOPED_TRACE(mast.springs.transpose());
    const StudyResult result = run(text_of(mast)).of("press");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    const auto loads = lambdas(result, EventKind::branching_kink);
    const Vector expected = loads_of(mast);
    ASSERT_EQ(loads.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(loads[i], expected[static_cast<Index>(i)], 10 * stretch);
      const std::string label = "KB" + std::to_string(i + 1);
      EXPECT_EQ(std::ranges::count(result.branches, label, &analysis::Branch::origin), 2);
    }
  }
}

}  // namespace
}  // namespace springfold::io
