// Double points at which the branch itself turns in lambda: three equal snap springs in series carry
// one force, lambda = A x_i^3 - B x_i. At x_i = +-sqrt(B / 3A) all of them fold together.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <array>
#include <random>

#include "continuation/locating/branch_point.hpp"
#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// F_i = (A x_i^3 - B x_i - lambda) / s_i in the unknowns q_i = s_i x_i.
struct SnapSprings {
  double A = 1, B = 1;
  Vector s = Vector::Ones(3);

  Index size() const { return s.size(); }
  static bool symmetric() { return true; }
  bool residual(const Vector& q, double lambda, Vector& F) const {
    const auto x = q.array() / s.array();
    F = ((A * x.square() - B) * x - lambda) / s.array();
    return true;
  }
  bool derivatives(const Vector& q, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    const auto x = q.array() / s.array();
    dF_dx = ((3 * A * x.square() - B) / s.array().square()).matrix().asDiagonal();
    dF_dlambda = -s.cwiseInverse();
    return true;
  }

  double fold() const { return std::sqrt(B / (3 * A)); }
  Vector elongations(const CurvePoint& p) const { return p.x.cwiseQuotient(s) / fold(); }
  StartPoint at(const Vector& x) const {
    StartPoint start{x.cwiseProduct(s), (A * x[0] * x[0] - B) * x[0]};
    start.towards = {s, 0};
    return start;
  }
  std::vector<Event> ends() const {
    const auto beyond = [*this](double sign) {
      return stop_where(
          "end", [*this, sign](const CurvePoint& p) { return elongations(p).mean() - sign * 2.5; });
    };
    return {beyond(1), beyond(-1)};
  }
  /// Partner of t on the same force: y^2 + y t + t^2 = B / A.
  double other(double t, double sign) const {
    return 0.5 * (-t + sign * std::sqrt(4 * B / A - 3 * t * t));
  }
};

double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
}

SnapSprings random_springs(std::mt19937& random) {
  SnapSprings springs{between(random, 0.5, 2), between(random, 0.5, 2)};
  for (double& s : springs.s) s = std::pow(10, between(random, -0.3, 0.3));
  return springs;
}

/// A start anywhere on the branch of equal springs, or on one where the third spring is apart.
StartPoint random_start(const SnapSprings& springs, bool equal, std::mt19937& random) {
  const double t = between(random, -1.9, 1.9) * springs.fold();
  if (equal) return springs.at(Vector::Constant(3, t));
  return springs.at(Vector{{t, t, springs.other(t, random() % 2 == 0 ? 1 : -1)}});
}

TEST(TurningDoublePoint, IsNoLimitPointOfTheBranchOfEqualSprings) {
  std::mt19937 random(3);
  for (int draw = 0; draw < 30; ++draw) {
    const SnapSprings springs = random_springs(random);
    const StartPoint start = springs.at(Vector::Constant(3, -2.3 * springs.fold()));
    const Curve curve = follow(springs, start, springs.ends());
    ASSERT_EQ(curve.hits.size(), 3u) << draw;
    for (const std::size_t i : {0u, 1u}) {
      const Hit& hit = curve.hits[i];
      EXPECT_EQ(hit.kind, HitKind::branch_point) << draw;
      EXPECT_EQ(hit.multiplicity, 2) << draw;
      const Vector x = springs.elongations(hit.point);
      EXPECT_LT((x.array() - (i == 0 ? -1 : 1)).abs().maxCoeff(), 1e-12) << draw;
      EXPECT_LT(std::abs(hit.point.tangent.dlambda), 1e-12) << draw;
    }
  }
}

TEST(TurningDoublePoint, IsToldFromSimplePointsAndFoldsOfASecondaryBranch) {
  std::mt19937 random(4);
  for (int draw = 0; draw < 30; ++draw) {
    const SnapSprings springs = random_springs(random);
    const Curve lap = follow(springs, random_start(springs, false, random), {});
    EXPECT_EQ(lap.stop, StopReason::closed) << draw;
    int doubles = 0, simple = 0, folds = 0;
    for (const Hit& hit : lap.hits) {
      const Vector x = springs.elongations(hit.point);
      const double t = std::abs(x[0]), y = std::abs(x[2]);
      const bool meets_all = std::abs(t - 1) + std::abs(y - 1) < 1e-10;
      const bool meets_one = std::abs(t - 1) + std::abs(y - 2) < 1e-10;
      const bool turns = std::abs(t - 2) + std::abs(y - 1) < 1e-10;
      doubles += hit.kind == HitKind::branch_point && hit.multiplicity == 2 && meets_all;
      simple += hit.kind == HitKind::branch_point && hit.multiplicity == 1 && meets_one;
      folds += hit.kind == HitKind::limit_point && turns;
    }
    EXPECT_EQ(lap.hits.size(), 6u) << draw;
    EXPECT_EQ(doubles, 2) << draw;
    EXPECT_EQ(simple, 2) << draw;
    EXPECT_EQ(folds, 2) << draw;
  }
}

