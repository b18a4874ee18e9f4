#include "springfold/statics/first_equilibrium.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "examples.hpp"

namespace springfold::statics {
namespace {

bool same_bits(const Vector& a, const Vector& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

/// Two rigid bars from (-half, 0) and (half, 0) to a point: a truss, no spring anywhere.
System truss(double half, double length, double left, double right, const Vector& point) {
  model::Mechanism m;
  m.bodies = {{"point", model::TaskSpace::xy, point}};
  for (const double x : {-half, half}) {
    model::Chain chain{.name = x < 0 ? "left" : "right"};
    chain.from_attachment.p[0] = x;
    chain.elements = {hinge("hinge", x < 0 ? left : right), link_along_x(length)};
    m.chains.push_back(chain);
  }
  return prepare(m);
}

TEST(FirstEquilibrium, IsFoundFromPoorGuessesWithFullPrecision) {
  std::mt19937 random(91);
  std::uniform_real_distribution<double> turn(-1.2, 1.2), shift(-0.8, 0.8);
  const double q1 = degrees(30), q2 = degrees(60);
  const System system = prepare(two_link_arm(q1, q2));
  for (int trial = 0; trial < 200; ++trial) {
    StartProblem problem{.z = guess(system), .inputs = {Vector(0), Vector{{0.3, -0.2}}}};
    problem.z.head(2) += Vector{{turn(random), turn(random)}};
    problem.z.tail(2) += Vector{{shift(random), shift(random)}};
    const FirstEquilibrium found = first_equilibrium(system, problem);
    ASSERT_EQ(found.status, StartStatus::found) << "guess " << problem.z.transpose();
    // Balance written out: k (q - q0) = J^T F.
    const double a = found.z[0], b = found.z[0] + found.z[1];
    const double elbow = 0.8 * (-std::sin(b) * 0.3 - std::cos(b) * 0.2);
    const double shoulder = -std::sin(a) * 0.3 - std::cos(a) * 0.2 + elbow;
    EXPECT_NEAR(2 * (found.z[0] - q1), shoulder, 1e-12);
    EXPECT_NEAR(found.z[1] - q2, elbow, 1e-12);
    EXPECT_LT(found.residual, 1e-12);
  }
}

TEST(FirstEquilibrium, StaysNearTheGuessedPoseWhateverTheJointsGuess) {
  // Joint coordinates of the centred platform, pose guesses near the two stable turned positions.
  for (const double psi : {-0.45, -0.3, 0.3, 0.45}) {
    model::Mechanism m = three_rpr({.free_length = 0.55});
    m.bodies[0].pose = Vector{{0.02, -0.01, psi}};
    const System system = prepare(m);
    const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(3));
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_NEAR(pose_of(system, found)[2], std::copysign(0.325471709506, psi), 1e-11);
  }
}

TEST(FirstEquilibrium, TriesAgainFromSeededPerturbations) {
  // Bars that lie flat on each other cannot close to first order: the guess itself leads nowhere.
  const System system = truss(0.5, 1, 0, 0, Vector{{1, 0}});
  StartProblem problem{.z = guess(system), .inputs = {Vector(0), Vector{{0, -1}}}};
  const FirstEquilibrium found = first_equilibrium(system, problem);
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_GT(found.attempts, 1);
  EXPECT_NEAR(std::abs(pose_of(system, found)[1]), std::sqrt(0.75), 1e-12);
  problem.attempts = 1;
  EXPECT_EQ(first_equilibrium(system, problem).status, StartStatus::no_assembly);
}

TEST(FirstEquilibrium, IsTheSameToTheLastBitForTheSameSeed) {
  const System system = truss(0.5, 1, 0, 0, Vector{{1, 0}});
  for (const std::uint64_t seed : {1u, 2u, 77u}) {
    const StartProblem problem{
        .z = guess(system), .inputs = {Vector(0), Vector{{0, -1}}}, .seed = seed};
    const FirstEquilibrium a = first_equilibrium(system, problem);
    const FirstEquilibrium b = first_equilibrium(system, problem);
    EXPECT_EQ(a.status, StartStatus::found);
    EXPECT_TRUE(same_bits(a.z, b.z)) << "seed " << seed;
    EXPECT_EQ(a.attempts, b.attempts);
    EXPECT_EQ(a.iterations, b.iterations);
  }
}

TEST(FirstEquilibrium, SaysWhenTheLegsAreTooShort) {
  const System system = truss(1, 0.7, 0.5, 2.5, Vector{{0, 0.5}});
  const FirstEquilibrium found = free_equilibrium(system, Vector{{0, -1}});
  EXPECT_EQ(found.status, StartStatus::no_assembly);
  EXPECT_EQ(found.attempts, 16);
  EXPECT_GT(found.residual, 0.1);
}

TEST(FirstEquilibrium, SaysWhenNothingBalancesTheLoad) {
  // A point on two passive sliders is closed everywhere and held nowhere.
  model::Mechanism m;
  m.bodies = {{"point", model::TaskSpace::xy, Vector::Zero(2)}};
  m.chains = {{.name = "table"}};
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    m.chains[0].elements.push_back(model::Joint{
        .name = axis[0] == 1 ? "x" : "y", .kind = model::JointKind::prismatic, .axis = axis});
  const System system = prepare(m);
  const FirstEquilibrium found = free_equilibrium(system, Vector{{1, 0}});
  EXPECT_EQ(found.status, StartStatus::no_equilibrium);
}

TEST(FirstEquilibrium, SaysWhenARigidToggleIsStretchedAcrossItsLoad) {
  const System system = truss(1, 1, 0, std::numbers::pi, Vector{{0, 0}});
  EXPECT_EQ(free_equilibrium(system, Vector{{0, -1}}).status, StartStatus::no_equilibrium);
}

TEST(FirstEquilibrium, WantsAsManyCommandsAsPoseCoordinates) {
  const System system = prepare(two_link_arm(0.3, 0.5));  // no actuator at all
  const StartProblem problem{.unknowns = StartUnknowns::commands,
                             .z = guess(system),
                             .inputs = {system.commands, Vector::Zero(2)}};
  EXPECT_EQ(first_equilibrium(system, problem).status, StartStatus::wrong_count);
  EXPECT_EQ(first_equilibrium_paper(system, problem).status, StartStatus::wrong_count);
}

TEST(FirstEquilibrium, ReturnsTheWrenchThatHoldsTheBody) {
  const System system = prepare(two_link_arm(degrees(30), degrees(60)));
  // Held where the load (0.3, -0.2) had put it: that load comes back.
  StartProblem problem{.unknowns = StartUnknowns::wrench,
                       .z = guess(system),
                       .inputs = {Vector(0), Vector::Zero(2)}};
  problem.z.tail(2) = Vector{{1.398972148781, 0.918646452560}};
  for (const double already : {0.0, 5.0}) {  // whatever acts already is counted
    problem.inputs.W.setConstant(already);
    const FirstEquilibrium found = first_equilibrium(system, problem);
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_LT((found.inputs.W - Vector{{0.3, -0.2}}).norm(), 1e-10);
    EXPECT_TRUE(same_bits(found.z.tail(2), problem.z.tail(2))) << "the pose was given";
  }
}

TEST(FirstEquilibrium, FindsTheCommandsOfThePapersTable) {
  // Exact values for p = 0.454: the commands that balance the platform without load.
  for (const auto& [s, stiffness, rho] : {std::tuple{-0.454, 0.0, 0.437001683500},
                                          {-0.454, 0.01, 0.433497973681},
                                          {-0.454, 0.1, 0.401964585313},
                                          {0.454, 0.05, 1.398920189796},
                                          {0.454, 0.1, 1.452838696091}}) {
    const System system = prepare(orthoglide(model::LinearSpring{stiffness, 0}, s, s));
    const FirstEquilibrium found =
        first_equilibrium(system, {.unknowns = StartUnknowns::commands,
                                   .z = guess(system),
                                   .inputs = {system.commands, Vector::Zero(2)}});
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_NEAR(found.inputs.rho[0], rho, 1e-11);
    EXPECT_NEAR(found.inputs.rho[1], rho, 1e-11);
  }
}

TEST(FirstEquilibrium, PutsOneSidedSpringsIntoTheSegmentWhereTheyAre) {
  const model::OneSidedSpring knee{0.5, std::numbers::pi / 12, model::OneSidedSpring::Side::above};
  for (const double s : {-0.3, 0.1, 0.454}) {
    const System system = prepare(orthoglide(knee, s, s));
    const FirstEquilibrium found = held_equilibrium(system);
    ASSERT_EQ(found.status, StartStatus::found);
    const std::int8_t side = std::asin(s) > std::numbers::pi / 12 ? 1 : -1;
    EXPECT_EQ(found.piece, (Piece{side, side})) << "s = " << s;
    EXPECT_EQ(found.piece, piece_at(system, found.z));
  }
}

TEST(FirstEquilibrium, IsTheSameFromAGuessThatIsAWholeTurnAway) {
  const System system = prepare(cantilever(3, 2, model::TaskSpace::spatial));
  const StartProblem near{.z = guess(system),
                          .inputs = {Vector(0), Vector{{0.0, 0.4, 0, 0, 0, 0}}}};
  const FirstEquilibrium expected = first_equilibrium(system, near);
  ASSERT_EQ(expected.status, StartStatus::found);
  const Index rotation = system.body_slices[0].t + 3;
  for (const double off : {0.0, 1e-9, -1e-3, 0.2}) {
    StartProblem far = near;
    far.z.segment(rotation, 3) << 0, 0, 2 * std::numbers::pi + off;
    const FirstEquilibrium found = first_equilibrium(system, far);
    ASSERT_EQ(found.status, StartStatus::found) << off;
    EXPECT_LT((found.z - expected.z).lpNorm<Eigen::Infinity>(), 1e-10) << off;
    EXPECT_GT(found.moved, 6);
  }
}

TEST(FirstEquilibrium, TellsHowFarItMoved) {
  const System system = prepare(two_link_arm(degrees(45), degrees(90)));
  const FirstEquilibrium still = free_equilibrium(system, Vector::Zero(2));
  EXPECT_LT(still.moved, 1e-14);
  EXPECT_EQ(still.attempts, 1);
  const FirstEquilibrium moved = free_equilibrium(system, Vector{{0, -0.8}});
  EXPECT_NEAR(moved.moved, degrees(126.4921043718 - 90), 1e-10);
  EXPECT_GT(moved.iterations, 0);
}

}  // namespace
}  // namespace springfold::statics
