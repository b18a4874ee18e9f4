// Two branches of one unknown that touch, cross twice or pass, and a third one that comes near a crossing: truths in
// closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// The branch x = f(lambda), seen along the axis of lambda and askew to it.
struct Path {
  double slope = 0, bend = 0;
  double at(double lambda) const { return lambda * (slope + bend * lambda); }
  double rate(double lambda) const { return slope + 2 * bend * lambda; }
};

/// y (y - k (lambda - c)^2) = 0 with y = x - f(lambda): the branch y = 0 is touched at lambda = c.
struct Touched {
  double k = 0, c = 0;
  Path path{};
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    const double y = x[0] - path.at(lambda);
    F = Vector::Constant(1, y * (y - k * (lambda - c) * (lambda - c)));
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const double y = x[0] - path.at(lambda), h = k * (lambda - c) * (lambda - c);
    dF_dx = Matrix::Constant(1, 1, 2 * y - h);
    dF_dlambda = Vector::Constant(1, -path.rate(lambda) * (2 * y - h) - 2 * y * k * (lambda - c));
    return true;
  }
};

/// Along the touched branch the determinant is -k (lambda - c)^2: small on a long way, and of one sign. Where the
/// step's middle, or a place at which its model is compared, falls beside the touch it is a matter of rounding.
TEST(TouchingBranches, AreSeenWhereverTheStepsEnd) {
  for (const double k : {0.24, -0.089, -0.03, 0.0145, 0.6})
    for (int place = 0; place < 60; ++place) {
      const double c = -0.3 + 0.01 * place + 0.00137 * std::cos(7.0 * place);
      const Touched problem{k, c, {0.8 * std::cos(1.3 * place), 0.5 * std::sin(2.1 * place)}};
      const double begin = -0.55 - 0.0021 * place;
      const StartPoint start{Vector::Constant(1, problem.path.at(begin)),
                             begin,
                             {},
                             {Vector::Constant(1, problem.path.rate(begin)), 1}};
      const Curve curve = follow(problem, start, {lambda_reaches(0.8)}, steps_up_to(0.05));
      ASSERT_EQ(curve.stop, StopReason::event) << k << ", " << c;
      const auto touches = hits_of(curve, HitKind::touch);
      ASSERT_EQ(touches.size(), 1u) << k << ", " << c;
      EXPECT_NEAR(touches[0].point.lambda, c, 1e-7) << k;
      EXPECT_EQ(curve.hits.size(), 2u) << k << ", " << c;
    }
}

/// x and y leave zero at lambda = c and at lambda = -d and d; the unknowns are turned by an angle.
struct OneBetweenTwo {
  double a = 0, k = 0, d = 0, c = 0, angle = 0;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  Matrix turn() const {
    return Matrix{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  }
  bool residual(const Vector& q, double lambda, Vector& F) const {
    const Vector z = turn().transpose() * q;
    F = turn() *
        Vector{{z[0] * (z[0] - a * (lambda - c)), z[1] * (z[1] - k * (lambda * lambda - d * d))}};
    return true;
  }
  bool derivatives(const Vector& q, double lambda, Matrix& dF_dq, Vector& dF_dlambda) const {
    const Vector z = turn().transpose() * q;
    const Vector diagonal{{2 * z[0] - a * (lambda - c), 2 * z[1] - k * (lambda * lambda - d * d)}};
    dF_dq = turn() * diagonal.asDiagonal() * turn().transpose();
    dF_dlambda = turn() * Vector{{-a * z[0], -2 * k * lambda * z[1]}};
    return true;
  }
};

/// The second eigenvalue is k d^2 at the first one's zero: small, and none.
TEST(BranchPoints, OfOneModeBetweenTwoOfAnotherAreThree) {
  for (const double d : {3e-3, 1e-3, 5e-4, 3.3e-4})
    for (const double c : {0.0, 0.3 * d, 0.55 * d}) {
      const OneBetweenTwo problem{0.73, 0.051, d, c, 1.4098};
      const StartPoint start{Vector::Zero(2), -0.4, {}, {Vector::Zero(2), 1}};
      const Curve curve = follow(problem, start, {lambda_reaches(0.4)}, steps_up_to(0.05));
      ASSERT_EQ(curve.stop, StopReason::event) << d << ", " << c;
      const auto points = hits_of(curve, HitKind::branch_point);
      ASSERT_EQ(points.size(), 3u) << d << ", " << c;
      const std::array expected{-d, c, d};
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(points[i].multiplicity, 1) << d << ", " << c;
        EXPECT_NEAR(points[i].point.lambda, expected[i], 1e-8) << d << ", " << c;
      }
    }
}

/// Three lines, y = 0, y = a lambda and y = b (lambda - d), each two of which cross.
struct ThreeLines {
  double a = 0, b = 0, d = 0;
  Path path{};
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    const double y = x[0] - path.at(lambda);
    F = Vector::Constant(1, y * (y - a * lambda) * (y - b * (lambda - d)));
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const double y = x[0] - path.at(lambda), v = y - a * lambda, w = y - b * (lambda - d);
    dF_dx = Matrix::Constant(1, 1, v * w + y * w + y * v);
    dF_dlambda = Vector::Constant(1, -path.rate(lambda) * dF_dx(0, 0) - a * y * w - b * y * v);
    return true;
  }
};

/// A branch that passes beside a crossing leaves a sphere around it as one that goes through it does, at a larger angle
/// on every smaller one.
TEST(Crossings, HaveFourWaysBesideAThirdBranch) {
  for (const ThreeLines& lines :
       {ThreeLines{
            0.36013681979981765, -0.10041358940216089, 0.005475503149760386, {-0.17649, -0.26459}},
        ThreeLines{
            1.7034802085458467, 0.24942793155972204, 0.0018963896499748266, {-0.472, 0.40335}}}) {
    DiagramOptions options;
    options.maximum_depth = 2;
    const Vector x = Vector::Constant(1, lines.path.at(-0.4));
    const Event high = lambda_reaches(0.5), low = lambda_reaches(-0.5);
    const Diagram diagram = trace_diagram(lines, {{x, -0.4, {}}}, {high, low}, options);
    EXPECT_EQ(diagram.junctions.size(), 3u) << lines.d;
    for (const Junction& junction : diagram.junctions)
      EXPECT_EQ(junction.ways.size(), 4u) << junction.point.lambda;
  }
}

}  // namespace
}  // namespace springfold::continuation
