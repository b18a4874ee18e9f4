// Shapes beside the values at which they have an edge: distances at 0, angles in space at 0 and pi.
#include "springfold/model/shape_edge.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>

#include "model/complex_step.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// A shape, its points at the edge, and the edge.
struct EdgeExample {
  CompiledShape shape{};
  ShapeEdge edge{};
  Vector points{};
};

std::vector<EdgeExample> edges() {
  const Vector far = (Vector(9) << -1, 0, 0, 0, 0, 0, 2, 0, 0).finished();
  Vector back = far;
  back[6] = -2;
  return {{{.kind = ShapeKind::path}, {}, Vector::Zero(6)},
          {{.kind = ShapeKind::line}, {}, far},
          {{.kind = ShapeKind::angle}, {pi, -1, true}, far},
          {{.kind = ShapeKind::angle}, {0, 1, true}, back}};
}

Vector away(const Vector& points, double by, std::mt19937& random) {
  std::uniform_real_distribution<double> at{-1, 1};
  Vector p = points;
  for (double& x : p) x += by * at(random);
  return p;
}

/// Gradient and Hessian of U(alpha) by way of sigma.
ShapeValue<double> energy_about_edge(const EdgeExample& at, const CompiledSpring& law,
                                     const Vector& p, double alpha) {
  const auto edge = edge_of(at.shape, static_cast<std::size_t>(p.size() / 3), alpha);
  const auto slopes = slopes_about_edge(law, law.segment_at(alpha), *edge, alpha);
  ShapeValue<double> sigma;
  evaluate_about_edge<double>(at.shape, *edge, p, sigma);
  return {0, slopes->slope * sigma.gradient,
          slopes->slope * sigma.hessian +
              slopes->curvature * sigma.gradient * sigma.gradient.transpose()};
}

/// Hardening, without force at the edge.
CompiledSpring law_at(const EdgeExample& at) {
  return compile(PolynomialSpring{{0, 2, 0.3, 5}, at.edge.at, {}, true});
}

TEST(ShapesAboutTheirEdge, HaveExactGradientsAndHessians) {
  std::mt19937 random(8);
  for (const EdgeExample& example : edges())
    for (int trial = 0; trial < 20; ++trial) {
      const Vector p = away(example.points, 0.3, random);
      ShapeValue<double> exact;
      evaluate_about_edge<double>(example.shape, example.edge, p, exact);
      for (Index i = 0; i < p.size(); ++i) {
        VectorOf<Complex> q = p.cast<Complex>();
        q[i] += Complex{0, tiny};
        ShapeValue<Complex> moved;
        evaluate_about_edge<Complex>(example.shape, example.edge, q, moved);
        EXPECT_NEAR(moved.value.imag() / tiny, exact.gradient[i], 1e-12);
        EXPECT_LT((moved.gradient.imag() / tiny - exact.hessian.col(i)).norm(), 1e-11);
      }
    }
}

TEST(ShapesAboutTheirEdge, GiveTheForcesThatAlphaGivesBesideIt) {
  std::mt19937 random(9);
  for (const EdgeExample& example : edges())
    for (const double by : {0.2, 0.01}) {
      const CompiledSpring law = law_at(example);
      const Vector p = away(example.points, by, random);
      ShapeValue<double> alpha;
      evaluate_shape<double>(example.shape, p, alpha);
      const double slope = law.torque(0, alpha.value), bend = law.stiffness(0, alpha.value);
      const ShapeValue<double> energy = energy_about_edge(example, law, p, alpha.value);
      EXPECT_LT((energy.gradient - slope * alpha.gradient).norm(), 1e-11);
      const Matrix hessian =
          slope * alpha.hessian + bend * alpha.gradient * alpha.gradient.transpose();
      EXPECT_LT((energy.hessian - hessian).norm(), 1e-10 / by);
    }
}

/// The Hessian goes over into that at the edge, from every side: its first terms are used below 1e-5.
TEST(ShapesAboutTheirEdge, HaveOneHessianThere) {
  std::mt19937 random(10);
  for (const EdgeExample& example : edges()) {
    const CompiledSpring law = law_at(example);
    const ShapeValue<double> there =
        energy_about_edge(example, law, example.points, example.edge.at);
    EXPECT_EQ(there.gradient.norm(), 0);
    for (const double by : {1e-3, 1e-4, 1e-6, 1e-9}) {
      const Vector p = away(example.points, by, random);
      ShapeValue<double> alpha;
      evaluate_shape<double>(example.shape, p, alpha);
      const ShapeValue<double> beside = energy_about_edge(example, law, p, alpha.value);
      EXPECT_LT((beside.hessian - there.hessian).norm(), 60 * by + 1e-9) << by;
    }
  }
}

/// Two bars of lengths 1 and 2 that bend by (y1 - y2)/1 + (y3 - y2)/2 in both planes across them.
TEST(ShapesAboutTheirEdge, BendAStraightRodInAllPlanesAlike) {
  const EdgeExample rod = edges()[2];
  const CompiledSpring law = compile(LinearSpring{3, pi});
  const Matrix H = energy_about_edge(rod, law, rod.points, pi).hessian;
  const Vec3<double> bend{1, -1.5, 0.5};
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(H(3 * i + axis, 3 * j + axis), axis == 0 ? 0 : 3 * bend[i] * bend[j], 1e-14);
}

TEST(ShapesAboutTheirEdge, AreNotSmoothWhereALawHasAForce) {
  const ShapeEdge straight{pi, -1, true};
  EXPECT_FALSE(slopes_about_edge(compile(LinearSpring{1, 3}), 0, straight, pi));
  EXPECT_FALSE(slopes_about_edge(compile(LinearSpring{1, 0.5}), 0, ShapeEdge{}, 0));
  EXPECT_TRUE(slopes_about_edge(compile(LinearSpring{1, 0}), 0, ShapeEdge{}, 0));
}

TEST(ShapesAboutTheirEdge, AreDistancesOfTwoPointsAndWhatHasNoSignInSpace) {
  EXPECT_TRUE(edge_of({.kind = ShapeKind::path}, 2, 0.1));
  EXPECT_FALSE(edge_of({.kind = ShapeKind::path}, 3, 0.1));
  EXPECT_FALSE(edge_of({.kind = ShapeKind::line, .in_plane = true}, 3, 0.1));
  EXPECT_FALSE(edge_of({.kind = ShapeKind::dihedral}, 4, 0.1));
  EXPECT_EQ(edge_of({.kind = ShapeKind::angle}, 3, 3.0)->at, pi);
  EXPECT_EQ(edge_of({.kind = ShapeKind::angle}, 3, 0.1)->at, 0);
}

}  // namespace
}  // namespace springfold::model
