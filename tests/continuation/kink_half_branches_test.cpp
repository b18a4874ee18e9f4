// One-sided springs exactly at their thresholds along a whole branch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "continuation/kinks/kink.hpp"
#include "kink_problems.hpp"
#include "springfold/core/decompositions.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;

Curve follow_straight(const OneSidedModes& problem, const Piece& piece, double to,
                      const TraceOptions& options = {}) {
  return follow(problem, {Vector::Zero(problem.n), 0, piece, {Vector::Zero(problem.n), 1}},
                {lambda_reaches(to)}, options);
}

TEST(HalfBranches, StartOfAStraightStateHasTwoWays) {
  for (const bool side : {true, false}) {
    const Rays rays = rays_from(OneSidedModes{}, Vector::Zero(1), 0, above({side}), {});
    EXPECT_TRUE(rays.complete) << rays.why;
    ASSERT_EQ(rays.rays.size(), 2u);
    for (const Ray& ray : rays.rays) {
      EXPECT_EQ(ray.piece, above({side})) << "the piece that was asked for";
      EXPECT_EQ(ray.resting, std::vector<Index>{0});
      EXPECT_NEAR(std::abs(ray.tangent.dlambda), 1, 1e-15);
    }
  }
}

TEST(HalfBranches, LeaveTheStraightStateWhereTheirOwnPieceBuckles) {
  // x < 0: lambda = 1 + x^2;  x > 0: lambda = 1.5 + x^2
  const OneSidedModes problem;
  for (const bool side : {true, false})
    for (const double longest : {0.05, 0.011, 0.2}) {
      const Curve curve = follow_straight(problem, above({side}), 2, steps_up_to(longest));
      ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
      ASSERT_EQ(curve.hits.size(), 3u);
      for (std::size_t i = 0; i < 2; ++i) {
        const Hit& hit = curve.hits[i];
        EXPECT_EQ(hit.kind, HitKind::branching_kink);
        EXPECT_EQ(hit.switches, std::vector<Index>{0});
        EXPECT_NEAR(hit.point.lambda, i == 0 ? 1 : 1.5, 1e-10);
        ASSERT_EQ(hit.leaving.size(), 2u) << "straight on, and one half-branch";
        EXPECT_NEAR(hit.leaving[0].tangent.dlambda, 1, 1e-12);
        EXPECT_NEAR(hit.leaving[1].tangent.dx[0], i == 0 ? -1 : 1, 1e-8);
        EXPECT_EQ(hit.leaving[1].piece, above({i == 1}));
        EXPECT_EQ(hit.leaving[1].negative, 0) << "the half-branch is stable";
      }
      for (const CurvePoint& p : curve.points) {
        EXPECT_EQ(p.piece, above({side}));
        EXPECT_EQ(p.negative, p.lambda > (side ? 1.5 : 1) ? 1 : 0) << "of the piece it carries";
      }
    }
}

TEST(HalfBranches, CanBeFollowedFromTheirKink) {
  const OneSidedModes problem;
  const Curve straight = follow_straight(problem, {1}, 2);
  const auto kinks = hits_of(straight, HitKind::branching_kink);
  ASSERT_EQ(kinks.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const CurvePoint& start = kinks[i].leaving.at(1);
    const Curve half = trace(problem, start.x, start.lambda, {start.piece, start.tangent},
                             {lambda_reaches(1.9)}, {});
    EXPECT_EQ(half.stop, StopReason::event) << half.stop_detail;
    const double x = std::sqrt(0.9 - 0.5 * static_cast<double>(i));
    EXPECT_NEAR(half.points.back().x[0], i == 0 ? -x : x, 0.1);
    EXPECT_NEAR(half.hits.back().point.x[0], i == 0 ? -x : x, 1e-10);
    EXPECT_TRUE(hits_of(half, HitKind::branching_kink).empty());
  }
}

