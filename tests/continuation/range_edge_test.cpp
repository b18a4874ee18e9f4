// Diagrams whose start lies on the edge of the range that is wanted.
#include <gtest/gtest.h>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// One mode that buckles at the load -0.005, behind the edge, and one at 2: F = ((0.005 + lambda) x, (2 - lambda) y +
/// y^3).
struct EdgeModes {
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  static bool residual(const Vector& x, double lambda, Vector& F) {
    F = Vector{
        {(0.005 + lambda) * x[0] + x[0] * x[0] * x[0], (2 - lambda) * x[1] + x[1] * x[1] * x[1]}};
    return true;
  }
  static bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) {
    dF_dx = Matrix{{0.005 + lambda + 3 * x[0] * x[0], 0.0}, {0.0, 2 - lambda + 3 * x[1] * x[1]}};
    dF_dlambda = Vector{{x[0], -x[1]}};
    return true;
  }
};

Diagram from_the_edge(const DiagramOptions& options) {
  return trace_diagram(EdgeModes{}, {{.x = Vector::Zero(2), .lambda = 0}},
                       {lambda_reaches(0), lambda_reaches(3)}, options);
}

TEST(RangeEdge, EndsACurveThatLeavesTheStartOutwardsRightThere) {
  DiagramOptions options;
  options.ends_at = [](const CurvePoint& p) {
    return p.lambda <= 0 && p.tangent.dlambda < 0 ? std::string("edge") : std::string();
  };
  const Diagram diagram = from_the_edge(options);
  ASSERT_EQ(diagram.junctions.size(), 1u);
  EXPECT_NEAR(diagram.junctions.front().point.lambda, 2, 1e-10);
  const auto ended =
      std::count_if(diagram.branches.begin(), diagram.branches.end(), [](const Branch& branch) {
        return branch.curve.points.size() == 1 && branch.curve.stop_detail == "edge";
      });
  EXPECT_EQ(ended, 1);
}

TEST(RangeEdge, MakesNoJunctionOfASpecialPointBeyondIt) {
  DiagramOptions options;
  options.outside = [](const CurvePoint& p) { return p.lambda < 0; };
  const Diagram diagram = from_the_edge(options);
  for (const Junction& junction : diagram.junctions) EXPECT_GE(junction.point.lambda, 0);
  EXPECT_EQ(diagram.junctions.size(), 1u);
}

}  // namespace
}  // namespace springfold::continuation
