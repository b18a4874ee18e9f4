// Diagrams of two modes that vanish close together on a path: their own branches, and those on which both take part.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::Each;
using testing::Ge;

/// Gradient of sum_i (load_i - lambda) y_i^2 / 2 + sum_ij C_ij y_i^2 y_j^2 / 4 in unknowns that are mixed by a
/// reflection. With Y = (y_1^2, y_2^2): y = 0; one y_i = 0 and C_jj Y_j = lambda - load_j; or C Y = lambda - loads.
struct CoupledModes {
  double first = 0.83, apart = 0;
  Index size() const { return 3; }
  static bool symmetric() { return true; }
  Vector loads() const { return Vector{{first, first + apart}}; }
  static Matrix coupling() { return Matrix{{1.1, 0.3}, {0.3, 0.7}}; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    const Vector u = mirrored(3) * x;
    const Vector y = u.head(2);
    const Vector stiffness = (loads().array() - lambda).matrix() + coupling() * y.cwiseAbs2();
    Vector own(3);
    own << stiffness.cwiseProduct(y), u[2] - std::sin(lambda);
    F = mirrored(3) * own;
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const Vector u = mirrored(3) * x;
    const Vector y = u.head(2);
    const Vector stiffness = (loads().array() - lambda).matrix() + coupling() * y.cwiseAbs2();
    Matrix A = Matrix::Zero(3, 3);
    A.topLeftCorner(2, 2) = 2 * y.asDiagonal() * coupling() * y.asDiagonal();
    A.topLeftCorner(2, 2) += stiffness.asDiagonal();
    A(2, 2) = 1;
    Vector b(3);
    b << -y, -std::cos(lambda);
    dF_dx = mirrored(3) * A * mirrored(3);
    dF_dlambda = mirrored(3) * b;
    return true;
  }
  Diagram diagram(double from = 0) const {
    const Event high{.name = "high",
                     .value = [](const CurvePoint& p) { return p.lambda - 1.5; },
                     .action = EventAction::stop};
    const Event low{.name = "low",
                    .value = [](const CurvePoint& p) { return p.lambda + 0.2; },
                    .action = EventAction::stop};
    DiagramOptions options;
    options.maximum_depth = 2;
    const Vector straight = mirrored(3) * (std::sin(from) * Vector::Unit(3, 2));
    return trace_diagram(*this, {{.x = straight, .lambda = from}}, {high, low}, options);
  }
  /// All states at lambda = 1.5.
  std::vector<Vector> states() const {
    std::vector<Vector> all{Vector::Zero(2)};
    const Vector load = (1.5 - loads().array()).matrix();
    const Vector both = coupling().inverse() * load;
    for (const double sign : {1.0, -1.0}) {
      for (Index i = 0; i < 2; ++i)
        all.push_back(sign * std::sqrt(load[i] / coupling()(i, i)) * Vector::Unit(2, i));
      for (const double other : {1.0, -1.0})
        all.push_back(Vector{{sign * std::sqrt(both[0]), other * std::sqrt(both[1])}});
    }
    return all;
  }
};

/// How many branches end at each of the states?
std::vector<int> arrivals(const CoupledModes& modes, const Diagram& diagram) {
  std::vector<int> count;
  for (const Vector& state : modes.states()) {
    count.push_back(0);
    for (const Branch& branch : diagram.branches) {
      const CurvePoint& end = branch.curve.hits.back().point;
      if (std::abs(end.lambda - 1.5) < 1e-9 &&
          ((mirrored(3) * end.x).head(2) - state).norm() < 1e-8)
        ++count.back();
    }
  }
  return count;
}

bool is_complete(const Diagram& diagram) {
  return std::none_of(diagram.doubts.begin(), diagram.doubts.end(),
                      [](const Doubt& doubt) { return doubt.kind != DoubtKind::bounds; });
}

TEST(DiagramsOfCloseModes, HaveEveryBranchOnce) {
  for (const double apart : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-10, 1e-11, 0.0}) {
    const CoupledModes modes{.apart = apart};
    const Diagram diagram = modes.diagram();
    EXPECT_TRUE(is_complete(diagram)) << apart;
    EXPECT_EQ(arrivals(modes, diagram), std::vector<int>(9, 1)) << apart;
  }
}

TEST(DiagramsOfCloseModes, MissNothingWithoutAWord) {
  for (double apart = 1e-3; apart > 1e-12; apart *= 0.6) {
    const CoupledModes modes{.apart = apart};
    const Diagram diagram = modes.diagram();
    if (!is_complete(diagram)) continue;
    EXPECT_EQ(arrivals(modes, diagram), std::vector<int>(9, 1)) << apart;
  }
}

TEST(DiagramsOfCloseModes, BegunAtEitherMissNothingWithoutAWord) {
  for (double apart = 1e-2; apart > 1e-12; apart *= 0.6)
    for (const Index first : {0, 1}) {
      const CoupledModes modes{.apart = apart};
      const Diagram diagram = modes.diagram(modes.loads()[first]);
      if (!is_complete(diagram)) continue;
      EXPECT_THAT(arrivals(modes, diagram), Each(Ge(1))) << apart << " from " << first;
    }
}

TEST(DiagramsOfCloseModes, BegunAtOneHaveEveryBranchOnce) {
  for (const double apart : {1e-3, 1e-4, 1e-6, 3e-7}) {
    const CoupledModes modes{.apart = apart};
    const Diagram diagram = modes.diagram(modes.loads()[0]);
    EXPECT_TRUE(is_complete(diagram)) << apart;
    EXPECT_EQ(arrivals(modes, diagram), std::vector<int>(9, 1)) << apart;
  }
}

TEST(DiagramsOfCloseModes, HaveBothBranchPointsWhereTheyAre) {
  for (const double apart : {1e-3, 1e-6, 1e-9}) {
    const CoupledModes modes{.apart = apart};
    const auto points = hits_of(modes.diagram().branches.front().curve, HitKind::branch_point);
    ASSERT_EQ(points.size(), 2u) << apart;
    for (Index i = 0; i < 2; ++i)
      EXPECT_NEAR(points[static_cast<std::size_t>(i)].point.lambda, modes.loads()[i], 1e-11);
  }
}

}  // namespace
}  // namespace springfold::continuation
