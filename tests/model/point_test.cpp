#include "springfold/model/point.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "model/complex_step.hpp"
#include "random_chain.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;

constexpr TaskSpace spaces[] = {TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz,
                                TaskSpace::spatial};

/// A point on a chain of 0 to 5 joints that begins at the base or at a body of any task space.
CompiledPoint random_point(std::mt19937& random, int trial) {
  const TaskSpace space = spaces[trial % 4];
  const CompiledChain chain = random_chain(random, space, false, false, trial % 6);
  return {.space = space, .body_moves = trial % 5 != 0, .joints = chain.joints, .last = chain.last};
}

/// Rotation vectors up to nearly a full turn, angles of several turns.
VectorOf<double> random_variables(std::mt19937& random, const CompiledPoint& point) {
  return random_vector(random, point.variable_count(), 3.5);
}

PointMotion<Complex> moved(const CompiledPoint& point, const VectorOf<double>& v, Index k) {
  VectorOf<Complex> w = v.cast<Complex>();
  w[k] += Complex(0, tiny);
  PointMotion<Complex> at;
  evaluate_point<Complex>(point, w, at);
  return at;
}

TEST(PointDerivatives, AgreeWithTheComplexStepAtTenThousandPoses) {
  std::mt19937 random(31);
  double worst = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const CompiledPoint point = random_point(random, trial);
    const VectorOf<double> v = random_variables(random, point);
    PointMotion<double> at;
    evaluate_point<double>(point, v, at);
    const double size = 1 + at.pose.p.norm();
    for (Index k = 0; k < v.size(); ++k) {
      const PointMotion<Complex> other = moved(point, v, k);
      worst = std::max(worst, (other.pose.p.imag() / tiny - at.dp.col(k)).norm() / size);
      const Mat3<double> turned = skew<double>(at.spin.col(k)) * at.pose.R;
      worst = std::max(worst, (other.pose.R.imag() / tiny - turned).norm());
      for (Index j = 0; j < v.size(); ++j) {
        const Vec3<double> ddp = other.dp.col(j).imag() / tiny;
        worst = std::max(worst, (ddp - second_displacement(at, j, k)).norm() / (10 * size));
        const Vec3<double> turning = other.spin.col(j).imag() / tiny;
        worst = std::max(worst, (turning - spin_rate(at, j, k)).norm());
      }
    }
  }
  EXPECT_LT(worst, 1e-10);
}

TEST(PointDerivatives, AreExactAtARotationOfAHalfTurn) {
  CompiledPoint point{.body_moves = true};
  point.last.p = {0.3, -0.2, 0.7};
  const VectorOf<double> v = (VectorOf<double>(6) << 1, 2, 3, 0, std::acos(-1.0) / std::sqrt(2),
                              std::acos(-1.0) / std::sqrt(2))
                                 .finished();
  PointMotion<double> at;
  evaluate_point<double>(point, v, at);
  for (Index k = 3; k < 6; ++k) {
    const PointMotion<Complex> other = moved(point, v, k);
    EXPECT_LT((other.pose.p.imag() / tiny - at.dp.col(k)).norm(), 1e-12);
    for (Index j = 3; j < 6; ++j)
      EXPECT_LT(
          (Vec3<double>(other.dp.col(j).imag() / tiny) - second_displacement(at, j, k)).norm(),
          1e-12);
  }
}

/// A body on an arm with these axes, with a load that a test chooses: at the end of the arm; without axes on the body.
bool conservative(TaskSpace space, LoadKind kind, bool follows, const Vec3<double>& vector,
                  const std::vector<Vec3<double>>& axes = {}, bool on_body = false) {
  Mechanism m;
  m.bodies = {{"tool", space, Vector::Zero(dimension(space))}};
  Chain chain{.name = "arm"};
  for (const Vec3<double>& axis : axes)
    chain.elements.push_back(
        Joint{.name = "j" + std::to_string(chain.elements.size()), .axis = axis});
  chain.elements.push_back(RigidLink{});
  chain.points.push_back({.name = "tip", .elements_before = chain.elements.size()});
  m.chains = {chain};
  Load load{.kind = kind, .follows = follows, .vector = vector};
  if (axes.empty() || on_body)
    load.on.body = 1;
  else
    load.on.chain = 0;
  EXPECT_TRUE(problems_in({.bodies = m.bodies, .chains = m.chains, .loads = {load}}).empty());
  return is_conservative(m, load);
}

const Vec3<double> e_x = Vec3<double>::UnitX(), e_z = Vec3<double>::UnitZ();

TEST(ConservativeLoads, AreAllDeadForces) {
  EXPECT_TRUE(conservative(TaskSpace::spatial, LoadKind::force, false, e_x));
  EXPECT_TRUE(conservative(TaskSpace::spatial, LoadKind::force, false, e_x, {e_x, e_z}));
}

TEST(ConservativeLoads, AreMomentsInThePlaneAndAboutOneAxis) {
  EXPECT_TRUE(conservative(TaskSpace::planar, LoadKind::moment, false, e_z));
  EXPECT_TRUE(conservative(TaskSpace::planar, LoadKind::moment, true, e_z));
  EXPECT_TRUE(conservative(TaskSpace::spatial, LoadKind::moment, false, e_x + e_z, {e_z, -e_z}));
}

TEST(ConservativeLoads, AreNotMomentsInSpace) {
  for (const bool follows : {false, true})
    EXPECT_FALSE(
        conservative(TaskSpace::spatial, LoadKind::moment, follows, e_z, {e_x, e_z}, true));
  EXPECT_FALSE(conservative(TaskSpace::spatial, LoadKind::moment, false, e_z, {e_x, e_z}));
}

TEST(ConservativeLoads, AreNotFollowerForcesUnlessNothingTurnsThem) {
  EXPECT_FALSE(conservative(TaskSpace::planar, LoadKind::force, true, e_x));
  EXPECT_FALSE(conservative(TaskSpace::spatial, LoadKind::force, true, e_x, {e_z, e_z}));
  EXPECT_TRUE(conservative(TaskSpace::spatial, LoadKind::force, true, e_z, {e_z, e_z}));
}

}  // namespace
}  // namespace springfold::model
