// Whole diagrams around points at which switches are exactly zero: every way out is followed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kink_problems.hpp"
#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// F = c x + right [x - play]^+ - left [-x - play]^+ - lambda sin x: a strut between two one-sided
/// springs; play > 0: a dead band, play < 0: pretension of both (their forces at x = 0 are equal).
struct Guyed {
  double c = 0, right = 1, left = 1, play = 0;

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    double f = c * x[0] - lambda * std::sin(x[0]);
    if (piece[0] > 0) f += right * (x[0] - play);
    if (piece[1] > 0) f -= left * (-x[0] - play);
    F = Vector::Constant(1, f);
    return true;
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    double k = c - lambda * std::cos(x[0]);
    if (piece[0] > 0) k += right;
    if (piece[1] > 0) k += left;
    dF_dx = Matrix::Constant(1, 1, k);
    dF_dlambda = Vector::Constant(1, -std::sin(x[0]));
    return true;
  }
  static Index switch_count() { return 2; }
  bool switches(const Vector& x, double, Vector& g) const {
    g = Vector{{x[0] - play, -x[0] - play}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{1}, {-1}};
    dg_dlambda = Vector::Zero(2);
    return true;
  }
};

std::vector<Event> limits(double low, double high, double widest) {
  return {lambda_reaches(low), lambda_reaches(high), x_reaches(widest), x_reaches(-widest)};
}

Diagram around(const Guyed& problem, double x, double lambda, const Piece& piece) {
  return trace_diagram(problem, {{Vector::Constant(1, x), lambda, piece}}, limits(-0.5, 2.5, 1),
                       {});
}

std::string texts(const Diagram& diagram) {
  std::string all;
  for (const Doubt& doubt : diagram.doubts) all += doubt.text + "; ";
  return all;
}

std::vector<double> places(const Diagram& diagram) {
  std::vector<double> list;
  for (const Junction& junction : diagram.junctions) list.push_back(junction.point.lambda);
  std::sort(list.begin(), list.end());
  return list;
}

/// All branches away from x = 0 satisfy the equilibrium of their piece.
void expect_branches_to(const Diagram& diagram, double left_load, double right_load) {
  int left = 0, right = 0;
  for (const Branch& branch : diagram.branches) {
    const CurvePoint& end = branch.curve.hits.back().point;
    if (std::abs(end.x[0]) < 0.9) continue;
    EXPECT_NEAR(end.lambda, end.x[0] < 0 ? left_load : right_load, 1e-10);
    (end.x[0] < 0 ? left : right) += 1;
  }
  EXPECT_EQ(left, 1);
  EXPECT_EQ(right, 1);
}

TEST(RestingDiagram, TwoOppositeSpringsLeaveZeroLoad) {
  for (const Piece& piece : {above({false, false}), above({true, true}), above({true, false})}) {
    const Guyed problem{0, 1, 0.6};
    const Diagram diagram = around(problem, 0, 0, piece);
    EXPECT_EQ(texts(diagram), "");
    EXPECT_THAT(places(diagram), testing::ElementsAre(testing::DoubleNear(0.6, 1e-10),
                                                      testing::DoubleNear(1, 1e-10)));
    expect_branches_to(diagram, 0.6 / std::sin(1.0), 1 / std::sin(1.0));
  }
}

TEST(RestingDiagram, EqualSpringsOnBothSidesAreOneLinearSpring) {
  const Diagram diagram = around({0, 1, 1}, 0, 0, above({true, false}));
  EXPECT_EQ(texts(diagram), "");
  ASSERT_EQ(diagram.junctions.size(), 1u);
  EXPECT_NEAR(diagram.junctions[0].point.lambda, 1, 1e-10);
  EXPECT_EQ(diagram.junctions[0].ways.size(), 4u);
  expect_branches_to(diagram, 1 / std::sin(1.0), 1 / std::sin(1.0));
}

TEST(RestingDiagram, TwoHalfBranchesNextToEachOtherAreTwoJunctions) {
  for (const double gap : {5e-8, 3e-7}) {
    const Diagram diagram = around({0, 1, 1 + gap}, 0, 0, above({true, false}));
    EXPECT_EQ(texts(diagram), "") << gap;
    ASSERT_EQ(diagram.junctions.size(), 2u) << gap;
    for (const Junction& junction : diagram.junctions)
      EXPECT_EQ(junction.ways.size(), 3u) << gap << ": up, down, and to one side";
    expect_branches_to(diagram, (1 + gap) / std::sin(1.0), 1 / std::sin(1.0));
  }
}

TEST(RestingDiagram, AStartOnItsOwnBranchingKinkIsAJunction) {
  const Diagram diagram = around({0, 1, 0.6}, 0, 0.6, above({true, false}));
  EXPECT_EQ(texts(diagram), "");
  ASSERT_GE(diagram.junctions.size(), 1u);
  EXPECT_EQ(diagram.junctions[0].start, 0);
  EXPECT_EQ(diagram.junctions[0].ways.size(), 3u) << "up, down, and to the left";
  expect_branches_to(diagram, 0.6 / std::sin(1.0), 1 / std::sin(1.0));
}

TEST(RestingDiagram, PretensionOfAnySizeLeavesBranchesThatSwitchSoon) {
  // With both springs at work k = 1.6; the weaker one lets go at |x| = pretension.
  for (const double play : {-1e-1, -1e-3, -1e-6}) {
    const Guyed problem{0, 1, 1, play};
    const Diagram diagram = around(problem, 0, 0, above({true, true}));
    EXPECT_EQ(texts(diagram), "") << play;
    ASSERT_EQ(diagram.junctions.size(), 1u) << play;
    EXPECT_NEAR(diagram.junctions[0].point.lambda, 2, 1e-10) << play;
    expect_branches_to(diagram, (1 - play) / std::sin(1.0), (1 - play) / std::sin(1.0));
  }
}

TEST(RestingDiagram, ADeadBandIsOneFamilyWithABranchAtEachEnd) {
  for (const double play : {0.1, 1e-2, 1e-4}) {
    const Guyed problem{0, 1, 1, play};
    const Diagram diagram = around(problem, 0, 0, above({false, false}));
    EXPECT_EQ(texts(diagram), "") << play;
    int families = 0;
    for (const Branch& branch : diagram.branches)
      for (const Hit& hit : branch.curve.hits) {
        EXPECT_THAT(hit.kind, testing::AnyOf(HitKind::family, HitKind::kink, HitKind::corner,
                                             HitKind::user, HitKind::branch_point))
            << play << " " << hit.name;
        if (hit.kind != HitKind::family) continue;
        ++families;
        EXPECT_NEAR(hit.s_after - hit.s_before, play, 1e-10);
      }
    EXPECT_EQ(families, 2) << "one to each side of the junction";
    expect_branches_to(diagram, (1 - play) / std::sin(1.0), (1 - play) / std::sin(1.0));
  }
}

TEST(RestingDiagram, ABranchThatStopsEarlyIsADoubt) {
  DiagramOptions options;
  options.trace.maximum_points = 5;
  const Diagram diagram =
      trace_diagram(Guyed{1, 1, 1, 5}, {{Vector::Zero(1), 0, above({false, false})}}, {}, options);
  ASSERT_FALSE(diagram.doubts.empty());
  EXPECT_EQ(diagram.doubts.front().kind, DoubtKind::stopped_early);
  EXPECT_TRUE(diagram.doubts.front().place.has_value());
}

}  // namespace
}  // namespace springfold::continuation
