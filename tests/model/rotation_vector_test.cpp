#include "springfold/model/rotation_vector.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <complex>
#include <numbers>

#include "model/complex_step.hpp"
#include "random_chain.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Angles on both sides of every change of formula: u = 1, pi, and close to zero.
constexpr std::array angles{0.0, 1e-12, 1e-6, 1e-3, 0.3,       0.999,     1.001, 2.0,
                            3.0, 3.14,  3.15, pi,   pi + 1e-9, pi - 1e-9, 4.0,   6.0};

Vec3<Complex> moved(const Vec3<double>& phi, int j) {
  Vec3<Complex> w = phi.cast<Complex>();
  w[j] += Complex(0, tiny);
  return w;
}

template <class Visit>
void for_many_rotations(const Visit& visit) {
  std::mt19937 random(12);
  for (const double angle : angles)
    for (int trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE("angle " + std::to_string(angle));
      visit(Vec3<double>(angle * random_unit(random)));
    }
}

TEST(RotationVector, ExponentialIsTheRotationAboutItsAxis) {
  for_many_rotations([](const Vec3<double>& phi) {
    if (phi.norm() == 0) return;
    const Eigen::AngleAxisd reference(phi.norm(), phi.normalized());
    EXPECT_LT((exp_rotation<double>(phi) - reference.toRotationMatrix()).norm(), 1e-14);
  });
}

TEST(RotationVector, LeftJacobianIsTheRateOfTheExponential) {
  for_many_rotations([](const Vec3<double>& phi) {
    const Mat3<double> R = exp_rotation<double>(phi), J = left_jacobian<double>(phi);
    for (int j = 0; j < 3; ++j) {
      const Mat3<double> rate = exp_rotation<Complex>(moved(phi, j)).imag() / tiny;
      const Mat3<double> by_jacobian = skew<double>(J.col(j)) * R;
      EXPECT_LT((rate - by_jacobian).norm(), 1e-12);
    }
  });
}

TEST(RotationVector, DerivativesOfTheLeftJacobianAgreeWithTheComplexStep) {
  for_many_rotations([](const Vec3<double>& phi) {
    const auto derivatives = left_jacobian_derivatives<double>(phi);
    for (int j = 0; j < 3; ++j) {
      const Mat3<double> rate = left_jacobian<Complex>(moved(phi, j)).imag() / tiny;
      EXPECT_LT((rate - derivatives[static_cast<std::size_t>(j)]).norm(), 1e-12);
    }
  });
}

TEST(RotationVector, LogarithmUndoesTheExponentialAtAnyAngle) {
  for_many_rotations([](const Vec3<double>& phi) {
    const Mat3<double> R = exp_rotation<double>(phi);
    const Vec3<double> log = log_rotation<double>(R);
    EXPECT_LE(log.norm(), pi + 1e-15);
    EXPECT_LT((exp_rotation<double>(log) - R).norm(), 2e-14);
  });
}

TEST(RotationVector, LogarithmHasTheRateOfTheInverseJacobian) {
  for_many_rotations([](const Vec3<double>& phi) {
    if (phi.norm() > pi - 1e-10) return;
    const Mat3<double> R = exp_rotation<double>(phi), inverse = inverse_left_jacobian<double>(phi);
    for (int j = 0; j < 3; ++j) {
      const Mat3<Complex> turned =
          exp_rotation<Complex>(moved(Vec3<double>::Zero(), j)) * R.cast<Complex>();
      const Vec3<double> rate = log_rotation<Complex>(turned).imag() / tiny;
      EXPECT_LT((rate - inverse.col(j)).norm(), 1e-11);
    }
  });
}

TEST(RotationVector, LogarithmsHessianIsTheSymmetricRateOfTheInverseJacobian) {
  std::mt19937 random(13);
  for_many_rotations([&random](const Vec3<double>& phi) {
    if (phi.norm() > pi - 1e-10) return;
    const Vec3<double> m = random_vector(random, 3, 2.0);
    const Mat3<Complex> R = exp_rotation<double>(phi).cast<Complex>();
    Mat3<double> rates;  // of J_l^-T m along Exp(e_j)
    for (int j = 0; j < 3; ++j) {
      const Mat3<Complex> turned = exp_rotation<Complex>(moved(Vec3<double>::Zero(), j)) * R;
      const Mat3<Complex> inverse = inverse_left_jacobian<Complex>(log_rotation<Complex>(turned));
      rates.row(j) = (inverse.transpose() * m.cast<Complex>()).imag().transpose() / tiny;
    }
    const Mat3<double> symmetric = 0.5 * (rates + rates.transpose());
    EXPECT_LT((symmetric - log_hessian<double>(phi, m)).norm(), 1e-10);
  });
}

TEST(RotationAbout, AnAxisIsTheExponentialOfAngleTimesAxis) {
  std::mt19937 random(14);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3<double> axis = random_unit(random);
    const double angle = random_vector(random, 1, 3.0)[0];
    const Mat3<double> R = exp_rotation<double>(Vec3<double>(angle * axis));
    EXPECT_LT((rotation_about<double>(axis, angle) - R).norm(), 1e-14);
  }
}

TEST(Pose, ComposesAndMovesPointsLikeAHomogeneousMatrix) {
  std::mt19937 random(15);
  const auto matrix = [](const Pose<double>& T) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
    M.topLeftCorner<3, 3>() = T.R;
    M.topRightCorner<3, 1>() = T.p;
    return M;
  };
  for (int trial = 0; trial < 100; ++trial) {
    const Pose<double> a = random_pose(random, false), b = random_pose(random, false);
    EXPECT_LT((matrix(a * b) - matrix(a) * matrix(b)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace springfold::model
