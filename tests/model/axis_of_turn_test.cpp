// Bodies that their chains let turn about one direction only.
#include "springfold/model/axis_of_turn.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "random_chain.hpp"
#include "springfold/model/closure.hpp"
#include "springfold/model/rotation_vector.hpp"

namespace springfold::model {
namespace {

Joint hinge(const std::string& name, const Vec3<double>& axis) {
  return {.name = name, .axis = axis, .role = JointRole::passive};
}

Body spatial(const std::string& name) {
  return {.name = name, .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)};
}

/// A chain with slide and two hinges about `axis`, given in the frame where the chain begins.
Chain about(std::mt19937& random, const std::string& name, const Vec3<double>& axis, Index from,
            Index to) {
  Chain chain{.name = name, .from = from, .to = to};
  chain.from_attachment = random_pose(random, false);
  chain.to_attachment = random_pose(random, false);
  const Pose<double> link = random_pose(random, false);
  const Vec3<double> first = chain.from_attachment.R.transpose() * axis;
  chain.elements = {hinge("a", first), RigidLink{link},
                    Joint{.name = "s", .kind = JointKind::prismatic, .axis = random_unit(random)},
                    hinge("b", -(link.R.transpose() * first))};
  return chain;
}

/// Ground - one - two, the second chain leading the other way.
Mechanism two_bodies(std::mt19937& random, const Vec3<double>& axis) {
  Mechanism m;
  m.bodies = {spatial("one"), spatial("two")};
  m.chains = {about(random, "c", axis, 0, 1)};
  m.chains.push_back(about(random, "d", Vec3<double>::UnitX(), 2, 1));
  // The direction of the second chain's axes in the body where it ends is that of the first one's.
  const Vec3<double> in_one = axes_of_turn(m)[0]->base.transpose() * axis;
  Mat3<double> end = m.chains[1].from_attachment.R;
  end = end * std::get<RigidLink>(m.chains[1].elements[1]).transform.R;
  const Vec3<double> at_end = end.transpose() * Vec3<double>::UnitX();
  const Mat3<double> turn = Eigen::Quaterniond::FromTwoVectors(at_end, in_one).toRotationMatrix();
  m.chains[1].to_attachment.R = turn;
  return m;
}

TEST(AxesOfTurn, LeadFromBodyToBodyAndGiveRotationsThatCloseTheChains) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3<double> axis = random_unit(random);
    const Mechanism m = two_bodies(random, axis);
    const auto turns = axes_of_turn(m);
    ASSERT_TRUE(turns[0] && turns[1]);
    const Vector q = random_vector(random, 6, 2);
    std::vector<Vector> poses;
    for (const auto& turn : turns) {
      EXPECT_TRUE(are_parallel(turn->axis, axis));
      double angle = 0;
      for (const TurnPart& part : turn->parts)
        angle += part.sign * q[3 * part.chain + static_cast<Index>(part.joint)];
      poses.push_back(Vector::Zero(6));
      poses.back().tail(3) =
          log_rotation<double>(exp_rotation<double>(Vec3<double>(angle * turn->axis)) * turn->base);
    }
    Closure<double> at;
    const Vector first = (Vector(9) << q.head(3), poses[0]).finished();
    evaluate_closure<double>(compile(m, m.chains[0]), first, nullptr, at);
    EXPECT_LT(at.e.tail(3).norm(), 1e-12);
    const Vector second = (Vector(15) << poses[1], q.tail(3), poses[0]).finished();
    evaluate_closure<double>(compile(m, m.chains[1]), second, nullptr, at);
    EXPECT_LT(at.e.tail(3).norm(), 1e-12);
  }
}

TEST(AxesOfTurn, AreNoneBehindAnAxisOfAnotherDirection) {
  std::mt19937 random(12);
  Mechanism m = two_bodies(random, Vec3<double>::UnitZ());
  std::get<Joint>(m.chains[1].elements[0]).axis = random_unit(random);
  EXPECT_TRUE(axes_of_turn(m)[0]);
  EXPECT_FALSE(axes_of_turn(m)[1]);
  std::get<Joint>(m.chains[0].elements[3]).axis = random_unit(random);
  EXPECT_FALSE(axes_of_turn(m)[0]);
}

TEST(AxesOfTurn, AreToldByOneChainWhateverTheOthersAre) {
  std::mt19937 random(13);
  Mechanism m;
  m.bodies = {spatial("top")};
  m.chains = {about(random, "loose", random_unit(random), 0, 1),
              about(random, "screw", Vec3<double>::UnitZ(), 0, 1)};
  std::get<Joint>(m.chains[0].elements[3]).axis = random_unit(random);
  EXPECT_TRUE(axes_of_turn(m)[0]);
  m.chains.pop_back();
  EXPECT_FALSE(axes_of_turn(m)[0]);
}

TEST(AxesOfTurn, AnyServesForABodyThatIsOnlyShifted) {
  std::mt19937 random(14);
  Mechanism m;
  m.bodies = {spatial("slide")};
  m.chains = {{.name = "rail"}};
  m.chains[0].elements = {
      Joint{.name = "s", .kind = JointKind::prismatic, .axis = random_unit(random)}};
  ASSERT_TRUE(axes_of_turn(m)[0]);
  EXPECT_FALSE(axes_of_turn(m)[0]->turns);
  for (const LoadKind kind : {LoadKind::force, LoadKind::moment})
    EXPECT_TRUE(is_conservative(
        m, {.on = {.body = 1}, .kind = kind, .follows = true, .vector = random_unit(random)}));
}

TEST(ConservativeLoads, AreMomentsAndForcesAlongTheAxisOfABodyThatTurnsAboutOneDirection) {
  std::mt19937 random(15);
  const Vec3<double> axis = random_unit(random), across = random_unit(random);
  const Mechanism m = two_bodies(random, axis);
  for (const Index body : {1, 2}) {
    const Vec3<double> own =
        axes_of_turn(m)[static_cast<std::size_t>(body - 1)]->base.transpose() * axis;
    const auto conservative = [&](LoadKind kind, bool follows, const Vec3<double>& vector) {
      return is_conservative(
          m, {.on = {.body = body}, .kind = kind, .follows = follows, .vector = vector});
    };
    EXPECT_TRUE(conservative(LoadKind::moment, false, across));
    EXPECT_TRUE(conservative(LoadKind::moment, true, across));
    EXPECT_TRUE(conservative(LoadKind::force, true, own));
    EXPECT_FALSE(conservative(LoadKind::force, true, across));
  }
}

}  // namespace
}  // namespace springfold::model
