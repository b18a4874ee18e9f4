// Extrema of the force that drives lambda, followed in a parameter: limit points of the equations with lambda free.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "parameters/families.hpp"

namespace springfold::continuation {
namespace {

constexpr double radians_of_degree = std::numbers::pi / 180;
constexpr double sway_of_truss = 0.2;  ///< stiffness of a spring across

/// Two bars of stiffness 1 from (-1, 0) and (1, 0) to an apex at (x, y), free length 1/cos(alpha), and a spring across:
/// what holds the apex, and its derivatives.
struct Truss {
  double alpha = 1;

  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double, Vector& F) const {
    Matrix J;
    Vector by_lambda;
    return terms(x, F, J);
  }
  bool derivatives(const Vector& x, double, Matrix& J, Vector& by_lambda) const {
    Vector F;
    by_lambda = Vector::Zero(2);
    return terms(x, F, J);
  }
  bool terms(const Vector& x, Vector& F, Matrix& J) const {
    F = Vector{{sway_of_truss * x[0], 0}};
    J = Matrix{{sway_of_truss, 0}, {0, 0}};
    for (const double foot : {-1.0, 1.0}) {
      const Vector d = x - Vector{{foot, 0}};
      const double l = d.norm(), r = 1 / std::cos(alpha) / l;
      F += (1 - r) * d;
      J += (1 - r) * Matrix::Identity(2, 2) + r * d * d.transpose() / (l * l);
    }
    return true;
  }
};

constexpr double unit_of_drive = -0.5;  ///< y = unit_of_drive * lambda

/// The same with y prescribed: an equation for x.
struct DrivenTruss {
  Truss truss{};

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    truss.residual(Vector{{x[0], unit_of_drive * lambda}}, 0, F);
    F.conservativeResize(1);
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& J, Vector& by_lambda) const {
    Matrix both;
    truss.derivatives(Vector{{x[0], unit_of_drive * lambda}}, 0, both, by_lambda);
    J = both.topLeftCorner(1, 1);
    by_lambda = unit_of_drive * both.topRightCorner(1, 1);
    return true;
  }
};

Family driven_trusses() {
  return family_of<DrivenTruss>([](double alpha) { return DrivenTruss{{alpha}}; });
}
Freed free_trusses() {
  return {.at = family_of<Truss>([](double alpha) { return Truss{alpha}; }).at,
          .place = 1,
          .unit = unit_of_drive};
}

/// A symmetric state whose bars stand at the angle f.
CriticalStart state_at(CriticalKind kind, double alpha, double f) {
  CriticalStart start = start_at(kind, single(0), std::tan(f) / unit_of_drive, alpha);
  start.freed = free_trusses();
  return start;
}

/// Where the force is extremal: cos^3 f = cos(alpha).
double angle_of_limit(double alpha) { return std::acos(std::cbrt(std::cos(alpha))); }
double force_at(double alpha, double f) {
  return 2 * (1 / std::cos(alpha) - 1 / std::cos(f)) * std::sin(f);
}

/// Where branch points meet the limit point: cos(alpha) = (2 + sway_of_truss/2)^(-3/2).
const double alpha_of_hilltop = std::acos(std::pow(2 + sway_of_truss / 2, -1.5));

/// The branch point: sin^2 f cos f = (1 + sway_of_truss/2) cos(alpha), the upper one of two.
double angle_of_branching(double alpha) {
  double low = std::atan(std::sqrt(2)), high = alpha;
  for (int i = 0; i < 100; ++i) {
    const double f = (low + high) / 2;
    const bool is_above =
        std::cos(f) * std::pow(std::sin(f), 2) > (1 + sway_of_truss / 2) * std::cos(alpha);
    (is_above ? low : high) = f;
  }
  return (low + high) / 2;
}

