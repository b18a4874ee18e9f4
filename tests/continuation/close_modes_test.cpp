// Modes that vanish close together on a path, each on its own; and modes that vanish in one point.
#include <gtest/gtest.h>

#include <cmath>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Gradient of sum_i (load_i - lambda) y_i^2 / 2 + (sum_i y_i^2)^2 / 4 + sum_k (z_k - a_k(lambda))^2 (1 + k) / 2 in
/// unknowns that are mixed by a reflection: y = 0 is a path, on which mode i vanishes at load_i. It is straight where
/// bend = 0.
struct ModesOnAPath {
  Vector loads{};
  double bend = 0;
  Index passive = 2;
  Vector rates{};  ///< of the modes' stiffnesses with the load; empty: -1
  Index size() const { return loads.size() + passive; }
  static bool symmetric() { return true; }
  double rest(Index k, double lambda) const {
    return (k % 2 == 0 ? 0.7 : -0.4) * lambda + bend * std::sin(lambda + static_cast<double>(k));
  }
  double rate_of_rest(Index k, double lambda) const {
    return (k % 2 == 0 ? 0.7 : -0.4) + bend * std::cos(lambda + static_cast<double>(k));
  }
  Vector rates_of_modes() const {
    return rates.size() > 0 ? rates : Vector(-Vector::Ones(loads.size()));
  }
  Vector stiffness(double lambda) const {
    return rates_of_modes().cwiseProduct((lambda - loads.array()).matrix());
  }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    const Matrix Q = mirrored(size());
    const Vector u = Q * x;
    const Index m = loads.size();
    Vector own(size());
    own.head(m) = stiffness(lambda).cwiseProduct(u.head(m)) + u.head(m).squaredNorm() * u.head(m);
    for (Index k = 0; k < passive; ++k)
      own[m + k] = static_cast<double>(1 + k) * (u[m + k] - rest(k, lambda));
    F = Q * own;
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const Matrix Q = mirrored(size());
    const Vector u = Q * x;
    const Index m = loads.size();
    Matrix A = Matrix::Zero(size(), size());
    Vector b(size());
    A.topLeftCorner(m, m) = 2 * u.head(m) * u.head(m).transpose();
    for (Index i = 0; i < m; ++i) A(i, i) += stiffness(lambda)[i] + u.head(m).squaredNorm();
    b.head(m) = rates_of_modes().cwiseProduct(u.head(m));
    for (Index k = 0; k < passive; ++k) {
      A(m + k, m + k) = static_cast<double>(1 + k);
      b[m + k] = -static_cast<double>(1 + k) * rate_of_rest(k, lambda);
    }
    dF_dx = Q * A * Q;
    dF_dlambda = Q * b;
    return true;
  }
  Curve path() const {
    Vector u = Vector::Zero(size());
    for (Index k = 0; k < passive; ++k) u[loads.size() + k] = rest(k, 0);
    const StartPoint start{mirrored(size()) * u, 0, {}, {Vector::Zero(size()), 1}};
    return follow(*this, start, {lambda_reaches(1.7)});
  }
};

TEST(CloseModes, AreBranchPointsOfTheirOwnOnPathsThatAreStraightAndThatBend) {
  for (const double bend : {0.0, 0.5})
    for (const Index count : {2, 3, 4})
      for (double apart = 1e-4; apart > 5e-10; apart /= 10) {
        const ModesOnAPath modes{
            0.83 + apart * Vector::LinSpaced(count, 0, static_cast<double>(count - 1)).array(),
            bend};
        const Curve curve = modes.path();
        const auto points = hits_of(curve, HitKind::branch_point);
        ASSERT_EQ(std::ssize(points), count) << bend << ", " << apart;
        EXPECT_EQ(curve.hits.size(), points.size() + 1) << bend << ", " << apart;
        for (Index i = 0; i < count; ++i) {
          const Hit& point = points[static_cast<std::size_t>(i)];
          EXPECT_NEAR(point.point.lambda, modes.loads[i], 1e-11) << bend << ", " << apart;
          EXPECT_EQ(point.multiplicity, 1);
        }
      }
}

TEST(CloseModes, ThatVanishInOnePointAreOne) {
  for (const double bend : {0.0, 0.5})
    for (const Index count : {2, 3}) {
      const auto points =
          hits_of(ModesOnAPath{Vector::Constant(count, 0.83), bend}.path(), HitKind::branch_point);
      ASSERT_EQ(points.size(), 1u);
      EXPECT_EQ(points[0].multiplicity, count);
      EXPECT_NEAR(points[0].point.lambda, 0.83, 1e-10);
    }
}

TEST(CloseModes, ThatVanishInOnePointAreToldFromAnotherOneBesideIt) {
  // Where two of them come from opposite sides their signs cancel, and beside the third one nothing is seen of them.
  for (const double bend : {0.0, 0.5})
    for (const double other : {1.0, -1.0})
      for (const double apart : {1e-5, 1e-6, 1e-7, -1e-6}) {
        const ModesOnAPath modes{Vector{{0.83, 0.83, 0.83 + apart}}, bend, 2,
                                 Vector{{-1, other, -1}}};
        auto points = hits_of(modes.path(), HitKind::branch_point);
        ASSERT_EQ(points.size(), 2u) << bend << ", " << other << ", " << apart;
        if (apart < 0) std::swap(points[0], points[1]);
        EXPECT_EQ(points[0].multiplicity, 2);
        EXPECT_EQ(points[1].multiplicity, 1);
        EXPECT_NEAR(points[0].point.lambda, 0.83, 1e-11);
        EXPECT_NEAR(points[1].point.lambda, 0.83 + apart, 1e-11);
      }
}

TEST(CloseModes, AreToldFromAnotherOneFartherOn) {
  const ModesOnAPath modes{Vector{{0.83, 0.83 + 1e-7, 0.84}}};
  const auto points = hits_of(modes.path(), HitKind::branch_point);
  ASSERT_EQ(points.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(points[i].point.lambda, modes.loads[static_cast<Index>(i)], 1e-11);
}

}  // namespace
}  // namespace springfold::continuation
