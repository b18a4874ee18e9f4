// Critical curves of small structures with closed forms: trusses, domes, struts, toggles.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "parameters/families.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// n bars of stiffness 1 from a circle of radius 1 to an apex; free length 1/cos(alpha); lateral springs kl at the
/// apex; P down. n = 2 is a von Mises truss.
struct Dome {
  int n = 2;
  double alpha = 1, kl = 0;

  Index size() const { return n == 2 ? 2 : 3; }
  static bool symmetric() { return true; }
  Vector foot(int i) const {
    const double turn = 2 * std::numbers::pi * i / n;
    return n == 2 ? Vector{{std::cos(turn), 0}} : Vector{{std::cos(turn), std::sin(turn), 0}};
  }
  bool terms(const Vector& x, double P, Vector& F, Matrix& J) const {
    const Index m = size();
    Vector lateral = Vector::Constant(m, kl);
    lateral[m - 1] = 0;
    F = lateral.cwiseProduct(x) + P * Vector::Unit(m, m - 1);
    J = lateral.asDiagonal();
    for (int i = 0; i < n; ++i) {
      const Vector d = x - foot(i);
      const double l = d.norm(), r = 1 / std::cos(alpha) / l;
      if (!(l > 1e-3)) return false;
      F += (1 - r) * d;
      J += (1 - r) * Matrix::Identity(m, m) + r * d * d.transpose() / (l * l);
    }
    return true;
  }
  bool residual(const Vector& x, double P, Vector& F) const {
    Matrix J;
    return terms(x, P, F, J);
  }
  bool derivatives(const Vector& x, double P, Matrix& J, Vector& by_P) const {
    Vector F;
    by_P = Vector::Unit(size(), size() - 1);
    return terms(x, P, F, J);
  }
};

/// The branch point of a dome whose bars stand at the angle f.
CriticalStart branch_point(int n, double alpha, double f) {
  CriticalStart start{.kind = CriticalKind::branch_point, .mu = alpha, .corank = n == 2 ? 1 : 2};
  start.x = Vector::Zero(n == 2 ? 2 : 3);
  start.x[start.x.size() - 1] = std::tan(f);
  start.lambda = n * (1 / std::cos(alpha) - 1 / std::cos(f)) * std::sin(f);
  return start;
}

/// The root of a falling function between a and b.
double root(const std::function<double(double)>& f, double a, double b) {
  for (int i = 0; i < 200; ++i) (f((a + b) / 2) > 0 ? a : b) = (a + b) / 2;
  return (a + b) / 2;
}

TEST(CriticalStructures, SwayOfAVonMisesTrussHasAHilltopAndABirth) {
  const double h = 0.1, alpha = 74 * degree;
  const Family family =
      family_of<Dome>([=](double a) { return Dome{.n = 2, .alpha = a, .kl = 2 * h}; });
  const double f = root(
      [&](double t) { return std::cos(t) * std::pow(std::sin(t), 2) - (1 + h) * std::cos(alpha); },
      std::atan(std::sqrt(2)), alpha);
  const auto curve = follow_critical(family, branch_point(2, alpha, f), false,
                                     {stop_at(65 * degree, 76 * degree)}, {});
  EXPECT_TRUE(curve.kept);
  const auto births = hits_of(curve, Degeneracy::branch_points_merge);
  ASSERT_EQ(births.size(), 1U);
  EXPECT_NEAR(births[0].point.mu / degree, 69.518235210634, 1e-9);
  EXPECT_NEAR(births[0].point.lambda, 1.8384776310850, 1e-9);
  const auto hilltops = hits_of(curve, Degeneracy::hilltop);
  ASSERT_EQ(hilltops.size(), 1U);
  EXPECT_NEAR(hilltops[0].point.mu / degree, 70.816016196273, 1e-8);
  EXPECT_NEAR(hilltops[0].point.lambda, 2.3073794659743, 1e-9);
}

