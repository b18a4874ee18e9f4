// From elements to kinematics: rigid links merged, joints in order, joints of several freedoms.
#include <gtest/gtest.h>

#include "random_chain.hpp"

namespace springfold::model {
namespace {

Joint revolute(const std::string& name, const Vec3<double>& axis) {
  return {.name = name, .kind = JointKind::revolute, .axis = axis};
}

Mechanism one_chain(std::vector<Element> elements) {
  Mechanism m;
  m.bodies = {{"tool", TaskSpace::spatial, Vector::Zero(6)}};
  m.chains = {Chain{.name = "leg", .elements = std::move(elements)}};
  return m;
}

/// End of the chain for the given joint displacements: the gap to a body that lies on the base.
Pose<double> end_of(const CompiledChain& chain, const Vector& displacements) {
  VectorOf<double> v = Vector::Zero(chain.variable_count());
  v.head(displacements.size()) = displacements;
  Closure<double> at;
  evaluate_closure<double>(chain, v, nullptr, at);
  return {exp_rotation<double>(Vec3<double>(at.e.tail(3))), at.e.head(3)};
}

double distance(const Pose<double>& a, const Pose<double>& b) {
  return (a.R - b.R).norm() + (a.p - b.p).norm();
}

TEST(Compile, MultipliesRigidLinksAndJointsInTheirOrder) {
  std::mt19937 random(51);
  for (int trial = 0; trial < 200; ++trial) {
    Pose<double> expected = random_pose(random, false);
    std::vector<Element> elements;
    const Pose<double> attachment = expected;
    std::vector<double> displacements;
    for (int i = 0; i < 9; ++i) {
      const std::string name = "joint" + std::to_string(i);
      if (std::uniform_int_distribution<int>(0, 1)(random) == 0) {
        const Pose<double> T = random_pose(random, false);
        elements.push_back(RigidLink{T});
        expected = expected * T;
        continue;
      }
      const Vec3<double> axis = random_unit(random);
      const double c = random_vector(random, 1, 2.0)[0];
      displacements.push_back(c);
      const bool turns = i % 3 != 0;
      elements.push_back(Joint{
          .name = name, .kind = turns ? JointKind::revolute : JointKind::prismatic, .axis = axis});
      const Pose<double> motion =
          turns ? Pose<double>{rotation_about<double>(axis, c), Vec3<double>::Zero()}
                : Pose<double>{Mat3<double>::Identity(), c * axis};
      expected = expected * motion;
    }
    Mechanism m = one_chain(elements);
    m.chains[0].from_attachment = attachment;
    const CompiledChain chain = compile(m, m.chains[0]);
    ASSERT_EQ(chain.joint_count(), static_cast<Index>(displacements.size()));
    const Vector v = Eigen::Map<const Vector>(displacements.data(), chain.joint_count());
    EXPECT_LT(distance(end_of(chain, v), expected), 1e-13) << "trial " << trial;
  }
}

TEST(Compile, AUniversalJointIsTwoRevolutesWithMeetingAxes) {
  const Mechanism m =
      one_chain({revolute("u1", Vec3<double>::UnitX()), revolute("u2", Vec3<double>::UnitY()),
                 RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitZ()}}});
  const CompiledChain chain = compile(m, m.chains[0]);
  const double a = 0.4, b = -0.9;
  const Vec3<double> tip = end_of(chain, Vector{{a, b}}).p;
  EXPECT_NEAR(tip[0], std::sin(b), 1e-15);
  EXPECT_NEAR(tip[1], -std::sin(a) * std::cos(b), 1e-15);
  EXPECT_NEAR(tip[2], std::cos(a) * std::cos(b), 1e-15);
}

