// Loads, weights and line springs at points of bodies and chains.
#include <gtest/gtest.h>

#include "equilibria.hpp"
#include "examples.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::statics {
namespace {

using model::Load;
using model::LoadKind;

/// A planar arm of two hinged links: points at elbow and tip.
model::Mechanism arm(double stiffness) {
  model::Mechanism m;
  m.bodies = {{"tip", TaskSpace::planar, Vector::Unit(3, 0) * 2}};
  model::Chain chain{.name = "arm"};
  chain.elements = {spring_hinge("a", stiffness), link_along_x(1), spring_hinge("b", stiffness),
                    link_along_x(1)};
  chain.points = {{.name = "elbow", .elements_before = 2}, {.name = "end", .elements_before = 4}};
  m.chains = {chain};
  return m;
}

/// Everything at once: a spatial and a planar body, chains between them, loads of all kinds on
/// bodies and points, masses, line springs.
model::Mechanism everything(std::mt19937& random) {
  model::Mechanism m;
  m.bodies = {{.name = "a", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6), .mass = 1.3},
              {.name = "b", .task_space = TaskSpace::planar, .pose = Vector::Zero(3), .mass = 0.7}};
  m.bodies[0].centre = random_vector(random, 3, 1);
  m.bodies[1].centre = {0.4, -0.1, 0};
  const auto chain = [&](const std::string& name, Index from, Index to) {
    model::Chain c{.name = name, .from = from, .to = to};
    c.from_attachment = random_pose(random, false);
    for (int i = 0; i < 4; ++i) {
      c.elements.push_back(
          model::Joint{.name = "j" + std::to_string(i),
                       .kind = i == 2 ? model::JointKind::prismatic : model::JointKind::revolute,
                       .axis = random_unit(random),
                       .role = i == 1 ? model::JointRole::actuated : model::JointRole::passive,
                       .command = 0.2});
      c.elements.push_back(model::RigidLink{random_pose(random, false)});
    }
    c.points = {{.name = "p", .elements_before = 5, .at = random_vector(random, 3, 1), .mass = 0.5},
                {.name = "q", .elements_before = 8}};
    m.chains.push_back(c);
  };
  chain("c", 0, 1);
  chain("d", 1, 2);
  m.gravity = random_vector(random, 3, 2);
  for (const LoadKind kind : {LoadKind::force, LoadKind::moment})
    for (const bool follows : {false, true}) {
      const Vec3 vector = random_vector(random, 3, 2);
      const Vec3 in_plane =
          kind == LoadKind::force ? Vec3(vector[0], vector[1], 0) : Vec3(0, 0, 1.5);
      const Vec3 at = random_vector(random, 3, 1);
      m.loads.push_back({"", {.body = 1, .at = at}, kind, follows, false, vector});
      m.loads.push_back({"", {.body = 2, .at = {at[0], at[1], 0}}, kind, follows, false, in_plane});
      m.loads.push_back({"", {.chain = 0, .point = 0, .at = at}, kind, follows, false, vector});
      m.loads.push_back({"", {.chain = 1, .point = 1, .at = at}, kind, follows, false, vector});
    }
  m.line_springs = {{"s1", {.body = 0, .at = {3, 1, 2}}, {.chain = 1, .point = 0}, 1.7, 0.8},
                    {"s2", {.chain = 0, .point = 1}, {.chain = 1, .point = 1}, 0.9, 0},
                    {"s3", {.body = 1, .at = {0, 1, 0}}, {.body = 2, .at = {1, 0, 0}}, 1.1, 0.4}};
  return m;
}