TEST(HalfBranches, ComeBackToTheStraightStateInABranchingKink) {
  OneSidedModes problem;
  for (const double stiffness : {0.5, 0.0}) {
    problem.c[0] = stiffness;
    for (const double longest : {0.05, 0.013, 0.2}) {
      SCOPED_TRACE(longest);
      const Curve curve =
          follow(problem, at(-0.8, 1.64, 1, -1, {-1}), {lambda_reaches(0.2)}, steps_up_to(longest));
      EXPECT_EQ(curve.stop, StopReason::several_ways) << curve.stop_detail;
      ASSERT_EQ(curve.hits.size(), 1u);
      EXPECT_EQ(curve.hits[0].kind, HitKind::branching_kink);
      EXPECT_NEAR(curve.hits[0].point.lambda, 1, 1e-10);
      EXPECT_EQ(curve.hits[0].leaving.size(), stiffness > 0 ? 2u : 3u)
          << "up and down the straight state, and the other half of a whole pitchfork";
    }
  }
}

TEST(HalfBranches, ThatBothSidesHaveTogetherAreBothFound) {
  // c = 0: an ordinary pitchfork that only the switch makes a kink
  OneSidedModes problem;
  problem.c[0] = 0;
  const Curve curve = follow_straight(problem, {-1}, 2);
  const auto kinks = hits_of(curve, HitKind::branching_kink);
  ASSERT_EQ(kinks.size(), 1u);
  EXPECT_EQ(kinks[0].leaving.size(), 3u);
  EXPECT_NEAR(kinks[0].point.lambda, 1, 1e-10);
}

TEST(HalfBranches, OfTwoSpringsAreThoseWhoseModesLieInTheirPieces) {
  // a = 1, c = 1/2, b = -1/5. Eigenvalues a + {0, c} -+ b with modes (1, -+1) and, with one spring,
  // a + c/2 -+ sqrt(c^2/4 + b^2): the lower mode moves both ways together, the upper ones oppositely.
  const OneSidedModes problem{2, Vector::Constant(2, 1.0), Vector::Constant(2, 0.5), -0.2};
  const double mixed = 1.25 + std::sqrt(0.0625 + 0.04);
  for (const Piece& piece : {Piece{-1, -1}, Piece{1, 1}, Piece{1, -1}}) {
    const Curve curve = follow_straight(problem, piece, 2.2);
    ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
    const auto kinks = hits_of(curve, HitKind::branching_kink);
    ASSERT_EQ(kinks.size(), 3u);
    EXPECT_NEAR(kinks[0].point.lambda, 0.8, 1e-10);
    ASSERT_EQ(kinks[0].leaving.size(), 2u);
    EXPECT_EQ(kinks[0].leaving[1].piece, (Piece{-1, -1}));
    EXPECT_NEAR(kinks[1].point.lambda, 1.3, 1e-10);
    ASSERT_EQ(kinks[1].leaving.size(), 2u);
    EXPECT_EQ(kinks[1].leaving[1].piece, (Piece{1, 1}));
    EXPECT_NEAR(kinks[2].point.lambda, mixed, 1e-10);
    ASSERT_EQ(kinks[2].leaving.size(), 3u);
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
      EXPECT_EQ(kinks[2].leaving[i].piece[0], -kinks[2].leaving[i].piece[1]);
    EXPECT_TRUE(hits_of(curve, HitKind::branch_point).empty());
    EXPECT_TRUE(hits_of(curve, HitKind::unresolved).empty());
  }
}

TEST(HalfBranches, AreNotInventedWhereTheModeLiesInAnotherPiece) {
  // (1, -1) at a - b = 1.2 in the piece (-, -): its index changes, nothing leaves
  const OneSidedModes problem{2, Vector::Constant(2, 1.0), Vector::Constant(2, 0.5), -0.2};
  const Curve curve = follow_straight(problem, {-1, -1}, 2.2);
  const auto kinks = hits_of(curve, HitKind::kink);
  ASSERT_EQ(kinks.size(), 1u);
  EXPECT_NEAR(kinks[0].point.lambda, 1.2, 1e-10);
  EXPECT_EQ(kinks[0].leaving.size(), 1u);
}