void expect_hilltop(const CriticalCurve& curve) {
  const auto hilltops = hits_of(curve, Degeneracy::hilltop);
  ASSERT_EQ(hilltops.size(), 1U);
  EXPECT_EQ(hilltops[0].name, "limit point of the force");
  EXPECT_NEAR(hilltops[0].point.mu, alpha_of_hilltop, 1e-10);
  ASSERT_EQ(hilltops[0].point.x.size(), 1);
  EXPECT_NEAR(hilltops[0].point.x[0], 0, 1e-9);
  EXPECT_NEAR(force_at(alpha_of_hilltop, std::atan(unit_of_drive * hilltops[0].point.lambda)),
              2.3073794659743, 1e-9);
}

TEST(Freed, CurveOfLimitPointsOfTheForceHasTheHilltopOfTheSameTrussUnderItsLoad) {
  const double alpha = 66 * radians_of_degree;
  const auto curve =
      follow_critical(driven_trusses(), state_at(CriticalKind::zero, alpha, angle_of_limit(alpha)),
                      true, {stop_at(60 * radians_of_degree, 78 * radians_of_degree)}, {});
  expect_hilltop(curve);
  EXPECT_TRUE(hits_of(curve, Degeneracy::corank_two).empty());
  for (const CriticalPoint& p : curve.points) {
    EXPECT_NEAR(std::atan(unit_of_drive * p.lambda), angle_of_limit(p.mu), 1e-9);
    EXPECT_NEAR(p.x[0], 0, 1e-9);
  }
}

TEST(Freed, CurveOfDrivenBranchPointsHasItToo) {
  const double alpha = 76 * radians_of_degree;
  const auto curve = follow_critical(
      driven_trusses(), state_at(CriticalKind::branch_point, alpha, angle_of_branching(alpha)),
      false, {stop_at(65 * radians_of_degree, 78 * radians_of_degree)}, {});
  EXPECT_TRUE(curve.kept);
  expect_hilltop(curve);
}

TEST(Freed, ArcLengthsAreThoseOfTheDrivenState) {
  const double alpha = 66 * radians_of_degree;
  const auto curve =
      follow_critical(driven_trusses(), state_at(CriticalKind::zero, alpha, angle_of_limit(alpha)),
                      true, {stop_at(60 * radians_of_degree, 78 * radians_of_degree)}, {});
  for (const CriticalPoint& p : curve.points)
    EXPECT_NEAR(std::hypot(p.dx.norm(), p.dlambda, p.dmu), 1, 1e-9);
}

TEST(Freed, RateOfALimitPointOfTheForceIsThatOfTheClosedForm) {
  const double alpha = 66 * radians_of_degree, f = angle_of_limit(alpha);
  const auto rate = critical_rate(driven_trusses(), state_at(CriticalKind::zero, alpha, f));
  ASSERT_TRUE(rate);
  // 3 cos^2 f sin f df = sin(alpha) dalpha, and y = tan f.
  const double df = std::sin(alpha) / (3 * std::pow(std::cos(f), 2) * std::sin(f));
  EXPECT_NEAR(rate->dlambda, df / std::pow(std::cos(f), 2) / unit_of_drive, 1e-9);
  EXPECT_NEAR(rate->dx[0], 0, 1e-9);
}

TEST(Freed, LimitPointOfTheForceIsFoundFromBeside) {
  const double alpha = 66 * radians_of_degree, f = angle_of_limit(alpha);
  CriticalStart start = state_at(CriticalKind::zero, alpha, f + 0.01);
  const auto point = polish_critical(driven_trusses(), start);
  ASSERT_TRUE(point);
  EXPECT_NEAR(std::atan(unit_of_drive * point->lambda), f, 1e-12);
}

/// The truss over a spring that pushes its apex up where that is below the height `stop`.
struct StoppedTruss {
  Truss truss{};
  double stiffness = 0, stop = 0;