TEST(CriticalStructures, DoubleBranchPointsOfADomeAreBornInPairsToo) {
  const double hh = 0.1, alpha = 62 * degree;
  const Family family =
      family_of<Dome>([=](double a) { return Dome{.n = 3, .alpha = a, .kl = 3 * hh}; });
  const double f = root(
      [&](double t) {
        const double c = std::cos(t);
        return c * (1 - c * c / 2) - (1 + hh) * std::cos(alpha);
      },
      std::acos(std::sqrt(2.0 / 3)), alpha);
  const auto curve = follow_critical(family, branch_point(3, alpha, f), false,
                                     {stop_at(55 * degree, 65 * degree)}, {});
  EXPECT_TRUE(curve.kept);
  const auto births = hits_of(curve, Degeneracy::branch_points_merge);
  ASSERT_FALSE(births.empty());  // further on: its mirror image, and the flat dome
  EXPECT_NEAR(births[0].point.mu / degree, 60.340376873088, 1e-9);
  EXPECT_NEAR(births[0].point.lambda, 1.3788582233138, 1e-9);
  const auto hilltops = hits_of(curve, Degeneracy::hilltop);
  ASSERT_FALSE(hilltops.empty());
  EXPECT_NEAR(hilltops[0].point.mu / degree, 60.389191389169, 1e-8);
  EXPECT_NEAR(hilltops[0].point.lambda, 1.3942740046347, 1e-9);
}

/// V = (t - t0)^2/2 + k e^2/2 + P (1 + e) cos t.
struct ExtensibleStrut {
  double k = 5, t0 = 0;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& u, double P, Vector& F) const {
    F = Vector{{u[0] - t0 - P * (1 + u[1]) * std::sin(u[0]), k * u[1] + P * std::cos(u[0])}};
    return true;
  }
  bool derivatives(const Vector& u, double P, Matrix& J, Vector& by_P) const {
    const double s = std::sin(u[0]), c = std::cos(u[0]);
    J = Matrix{{1 - P * (1 + u[1]) * c, -P * s}, {-P * s, k}};
    by_P = Vector{{-(1 + u[1]) * s, c}};
    return true;
  }
};

TEST(CriticalStructures, BranchPointsOfAnExtensibleStrutMerge) {
  const Family family =
      family_of<ExtensibleStrut>([](double k) { return ExtensibleStrut{.k = k}; });
  const double k = 5, P = k / 2 * (1 - std::sqrt(1 - 4 / k));
  const auto curve = follow_critical(
      family, {.kind = CriticalKind::branch_point, .x = Vector{{0, -P / k}}, .lambda = P, .mu = k},
      false, {stop_at(3, 6)}, {});
  const auto births = hits_of(curve, Degeneracy::branch_points_merge);
  ASSERT_EQ(births.size(), 1U);
  EXPECT_NEAR(births[0].point.mu, 4, 1e-12);
  EXPECT_NEAR(births[0].point.lambda, 2, 1e-9);
}

TEST(CriticalStructures, BranchesOfAnImperfectExtensibleStrutCross) {
  const double t0 = 0.0052908288456748;
  const Family family =
      family_of<ExtensibleStrut>([=](double k) { return ExtensibleStrut{.k = k, .t0 = t0}; });
  const CriticalStart guess{.x = Vector{{0.227942, -0.437596}}, .lambda = 1.751943, .mu = 3.9};
  int crossings = 0;
  for (const bool growing : {true, false}) {
    const auto curve = follow_critical(family, guess, growing, {stop_at(3.5, 5)}, {});
    for (const auto& hit : hits_of(curve, Degeneracy::crossing)) {
      if (std::abs(hit.point.x[0] - 0.2) > 1e-3) continue;
      ++crossings;
      EXPECT_NEAR(hit.point.mu, 3.8421219880058, 1e-9);
      EXPECT_NEAR(hit.point.lambda, 1.9601331556825, 1e-9);
    }
  }
  EXPECT_GE(crossings, 1);
}

