// Moments on bodies that can turn about one direction only have a potential.
#include <gtest/gtest.h>

#include "equilibria.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/model/axis_of_turn.hpp"
#include "springfold/statics/stage_jacobians.hpp"
#include "springfold/statics/stages.hpp"

namespace springfold::statics {
namespace {

using model::Load;
using model::LoadKind;
using model::Mat3;

/// A slide and two hinges about a direction that is given in the frame where the chain begins.
model::Chain screw(std::mt19937& random, const std::string& name, const Vec3& axis, Index from,
                   Index to) {
  model::Chain chain{.name = name, .from = from, .to = to};
  chain.from_attachment = random_pose(random, false);
  chain.to_attachment = random_pose(random, false);
  const model::Pose<double> link = random_pose(random, false);
  const Vec3 first = chain.from_attachment.R.transpose() * axis;
  const auto joint = [](const char* own, const Vec3& along, model::JointKind kind,
                        model::JointRole role) {
    return model::Joint{.name = own, .kind = kind, .axis = along, .role = role, .command = 0.3};
  };
  using enum model::JointKind;
  using enum model::JointRole;
  chain.elements = {joint("a", first, revolute, passive), model::RigidLink{link},
                    joint("s", random_unit(random), prismatic, passive),
                    joint("b", -(link.R.transpose() * first), revolute, actuated)};
  chain.points = {{.name = "p", .elements_before = 3, .at = random_vector(random, 3, 1)}};
  return chain;
}

/// Two bodies that turn about the same direction, one carried by the other, under moments of every kind.
model::Mechanism tower(std::mt19937& random) {
  model::Mechanism m;
  const Vec3 axis = random_unit(random);
  m.bodies = {{.name = "one", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)},
              {.name = "two", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)}};
  m.chains = {screw(random, "c", axis, 0, 1)};
  const Vec3 in_one = axes_of_turn(m)[0]->base.transpose() * axis;
  m.chains.push_back(screw(random, "d", in_one, 1, 2));
  const auto add = [&](const model::Anchor& on, LoadKind kind, bool follows, const Vec3& vector) {
    m.loads.push_back({"", on, kind, follows, false, vector});
  };
  const auto turns = axes_of_turn(m);
  for (const Index body : {1, 2}) {
    const Vec3 along = turns[static_cast<std::size_t>(body - 1)]->base.transpose() * axis;
    const model::Anchor on{.body = body, .at = random_vector(random, 3, 1)};
    add(on, LoadKind::moment, false, random_vector(random, 3, 2));
    add(on, LoadKind::moment, true, random_vector(random, 3, 2));
    add(on, LoadKind::moment, true, 1.3 * along);
    add(on, LoadKind::force, true, -0.7 * along);
  }
  add({.chain = 1}, LoadKind::moment, false, random_vector(random, 3, 2));
  return m;
}

/// A body on a slide, and one that stands on a planar body, each under moments and with a hinged arm under another one.
model::Mechanism slide_and_turntable(std::mt19937& random) {
  model::Mechanism m;
  m.bodies = {{.name = "slide", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)},
              {.name = "table", .task_space = TaskSpace::planar, .pose = Vector::Zero(3)},
              {.name = "lift", .task_space = TaskSpace::spatial, .pose = Vector::Zero(6)}};
  const auto rail = [&](const std::string& name, Index from, Index to) {
    model::Chain chain{.name = name, .from = from, .to = to};
    chain.from_attachment = random_pose(random, false);
    chain.elements = {model::Joint{
        .name = "s", .kind = model::JointKind::prismatic, .axis = random_unit(random)}};
    return chain;
  };
  m.chains = {rail("a", 0, 1), rail("b", 2, 3)};
  const Vec3 in_lift = axes_of_turn(m)[2]->base.transpose() * Vec3::UnitZ();
  m.chains.push_back(screw(random, "c", random_unit(random), 1, 3));
  m.chains.push_back(screw(random, "d", in_lift, 3, 1));
  for (const Index body : {1, 3})
    for (const bool follows : {false, true})
      m.loads.push_back(
          {"", {.body = body}, LoadKind::moment, follows, false, random_vector(random, 3, 2)});
  for (const Index chain : {2, 3})
    m.loads.push_back(
        {"", {.chain = chain}, LoadKind::moment, false, false, random_vector(random, 3, 2)});
  return m;
}

State random_state(std::mt19937& random, const model::Mechanism& mechanism) {
  State state{prepare(mechanism), {}, {}};
  state.z = random_vector(random, state.system.size, 0.8);
  state.inputs = {random_vector(random, state.system.commands.size(), 1),
                  random_vector(random, state.system.load_size, 1),
                  random_vector(random, std::ssize(mechanism.loads), 1)};
  return state;
}

/// Rotation vectors as the joints have them.
void close_rotations(State& state) {
  const auto turns = axes_of_turn(state.system.mechanism);
  for (std::size_t b = 0; b < turns.size(); ++b) {
    if (!turns[b]) continue;
    double angle = 0;
    for (const auto& part : state.system.body_slices[b].turn->angle)
      angle += part.sign * ((part.z >= 0 ? state.z[part.z] : 0) +
                            (part.rho >= 0 ? state.inputs.rho[part.rho] : 0));
    const Mat3<double> R =
        model::exp_rotation<double>(Vec3(angle * turns[b]->axis)) * turns[b]->base;
    state.z.segment<3>(state.system.body_slices[b].t + 3) = model::log_rotation<double>(R);
  }
}