TEST(Compile, ASphericalJointOfThreeRevolutesReachesEveryRotation) {
  const Mechanism m =
      one_chain({revolute("s1", Vec3<double>::UnitX()), revolute("s2", Vec3<double>::UnitY()),
                 revolute("s3", Vec3<double>::UnitZ())});
  const CompiledChain chain = compile(m, m.chains[0]);
  std::mt19937 random(52);
  for (int trial = 0; trial < 200; ++trial) {
    const Mat3<double> R = random_pose(random, false).R;
    // R = Rx(a) Ry(b) Rz(c)
    const double b = std::asin(R(0, 2)), a = std::atan2(-R(1, 2), R(2, 2)),
                 c = std::atan2(-R(0, 1), R(0, 0));
    const Pose<double> end = end_of(chain, Vector{{a, b, c}});
    EXPECT_LT((end.R - R).norm(), 1e-12);
    EXPECT_LT(end.p.norm(), 1e-15);
  }
}

TEST(Compile, ALaterJointTurnsAboutItsOwnMovedAxis) {
  const Mechanism m = one_chain(
      {revolute("first", Vec3<double>::UnitZ()),
       RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}},
       Joint{.name = "slide", .kind = JointKind::prismatic, .axis = Vec3<double>::UnitY()}});
  const CompiledChain chain = compile(m, m.chains[0]);
  const double quarter = std::acos(0.0);
  const Pose<double> end = end_of(chain, Vector{{quarter, 2}});
  EXPECT_LT((end.p - Vec3<double>(-2, 1, 0)).norm(), 1e-15);
}

TEST(Compile, ARigidChainHasNoVariablesButItsBody) {
  const Mechanism m = one_chain({RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}}});
  const CompiledChain chain = compile(m, m.chains[0]);
  EXPECT_EQ(chain.joint_count(), 0);
  EXPECT_EQ(chain.variable_count(), 6);
  EXPECT_EQ(end_of(chain, Vector(0)).p, Vec3<double>::UnitX());
}

TEST(Compile, CountsTheVariablesOfMovingEnds) {
  Mechanism m = one_chain({revolute("hinge", Vec3<double>::UnitZ())});
  m.bodies.push_back({"carrier", TaskSpace::spatial, Vector::Zero(6)});
  m.chains[0].from = 2;
  CompiledChain chain = compile(m, m.chains[0]);
  EXPECT_EQ(chain.variable_count(), 13);
  EXPECT_EQ(chain.first_joint(), 6);
  EXPECT_EQ(chain.first_to(), 7);
  m.chains[0].to = 0;
  chain = compile(m, m.chains[0]);
  EXPECT_EQ(chain.variable_count(), 7);
}

TEST(Compile, AChainWalkedBackwardsHasTheSameGap) {
  const auto inverse = [](const Pose<double>& T) {
    return Pose<double>{T.R.transpose(), -(T.R.transpose() * T.p)};
  };
  std::mt19937 random(53);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose<double> a = random_pose(random, false), b = random_pose(random, false);
    const Vec3<double> axis = random_unit(random);
    Mechanism m = one_chain({RigidLink{a}, revolute("hinge", axis), RigidLink{b}});
    const CompiledChain forward = compile(m, m.chains[0]);
    m.chains[0].from = 1;
    m.chains[0].to = 0;
    m.chains[0].elements = {RigidLink{inverse(b)}, revolute("hinge", -axis), RigidLink{inverse(a)}};
    const CompiledChain backward = compile(m, m.chains[0]);

    const Vector c = random_vector(random, 1, 2.0), t = random_vector(random, 6, 1.0);
    Closure<double> there, back;
    VectorOf<double> v(7);
    v << c, t;
    evaluate_closure<double>(forward, v, nullptr, there);
    v << t, c;
    evaluate_closure<double>(backward, v, nullptr, back);
    EXPECT_NEAR(there.e.tail(3).norm(), back.e.tail(3).norm(), 1e-12);
    // Forward the chain's end p is compared with the body's origin t, backward the base's origin
    // with t - E^T p, where E turns the body into the chain's end.
    const Mat3<double> E =
        end_of(forward, c).R * exp_rotation<double>(Vec3<double>(t.tail(3))).transpose();
    const Vec3<double> p = there.e.head(3) + t.head(3);
    EXPECT_LT((back.e.head(3) - (t.head(3) - E.transpose() * p)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace springfold::model
