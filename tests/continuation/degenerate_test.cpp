// Branch points at which the branches meet in higher order than usual.
#include <gtest/gtest.h>

#include "continuation/locating/exits.hpp"
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

/// V = weight (x^4 / 4 - (lambda - 0.3) x^2 / 2) + (w - sin x)^2 / 2 in unknowns turned by 0.7 rad: beside the
/// stiff member the terms that make the branch point are small.
struct WeakCrossing {
  double weight = 1;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  static Matrix turn() {
    return Matrix{{std::cos(0.7), -std::sin(0.7)}, {std::sin(0.7), std::cos(0.7)}};
  }
  bool residual(const Vector& q, double lambda, Vector& F) const {
    const Vector z = turn().transpose() * q;
    const double x = z[0], off = z[1] - std::sin(x);
    F = turn() * Vector{{weight * (x * x - (lambda - 0.3)) * x - std::cos(x) * off, off}};
    return true;
  }
  bool derivatives(const Vector& q, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const Vector z = turn().transpose() * q;
    const double x = z[0], c = std::cos(x), off = z[1] - std::sin(x);
    dF_dx =
        turn() *
        Matrix{{weight * (3 * x * x - (lambda - 0.3)) + c * c + std::sin(x) * off, -c}, {-c, 1}} *
        turn().transpose();
    dF_dlambda = turn() * Vector{{-weight * x, 0}};
    return true;
  }
};

TEST(BranchPoint, OfCurvesThatCrossWeaklyIsPlacedToRoundingOrSaidToBeInexact) {
  for (const double weight : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7})
    for (const double from : {-0.3, -0.31, -0.33}) {
      const WeakCrossing problem{weight};
      const Curve curve =
          follow(problem, {Vector::Zero(2), from, {}, {Vector::Zero(2), 1}}, {lambda_reaches(0.8)});
      const auto points = hits_of(curve, HitKind::branch_point);
      const auto doubts = hits_of(curve, HitKind::inexact);
      ASSERT_EQ(points.size(), 1u) << weight;
      const double error =
          std::max(std::abs(points[0].point.lambda - 0.3), points[0].point.x.norm());
      EXPECT_TRUE(error < 1e-10 || !doubts.empty()) << weight << ": " << error;
      EXPECT_TRUE(weight < 1e-4 || doubts.empty()) << weight;
      EXPECT_LT(error * weight, 1e-14) << weight;
    }
}

}  // namespace
}  // namespace springfold::continuation