TEST(HalfBranches, AreToldOnceWherePiecesWithAndWithoutAHardlyStretchedSpringBuckleTogether) {
  // The mode (1, 5e-4) buckles at 2 - sqrt(1 + b^2) without springs and at 1/2 more with both. With only one of them
  // the zero is about 1e-7 beside, and its mode lies in another piece.
  const double b = -1e-3;
  const OneSidedModes problem{2, Vector{{1, 3}}, Vector::Constant(2, 0.5), b};
  const Curve curve = follow_straight(problem, {1, 1}, 2);
  const auto kinks = hits_of(curve, HitKind::branching_kink);
  ASSERT_EQ(kinks.size(), 2u);
  EXPECT_NEAR(kinks[0].point.lambda, 2 - std::sqrt(1 + b * b), 1e-10);
  EXPECT_NEAR(kinks[1].point.lambda, 2.5 - std::sqrt(1 + b * b), 1e-10);
  for (const Hit& kink : kinks) EXPECT_EQ(kink.leaving.size(), 2u);
}

TEST(HalfBranches, AreTheSameInTheOtherDirection) {
  const OneSidedModes problem{2, Vector{{1, 1.1}}, Vector{{0.5, 0.3}}, -0.2};
  const Curve up = follow_straight(problem, {1, -1}, 2.2);
  const Curve down =
      follow(problem, {Vector::Zero(2), 2.2, {1, -1}, {Vector::Zero(2), -1}}, {lambda_reaches(0)});
  auto a = hits_of(up, HitKind::branching_kink), b = hits_of(down, HitKind::branching_kink);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Hit& other = b[b.size() - 1 - i];
    EXPECT_NEAR(a[i].point.lambda, other.point.lambda, 1e-10);
    EXPECT_EQ(a[i].leaving.size(), other.leaving.size());
  }
}

TEST(HalfBranches, AreFoundInAllPiecesOfTenSwitches) {
  // ten springs in ten motions of their own: 1,024 pieces, all with room beside the branch
  const OneSidedModes problem{10, Vector::LinSpaced(10, 1.0, 1.9), Vector::Constant(10, 0.5), 0};
  const Curve curve = follow_straight(problem, Piece(10, 1), 1.15);
  EXPECT_EQ(curve.stop, StopReason::event);
  EXPECT_TRUE(hits_of(curve, HitKind::unresolved).empty());
  // Without its spring a motion goes at 1.0, 1.1, ..., to one side.
  const auto kinks = hits_of(curve, HitKind::branching_kink);
  ASSERT_EQ(kinks.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(kinks[i].point.lambda, i == 0 ? 1.0 : 1.1, 1e-10);
    EXPECT_EQ(kinks[i].leaving.size(), 2u);
  }
}

TEST(HalfBranches, AreSaidToBeUnresolvedWhereTooManySwitchesRest) {
  const OneSidedModes problem{13, Vector::Constant(13, 1.0), Vector::Constant(13, 0.5), 0};
  const Ray straight{Piece(13, 1), {Vector::Zero(13), 1}};
  const Curve curve = trace(problem, Vector::Zero(13), 0, straight, {lambda_reaches(0.5)}, {});
  EXPECT_EQ(curve.stop, StopReason::event);
  const auto unresolved = hits_of(curve, HitKind::unresolved);
  ASSERT_EQ(unresolved.size(), 1u) << "once for the whole branch";
  EXPECT_EQ(unresolved[0].s_before, 0);
  EXPECT_NEAR(unresolved[0].s_after, 0.5, 0.06);
}

/// A mast on springs that are strung all around it, and just rest: each pulls along its direction d_j with
/// c_j (d_j x)_+, the load pushes with lambda x, |x|^2 x holds beyond.
struct SpringsAround {
  Matrix d{};  ///< k x 2
  Vector c{};

