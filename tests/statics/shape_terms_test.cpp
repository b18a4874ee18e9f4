// Springs of shapes and pressures in the equilibrium of mechanisms.
#include <gtest/gtest.h>

#include "equilibria.hpp"
#include "examples.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "springfold/statics/shapes.hpp"
#include "springfold/statics/stages.hpp"

namespace springfold::statics {
namespace {

using model::Anchor;
using model::ShapeKind;
using model::ShapeSpring;

/// Two spatial bodies and chains between them, with springs of all shapes and a pressure.
/// @param in_series  other springs before those of some shapes
model::Mechanism all_shapes(std::mt19937& random, bool in_series = false) {
  model::Mechanism m;
  m.bodies = {{.name = "a", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)},
              {.name = "b", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)}};
  const auto chain = [&](const std::string& name, Index from, Index to) {
    model::Chain c{.name = name, .from = from, .to = to};
    for (int i = 0; i < 4; ++i) {
      c.elements.push_back(
          model::Joint{.name = "j" + std::to_string(i),
                       .kind = i == 2 ? model::JointKind::prismatic : model::JointKind::revolute,
                       .axis = random_unit(random),
                       .role = i == 1 ? model::JointRole::actuated : model::JointRole::passive,
                       .command = 0.2});
      c.elements.push_back(model::RigidLink{random_pose(random, false)});
    }
    c.points = {{.name = "p", .elements_before = 5, .at = random_vector(random, 3, 1)}};
    m.chains.push_back(c);
  };
  chain("c", 0, 1);
  chain("d", 1, 2);
  const auto points = [&](std::size_t count) {
    std::vector<Anchor> list{{.chain = 0, .point = 0},
                             {.body = 1, .at = random_vector(random, 3, 1)},
                             {.chain = 1, .point = 0},
                             {.body = 0, .at = random_vector(random, 3, 2)},
                             {.body = 2, .at = random_vector(random, 3, 1)}};
    std::shuffle(list.begin(), list.end(), random);
    list.resize(count);
    return list;
  };
  const model::PiecewiseLinearSpring bent{{0.7}, {1.1, 2.3}, 0.4, 0.2};
  m.shape_springs = {{"path", {.kind = ShapeKind::path, .points = points(4)}, bent},
                     {"angle", {.kind = ShapeKind::angle, .points = points(3)}, bent},
                     {"fold", {.kind = ShapeKind::dihedral, .points = points(4)}, bent},
                     {"area", {.kind = ShapeKind::area, .points = points(5)}, bent},
                     {"volume",
                      {.kind = ShapeKind::volume,
                       .points = points(4),
                       .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
                      bent},
                     {"line", {.kind = ShapeKind::line, .points = points(3)}, bent},
                     {"plane", {.kind = ShapeKind::plane, .points = points(4)}, bent}};
  if (in_series) {
    const model::PolynomialSpring falls{{0, 2.5, -3, 1}, 0, {}, true};
    m.shape_springs[0].before = {{falls}, {bent}};
    m.shape_springs[1].before = {{model::LinearSpring{2.1, 0.3}, 0.4}};
    m.shape_springs[3].before = {{model::OneSidedSpring{1.7, 0.1}}};
    m.shape_springs[4].before = {{falls}};
    m.shape_springs[6].before = {{falls}, {bent}, {falls}};
    m.shape_springs[6].offset = 0.3;
  }
  m.loads = {{.name = "p",
              .kind = model::LoadKind::pressure,
              .with_lambda = true,
              .vector = {1.3, 0, 0},
              .shape = {.kind = ShapeKind::area, .points = points(3)}}};
  return m;
}

State some_state(std::mt19937& random, bool in_series = false) {
  const model::Mechanism mechanism = all_shapes(random, in_series);
  EXPECT_EQ(model::problems_in(mechanism), std::vector<std::string>{});
  State state{prepare(mechanism), {}, {}};
  state.z = random_vector(random, state.system.size, 1.5);
  drop_wrenches(state.system, state.z);
  state.inputs = {random_vector(random, 2, 1), Vector::Zero(state.system.load_size),
                  random_vector(random, 1, 1)};
  return state;
}

/// Residual of the pieces of another state, so that no spring switches on the way.
std::optional<Vector> residual_on(const Piece& piece, const State& state) {
  Workspace work;
  Vector r;
  if (!equilibrium_residual(state.system, piece, state.z, state.inputs, work, r))
    return std::nullopt;
  return r;
}

TEST(ShapeTerms, HaveExactDerivativesByCoordinatesPosesCommandsAndPressures) {
  std::mt19937 random(51);
  for (int trial = 0; trial < 60; ++trial) {
    const State state = some_state(random, trial % 2 == 1);
    const System& system = state.system;
    const Piece piece = piece_at(system, state.z, state.inputs.rho);
    Workspace work;
    Vector r;
    Matrix A, by_rho;
    ASSERT_TRUE(equilibrium_matrix(system, piece, state.z, state.inputs, work, r, A, &by_rho));
    Vector direction = random_vector(random, system.size, 1);
    drop_wrenches(system, direction);
    const Vector along = random_vector(random, 2, 1), more = random_vector(random, 1, 1);
    const double scale = 1 + A.norm();
    const auto moved = [&](double t) {
      State other = state;
      other.z += t / scale * direction;
      other.inputs.rho += t / scale * along;
      other.inputs.loads += t / scale * more;
      return residual_on(piece, other);
    };
    const auto difference = six_point_derivative(moved, 0, 0x1p-5);
    ASSERT_TRUE(difference);
    const Vector exact =
        (A * direction + by_rho * along + load_rate(system, state.z, state.inputs.rho, more)) /
        scale;
    Vector error = *difference - exact;
    drop_wrenches(system, error);
    EXPECT_LT(error.norm() / (1 + exact.norm()), 1e-9) << trial;
    EXPECT_LT((A - A.transpose()).norm(), 1e-12 * scale);
  }
}

TEST(ShapeTerms, AreTheGradientOfTheirEnergy) {
  std::mt19937 random(52);
  for (int trial = 0; trial < 10; ++trial) {
    const State state = some_state(random, trial % 2 == 1);
    const Vector r = *residual_on(piece_at(state.system, state.z, state.inputs.rho), state);
    const double scale = 1 + r.norm();
    for (Index i = 0; i < state.system.size; ++i) {
      if (state.system.is_wrench[static_cast<std::size_t>(i)]) continue;
      const auto potential = [&](double t) -> std::optional<Vector> {
        Vector z = state.z;
        z[i] += t;
        return Vector::Constant(1, spring_energy(state.system, z, state.inputs.rho) +
                                       load_potential(state.system, z, state.inputs));
      };
      EXPECT_NEAR(r[i], (*six_point_derivative(potential, 0, 0x1p-10))[0], 1e-7 * scale);
    }
  }
}

TEST(ShapeSwitches, HaveExactGradients) {
  std::mt19937 random(53);
  for (int trial = 0; trial < 20; ++trial) {
    const bool in_series = trial % 2 == 1;
    const State state = some_state(random, in_series);
    const System& system = state.system;
    ASSERT_EQ(system.switches.size(), in_series ? 10u : 7u);
    const Vector direction = random_vector(random, system.size, 1);
    const Vector along = random_vector(random, 2, 1);
    for (std::size_t j = 0; j < system.switches.size(); ++j) {
      SwitchGradient at;
      ASSERT_TRUE(switch_gradient(system, j, state.z, state.inputs.rho, at));
      const double exact = at.z.dot(direction) + at.rho.dot(along);
      const auto value = [&](double t) -> std::optional<Vector> {
        return Vector::Constant(
            1, switch_value(system, j, state.z + t * direction, state.inputs.rho + t * along));
      };
      EXPECT_NEAR((*six_point_derivative(value, 0, 0x1p-11))[0], exact,
                  1e-8 * (1 + at.z.squaredNorm()));
    }
  }
}

/// A distance with a linear law is a line spring.
TEST(ShapeTerms, OfADistanceAreThoseOfALineSpring) {
  std::mt19937 random(54);
  model::Mechanism by_shape = all_shapes(random);
  by_shape.loads.clear();
  const Anchor from{.chain = 0, .point = 0}, to{.body = 2, .at = {0.3, 0.1, -0.4}};
  by_shape.shape_springs = {
      {"s", {.kind = ShapeKind::path, .points = {from, to}}, model::LinearSpring{1.7, 0.6}}};
  model::Mechanism by_line = by_shape;
  by_line.shape_springs.clear();
  by_line.line_springs = {{"s", from, to, 1.7, 0.6}};
  State a{prepare(by_shape), {}, {}}, b{prepare(by_line), {}, {}};
  a.z = random_vector(random, a.system.size, 1);
  a.inputs = {a.system.commands, Vector::Zero(a.system.load_size), {}};
  b.z = a.z;
  b.inputs = a.inputs;
  EXPECT_LT((evaluate(a).residual - evaluate(b).residual).norm(), 1e-13);
  EXPECT_LT((evaluate(a).A - evaluate(b).A).norm(), 1e-12);
  EXPECT_NEAR(spring_energy(a.system, a.z), spring_energy(b.system, b.z), 1e-14);
}

/// The tip of a hinged arm as seen from the base: its angle is that of the hinge, whole turns counted.
TEST(AnglesOfThreePoints, CountWholeTurnsOfTheFramesThatTheyTurnWith) {
  model::Mechanism m;
  m.bodies = {{"tip", TaskSpace::planar, Vector::Unit(3, 0)}};
  model::Chain chain{.name = "arm"};
  chain.elements = {spring_hinge("h", 1), link_along_x(1)};
  m.chains = {chain};
  const auto angle = [](const Anchor& first, const Anchor& last) {
    return model::Shape{.kind = ShapeKind::angle, .points = {first, Anchor{}, last}, .near = 0};
  };
  const Anchor east{.at = {1, 0, 0}}, tip{.body = 1};
  m.shape_springs = {{"a", angle(east, tip), model::LinearSpring{1, 0}},
                     {"b", angle(tip, east), model::LinearSpring{1, 0}}};
  const System system = prepare(m);
  for (const double turned : {-20.0, -3.5, 0.4, 3.3, 30.0}) {
    Vector z = guess(system);
    z.tail(3) << std::cos(turned), std::sin(turned), turned;
    const Inputs inputs{system.commands, Vector::Zero(3), {}};
    EXPECT_NEAR(shape_state(system, 0, z, inputs).value, turned, 1e-13);
    EXPECT_NEAR(shape_state(system, 1, z, inputs).value, -turned, 1e-13);
  }
}

/// Prepared anew in the places of another system the numbers are those of a new one.
TEST(ShapeTerms, InSeriesAreTheSameWhenPreparedAgain) {
  std::mt19937 random(56);
  const model::Mechanism first = all_shapes(random, true);
  model::Mechanism second = first;
  second.shape_springs[0].before[1].law = model::LinearSpring{0.7, 0.2};
  second.shape_springs[6].offset = 0.1;
  const System again = prepare(second, prepare(first)), anew = prepare(second);
  ASSERT_EQ(again.size, anew.size);
  EXPECT_EQ(again.inner_count(), 8);
  EXPECT_EQ(again.coordinate_names[static_cast<std::size_t>(again.first_inner)], "path.1");
  ASSERT_EQ(again.switches.size(), anew.switches.size());
  State a{again, random_vector(random, again.size, 1), {}};
  a.inputs = {random_vector(random, 2, 1), Vector::Zero(again.load_size), Vector::Ones(1)};
  State b{anew, a.z, a.inputs};
  EXPECT_EQ(evaluate(a).residual, evaluate(b).residual);
  EXPECT_EQ(evaluate(a).A, evaluate(b).A);
}

TEST(ShapeTerms, KeepLongChainsOutOfStages) {
  std::mt19937 random(55);
  const System system = prepare(all_shapes(random));
  EXPECT_TRUE(system.chains_coupled);
  EXPECT_FALSE(has_stage_form(system));
}

}  // namespace
}  // namespace springfold::statics
