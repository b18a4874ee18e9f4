#include "springfold/model/mechanism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace springfold::model {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A slider with a drive spring, a preloaded knee, a link and a passive hinge: nothing to object to.
Mechanism usable() {
  Chain chain;
  chain.name = "leg";
  chain.elements = {
      Joint{.name = "drive",
            .kind = JointKind::prismatic,
            .axis = Vec3<double>::UnitX(),
            .role = JointRole::actuated,
            .spring = LinearSpring{1, 0}},
      Joint{.name = "knee", .role = JointRole::preloaded, .spring = OneSidedSpring{1, 0}},
      RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}}, Joint{.name = "hinge"}};
  Mechanism m;
  m.bodies = {{"tool", TaskSpace::planar, Vector::Zero(3)}};
  m.chains = {chain};
  return m;
}

/// The usable mechanism with one thing changed.
template <class Change>
std::vector<std::string> problems_after(const Change& change) {
  Mechanism m = usable();
  change(m);
  return problems_in(m);
}

Joint& joint(Mechanism& m, std::size_t element) {
  return std::get<Joint>(m.chains[0].elements[element]);
}

TEST(MechanismProblems, AreNoneForAUsableMechanism) {
  EXPECT_THAT(problems_in(usable()), IsEmpty());
}

TEST(MechanismProblems, WantABodyAndAChain) {
  EXPECT_THAT(problems_in(Mechanism{}), ElementsAre("body: a mechanism needs a moving body",
                                                    "chain: a mechanism needs a chain"));
}

TEST(MechanismProblems, WantNamesToBeUnique) {
  EXPECT_THAT(problems_after([](Mechanism& m) { m.bodies.push_back(m.bodies[0]); }),
              ElementsAre("body[2]: name: \"tool\" is used twice"));
  EXPECT_THAT(problems_after([](Mechanism& m) { m.bodies[0].name = "base"; }),
              ElementsAre("body[1]: name: \"base\" is used twice"));
  EXPECT_THAT(problems_after([](Mechanism& m) { m.chains.push_back(m.chains[0]); }),
              ElementsAre("chain[2]: name: \"leg\" is used twice"));
  EXPECT_THAT(problems_after([](Mechanism& m) { joint(m, 3).name = "knee"; }),
              ElementsAre("chain[1].elements[4]: name: \"knee\" is used twice"));
}

TEST(MechanismProblems, WantBodiesChainsAndJointsToHaveNames) {
  EXPECT_THAT(problems_after([](Mechanism& m) { m.bodies[0].name = ""; }),
              ElementsAre("body[1]: name: is empty, need one"));
  EXPECT_THAT(problems_after([](Mechanism& m) { m.chains[0].name = ""; }),
              ElementsAre("chain[1]: name: is empty, need one"));
  EXPECT_THAT(problems_after([](Mechanism& m) { joint(m, 1).name = ""; }),
              ElementsAre("chain[1].elements[2]: name: is empty, need one"));
}

TEST(MechanismProblems, WantNamesOfLoadsAndLineSpringsToBeUniqueWhereTheyAreGiven) {
  const Load load{.name = "push", .on = {.body = 1}, .vector = Vec3<double>::UnitX()};
  EXPECT_THAT(problems_after([&](Mechanism& m) {
                m.loads = {load, load};
              }),
              ElementsAre("load[2]: name: \"push\" is used twice"));
  Load unnamed = load;
  unnamed.name = "";
  EXPECT_THAT(problems_after([&](Mechanism& m) { m.loads = {unnamed, unnamed}; }), IsEmpty());
  const LineSpring spring{.name = "rope", .to = {.body = 1}};
  EXPECT_THAT(problems_after([&](Mechanism& m) {
                m.line_springs = {spring, spring};
              }),
              ElementsAre("spring[2]: name: \"rope\" is used twice"));
}

TEST(MechanismProblems, WantMassesThatAreFiniteAndNotNegative) {
  for (const double mass : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(problems_after([&](Mechanism& m) { m.bodies[0].mass = mass; }),
                ElementsAre("body[1]: mass: need a finite number >= 0"));
    EXPECT_THAT(problems_after([&](Mechanism& m) {
                  m.chains[0].points = {ChainPoint{.name = "tip", .mass = mass}};
                }),
                ElementsAre("chain[1].points[\"tip\"]: mass: need a finite number >= 0"));
  }
}