  static Index size() { return 2; }
  static bool symmetric() { return true; }
  Matrix stiffness(const Piece& piece) const {
    Matrix K = Matrix::Zero(2, 2);
    for (Index j = 0; j < c.size(); ++j)
      if (piece[static_cast<std::size_t>(j)] > 0) K += c[j] * d.row(j).transpose() * d.row(j);
    return K;
  }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    F = stiffness(piece) * x + (x.squaredNorm() - lambda) * x;
    return true;
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = stiffness(piece) + (x.squaredNorm() - lambda) * Matrix::Identity(2, 2) +
            2 * x * x.transpose();
    dF_dlambda = -x;
    return true;
  }
  Index switch_count() const { return c.size(); }
  bool switches(const Vector& x, double, Vector& g) const {
    g = d * x;
    return true;
  }
  bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) const {
    dg_dx = d;
    dg_dlambda = Vector::Zero(c.size());
    return true;
  }

  Piece piece_of(const Vector& x) const {
    Piece piece;
    for (Index j = 0; j < c.size(); ++j) piece.push_back(d.row(j).dot(x) > 0 ? 1 : -1);
    return piece;
  }

  /// Loads at which something leaves: eigenvalues of the stiffness of a cone whose eigenvector lies in it. The cones
  /// are found by going round in small steps.
  std::vector<double> branching_loads() const {
    std::set<Piece> seen;
    std::vector<double> loads;
    for (int step = 0; step < 36000; ++step) {
      const double angle = 2 * std::numbers::pi * (step + 0.5) / 36000;
      const Piece piece = piece_of(Vector{{std::cos(angle), std::sin(angle)}});
      if (!seen.insert(piece).second) continue;
      const SymmetricEigen eigen = symmetric_eigen(stiffness(piece));
      for (Index i = 0; i < 2; ++i)
        for (const double sign : {1.0, -1.0})
          if (piece_of(sign * eigen.vectors.col(i)) == piece) loads.push_back(eigen.values[i]);
    }
    std::sort(loads.begin(), loads.end());
    return loads;
  }
};

TEST(HalfBranches, OfTwelveSpringsAroundAMastAreAllFound) {
  SpringsAround problem{Matrix(12, 2), Vector(12)};
  for (Index j = 0; j < 12; ++j) {
    const auto number = static_cast<double>(j);
    const double angle = 2 * std::numbers::pi * number / 12 + 0.1 * std::sin(5 * number);
    problem.d.row(j) << std::cos(angle), std::sin(angle);
    problem.c[j] = 1 + 0.8 * std::sin(2 * number + 1);
  }
  const std::vector<double> loads = problem.branching_loads();
  ASSERT_GE(loads.size(), 4u) << "least and largest stiffness of the way round, at the least";
  const Curve curve = follow(problem, {Vector::Zero(2), 0, Piece(12, 1), {Vector::Zero(2), 1}},
                             {lambda_reaches(loads.back() + 1)});
  EXPECT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
  EXPECT_TRUE(hits_of(curve, HitKind::unresolved).empty());
  const auto kinks = hits_of(curve, HitKind::branching_kink);
  ASSERT_EQ(kinks.size(), loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    EXPECT_NEAR(kinks[i].point.lambda, loads[i], 1e-10);
    EXPECT_EQ(kinks[i].leaving.size(), 2u) << "straight on, and one half-branch";
  }
}

TEST(HalfBranches, TheStepLogSaysThatASwitchRestsAndWhatTheOtherSideIs) {
  OneSidedModes problem;
  problem.a[0] = -1;
  problem.c[0] = 3;
  const Curve curve = follow_straight(problem, {1}, 0.5);
  ASSERT_FALSE(curve.log.empty());
  EXPECT_THAT(curve.log[0].reason, HasSubstr("stays on the surface of switch 1"));
  EXPECT_THAT(curve.log[0].reason, HasSubstr("negative eigenvalues: 0, 1 beyond switch 1"));
}

}  // namespace
}  // namespace springfold::continuation