/// lambda = h(x), with another slope beyond the switch at x = g.
struct Bent {
  std::function<double(double)> h{}, slope{};
  double g = 0;
  std::function<double(double)> more{}, more_slope{};  ///< added beyond

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double l, const Piece& piece, Vector& F) const {
    F = Vector::Constant(1, h(x[0]) + (piece[0] > 0 ? more(x[0]) : 0) - l);
    return true;
  }
  bool derivatives(const Vector& x, double, const Piece& piece, Matrix& J, Vector& by_l) const {
    J = Matrix::Constant(1, 1, slope(x[0]) + (piece[0] > 0 ? more_slope(x[0]) : 0));
    by_l = Vector::Constant(1, -1);
    return true;
  }
  static Index switch_count() { return 1; }
  bool switches(const Vector& x, double, Vector& value) const {
    value = Vector::Constant(1, x[0] - g);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Ones(1, 1);
    dg_dlambda = Vector::Zero(1);
    return true;
  }
};

CriticalStart corner(double g, double lambda) {
  return {.kind = CriticalKind::surface,
          .x = Vector::Constant(1, g),
          .lambda = lambda,
          .mu = g,
          .piece = {-1},
          .behind = {1},
          .switching = 0};
}

TEST(CriticalStructures, CornersOfAToggleWithAStopReverseTheLoadBetweenTheirEnds) {
  const double alpha = 45 * degree;
  const auto f = [=](double w) { return std::asin(std::sin(alpha) - w); };
  const auto P = [=](double w) { return 4 * (std::cos(f(w)) - std::cos(alpha)) * std::tan(f(w)); };
  const auto slope = [=](double w) {
    const double c = std::cos(f(w));
    return -4 * (c - std::cos(alpha) / (c * c)) / c;
  };
  const Family family = family_of<Bent>([=](double g) {
    return Bent{P, slope, g, [=](double w) { return w - g; }, [](double) { return 1.0; }};
  });
  std::vector<CriticalHit> folds, reversals;
  for (const double g : {0.4, 1.0})
    for (const bool growing : {true, false}) {
      const auto curve = follow_critical(family, corner(g, P(g)), growing,
                                         {stop_at(g < 0.7 ? 0.05 : 0.8, g < 0.7 ? 0.6 : 1.3)}, {});
      for (const auto& hit : curve.hits) {
        if (hit.kind == Degeneracy::fold_meets_activation) folds.push_back(hit);
        if (hit.kind == Degeneracy::corner_loses_reversal) reversals.push_back(hit);
      }
    }
  ASSERT_EQ(folds.size(), 2U);
  ASSERT_EQ(reversals.size(), 2U);
  EXPECT_NEAR(folds[0].point.mu, 0.25290476223914, 1e-9);
  EXPECT_NEAR(folds[0].point.lambda, 0.37480655042324, 1e-9);
  EXPECT_NEAR(folds[1].point.mu, 1.1613088001340, 1e-9);
  EXPECT_NEAR(reversals[0].point.mu, 0.51089188251234, 1e-9);
  EXPECT_NEAR(reversals[0].point.lambda, 0.21887788809525, 1e-9);
  EXPECT_NEAR(reversals[1].point.mu, 0.90332167986075, 1e-9);
}

TEST(CriticalStructures, ASofteningStrutLosesItsCornerWhereTheSpringStaysStiffEnough) {
  const double kappa = 0.5;
  const auto free = [](double t) { return t / std::sin(t); };
  const auto slope = [](double t) {
    return (std::sin(t) - t * std::cos(t)) / std::pow(std::sin(t), 2);
  };
  const Family family = family_of<Bent>([=](double g) {
    return Bent{free, slope, g, [=](double t) { return (kappa - 1) * (t - g) / std::sin(t); },
                [=](double t) {
                  return (kappa - 1) * (std::sin(t) - (t - g) * std::cos(t)) /
                         std::pow(std::sin(t), 2);
                }};
  });
  const auto curve = follow_critical(family, corner(0.5, free(0.5)), true, {stop_at(0.1, 1.5)}, {});
  const auto ends = hits_of(curve, Degeneracy::corner_loses_reversal);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_NEAR(ends[0].point.mu, 1.1655611852072, 1e-9);
  EXPECT_NEAR(ends[0].point.lambda, 1.2682794946153, 1e-9);
}

}  // namespace
}  // namespace springfold::continuation