  static Index size() { return 2; }
  static bool symmetric() { return true; }
  double acting(const Piece& piece) const { return piece[0] < 0 ? stiffness : 0; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    truss.residual(x, lambda, F);
    F[1] += acting(piece) * (x[1] - stop);
    return true;
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& J,
                   Vector& by_lambda) const {
    truss.derivatives(x, lambda, J, by_lambda);
    J(1, 1) += acting(piece);
    return true;
  }
  static Index switch_count() { return 1; }
  bool switches(const Vector& x, double, Vector& g) const {
    g = single(x[1] - stop);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{0, 1}};
    dg_dlambda = Vector::Zero(1);
    return true;
  }
  static const char* switch_name(Index) { return "stop"; }
};

/// The same with y prescribed.
struct DrivenStoppedTruss {
  StoppedTruss free{};

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, const Piece&, Vector& F) const {
    return DrivenTruss{free.truss}.residual(x, lambda, F);
  }
  bool derivatives(const Vector& x, double lambda, const Piece&, Matrix& J,
                   Vector& by_lambda) const {
    return DrivenTruss{free.truss}.derivatives(x, lambda, J, by_lambda);
  }
  static Index switch_count() { return 1; }
  bool switches(const Vector&, double lambda, Vector& g) const {
    g = single(unit_of_drive * lambda - free.stop);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Zero(1, 1);
    dg_dlambda = single(unit_of_drive);
    return true;
  }
  static const char* switch_name(Index) { return "stop"; }
};

using StoppedTrusses = std::function<StoppedTruss(double mu)>;
Family driven(const StoppedTrusses& of) {
  return family_of<DrivenStoppedTruss>([=](double mu) { return DrivenStoppedTruss{of(mu)}; });
}
/// A limit point of the force whose bars stand at the angle f.
CriticalStart limit_of(const StoppedTrusses& of, double mu, double f, const Piece& piece) {
  CriticalStart start = start_at(CriticalKind::zero, single(0), std::tan(f) / unit_of_drive, mu);
  start.piece = piece;
  start.freed = {.at = family_of<StoppedTruss>(of).at, .place = 1, .unit = unit_of_drive};
  return start;
}

TEST(Freed, CurveOfLimitPointsOfTheForceEndsWhereItReachesASpringThatSwitches) {
  const double alpha = 66 * radians_of_degree, end = 62 * radians_of_degree,
               stop = std::tan(angle_of_limit(end));
  const StoppedTrusses trusses = [=](double mu) { return StoppedTruss{{mu}, 0.3, stop}; };
  const auto curve =
      follow_critical(driven(trusses), limit_of(trusses, alpha, angle_of_limit(alpha), {1}), false,
                      {stop_at(55 * radians_of_degree, 70 * radians_of_degree)}, {});
  const auto ends = hits_of(curve, Degeneracy::fold_meets_activation);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].name, "stop");
  EXPECT_NEAR(ends[0].point.mu, end, 1e-10);
  EXPECT_NEAR(unit_of_drive * ends[0].point.lambda, stop, 1e-10);
  EXPECT_EQ(curve.stop, StopReason::event);
}

TEST(Freed, CurveOfLimitPointsOfTheForceFollowsASpringWhoseLawChangesAlongIt) {
  // cos^3 f = (1 + stiffness/2) cos(alpha) below the stop, which rises with the stiffness.
  const double alpha = 72 * radians_of_degree;
  const StoppedTrusses trusses = [=](double mu) { return StoppedTruss{{alpha}, mu, 3 + mu}; };
  const auto angle = [=](double stiffness) {
    return std::acos(std::cbrt((1 + stiffness / 2) * std::cos(alpha)));
  };
  const auto curve = follow_critical(driven(trusses), limit_of(trusses, 0.2, angle(0.2), {-1}),
                                     true, {stop_at(0.1, 1)}, {});
  EXPECT_EQ(curve.stop_detail, "end");
  EXPECT_GT(curve.points.back().mu, 0.9);
  for (const CriticalPoint& p : curve.points) {
    EXPECT_NEAR(std::atan(unit_of_drive * p.lambda), angle(p.mu), 1e-9);
    EXPECT_NEAR(p.x[0], 0, 1e-9);
  }
}

}  // namespace
}  // namespace springfold::continuation
