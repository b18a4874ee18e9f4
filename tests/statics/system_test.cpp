// Who stands where in the vector of unknowns.
#include "springfold/statics/system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "examples.hpp"

namespace springfold::statics {
namespace {

using testing::ElementsAre;

TEST(System, NamesItsUnknownsChainByChainThenTheBodies) {
  const System system = prepare(orthoglide(model::LinearSpring{0.1, 0}, 0.1, 0.2));
  EXPECT_THAT(system.coordinate_names, ElementsAre("leg_x.drive.theta", "leg_x.knee", "leg_x.Fx",
                                                   "leg_x.Fy", "leg_y.drive.theta", "leg_y.knee",
                                                   "leg_y.Fx", "leg_y.Fy", "tool.x", "tool.y"));
  EXPECT_THAT(system.command_names, ElementsAre("leg_x.drive", "leg_y.drive"));
  EXPECT_THAT(system.is_wrench,
              ElementsAre(false, false, true, true, false, false, true, true, false, false));
  EXPECT_THAT(system.is_length,
              ElementsAre(true, false, true, true, true, false, true, true, true, true));
  EXPECT_EQ(system.size, 10);
  EXPECT_EQ(system.first_pose, 8);
  EXPECT_EQ(system.load_size, 2);
  EXPECT_EQ(system.closure_count(), 4);
}

TEST(System, NamesThePosesAndWrenchesOfEveryTaskSpace) {
  using model::TaskSpace;
  model::Mechanism m;
  for (const auto& [name, space] :
       {std::pair{"a", TaskSpace::planar}, {"b", TaskSpace::xyz}, {"c", TaskSpace::spatial}}) {
    m.bodies.push_back({name, space, Vector::Zero(dimension(space))});
    m.chains.push_back({.name = std::string("to_") + name,
                        .to = static_cast<Index>(m.bodies.size()),
                        .elements = {hinge("hinge")}});
  }
  const System system = prepare(m);
  EXPECT_THAT(system.coordinate_names,
              ElementsAre("to_a.hinge", "to_a.Fx", "to_a.Fy", "to_a.Mz",  //
                          "to_b.hinge", "to_b.Fx", "to_b.Fy", "to_b.Fz",  //
                          "to_c.hinge", "to_c.Fx", "to_c.Fy", "to_c.Fz", "to_c.Mx", "to_c.My",
                          "to_c.Mz",              //
                          "a.x", "a.y", "a.phi",  //
                          "b.x", "b.y", "b.z",    //
                          "c.x", "c.y", "c.z", "c.rx", "c.ry", "c.rz"));
  for (Index i = 0; i < system.size; ++i) {
    const std::string& name = system.coordinate_names[static_cast<std::size_t>(i)];
    const std::string last = name.substr(name.find('.') + 1);
    const bool angle = last[0] == 'M' || last == "phi" || last[0] == 'r' || last == "hinge";
    EXPECT_EQ(system.is_length[static_cast<std::size_t>(i)], !angle) << name;
  }
  EXPECT_EQ(system.load_size, 12);
}

TEST(System, KeepsTheEndsOfChainsBetweenBodies) {
  model::Mechanism m = two_link_arm(0.1, 0.2);
  m.bodies.push_back({"second", model::TaskSpace::xy, Vector{{3, 4}}});
  m.chains.push_back(m.chains[0]);
  m.chains[1].name = "between";
  m.chains[1].from = 1;
  m.chains[1].to = 2;
  const System system = prepare(m);
  EXPECT_EQ(system.chain_slices[0].from, -1);
  EXPECT_EQ(system.chain_slices[0].to, system.body_slices[0].t);
  EXPECT_EQ(system.chain_slices[1].from, system.body_slices[0].t);
  EXPECT_EQ(system.chain_slices[1].to, system.body_slices[1].t);
  EXPECT_EQ(system.body_slices[1].W, 2);
}

TEST(System, ARigidDriveHasACommandAndNoCoordinate) {
  model::Mechanism m = orthoglide(model::LinearSpring{0.1, 0}, 0.1, 0.2);
  std::get<model::Joint>(m.chains[0].elements[0]).spring.reset();
  const System system = prepare(m);
  EXPECT_EQ(system.size, 9);
  EXPECT_THAT(system.chain_slices[0].joint_coordinate, ElementsAre(-1, 0));
  EXPECT_THAT(system.chain_slices[0].joint_command, ElementsAre(0, -1));
  EXPECT_THAT(system.chain_slices[1].joint_command, ElementsAre(1, -1));
}

TEST(System, GuessesWhatTheMechanismSays) {
  const System system = prepare(orthoglide(model::LinearSpring{0.1, 0}, 0.1, 0.2));
  EXPECT_EQ(guess(system), (Vector{{0, std::asin(0.2), 0, 0, 0, std::asin(0.1), 0, 0, 0.1, 0.2}}));
  EXPECT_EQ(system.commands, (Vector{{0.1 + std::sqrt(1 - 0.04), 0.2 + std::sqrt(0.99)}}));
}

TEST(System, OrdersTheSwitchesOfASpringUpwards) {
  const model::PiecewiseLinearSpring knee{{-0.2, 0.1, 0.4}, {1, 0, 2, 3}, 0, 0};
  const System system = prepare(orthoglide(knee, 0.3, -0.5));
  ASSERT_EQ(system.switches.size(), 6u);
  const Vector z = guess(system);
  const Piece piece = piece_at(system, z);
  EXPECT_THAT(piece, ElementsAre(-1, -1, -1, 1, 1, -1));
  EXPECT_EQ(system.springs.size(), 4u);
  for (const CoordinateSpring& spring : system.springs)
    EXPECT_EQ(segment_of(spring, piece), spring.law.segment_at(z[spring.coordinate]))
        << spring.name;
}

TEST(System, AStateOnABreakpointIsInTheUpperSegment) {
  const System system = prepare(orthoglide(model::LinearSpring{0.1, 0}, 0.1, 0.2));
  EXPECT_TRUE(piece_at(system, guess(system)).empty());
  const model::OneSidedSpring knee{1, std::asin(0.2), model::OneSidedSpring::Side::above};
  const System switched = prepare(orthoglide(knee, 0.1, 0.2));
  EXPECT_THAT(piece_at(switched, guess(switched)), ElementsAre(1, -1));
}

TEST(System, AddsUpTheEnergyOfItsSprings) {
  const System system = prepare(two_link_arm(0.3, -0.4));
  Vector z = guess(system);
  EXPECT_EQ(spring_energy(system, z), 0);
  z[0] += 0.1;
  z[1] -= 0.2;
  EXPECT_NEAR(spring_energy(system, z), 0.5 * 2 * 0.01 + 0.5 * 1 * 0.04, 1e-15);
}

}  // namespace
}  // namespace springfold::statics
