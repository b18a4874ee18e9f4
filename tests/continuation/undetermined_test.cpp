// Where rounding moves corrected points from one branch to another, no step may end.
#include <gtest/gtest.h>

#include <cmath>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Gradient of x^2 / 2 - lambda x + e(x) y^2 / 2 + y^4 / 4 + k / 2 sum (w_i - sin(i y + x))^2 with e = c prod (x -
/// b_i), in unknowns mirrored at a plane. The straight branch y = 0 is met by others where e = 0; where the b_i are
/// close together, they leave it so flatly that the rounding of the springs hides which is which.
struct FlatCrossings {
  double c = 1, k = 1;
  std::vector<double> b{};
  static constexpr Index n = 6;
  static Index size() { return n; }
  static bool symmetric() { return true; }
  static Matrix mirror() { return mirrored(n); }
  /// e and its first two derivatives.
  Vector e(double x) const {
    Vector value{{c, 0, 0}};
    for (const double place : b)
      value = Vector{{value[0] * (x - place), value[1] * (x - place) + value[0],
                      value[2] * (x - place) + 2 * value[1]}};
    return value;
  }
  bool residual(const Vector& q, double lambda, Vector& F) const {
    const Vector z = mirror() * q, E = e(z[0]);
    const double y = z[1];
    Vector f(n);
    f.head(2) << z[0] - lambda + 0.5 * E[1] * y * y, E[0] * y + y * y * y;
    for (Index i = 2; i < n; ++i) {
      const auto m = static_cast<double>(i);
      const double angle = m * y + z[0];
      f[i] = k * (z[i] - std::sin(angle));
      f[0] -= f[i] * std::cos(angle);
      f[1] -= f[i] * m * std::cos(angle);
    }
    F = mirror() * f;
    return true;
  }
  bool derivatives(const Vector& q, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    const Vector z = mirror() * q, E = e(z[0]);
    const double y = z[1];
    Matrix H = Matrix::Zero(n, n);
    H.topLeftCorner(2, 2) << 1 + 0.5 * E[2] * y * y, E[1] * y, E[1] * y, E[0] + 3 * y * y;
    for (Index i = 2; i < n; ++i) {
      const auto m = static_cast<double>(i);
      const double angle = m * y + z[0], s = std::sin(angle), t = std::cos(angle);
      const Vector along{{1, m}};
      H(i, i) = k;
      H.row(i).head(2) = -k * t * along.transpose();
      H.col(i).head(2) = -k * t * along;
      H.topLeftCorner(2, 2) += k * (t * t + (z[i] - s) * s) * along * along.transpose();
    }
    dF_dx = mirror() * H * mirror();
    dF_dlambda = -mirror().col(0);
    return true;
  }
  Vector at(double x) const {
    Vector z = Vector::Constant(n, std::sin(x));
    z[0] = x;
    z[1] = 0;
    return mirror() * z;
  }
};

TEST(Undetermined, TouchesOfAnEigenvalueAreTheSameAtAllStepLengths) {
  for (const double c : {1.0, 1e-2})
    for (const double steps : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0}) {
      const FlatCrossings problem{c, 0.1, {0.1, 0.1, 0.4}};
      TraceOptions options;
      options.step.initial *= steps;
      options.step.maximum *= steps;
      const Vector along = problem.at(-0.4999) - problem.at(-0.5);
      const Ray ray = ray_of(problem, {problem.at(-0.5), -0.5, {}, {along, 1e-4}}, options);
      const Curve curve =
          trace(problem, problem.at(-0.5), -0.5, ray, {lambda_reaches(0.6)}, options);
      ASSERT_EQ(curve.stop, StopReason::event) << c << ", " << steps << ": " << curve.stop_detail;
      const auto touches = hits_of(curve, HitKind::touch),
                 crossings = hits_of(curve, HitKind::branch_point);
      ASSERT_EQ(touches.size(), 1u) << c << ", steps x " << steps;
      EXPECT_NEAR(touches[0].point.lambda, 0.1, 1e-5) << c << ", steps x " << steps;
      ASSERT_EQ(crossings.size(), 1u) << c << ", steps x " << steps;
      EXPECT_NEAR(crossings[0].point.lambda, 0.4, 1e-7) << c << ", steps x " << steps;
    }
}

TEST(Undetermined, PointsDoNotLeadACurveOntoAnotherBranchInSilence) {
  for (const double c : {1.0, 0.1})
    for (const double gap : {0.0, 1e-6, 1e-5, 1e-4})
      for (const double from : {-0.5}) {
        const FlatCrossings problem{c, 10, {0.1, 0.1, 0.1 + gap}};
        const Vector along = problem.at(from + 1e-4) - problem.at(from);
        const StartPoint start{problem.at(from), from, {}, {along, 1e-4}};
        // Tangents at branch points that are almost one are not known to what follow() asks of them.
        const Curve curve = trace(problem, start.x, start.lambda, ray_of(problem, start, {}),
                                  {lambda_reaches(0.6)}, {});
        double aside = 0;
        for (const CurvePoint& p : curve.points)
          aside = std::max(aside, std::abs(FlatCrossings::mirror().col(1).dot(p.x)));
        EXPECT_LT(aside, 1e-3) << c << ", gap " << gap << ", from " << from
                               << ": on another branch";
        EXPECT_TRUE(curve.stop != StopReason::event || curve.hits.size() > 1)
            << c << ", gap " << gap << ": passed in silence";
      }
}

}  // namespace
}  // namespace springfold::continuation
