#include "springfold/statics/prepare_again.hpp"

#include <gmock/gmock.h>

#include "examples.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/statics/moved_places.hpp"

namespace springfold::statics {
namespace {

/// With something of every sort that acts on chains and bodies.
model::Mechanism loaded(const model::SpringLaw& knee, double size) {
  model::Mechanism m = orthoglide(knee, 0.4 * size, 0.3);
  m.gravity = {0, -size, 0};
  m.bodies[0].mass = 0.1 * size;
  m.chains[0].points = {{.name = "knee", .elements_before = 2, .mass = 0.2}};
  m.chains[1].points = {{.name = "knee", .elements_before = 2}};
  m.loads = {{.name = "pull", .on = {.body = 1}, .vector = {0.3 * size, 0, 0}}};
  m.line_springs = {{.name = "line",
                     .from = {.chain = 0, .point = 0},
                     .to = {.chain = 1, .point = 0},
                     .stiffness = 0.5 * size,
                     .free = 0.2}};
  m.shape_springs = {{.name = "reach",
                      .shape = {.points = {{.body = 0}, {.body = 1}}},
                      .law = model::LinearSpring{0.7 * size, 0.1}}};
  return m;
}

/// Everything that the equilibrium says in one state.
Matrix said(const System& system) {
  Vector z = guess(system);
  for (Index i = 0; i < z.size(); ++i) z[i] += 0.01 * static_cast<double>(i + 1);
  Workspace work;
  Vector r;
  Matrix A, by_commands;
  const Inputs inputs{system.commands, Vector::Constant(system.load_size, 0.1)};
  EXPECT_TRUE(equilibrium_matrix(system, piece_at(system, z), z, inputs, work, r, A, &by_commands));
  Matrix all(A.rows(), A.cols() + by_commands.cols() + 2);
  all << A, by_commands, r, z;
  return all;
}

TEST(PreparedAgain, AMechanismWithOtherNumbersIsWhatItIsFromNothing) {
  const model::Mechanism before = loaded(model::LinearSpring{0.1, 0}, 1),
                         after = loaded(model::LinearSpring{0.3, 0.2}, 1.7);
  const System anew = prepare(after), again = prepare(after, prepare(before));
  EXPECT_EQ(said(again), said(anew));
  EXPECT_EQ(again.coordinate_names, anew.coordinate_names);
  EXPECT_EQ(again.points.size(), anew.points.size());
  EXPECT_EQ(again.loads.size(), anew.loads.size());
}

TEST(PreparedAgain, LawsMayHaveOtherBreakpoints) {
  const model::OneSidedSpring stop{0.4, 0.35, model::OneSidedSpring::Side::above};
  const model::Mechanism before = loaded(model::LinearSpring{0.1, 0}, 1), after = loaded(stop, 1);
  const System anew = prepare(after), again = prepare(after, prepare(before));
  ASSERT_EQ(again.switches.size(), 2U);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(again.switches[j].coordinate, anew.switches[j].coordinate);
    EXPECT_EQ(again.switches[j].breakpoint, anew.switches[j].breakpoint);
    EXPECT_EQ(again.switches[j].spring, anew.switches[j].spring);
  }
  EXPECT_EQ(said(again), said(anew));
}

TEST(PreparedAgain, PartsWithOtherNumbersAreRenewedInPlace) {
  model::Mechanism m =
      loaded(model::OneSidedSpring{0.4, 0.35, model::OneSidedSpring::Side::above}, 1);
  std::get<model::Joint>(m.chains[0].elements[1]).spring.reset();
  m.chains[0].coupled_springs = {{.name = "knee",
                                  .elements = {1},
                                  .stiffness = Matrix::Constant(1, 1, 0.2),
                                  .free = Vector::Constant(1, 0.1)}};
  System system = prepare(m);
  const MovedPlaces places = places_of(system, {.laws = {{0, 0}, {1, 1}},
                                                .commands = {{1, 0}},
                                                .coupled = {{0, 0}},
                                                .lines = {0},
                                                .shape_laws = {0},
                                                .loads = {0}});
  model::Mechanism& own = system.mechanism;
  std::get<model::Joint>(own.chains[0].elements[0]).spring = model::LinearSpring{2, 0.1};
  std::get<model::Joint>(own.chains[1].elements[1]).spring =
      model::OneSidedSpring{0.7, 0.25, model::OneSidedSpring::Side::above};
  std::get<model::Joint>(own.chains[1].elements[0]).command += 0.1;
  own.chains[0].coupled_springs[0].stiffness *= 3;
  own.chains[0].coupled_springs[0].free[0] = -0.2;
  own.line_springs[0].stiffness = 0.9;
  own.line_springs[0].free = 0.3;
  own.shape_springs[0].law = model::LinearSpring{0.2, 0.4};
  own.loads[0].vector = {0.1, -0.2, 0};
  ASSERT_TRUE(renew(places, system));
  const System anew = prepare(own);
  EXPECT_EQ(said(system), said(anew));
  ASSERT_EQ(system.switches.size(), 1U);
  EXPECT_EQ(system.switches[0].breakpoint, 0.25);
}

TEST(PreparedAgain, PartsWithOtherBreakpointsAreNot) {
  System system = prepare(loaded(model::LinearSpring{0.1, 0}, 1));
  const MovedPlaces places = places_of(system, {.laws = {{0, 1}}});
  std::get<model::Joint>(system.mechanism.chains[0].elements[1]).spring =
      model::OneSidedSpring{0.4, 0.35, model::OneSidedSpring::Side::above};
  EXPECT_FALSE(renew(places, system));
}

TEST(PreparedAgain, MassesAndLoadsMayComeAndGo) {
  model::Mechanism bare = loaded(model::LinearSpring{0.1, 0}, 1);
  const model::Mechanism full = bare;
  bare.gravity.setZero();
  bare.loads.clear();
  bare.line_springs.clear();
  bare.shape_springs.clear();
  EXPECT_EQ(said(prepare(bare, prepare(full))), said(prepare(bare)));
  EXPECT_EQ(said(prepare(full, prepare(bare))), said(prepare(full)));
}

TEST(PreparedAgain, AnotherMechanismIsPreparedFromNothing) {
  const model::Mechanism arm = two_link_arm(0.3, 0.4);
  const System again = prepare(arm, prepare(loaded(model::LinearSpring{0.1, 0}, 1)));
  EXPECT_EQ(again.coordinate_names, prepare(arm).coordinate_names);
  EXPECT_EQ(again.size, prepare(arm).size);
}

StartProblem neighbour_of(const FirstEquilibrium& known) {
  return {.z = known.z, .inputs = known.inputs, .is_neighbour = true};
}

TEST(Neighbours, TheirFactorsAndExpectationsLeadToTheSameEquilibrium) {
  const auto at = [](double stiffness) {
    return prepare(loaded(model::LinearSpring{stiffness, 0}, 1));
  };
  const System first = at(0.1), second = at(0.101), third = at(0.102);
  const FirstEquilibrium a = free_equilibrium(first, Vector::Zero(2));
  ASSERT_EQ(a.status, StartStatus::found);
  const FirstEquilibrium b = first_equilibrium(second, neighbour_of(a));
  ASSERT_EQ(b.status, StartStatus::found);
  ASSERT_TRUE(b.factors);
  StartProblem foreseen = neighbour_of(b);
  foreseen.foresight = {.z = 2 * b.z - a.z, .rho = {}, .factors = b.factors};
  const FirstEquilibrium plain = first_equilibrium(third, neighbour_of(b)),
                         quick = first_equilibrium(third, foreseen);
  ASSERT_EQ(plain.status, StartStatus::found);
  ASSERT_EQ(quick.status, StartStatus::found);
  EXPECT_LT((plain.z - quick.z).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(Neighbours, AnExactExpectationNeedsNewFactorsUnlessNeighboursEncloseIt) {
  const System system = prepare(loaded(model::LinearSpring{0.1, 0}, 1));
  const FirstEquilibrium known = free_equilibrium(system, Vector::Zero(2));
  ASSERT_EQ(known.status, StartStatus::found);
  StartProblem problem = neighbour_of(known);
  const FirstEquilibrium near = first_equilibrium(system, problem);
  ASSERT_TRUE(near.factors);
  problem.foresight = {.z = near.z, .rho = {}, .factors = near.factors};
  const FirstEquilibrium alone = first_equilibrium(system, problem);
  EXPECT_EQ(alone.status, StartStatus::found);
  EXPECT_NE(alone.factors, near.factors);
  problem.foresight.enclosed = true;
  const FirstEquilibrium enclosed = first_equilibrium(system, problem);
  EXPECT_EQ(enclosed.status, StartStatus::found);
  EXPECT_EQ(enclosed.factors, near.factors);
  EXPECT_EQ(enclosed.z, alone.z);
}

/// Springs of no free length in a row along x: a stiff one from x = 1 to the first point, a soft one between the
/// points.
model::Mechanism stiff_and_soft(double soft) {
  model::Mechanism m;
  for (const char* name : {"a", "b"})
    m.bodies.push_back({name, model::TaskSpace::xyz, Vector{{1, 0, 0}}});
  m.line_springs.push_back({"stiff", {.body = 0, .at = Vec3::UnitX()}, {.body = 1}, 1, 0});
  m.line_springs.push_back({"soft", {.body = 1}, {.body = 2}, soft, 0});
  return m;
}

TEST(Neighbours, LoadsThatStiffSpringsDoNotFeelAreNotNothing) {
  constexpr double soft = 1e-10, load = 1e-16;
  const System system = prepare(stiff_and_soft(soft));
  StartProblem problem{.z = guess(system)};
  problem.inputs = {system.commands, Vector::Zero(system.load_size), {}};
  Vector& W = problem.inputs.W;
  const auto moved = [&](const FirstEquilibrium& found) { return found.z[found.z.size() - 3] - 1; };
  W[3] = load;
  FirstEquilibrium known = first_equilibrium(system, problem);
  ASSERT_EQ(known.status, StartStatus::found);
  EXPECT_NEAR(moved(known), load / soft, 1e-9 * load / soft);
  W[3] = 2 * load;
  StartProblem beside = neighbour_of(known);
  beside.inputs = problem.inputs;
  known = first_equilibrium(system, beside);
  ASSERT_EQ(known.status, StartStatus::found);
  EXPECT_NEAR(moved(known), 2 * load / soft, 1e-9 * load / soft);
  W[3] = 3 * load;
  beside = neighbour_of(known);
  beside.inputs = problem.inputs;
  beside.foresight = {.z = known.z, .rho = {}, .factors = known.factors};
  known = first_equilibrium(system, beside);
  ASSERT_EQ(known.status, StartStatus::found);
  EXPECT_NEAR(moved(known), 3 * load / soft, 1e-9 * load / soft);
}

TEST(Neighbours, WrongExpectationsAndFactorsDoNoHarm) {
  const System system = prepare(loaded(model::LinearSpring{0.1, 0}, 1));
  const FirstEquilibrium known = free_equilibrium(system, Vector::Zero(2));
  ASSERT_EQ(known.status, StartStatus::found);
  StartProblem problem = neighbour_of(known);
  problem.foresight = {
      .z = known.z + Vector::Constant(known.z.size(), 1.0),
      .rho = {},
      .factors = std::make_shared<Lu>(Matrix::Identity(known.z.size(), known.z.size()))};
  const FirstEquilibrium found = first_equilibrium(system, problem);
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_LT((found.z - known.z).lpNorm<Eigen::Infinity>(), 1e-12);
}

}  // namespace
}  // namespace springfold::statics
