// Equations of motion with masses on a closure: their derivatives against differences.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/flow.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

/// V = x^2 y + z^4 on the unit sphere; mu times (x^2 + y^2 + z^2 - 1)/2.
struct OnABall {
  static Index size() { return 4; }
  static bool symmetric() { return true; }
  bool residual(const Vector& u, double, Vector& F) const {
    const double x = u[0], y = u[1], z = u[2], mu = u[3];
    F = Eigen::Vector4d(2 * x * y + mu * x, x * x + mu * y, 4 * z * z * z + mu * z,
                        (x * x + y * y + z * z - 1) / 2);
    return true;
  }
  bool derivatives(const Vector& u, double, Matrix& A, Vector& b) const {
    A.setZero(4, 4);
    A.diagonal() << 2 * u[1] + u[3], u[3], 12 * u[2] * u[2] + u[3], 0;
    A(0, 1) = A(1, 0) = 2 * u[0];
    for (Index i = 0; i < 3; ++i) A(i, 3) = A(3, i) = u[i];
    b.setZero(4);
    return true;
  }
};

/// Two masses, at (x, y, z) and at (x + y^2, x z, sin z).
std::vector<MassPoint> masses(const Vector& u) {
  Matrix plain = Matrix::Identity(3, 3), bent(3, 3);
  bent << 1, 2 * u[1], 0, u[2], 0, u[0], 0, 0, std::cos(u[2]);
  return {{1, plain}, {0.7, bent}};
}

std::vector<std::array<Matrix, 3>> curvatures(const Vector& u) {
  std::array<Matrix, 3> none, second;
  none.fill(Matrix::Zero(3, 3));
  second.fill(Matrix::Zero(3, 3));
  second[0](1, 1) = 2;
  second[1](0, 2) = second[1](2, 0) = 1;
  second[2](2, 2) = -std::sin(u[2]);
  return {none, second};
}

TEST(MotionEquations, WithMassesHaveTheirExactDerivatives) {
  const OnABall problem;
  const Landscape landscape(
      Terrain{.problem = problem,
              .is_multiplier = {false, false, false, true},
              .energy = [](const Vector& u) { return u[0] * u[0] * u[1] + std::pow(u[2], 4); }});
  Motion motion{landscape, masses, 0.3};
  motion.curvatures = curvatures;
  // Beside the ball and not along it: gaps fade, and that has derivatives too.
  const Vector x = Eigen::Vector4d(0.5, 0.6, 0.65, 0), v = Eigen::Vector3d(0.4, -0.2, 0.3);
  const auto at = inertial_rate(motion, x, v, {});
  ASSERT_TRUE(at.has_value());
  const auto jacobian = inertial_jacobian(motion, x, v, {}, *at);
  ASSERT_TRUE(jacobian.has_value());
  for (Index k = 0; k < 6; ++k) {
    const auto rate = [&](double step) -> std::optional<Vector> {
      Vector there = x, faster = v;
      (k < 3 ? there[k] : faster[k - 3]) += step;
      const auto found = inertial_rate(motion, there, faster, {});
      if (!found) return std::nullopt;
      return found->rate;
    };
    const auto difference = six_point_derivative(rate, 0, 1e-2);
    ASSERT_TRUE(difference.has_value());
    EXPECT_LT((jacobian->col(k) - *difference).norm(), 1e-7 * std::max(1.0, difference->norm()))
        << k;
  }
}

}  // namespace
}  // namespace springfold::analysis
