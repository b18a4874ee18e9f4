// Curves whose load grows without bound before anything else ends them: nothing that lies before is lost.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::HasSubstr;

/// The paper's planar Orthoglide with springs of stiffness kv in its knees, pushed along the diagonal from (p, p),
/// where it is at rest. Its force is infinite where the arms lie along the diagonal's square: x = y = 1.
std::string diagonal(const std::string& p, const std::string& kv, const std::string& study) {
  const auto leg = [&](const std::string& name, const std::string& axis, const std::string& turn,
                       const std::string& link) {
    return "[[chain]]\nname = \"" + name + "\"\nelements = [ { joint = \"prismatic\", axis = \"" +
           axis +
           "\", name = \"drive\", role = \"actuated\", value = 1, stiffness = 1 }, { joint = "
           "\"revolute\", axis = \"" +
           turn +
           "\", name = \"knee\", role = \"preloaded\", spring = { law = \"linear\", stiffness = "
           "\"kv\" } }, { rigid = " +
           link + " } ]\n";
  };
  return "[parameters]\nkv = " + kv +
         "\n[[body]]\nname = \"tool\"\ntask_space = \"xy\"\npose = [0, 0]\n" +
         leg("leg_x", "x", "-z", "[-1, 0]") + leg("leg_y", "y", "z", "[0, -1]") +
         "[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = [1, 1]\nstart = { pose = [" + p +
         ", " + p + "], solve = \"actuators\" }\n" + study;
}

std::vector<double> limit_loads(const StudyResult& result) {
  std::vector<double> loads;
  for (const auto& event : result.branches.front().events)
    if (event.kind == EventKind::limit_point)
      loads.push_back(result.branches.front().samples[event.row].values[column(result, "lambda")]);
  return loads;
}

TEST(ALoadWithoutBound, EndsTheCurveWhereItsChainsAreStretchedAndLeavesNothingOut) {
  for (const std::string branches : {"", "branches = { depth = 0 }\n"}) {
    const auto ran =
        run(diagonal("0.3", "0.05", "until = { deflection = [-0.05, 1.1] }\n" + branches));
    const StudyResult& result = ran.of("s");
    EXPECT_TRUE(complete(result));
    const auto loads = limit_loads(result);
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_NEAR(loads[0], 0.10176962904455, 1e-12);
    EXPECT_NEAR(loads[1], 0.0478327398162, 1e-12);
    EXPECT_THAT(result.branches.front().forward.reason, HasSubstr("end of the reach"));
    EXPECT_LT(result.branches.front().samples.size(), 600u);
  }
}

TEST(ALoadWithoutBound, IsFollowedAsFarAsALimitOfLambdaAsks) {
  const auto ran =
      run(diagonal("0.3", "0.05", "until = { deflection = [-0.05, 1.1], lambda = [-1, 1e6] }\n"));
  EXPECT_EQ(limit_loads(ran.of("s")).size(), 2u);
  EXPECT_THAT(ran.of("s").branches.front().forward.reason, HasSubstr("lambda reaches its upper"));
}

TEST(ALoadWithoutBound, LeavesThresholdsTheirPath) {
  const auto ran =
      run(diagonal("0.6", "0.05",
                   "kind = \"threshold\"\nuntil = { deflection = [-0.05, 0.6] }\n"
                   "threshold = { of = \"limit_point\", parameter = \"kv\", range = [0, 0.5] }\n"));
  ASSERT_TRUE(ran.of("s").threshold);
  EXPECT_TRUE(complete(ran.of("s")));
  EXPECT_NEAR(ran.of("s").threshold->value, 0.00317277115398, 1e-12);
}

/// Stiffness at which the limit points of the diagonal merge: F = F0 + kv G has F' = 0 where kv = -F0'/G', at most at
/// the cusp.
double cusp_of_diagonal(double p) {
  const double cp = std::sqrt(1 - p * p), preload = std::asin(p) / (cp - p);
  const auto stiffness = [&](double x) {
    const double c = std::sqrt(1 - x * x), t = x / c;
    const double dF0 = (1 - t) * (1 - t) - (x + c - p - cp) / (c * c * c);
    const double dG = 1 / (c * c) + (std::asin(x) * x + preload) / (c * c * c);
    return -dF0 / dG;
  };
  double low = p, high = std::sqrt(0.5);
  for (int i = 0; i < 200; ++i) {
    const double third = (high - low) / 3;
    if (stiffness(low + third) < stiffness(high - third))
      low += third;
    else
      high -= third;
  }
  return stiffness(0.5 * (low + high));
}

TEST(ALoadWithoutBound, LeavesThresholdsTheirPathHoweverNearTheStretchedLegsAre) {
  for (const char* p : {"0.6", "0.68", "0.7"}) {
    const auto ran = run(
        diagonal(p, "0.05",
                 "kind = \"threshold\"\nuntil = { deflection = [-0.05, 0.6] }\n"
                 "threshold = { of = \"limit_point\", parameter = \"kv\", range = [0, 0.5] }\n"));
    const StudyResult& result = ran.of("s");
    ASSERT_TRUE(result.threshold);
    EXPECT_TRUE(complete(result)) << p;
    const double cusp = cusp_of_diagonal(std::stod(p));
    EXPECT_NEAR(result.threshold->value / cusp, 1, 1e-9) << p;
  }
}

/// A bar on a slide whose spring is a law c x / (1 - x): the load is infinite at the end of its way, and no chain is
/// stretched.
TEST(ALoadWithoutBound, OfALawIsToldWhereNoChainExplainsIt) {
  const auto ran = run(
      "[[body]]\nname = \"b\"\ntask_space = \"xy\"\npose = [0, 0]\n[[chain]]\nname = "
      "\"c\"\nelements "
      "= [ { joint = \"prismatic\", axis = \"x\", name = \"slide\", role = \"preloaded\", spring = "
      "{ "
      "law = \"formula\", formula = \"u/(1-u)\" } } ]\n[[study]]\nname = \"s\"\ncontrol = "
      "\"load\"\n"
      "direction = [1, 0]\nuntil = { deflection = [-1, 2] }\n");
  const auto& branch = ran.of("s").branches.front();
  EXPECT_FALSE(branch.forward.complete);
  EXPECT_THAT(branch.forward.reason, HasSubstr("lambda grows without bound"));
  EXPECT_LT(branch.samples.size(), 1500u);
}

}  // namespace
}  // namespace springfold::io
