// Shapes of points: values against closed forms, derivatives against complex step.
#include "springfold/model/shape.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>

#include "model/complex_step.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

const std::vector<std::array<std::size_t, 3>> tetrahedron{
    {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

struct Example {
  CompiledShape shape{};
  Index points = 0;
};

std::vector<Example> examples() {
  return {{{.kind = ShapeKind::path}, 2},
          {{.kind = ShapeKind::path}, 4},
          {{.kind = ShapeKind::path, .closed = true}, 4},
          {{.kind = ShapeKind::angle}, 3},
          {{.kind = ShapeKind::angle, .in_plane = true, .near = pi}, 3},
          {{.kind = ShapeKind::dihedral, .near = pi}, 4},
          {{.kind = ShapeKind::area}, 5},
          {{.kind = ShapeKind::volume, .triangles = tetrahedron}, 4},
          {{.kind = ShapeKind::line}, 3},
          {{.kind = ShapeKind::line, .in_plane = true}, 3},
          {{.kind = ShapeKind::plane}, 4}};
}

Vector random_points(std::mt19937& random, Index count) {
  std::uniform_real_distribution<double> at{-1, 1};
  Vector p(3 * count);
  for (double& x : p) x = at(random);
  return p;
}

ShapeValue<double> value_at(const CompiledShape& shape, const Vector& p) {
  ShapeValue<double> out;
  evaluate_shape<double>(shape, p, out);
  return out;
}

TEST(Shapes, HaveExactGradientsAndHessians) {
  std::mt19937 random(5);
  for (const Example& example : examples())
    for (int trial = 0; trial < 50; ++trial) {
      const Vector p = random_points(random, example.points);
      const ShapeValue<double> exact = value_at(example.shape, p);
      for (Index i = 0; i < p.size(); ++i) {
        VectorOf<Complex> q = p.cast<Complex>();
        q[i] += Complex{0, tiny};
        ShapeValue<Complex> moved;
        evaluate_shape<Complex>(example.shape, q, moved);
        const double scale = 1 + exact.hessian.norm();
        EXPECT_NEAR(moved.value.imag() / tiny, exact.gradient[i], 1e-12 * scale);
        EXPECT_LT((moved.gradient.imag() / tiny - exact.hessian.col(i)).norm(), 1e-11 * scale);
      }
      EXPECT_LT((exact.hessian - exact.hessian.transpose()).norm(),
                1e-12 * (1 + exact.hessian.norm()));
    }
}

TEST(Shapes, DoNotChangeWithAMotionOfAllPoints) {
  std::mt19937 random(6);
  for (const Example& example : examples()) {
    const Vector p = random_points(random, example.points);
    Vector moved = p;
    const bool turns_about_z = example.shape.in_plane || example.shape.kind == ShapeKind::area;
    const Vec3<double> axis = turns_about_z ? Vec3<double>(0, 0, 7) : Vec3<double>(2, 3, 6);
    const Mat3<double> R = rotation_about<double>(axis / 7, 0.7);
    for (Index i = 0; i < example.points; ++i)
      moved.segment<3>(3 * i) = R * p.segment<3>(3 * i) + Vec3<double>(3, -1, 2);
    EXPECT_NEAR(value_at(example.shape, moved).value, value_at(example.shape, p).value, 1e-13);
  }
}

TEST(Shapes, OfTheUnitSquareAndCubeAreKnown) {
  const Vector square = (Vector(12) << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0).finished();
  EXPECT_EQ(value_at({.kind = ShapeKind::area}, square).value, 1);
  EXPECT_EQ(value_at({.kind = ShapeKind::path}, square).value, 3);
  EXPECT_EQ(value_at({.kind = ShapeKind::path, .closed = true}, square).value, 4);
  const Vector corner = (Vector(12) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1).finished();
  EXPECT_DOUBLE_EQ(value_at({.kind = ShapeKind::volume, .triangles = tetrahedron}, corner).value,
                   1.0 / 6);
}

TEST(Distances, FromLinesAndPlanesHaveTheSideAsTheirSign) {
  const Vector in_plane = (Vector(9) << 0.5, 2, 0, 0, 0, 0, 3, 0, 0).finished();
  EXPECT_DOUBLE_EQ(value_at({.kind = ShapeKind::line, .in_plane = true}, in_plane).value, 2);
  EXPECT_DOUBLE_EQ(value_at({.kind = ShapeKind::line}, in_plane).value, 2);
  Vector below = in_plane;
  below[1] = -2;
  EXPECT_DOUBLE_EQ(value_at({.kind = ShapeKind::line, .in_plane = true}, below).value, -2);
  EXPECT_DOUBLE_EQ(value_at({.kind = ShapeKind::line}, below).value, 2);
  const Vector above = (Vector(12) << 4, 5, 1.5, 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
  EXPECT_DOUBLE_EQ(value_at({.kind = ShapeKind::plane}, above).value, 1.5);
}

/// The third point on a circle about the second: the angle from the first, counted from `near`.
TEST(Angles, AreThoseNearestToTheGivenOne) {
  for (const double angle : {0.3, 2.0, 3.1, 3.2, 5.9, 7.0, 11.0}) {
    const Vector p =
        (Vector(9) << 1, 0, 0, 0, 0, 0, std::cos(angle), std::sin(angle), 0).finished();
    const auto near = [&](double at) {
      return value_at({.kind = ShapeKind::angle, .in_plane = true, .near = at}, p).value;
    };
    EXPECT_NEAR(near(angle + 3), angle, 1e-14);
    EXPECT_NEAR(near(angle - 3), angle, 1e-14);
    EXPECT_NEAR(near(angle + 4), angle + 2 * pi, 1e-14);
  }
}

TEST(Folds, AreFlatAtPiAndClosedAtZero) {
  for (const double angle : {0.1, 1.0, 3.0, 3.3, 6.0}) {
    const Vector p =
        (Vector(12) << 1, 0, 0.3, 0, 0, 0, 0, 0, 2, std::cos(angle), std::sin(angle), 1).finished();
    EXPECT_NEAR(value_at({.kind = ShapeKind::dihedral, .near = pi}, p).value, angle, 1e-14);
  }
}

/// p V^n is constant, and the pressure is minus the slope of the energy.
TEST(Gas, HasThePressureOfItsEquationOfState) {
  for (const double n : {1.0, 1.4, 3.0}) {
    const Gas gas{.nRT = 2, .initial = 0.5, .exponent = n};
    EXPECT_EQ(energy_of(gas, 0.5).slope, 0);
    EXPECT_EQ(energy_of(gas, 0.5).energy, 0);
    for (const double V : {0.1, 0.4, 0.6, 2.0}) {
      EXPECT_NEAR(-energy_of(gas, V).slope, 4 * (std::pow(0.5 / V, n) - 1), 1e-13 * 4 / V);
      const double h = 1e-5;
      const ShapeEnergy low = energy_of(gas, V - h), high = energy_of(gas, V + h);
      EXPECT_NEAR((high.energy - low.energy) / (2 * h), energy_of(gas, V).slope, 1e-4);
      EXPECT_NEAR((high.slope - low.slope) / (2 * h), energy_of(gas, V).curvature,
                  1e-5 * energy_of(gas, V).curvature);
    }
    EXPECT_FALSE(std::isfinite(energy_of(gas, -0.1).slope));
  }
}

TEST(ShapeProblems, NameOpenMeshesWrongCountsAndPointsThatCannotMove) {
  const auto problems = [](Shape shape) { return problems_in(shape); };
  const std::vector<Anchor> moving(4, Anchor{.body = 1}), fixed(3);
  EXPECT_TRUE(
      problems({.kind = ShapeKind::volume, .points = moving, .triangles = tetrahedron}).empty());
  EXPECT_EQ(problems({.kind = ShapeKind::angle, .points = moving}).size(), 1u);
  EXPECT_EQ(problems({.kind = ShapeKind::area, .points = fixed}).size(), 1u);
  EXPECT_EQ(problems({.kind = ShapeKind::volume, .points = moving}).size(), 1u);
  auto turned = tetrahedron;
  std::swap(turned[0][0], turned[0][1]);
  EXPECT_EQ(problems({.kind = ShapeKind::volume, .points = moving, .triangles = turned}).size(),
            1u);
}

}  // namespace
}  // namespace springfold::model