/// A point inside every arc between neighbouring junctions: three of equal springs, four of each
/// ellipse with one spring apart, six of the circle on which all are different.
std::vector<Vector> arcs_of(const SnapSprings& springs) {
  const double fold = springs.fold();
  std::vector<Vector> arcs;
  for (const double t : {-2.0, 0.0, 2.0}) arcs.push_back(Vector::Constant(3, t * fold));
  for (const Index k : {0, 1, 2})
    for (const auto& [t, sign] : {std::pair{0.1, 1}, {0.1, -1}, {1.5, 1}, {-1.5, -1}}) {
      arcs.push_back(Vector::Constant(3, t * fold));
      arcs.back()[k] = springs.other(t * fold, sign);
    }
  const Vector e = Vector{{1, -1, 0}}.normalized(), f = Vector{{1, 1, -2}}.normalized();
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::acos(0.5);
    arcs.push_back(std::sqrt(2 * springs.B / springs.A) *
                   (std::cos(angle) * e + std::sin(angle) * f));
  }
  return arcs;
}

int branches_through(const SnapSprings& springs, const Diagram& diagram, const Vector& x) {
  const StartPoint at = springs.at(x);
  CurvePoint point;
  point.x = at.x;
  point.lambda = at.lambda;
  point.tangent = ray_of(springs, at, {}).tangent;
  int passes = 0;
  for (const Branch& branch : diagram.branches)
    passes += passes_through(springs, branch.curve, point, {});
  return passes;
}

void expect_whole_diagram(const SnapSprings& springs, const StartPoint& start) {
  const Diagram diagram = trace_diagram(
      springs, {{.x = start.x, .lambda = start.lambda, .piece = {}}}, springs.ends(), {});
  EXPECT_TRUE(diagram.doubts.empty()) << diagram.doubts.front();
  std::array<int, 3> junctions{};
  std::size_t ways = 0;
  for (const Junction& junction : diagram.junctions) {
    ASSERT_LE(junction.multiplicity, 2);
    ++junctions[static_cast<std::size_t>(junction.multiplicity)];
    EXPECT_EQ(junction.ways.size(), junction.multiplicity == 2 ? 8u : 4u);
    ways += junction.ways.size();
  }
  EXPECT_EQ(junctions[2], 2);
  EXPECT_EQ(junctions[1], 6);
  const std::vector<Vector> arcs = arcs_of(springs);
  EXPECT_EQ(ways, 2 * arcs.size() - 2);  // two ends are ends of the range
  for (const Vector& x : arcs)
    EXPECT_EQ(branches_through(springs, diagram, x), 1) << x.transpose() / springs.fold();
}

TEST(TurningDoublePoint, OfTheDiagramJoinsEveryArcOnce) {
  std::mt19937 random(5);
  for (int draw = 0; draw < 16; ++draw) {
    const SnapSprings springs = random_springs(random);
    expect_whole_diagram(springs, random_start(springs, draw % 2 == 0, random));
    if (HasFailure()) FAIL() << "draw " << draw;
  }
  const SnapSprings stubborn{1.2984589945049954, 0.69206848588817205,
                             Vector{{1.7418607054302333, 1.7558902609833456, 0.75614597146958706}}};
  expect_whole_diagram(stubborn, stubborn.at(Vector::Constant(3, 0.2876079201829308)));
}

TEST(TurningDoublePoint, IsPlacedToRoundingFromRoughPlaces) {
  const SnapSprings springs{1.3, 0.7, Vector{{1.7, 0.6, 1.1}}};
  const Walker walker{springs, Vector::Ones(3), {}};
  const StartPoint exact = springs.at(Vector::Constant(3, springs.fold()));
  for (const double error : {1e-4, 1e-6, 0.0}) {
    CurvePoint near;
    near.x = exact.x + error * Vector{{1, -0.5, 0.3}};
    near.lambda = exact.lambda + error;
    near.tangent = {springs.s.normalized(), 0};
    const auto place = place_branch_point(walker, near, 2);
    ASSERT_TRUE(place.has_value()) << error;
    EXPECT_LT((place->point.x - exact.x).norm(), 1e-13) << error;
    EXPECT_NEAR(place->point.lambda, exact.lambda, 1e-14) << error;
    EXPECT_LT(place->off, 1e-13) << error;
    EXPECT_LT(place->left, branches_apart) << error;
  }
}

}  // namespace
}  // namespace springfold::continuation