TEST(MechanismProblems, WantFiniteNumbersWhereverANumberStands) {
  using Problems = std::vector<std::string>;
  const auto wants_finite = [](const Problems& problems) {
    return problems.size() == 1 && (problems[0].find("finite") != std::string::npos ||
                                    problems[0].find("unit vector") != std::string::npos ||
                                    problems[0].find("rigid motion") != std::string::npos);
  };
  const std::vector<void (*)(Mechanism&)> changes{
      [](Mechanism& m) { m.gravity[1] = nan; },
      [](Mechanism& m) { m.bodies[0].centre[0] = nan; },
      [](Mechanism& m) { joint(m, 0).axis[2] = nan; },
      [](Mechanism& m) { joint(m, 0).command = nan; },
      [](Mechanism& m) { joint(m, 1).initial = nan; },
      [](Mechanism& m) {
        joint(m, 1).spring = LinearSpring{nan, 0};
      },
      [](Mechanism& m) {
        joint(m, 1).spring = LinearSpring{1, nan};
      },
      [](Mechanism& m) {
        joint(m, 1).spring = OneSidedSpring{1, nan};
      },
      [](Mechanism& m) { m.chains[0].from_attachment.p[0] = nan; },
      [](Mechanism& m) { m.chains[0].to_attachment.R(0, 0) = nan; },
      [](Mechanism& m) { std::get<RigidLink>(m.chains[0].elements[2]).transform.p[2] = nan; },
      [](Mechanism& m) {
        m.chains[0].points = {ChainPoint{.name = "tip", .at = Vec3<double>::Constant(nan)}};
      },
      [](Mechanism& m) {
        m.loads = {Load{.on = {.body = 1}, .vector = {nan, 0, 0}}};
      },
      [](Mechanism& m) { m.line_springs = {LineSpring{.to = {.body = 1}, .stiffness = nan}}; },
      [](Mechanism& m) { m.line_springs = {LineSpring{.to = {.body = 1}, .free = nan}}; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i)
    EXPECT_PRED1(wants_finite, problems_after(changes[i])) << "change " << i;
}

TEST(MechanismProblems, WantAPoseThatFitsTheTaskSpace) {
  EXPECT_THAT(problems_after([](Mechanism& m) { m.bodies[0].pose = Vector::Zero(2); }),
              ElementsAre("body[1]: pose: need 3 finite numbers"));
  EXPECT_THAT(problems_after([](Mechanism& m) { m.bodies[0].pose[1] = nan; }),
              ElementsAre("body[1]: pose: need 3 finite numbers"));
}

TEST(MechanismProblems, WantEndsThatExistAndDiffer) {
  EXPECT_THAT(problems_after([](Mechanism& m) { m.chains[0].to = 2; }),
              ElementsAre("chain[1]: from, to: no such body"));
  EXPECT_THAT(problems_after([](Mechanism& m) { m.chains[0].from = -1; }),
              ElementsAre("chain[1]: from, to: no such body"));
  EXPECT_THAT(problems_after([](Mechanism& m) { m.chains[0].from = 1; }),
              ElementsAre("chain[1]: from, to: the chain must join two different bodies"));
}

TEST(MechanismProblems, WantElementsInEveryChain) {
  EXPECT_THAT(problems_after([](Mechanism& m) { m.chains[0].elements.clear(); }),
              ElementsAre("chain[1]: elements: a chain needs at least one element"));
}

TEST(MechanismProblems, WantRigidMotions) {
  const auto no_rotation = [](Mat3<double>& R) { R *= 1.01; };
  const auto reflection = [](Mat3<double>& R) { R.col(2) *= -1; };
  for (const auto& spoil : {std::function<void(Mat3<double>&)>(no_rotation),
                            std::function<void(Mat3<double>&)>(reflection)}) {
    EXPECT_THAT(problems_after([&](Mechanism& m) { spoil(m.chains[0].from_attachment.R); }),
                ElementsAre("chain[1]: attachment: need a rigid motion"));
    EXPECT_THAT(problems_after([&](Mechanism& m) { spoil(m.chains[0].to_attachment.R); }),
                ElementsAre("chain[1]: attachment: need a rigid motion"));
    EXPECT_THAT(problems_after([&](Mechanism& m) {
                  spoil(std::get<RigidLink>(m.chains[0].elements[2]).transform.R);
                }),
                ElementsAre("chain[1].elements[3]: rigid: need a rigid motion"));
  }
  EXPECT_THAT(problems_after([](Mechanism& m) {
                std::get<RigidLink>(m.chains[0].elements[2]).transform.p[0] = nan;
              }),
              ElementsAre("chain[1].elements[3]: rigid: need a rigid motion"));
}

TEST(MechanismProblems, WantUnitAxesAndFiniteNumbersInJoints) {
  EXPECT_THAT(problems_after([](Mechanism& m) {
                joint(m, 0).axis = {1, 1, 0};
              }),
              ElementsAre("chain[1].elements[1]: axis: need a unit vector"));
  EXPECT_THAT(problems_after([](Mechanism& m) { joint(m, 1).initial = nan; }),
              ElementsAre("chain[1].elements[2]: initial: need a finite number"));
  EXPECT_THAT(problems_after([](Mechanism& m) { joint(m, 0).command = nan; }),
              ElementsAre("chain[1].elements[1]: value: need a finite number"));
}

TEST(MechanismProblems, WantSpringsThatFitTheRole) {
  for (const JointRole role : {JointRole::preloaded, JointRole::compliant})
    EXPECT_THAT(problems_after([role](Mechanism& m) {
                  joint(m, 1).role = role;
                  joint(m, 1).spring.reset();
                }),
                ElementsAre("chain[1].elements[2]: spring: a joint with this role needs a spring"));
  EXPECT_THAT(problems_after([](Mechanism& m) { joint(m, 1).role = JointRole::passive; }),
              ElementsAre("chain[1].elements[2]: spring: a passive joint has none; give it the "
                          "role preloaded"));
  EXPECT_THAT(problems_after([](Mechanism& m) { joint(m, 0).spring.reset(); }), IsEmpty());
}

TEST(MechanismProblems, PassOnWhatIsWrongWithASpring) {
  EXPECT_THAT(problems_after([](Mechanism& m) {
                joint(m, 1).spring = LinearSpring{1, nan};
              }),
              ElementsAre("chain[1].elements[2]: spring.free: need a finite number"));
}

TEST(MechanismProblems, AreAllToldAtOnce) {
  EXPECT_THAT(problems_after([](Mechanism& m) {
                m.bodies[0].pose.resize(0);
                joint(m, 1).axis.setZero();
                joint(m, 3).initial = nan;
              }),
              UnorderedElementsAre("body[1]: pose: need 3 finite numbers",
                                   "chain[1].elements[2]: axis: need a unit vector",
                                   "chain[1].elements[4]: initial: need a finite number"));
}

TEST(TaskSpace, HasTranslationsFirst) {
  EXPECT_EQ(dimension(TaskSpace::xy), 2);
  EXPECT_EQ(dimension(TaskSpace::planar), 3);
  EXPECT_EQ(dimension(TaskSpace::xyz), 3);
  EXPECT_EQ(dimension(TaskSpace::spatial), 6);
  EXPECT_EQ(translations(TaskSpace::xy), 2);
  EXPECT_EQ(translations(TaskSpace::planar), 2);
  EXPECT_EQ(translations(TaskSpace::xyz), 3);
  EXPECT_EQ(translations(TaskSpace::spatial), 3);
}

TEST(TaskSpace, OfAChainIsThatOfItsMovingEnd) {
  Mechanism m = usable();
  EXPECT_EQ(task_space_of(m, m.chains[0]), TaskSpace::planar);
  m.bodies.push_back({"point", TaskSpace::xyz, Vector::Zero(3)});
  m.chains[0].from = 2;
  m.chains[0].to = 0;
  EXPECT_EQ(task_space_of(m, m.chains[0]), TaskSpace::xyz);
}

TEST(Joint, HasACoordinateUnlessItsDriveIsRigid) {
  const Mechanism m = usable();
  Joint drive = std::get<Joint>(m.chains[0].elements[0]);
  EXPECT_TRUE(has_coordinate(drive));
  EXPECT_EQ(coordinate_name(drive), "drive.theta");
  drive.spring.reset();
  EXPECT_FALSE(has_coordinate(drive));
  EXPECT_TRUE(has_coordinate(std::get<Joint>(m.chains[0].elements[3])));
  EXPECT_EQ(coordinate_name(std::get<Joint>(m.chains[0].elements[3])), "hinge");
}

}  // namespace
}  // namespace springfold::model