/// As if nothing were known of how the bodies turn.
State plain(const State& state) {
  State other = state;
  for (BodySlice& body : other.system.body_slices) body.turn.reset();
  for (PointLoad& load : other.system.loads) {
    const Load& given = state.system.mechanism.loads[static_cast<std::size_t>(load.number)];
    load.about_one_axis = false;
    load.follows = given.follows;
    load.vector = given.vector;
  }
  return other;
}

TEST(TurnMoments, HaveExactAndSymmetricDerivativesWhereverTheBodiesAre) {
  std::mt19937 random(51);
  for (int trial = 0; trial < 30; ++trial) {
    const State state =
        random_state(random, trial % 2 == 0 ? tower(random) : slide_and_turntable(random));
    ASSERT_TRUE(state.system.body_slices.front().turn && state.system.body_slices.back().turn);
    const Evaluated at = evaluate(state);
    EXPECT_LT((at.A - at.A.transpose()).norm(), 1e-12 * at.A.norm());
    const Vector direction = random_vector(random, state.system.size, 1);
    const Vector along = random_vector(random, 2, 1),
                 wrench = random_vector(random, state.system.load_size, 1);
    const auto moved = [&](double t) -> std::optional<Vector> {
      State other = state;
      other.z += t * direction;
      other.inputs.rho += t * along;
      other.inputs.W += t * wrench;
      return residual_at(other, {});
    };
    const Vector exact =
        at.A * direction + at.dR_drho * along + load_columns(state.system, state.z) * wrench;
    EXPECT_LT((*six_point_derivative(moved, 0, 0x1p-8) - exact).norm(), 1e-9 * at.A.norm());
  }
}

TEST(TurnMoments, AreTheMomentsThemselvesWhereTheChainsAreClosed) {
  std::mt19937 random(52);
  for (int trial = 0; trial < 30; ++trial) {
    State state =
        random_state(random, trial % 2 == 0 ? tower(random) : slide_and_turntable(random));
    close_rotations(state);
    const Vector r = residual_at(state, {}), as_given = residual_at(plain(state), {});
    EXPECT_LT((r - as_given).norm(), 1e-12 * (1 + r.norm()));
  }
}

TEST(TurnMoments, DoTheWorkThatTheirPotentialLoses) {
  std::mt19937 random(53);
  for (int trial = 0; trial < 30; ++trial) {
    State state =
        random_state(random, trial % 2 == 0 ? tower(random) : slide_and_turntable(random));
    close_rotations(state);
    Vector direction = random_vector(random, state.system.size, 1);
    const auto moved = [&](double t) {
      State other = state;
      other.z += t * direction;
      close_rotations(other);
      return other;
    };
    const auto potential = [&](double t) -> std::optional<Vector> {
      const State other = moved(t);
      return Vector::Constant(1, load_potential(other.system, other.z, other.inputs));
    };
    const auto places = [&](double t) -> std::optional<Vector> { return moved(t).z; };
    Vector rate = *six_point_derivative(places, 0, 0x1p-8);
    for (Index i = 0; i < rate.size(); ++i)
      if (state.system.is_wrench[static_cast<std::size_t>(i)]) state.z[i] = rate[i] = 0;
    const Vector r = residual_at(state, {});
    EXPECT_NEAR((*six_point_derivative(potential, 0, 0x1p-8))[0], r.dot(rate), 1e-8);
  }
}

TEST(TurnMoments, AreTheSameInTurnedFrames) {
  std::mt19937 random(54);
  for (int trial = 0; trial < 30; ++trial) {
    const State state = random_state(random, tower(random));
    std::vector<Mat3<double>> rotations;
    State turned = state;
    for (const BodySlice& body : state.system.body_slices) {
      rotations.push_back(model::exp_rotation<double>(Vec3(state.z.segment<3>(body.t + 3))));
      turned.z.segment<3>(body.t + 3).setZero();
    }
    turn_frames(state.system, rotations, turned.system);
    Vector r = residual_at(turned, {});
    for (const BodySlice& body : state.system.body_slices)
      r.segment<3>(body.t + 3) =
          model::left_jacobian<double>(Vec3(state.z.segment<3>(body.t + 3))).transpose() *
          Vec3(r.segment<3>(body.t + 3));
    EXPECT_LT((r - residual_at(state, {})).norm(), 1e-11 * (1 + r.norm()));
    const Matrix A = evaluate(turned).A;
    EXPECT_LT((A - A.transpose()).norm(), 1e-12 * A.norm());
  }
}

TEST(TurnMoments, AreTheSameInStages) {
  std::mt19937 random(55);
  const State state = random_state(random, tower(random));
  ASSERT_TRUE(has_stage_form(state.system));
  StageJacobians stages(state.system);
  Vector r;
  StructuredMatrix J;
  ASSERT_TRUE(stages.matrix(state.system, {}, state.z, state.inputs, {}, {}, r, J));
  const Evaluated at = evaluate(state);
  EXPECT_LT((r - at.residual).norm(), 1e-12 * (1 + r.norm()));
  const Vector direction = random_vector(random, state.system.size, 1);
  EXPECT_LT((stages.product(direction, {}) - at.A * direction).norm(), 1e-11 * at.A.norm());
}

}  // namespace
}  // namespace springfold::statics
