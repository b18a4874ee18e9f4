// Branch points of a piece on a branch along which switches rest, in a second parameter.
#include <gtest/gtest.h>

#include <algorithm>

#include "parameters/families.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {
namespace {

/// Two unknowns coupled by m, x = 0 for every load: F = [1 - l, m; m, 2 - l] x + 3 [x0]_+ e0, and cubes. Switches x0,
/// which leaves zero by `off`, and x1.
struct Rests {
  double m = 0, off = 0;
  Index size() const { return 2; }
  static bool symmetric() { return true; }
  static Index switch_count() { return 2; }
  bool residual(const Vector& x, double l, const Piece& piece, Vector& F) const {
    const Vector cubes = x.array().cube();
    F = matrix(l, piece) * x + cubes;
    return true;
  }
  bool derivatives(const Vector& x, double l, const Piece& piece, Matrix& J,
                   Vector& by_lambda) const {
    J = matrix(l, piece);
    J.diagonal() += Vector(3 * x.array().square());
    by_lambda = -x;
    return true;
  }
  bool switches(const Vector& x, double, Vector& g) const {
    g = Vector{{x[0] + off, x[1]}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Identity(2, 2);
    dg_dlambda = Vector::Zero(2);
    return true;
  }
  static std::string switch_name(Index j) { return j == 0 ? "first" : "second"; }

 private:
  Matrix matrix(double l, const Piece& piece) const {
    return Matrix{{1 - l + (piece[0] > 0 ? 3 : 0), m}, {m, 2 - l}};
  }
};

CriticalStart start_on(Piece piece, double lambda, double mu) {
  CriticalStart start = start_at(CriticalKind::branch_point, Vector::Zero(2), lambda, mu);
  start.piece = std::move(piece);
  start.resting = {0, 1};
  return start;
}

/// The least eigenvalue of [a, m; m, 2].
double least(double a, double m) { return (a + 2) / 2 - std::hypot((a - 2) / 2, m); }

TEST(RestingSwitches, OfAPieceHaveItsCriticalLoadOverAParameter) {
  const Family family = family_of<Rests>([](double mu) { return Rests{.m = mu}; });
  const auto start = start_on({-1, 1}, least(1, 0.5), 0.5);
  const auto curve = follow_critical(family, start, true, {stop_at(0, 0.9)}, {});
  EXPECT_EQ(curve.stop, StopReason::event);
  EXPECT_NEAR(curve.hits.back().point.mu, 0.9, 1e-10);
  for (const CriticalPoint& p : curve.points) EXPECT_NEAR(p.lambda, least(1, p.mu), 1e-12);
}

TEST(RestingSwitches, EndTheCurveWhereTheModeComesToASurface) {
  // At mu = 0 the mode is x0 alone: beyond it the half-branch leaves in the piece on the other side of x1.
  const Family family = family_of<Rests>([](double mu) { return Rests{.m = mu}; });
  const auto start = start_on({-1, 1}, least(1, 0.5), 0.5);
  const auto curve = follow_critical(family, start, false, {stop_at(-0.9, 1)}, {});
  const auto hits = hits_of(curve, Degeneracy::fold_meets_activation);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].name, "second");
  EXPECT_NEAR(hits[0].point.mu, 0, 1e-9);
  EXPECT_NEAR(hits[0].point.lambda, 1, 1e-12);
  EXPECT_EQ(curve.stop, StopReason::event);
}

TEST(RestingSwitches, EndTheCurveWhereOneOfThemLeavesZero) {
  const Family family =
      family_of<Rests>([](double mu) { return Rests{.m = mu, .off = std::max(0.0, mu - 0.7)}; });
  const auto start = start_on({-1, 1}, least(1, 0.5), 0.5);
  const auto curve = follow_critical(family, start, true, {stop_at(0, 0.9)}, {});
  const auto hits = hits_of(curve, Degeneracy::fold_meets_activation);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].name, "first");
  EXPECT_NEAR(hits[0].point.mu, 0.7, 1e-9);
}

}  // namespace
}  // namespace springfold::continuation