/// No wrenches: what is left in the rows of the motions is the loads' and line springs'.
TEST(PointLoads, HaveExactDerivativesByCoordinatesPosesAndCommands) {
  std::mt19937 random(41);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const model::Mechanism mechanism = everything(random);
    ASSERT_TRUE(model::problems_in(mechanism).empty());
    State state{prepare(mechanism), {}, {}};
    const System& system = state.system;
    state.z = random_vector(random, system.size, 1.5);
    drop_wrenches(system, state.z);
    const auto loads = static_cast<Index>(mechanism.loads.size());
    state.inputs = {random_vector(random, 2, 1), Vector::Zero(system.load_size),
                    random_vector(random, loads, 1)};
    const Evaluated at = evaluate(state);
    Vector direction = random_vector(random, system.size, 1);
    drop_wrenches(system, direction);
    const Vector along = random_vector(random, 2, 1), more = random_vector(random, loads, 1);
    const auto moved = [&](double t) -> std::optional<Vector> {
      State other = state;
      other.z += t * direction;
      other.inputs.rho += t * along;
      other.inputs.loads += t * more;
      return residual_at(other, {});
    };
    const auto difference = six_point_derivative(moved, 0, 0x1p-8);
    ASSERT_TRUE(difference);
    const Vector exact =
        at.A * direction + at.dR_drho * along + load_rate(system, state.z, state.inputs.rho, more);
    Vector error = *difference - exact;
    drop_wrenches(system, error);
    worst = std::max(worst, error.norm() / (1 + exact.norm()));
  }
  EXPECT_LT(worst, 1e-10);
}

TEST(PointLoads, WithAPotentialMakeASymmetricMatrix) {
  std::mt19937 random(42);
  for (int trial = 0; trial < 50; ++trial) {
    model::Mechanism mechanism = everything(random);
    std::erase_if(mechanism.loads,
                  [&](const Load& load) { return !is_conservative(mechanism, load); });
    EXPECT_EQ(mechanism.loads.size(), 6u);
    State state{prepare(mechanism), {}, {}};
    state.z = random_vector(random, state.system.size, 1.5);
    state.inputs = {random_vector(random, 2, 1), Vector::Zero(state.system.load_size), {}};
    const Matrix A = evaluate(state).A;
    EXPECT_LT((A - A.transpose()).norm(), 1e-12 * A.norm());
  }
}

TEST(PointLoads, OfWeightsAndLineSpringsAreTheGradientOfTheirPotential) {
  std::mt19937 random(43);
  model::Mechanism mechanism = everything(random);
  std::erase_if(mechanism.loads,
                [&](const Load& load) { return load.kind == LoadKind::moment || load.follows; });
  State state{prepare(mechanism), random_vector(random, prepare(mechanism).size, 1.2), {}};
  drop_wrenches(state.system, state.z);
  state.inputs = {state.system.commands, Vector::Zero(state.system.load_size), {}};
  const Vector r = residual_at(state, {});
  for (Index i = 0; i < state.system.size; ++i) {
    if (state.system.is_wrench[static_cast<std::size_t>(i)]) continue;
    const auto potential = [&](double t) -> std::optional<Vector> {
      Vector z = state.z;
      z[i] += t;
      return Vector::Constant(1, spring_energy(state.system, z, state.inputs.rho) +
                                     load_potential(state.system, z, state.inputs));
    };
    EXPECT_NEAR(r[i], (*six_point_derivative(potential, 0, 0x1p-8))[0], 1e-10);
  }
}

TEST(PointLoads, AtTheOriginOfABodyAreItsWrench) {
  std::mt19937 random(44);
  model::Mechanism mechanism = everything(random);
  mechanism.loads.clear();
  State by_wrench{prepare(mechanism), random_vector(random, prepare(mechanism).size, 1), {}};
  const Vector wrench = random_vector(random, 6, 2);
  by_wrench.inputs = {by_wrench.system.commands, Vector::Zero(by_wrench.system.load_size), {}};
  by_wrench.inputs.W.head(6) = wrench;
  mechanism.loads = {{"", {.body = 1}, LoadKind::force, false, false, wrench.head(3)},
                     {"", {.body = 1}, LoadKind::moment, false, false, wrench.tail(3)}};
  State by_loads{prepare(mechanism), by_wrench.z, by_wrench.inputs};
  by_loads.inputs.W.setZero();
  const Evaluated a = evaluate(by_wrench), b = evaluate(by_loads);
  EXPECT_LT((a.residual - b.residual).norm(), 1e-13);
  EXPECT_LT((a.A - b.A).norm(), 1e-13);
}

