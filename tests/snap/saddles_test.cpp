// Saddles between minima: strings that are relaxed, and coordinates that are driven. Published numbers and closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/drive.hpp"
#include "analysis/strings.hpp"
#include "snap/energies.hpp"

namespace springfold::analysis {
namespace {

using test::degree;
using test::EnergyProblem;
using test::landscape_of;

/// Mueller, Brown, "Location of saddle points and minimum energy paths by a constrained simplex optimization
/// procedure", Theor. Chim. Acta 53 (1979): three minima and two saddles between the outer ones.
EnergyProblem mueller_brown() {
  struct Term {
    double A, a, b, c, x, y;
  };
  static constexpr Term terms[] = {{-200, -1, 0, -10, 1, 0},
                                   {-100, -1, 0, -10, 0, 0.5},
                                   {-170, -6.5, 11, -6.5, -0.5, 1.5},
                                   {15, 0.7, 0.6, 0.7, -1, 1}};
  const auto value = [](const Term& t, const Vector& q) {
    const double u = q[0] - t.x, v = q[1] - t.y;
    return t.A * std::exp(t.a * u * u + t.b * u * v + t.c * v * v);
  };
  const auto slopes = [](const Term& t, const Vector& q) {
    const double u = q[0] - t.x, v = q[1] - t.y;
    return Vector(Eigen::Vector2d(2 * t.a * u + t.b * v, t.b * u + 2 * t.c * v));
  };
  return {.V =
              [=](const Vector& q, double) {
                double V = 0;
                for (const Term& t : terms) V += value(t, q);
                return V;
              },
          .gradient =
              [=](const Vector& q, double) {
                Vector g = Vector::Zero(2);
                for (const Term& t : terms) g += value(t, q) * slopes(t, q);
                return g;
              },
          .hessian =
              [=](const Vector& q, double) {
                Matrix H = Matrix::Zero(2, 2);
                for (const Term& t : terms) {
                  const Vector s = slopes(t, q);
                  Matrix bend(2, 2);
                  bend << 2 * t.a, t.b, t.b, 2 * t.c;
                  H += value(t, q) * (s * s.transpose() + bend);
                }
                return H;
              },
          .n = 2};
}

TEST(Strings, FindBothSaddlesOfThePublishedSurfaceAndTheMinimumBetween) {
  const EnergyProblem problem = mueller_brown();
  const Landscape landscape = landscape_of(problem, 0);
  const auto low = rest_near(landscape, Eigen::Vector2d(-0.558, 1.442));
  const auto high = rest_near(landscape, Eigen::Vector2d(0.623, 0.028));
  ASSERT_TRUE(low && high);
  const RelaxedWay way = relaxed_way(landscape, low->x, high->x);
  ASSERT_TRUE(way.is_whole);
  const auto saddles = saddles_on(landscape, way);
  ASSERT_EQ(saddles.size(), 2u);
  constexpr double printed = 5e-4;
  EXPECT_NEAR(saddles[0].x[0], -0.822, printed);
  EXPECT_NEAR(saddles[0].x[1], 0.624, printed);
  EXPECT_NEAR(saddles[0].energy, -40.665, printed);
  EXPECT_NEAR(saddles[1].x[0], 0.212, printed);
  EXPECT_NEAR(saddles[1].x[1], 0.293, printed);
  EXPECT_NEAR(saddles[1].energy, -72.249, printed);
  for (const RestState& saddle : saddles) {
    EXPECT_EQ(saddle.index, 1);
    EXPECT_LT(problem.gradient(saddle.x, 0).norm(), 1e-9);
  }
  StateBook book(landscape);
  book.add(*low);
  book.add(*high);
  join_by_strings(book);
  std::vector<double> minima;
  for (const RestState& state : book.states())
    if (is_minimum(state)) minima.push_back(state.energy);
  std::sort(minima.begin(), minima.end());
  ASSERT_EQ(minima.size(), 3u);
  EXPECT_NEAR(minima[1], -108.167, printed);
  EXPECT_NEAR(minima[2], -80.768, printed);
}

/// V = 4 x^3 - 3 x + 5 z^2 on the unit sphere: cos 3 phi along its equator, with minima at 60, 180 and 300 degrees.
struct OnSphere {
  static Index size() { return 4; }
  static bool symmetric() { return true; }
  bool residual(const Vector& u, double, Vector& F) const {
    const double x = u[0], y = u[1], z = u[2], mu = u[3];
    F = Eigen::Vector4d(12 * x * x - 3 + mu * x, mu * y, 10 * z + mu * z,
                        (x * x + y * y + z * z - 1) / 2);
    return true;
  }
  bool derivatives(const Vector& u, double, Matrix& A, Vector& b) const {
    A.setZero(4, 4);
    A.diagonal() << 24 * u[0] + u[3], u[3], 10 + u[3], 0;
    for (Index i = 0; i < 3; ++i) A(i, 3) = A(3, i) = u[i];
    b.setZero(4);
    return true;
  }
};

TEST(Strings, KeepTheClosuresAllAlong) {
  const OnSphere problem;
  const Landscape landscape(Terrain{.problem = problem,
                                    .is_multiplier = {false, false, false, true},
                                    .energy = [](const Vector& u) {
                                      return 4 * u[0] * u[0] * u[0] - 3 * u[0] + 5 * u[2] * u[2];
                                    }});
  const auto at = [](double angle) {
    return Vector(Eigen::Vector4d(std::cos(angle * degree), std::sin(angle * degree), 0, 0));
  };
  const RelaxedWay way = relaxed_way(landscape, at(60), at(180));
  ASSERT_TRUE(way.is_whole);
  for (const Vector& x : way.images) EXPECT_NEAR(x.head(3).norm(), 1, 1e-12);
  const auto saddles = saddles_on(landscape, way);
  ASSERT_EQ(saddles.size(), 1u);
  EXPECT_NEAR(saddles[0].x[0], std::cos(120 * degree), 1e-9);
  EXPECT_NEAR(saddles[0].x[1], std::sin(120 * degree), 1e-9);
  EXPECT_NEAR(saddles[0].energy, 1, 1e-9);
  EXPECT_EQ(saddles[0].index, 1);
}

/// Two circles far apart: no way on them leads from one to the other.
struct OnTwoCircles {
  static Index size() { return 3; }
  static bool symmetric() { return true; }
  static double side(double x) { return x < 0 ? -3 : 3; }
  bool residual(const Vector& u, double, Vector& F) const {
    const double dx = u[0] - side(u[0]);
    F = Eigen::Vector3d(u[2] * dx, 1 + u[2] * u[1], (dx * dx + u[1] * u[1] - 1) / 2);
    return true;
  }
  bool derivatives(const Vector& u, double, Matrix& A, Vector& b) const {
    const double dx = u[0] - side(u[0]);
    A.setZero(3, 3);
    A << u[2], 0, dx, 0, u[2], u[1], dx, u[1], 0;
    b.setZero(3);
    return true;
  }
};

TEST(Strings, SayWhereNoWayLeads) {
  const OnTwoCircles problem;
  const Landscape landscape(Terrain{.problem = problem,
                                    .is_multiplier = {false, false, true},
                                    .energy = [](const Vector& u) { return u[1]; }});
  EXPECT_FALSE(
      relaxed_way(landscape, Eigen::Vector3d(-3, -1, 0), Eigen::Vector3d(3, -1, 0)).is_whole);
}

/// Trusses in series without load snap one by one: from every state each of them on its own, over its flat position.
TEST(Strings, JoinAllStatesOfTrussesInSeries) {
  const std::vector<double> angles{40 * degree, 45 * degree, 50 * degree};
  const EnergyProblem problem = test::trusses_in_series(angles);
  const Landscape landscape = landscape_of(problem, 0);
  StateBook book(landscape);
  for (int s = 0; s < 8; ++s) {
    Vector w(3);
    for (Index i = 0; i < 3; ++i)
      w[i] = (s >> i & 1) != 0 ? 2 * std::tan(angles[static_cast<std::size_t>(i)]) : 0;
    const auto state = rest_near(landscape, w);
    ASSERT_TRUE(state && is_minimum(*state));
    book.add(*state);
  }
  join_by_strings(book);
  std::vector<bool> is_joined(8, false);
  is_joined[0] = true;
  for (int round = 0; round < 8; ++round)
    for (std::size_t s = 8; s < book.states().size(); ++s) {
      if (book.states()[s].index != 1) continue;
      const auto minima = book.ways_from(s).minima;
      ASSERT_EQ(minima.size(), 2u);
      if (is_joined[minima[0]] || is_joined[minima[1]])
        is_joined[minima[0]] = is_joined[minima[1]] = true;
    }
  EXPECT_EQ(std::count(is_joined.begin(), is_joined.end(), true), 8);
}

/// Flat, both bars of a truss are shortened from a/cos(angle) to a.
TEST(Drive, OverAFlatTrussFindsItsSaddle) {
  const EnergyProblem problem = test::trusses_in_series({45 * degree, 50 * degree});
  const Landscape landscape = landscape_of(problem, 0);
  const auto start = rest_near(landscape, Vector::Zero(2));
  ASSERT_TRUE(start);
  const Driven driven = drive(landscape, *start, Vector::Unit(2, 0), {.farthest = 3});
  ASSERT_TRUE(driven.saddle);
  EXPECT_EQ(driven.saddle->index, 1);
  EXPECT_NEAR(driven.saddle->x[0], 1, 1e-10);
  EXPECT_NEAR(driven.saddle->x[1], 0, 1e-10);
  EXPECT_NEAR(driven.saddle->energy, std::pow(1 / std::cos(45 * degree) - 1, 2), 1e-12);
  // Outward the force never turns.
  EXPECT_FALSE(drive(landscape, *start, -Vector::Unit(2, 0), {.farthest = 3}).beyond);
  // Nor below the saddle.
  const double below = 0.9 * driven.saddle->energy;
  EXPECT_FALSE(
      drive(landscape, *start, Vector::Unit(2, 0), {.farthest = 3, .highest = below}).beyond);
}

}  // namespace
}  // namespace springfold::analysis
