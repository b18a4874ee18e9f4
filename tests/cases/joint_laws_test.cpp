// Bodies on one joint, driven: the curve is a straight line, and the force on it is the law of the joint.
#include <gmock/gmock.h>

#include <cmath>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

analysis::StudyResult driven_along(const std::string& law, const std::string& from,
                                   const std::string& until) {
  return run("[[body]]\nname = \"t\"\ntask_space = \"xy\"\npose = [" + from +
             ", 0]\n[[chain]]\nname = \"c\"\nelements = [{ joint = \"prismatic\", axis = \"x\", "
             "name = "
             "\"j\", role = \"preloaded\", initial = " +
             from + ", spring = " + law +
             " }]\n[[study]]\nname = \"p\"\nbody = \"t\"\ncontrol = \"mixed\"\ndirection = [1, "
             "0]\nload = [0, 0]\nuntil = { t.x = [" +
             until + "] }\n")
      .results[0];
}

/// Where the body is.
std::vector<double> places(const analysis::StudyResult& result, EventKind kind) {
  std::vector<double> list;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == kind) list.push_back(value(result, event.row, "t.x"));
  return list;
}

// dF/dx = 3 u^2 or 5 u^4: zero at one place, where the force does not turn back.
TEST(StraightCurves, HaveNoLimitPointWhereALawIsFlatAndRisesOn) {
  for (const std::string law :
       {"{ law = \"formula\", formula = \"u^3\", free = 1.2 }",
        "{ law = \"polynomial\", coefficients = [0, 0, 0, 0, 0, 1], free = 1.2 }"}) {
    const auto result = driven_along(law, "1.2", "0.3, 2.1");
    EXPECT_TRUE(analysis::complete(result)) << law;
    EXPECT_THAT(places(result, EventKind::limit_point), IsEmpty()) << law;
  }
}

// F = 2 (p/0.3)^1.5 behind the contact: the curve has no end there, and no limit point.
TEST(StraightCurves, PassAContactWithAPowerLaw) {
  const auto result = driven_along(
      "{ law = \"power\", force = 2, depth = 0.3, exponent = 1.5, from = 1.3 }", "1", "0.75, 2.6");
  EXPECT_TRUE(analysis::complete(result));
  EXPECT_THAT(places(result, EventKind::limit_point), IsEmpty());
  EXPECT_THAT(places(result, EventKind::switching), ElementsAre(DoubleNear(1.3, 1e-10)));
}

// A shape-preserving cubic has its extrema at data points.
TEST(StraightCurves, HaveTheLimitPointsOfATable) {
  const auto result = driven_along(
      "{ law = \"table\", points = [[-1, -4], [-0.4, -1.3], [0.1, 0.2], [0.5, 0.1], [1, 2], [2, "
      "2.5]], free = 1.3, falling = true }",
      "1", "0.75, 2.6");
  EXPECT_TRUE(analysis::complete(result));
  EXPECT_THAT(places(result, EventKind::limit_point),
              ElementsAre(DoubleNear(1.4, 1e-10), DoubleNear(1.8, 1e-10)));
}

}  // namespace
}  // namespace springfold::io
