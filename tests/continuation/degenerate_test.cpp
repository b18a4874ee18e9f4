// Branch points at which the branches meet in higher order than usual.
#include <gtest/gtest.h>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// lambda = 4 + x^4 / 10 beside the straight branch x = 0: a pitchfork without quadratic term.
struct QuarticPitchfork {
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  static bool residual(const Vector& x, double lambda, Vector& F) {
    F = (4 + 0.1 * std::pow(x[0], 4) - lambda) * x;
    return true;
  }
  static bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, 4 + 0.5 * std::pow(x[0], 4) - lambda);
    dF_dlambda = -x;
    return true;
  }
};

TEST(Diagram, OfAPitchforkOfFourthOrderIsWholeAndHasNoFlatPoints) {
  const Diagram diagram =
      trace_diagram(QuarticPitchfork{}, {{.x = Vector::Zero(1), .lambda = 3.5, .piece = {}}},
                    {lambda_reaches(3), lambda_reaches(5)}, {});
  EXPECT_TRUE(diagram.doubts.empty()) << diagram.doubts.front();
  ASSERT_EQ(diagram.junctions.size(), 1u);
  EXPECT_NEAR(diagram.junctions[0].point.lambda, 4, 1e-10);
  EXPECT_EQ(diagram.junctions[0].ways.size(), 4u);
  ASSERT_EQ(diagram.branches.size(), 4u);
  for (const Branch& branch : diagram.branches) {
    EXPECT_EQ(branch.curve.stop, StopReason::event);
    EXPECT_TRUE(hits_of(branch.curve, HitKind::family).empty());
    EXPECT_TRUE(hits_of(branch.curve, HitKind::unresolved).empty());
    if (branch.depth == 0) continue;
    EXPECT_NEAR(std::abs(branch.curve.points.back().x[0]), std::pow(10, 0.25), 0.05);
    for (const CurvePoint& p : branch.curve.points)
      EXPECT_NEAR(p.lambda, 4 + 0.1 * std::pow(p.x[0], 4), 1e-12);
  }
}

/// A mode that buckles at lambda = 1 and a member that is stiffer by far.
struct StiffAndSlender {
  double stiffness = 1e10;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = Vector{{(1 - lambda) * x[0] + std::pow(x[0], 3), stiffness * x[1] - lambda}};
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Vector{{1 - lambda + 3 * x[0] * x[0], stiffness}}.asDiagonal();
    dF_dlambda = Vector{{-x[0], -1}};
    return true;
  }
};

TEST(Corank, IsNotRaisedByMembersOfVeryDifferentStiffness) {
  for (const double stiffness : {1.0, 1e4, 1e8, 1e10}) {
    const StiffAndSlender problem{stiffness};
    const Walker walker{problem, Vector::Ones(2), {}};
    const auto corank_at = [&](double lambda) {
      return corank_of(walker, {.x = Vector{{0, lambda / stiffness}}, .lambda = lambda});
    };
    EXPECT_EQ(corank_at(0), 0) << stiffness;
    EXPECT_EQ(corank_at(0.99), 0) << stiffness;
    EXPECT_EQ(corank_at(1), 1) << stiffness;
  }
}

}  // namespace
}  // namespace springfold::continuation