/// The straight arm under a follower force P along its last link, which is Ziegler's column.
TEST(ZieglersColumn, HasTheDeterminantCSquaredUnderAnyForce) {
  const double c = 1.5;
  model::Mechanism m = arm(c);
  m.loads = {{"P", {.body = 1}, LoadKind::force, true, true, -Vec3::UnitX()}};
  const System system = prepare(m);
  for (const double P : {0.0, 0.5, 1.0, 2.5, 3.9, 7.0}) {
    Vector z = guess(system);
    z[system.chain_slices[0].F] = -P;  // the links carry it
    const State state{system, z, {system.commands, Vector::Zero(3), Vector::Constant(1, P)}};
    const Evaluated at = evaluate(state);
    EXPECT_LT(at.residual.norm(), 1e-14);
    EXPECT_NEAR(tangent_determinant(system, at.A), c * c, 1e-12);
    EXPECT_EQ(tangent_stiffness(system, at.A).rows(), 2);
  }
}

TEST(ZieglersColumn, LosesNoStabilityByDivergenceButTheDeadLoadDoes) {
  model::Mechanism m = arm(1);
  m.loads = {{"P", {.body = 1}, LoadKind::force, false, true, -Vec3::UnitX()}};
  const System system = prepare(m);
  Vector z = guess(system);
  const double P = (3 - std::sqrt(5.0)) / 2;
  z[system.chain_slices[0].F] = -P;
  const State state{system, z, {system.commands, Vector::Zero(3), Vector::Constant(1, P)}};
  EXPECT_NEAR(tangent_determinant(system, evaluate(state).A), 0, 1e-14);
}

/// Weight of a rod that hangs from its hinge: stiffness m g r about the hinge.
TEST(HangingRod, HasTheStiffnessOfItsWeight) {
  model::Mechanism m;
  m.bodies = {{"end", TaskSpace::planar, (Vector(3) << 0, -2, -std::acos(-1.0) / 2).finished()}};
  model::Chain chain{.name = "rod"};
  chain.elements = {hinge("h", -std::acos(-1.0) / 2), link_along_x(2)};
  chain.points = {{.elements_before = 1, .at = {0.75, 0, 0}, .mass = 3}};
  m.chains = {chain};
  m.gravity = {0, -9.81, 0};
  const System system = prepare(m);
  const auto found = first_equilibrium(
      system, {.z = guess(system), .inputs = {system.commands, Vector::Zero(3), {}}});
  ASSERT_EQ(found.status, StartStatus::found);
  const State state{system, found.z, found.inputs};
  const Evaluated at = evaluate(state);
  EXPECT_NEAR(tangent_determinant(system, at.A), 3 * 9.81 * 0.75, 1e-12);
  EXPECT_EQ(stability(system, at.A).force_controlled, 0);
}

/// One look at every spring, whatever their number: with one at all of them for every point this takes a minute.
TEST(PointLoads, FortyThousandCopiesOfASpringActAsOneOfTheSumOfTheirStiffnesses) {
  constexpr int copies = 40000;
  model::Mechanism one = arm(2);
  one.line_springs = {{"s", {.body = 0, .at = {3, 1, 0}}, {.chain = 0, .point = 0}, 1.5, 0.5}};
  model::Mechanism many = one;
  many.line_springs.assign(copies, one.line_springs.front());
  for (int i = 0; i < copies; ++i) {
    many.line_springs[static_cast<std::size_t>(i)].name = "s" + std::to_string(i);
    many.line_springs[static_cast<std::size_t>(i)].stiffness = 1.5 / copies;
  }
  const auto state_of = [](const model::Mechanism& mechanism) {
    State state{prepare(mechanism), {}, {}};
    state.z = Vector::LinSpaced(state.system.size, -0.4, 0.7);
    state.inputs = {state.system.commands, Vector::Zero(state.system.load_size), {}};
    return state;
  };
  const State a = state_of(one), b = state_of(many);
  const Matrix A = evaluate(a).A, B = evaluate(b).A;
  const Vector r = residual_at(a, {}), s = residual_at(b, {});
  EXPECT_LT((r - s).norm(), 1e-12 * r.norm());
  EXPECT_LT((A - B).norm(), 1e-12 * A.norm());
}

}  // namespace
}  // namespace springfold::statics
