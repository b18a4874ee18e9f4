// Switches of shapes along a path: gradients by all unknowns of the path, quaternions among them.
#include <gtest/gtest.h>

#include "analysis/path_problem.hpp"
#include "analysis/quaternion.hpp"
#include "model/random_chain.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

using model::Anchor;
using model::random_pose;
using model::random_unit;
using model::random_vector;
using model::ShapeKind;

/// Two spatial bodies on chains of four hinges; contacts between points of them.
model::Mechanism touching_bodies(std::mt19937& random) {
  model::Mechanism m;
  for (Index b = 1; b <= 2; ++b) {
    m.bodies.push_back({.name = "b" + std::to_string(b), .pose = Vector::Zero(6)});
    model::Chain chain{.name = "c" + std::to_string(b), .from = b - 1, .to = b};
    for (int i = 0; i < 4; ++i) {
      chain.elements.push_back(model::Joint{
          .name = "j" + std::to_string(i),
          .axis = random_unit(random),
          .role = i == 0 ? model::JointRole::actuated : model::JointRole::preloaded,
          .spring = i == 0 ? std::nullopt
                           : std::optional<model::SpringLaw>(model::OneSidedSpring{1, 0.1})});
      chain.elements.push_back(model::RigidLink{random_pose(random, false)});
    }
    chain.points = {{.name = "p", .elements_before = 4}};
    m.chains.push_back(chain);
  }
  const auto on = [&](Index body) {
    return Anchor{.body = body, .at = random_vector(random, 3, 1)};
  };
  const model::OneSidedSpring push{2, 0.7, model::OneSidedSpring::Side::below};
  m.shape_springs = {
      {"ball", {.points = {on(1), on(2)}}, push},
      {"fold", {.kind = ShapeKind::dihedral, .points = {on(0), on(1), on(2), on(1)}}, push},
      {"plane", {.kind = ShapeKind::plane, .points = {{.chain = 1}, on(1), on(1), on(2)}}, push}};
  return m;
}

PathRule moving_rule(const statics::System& system, std::mt19937& random) {
  PathRule rule{.body = 2, .t_start = Vector::Zero(6), .t_rate = Vector::Zero(6)};
  rule.t_rate.head(3) = random_vector(random, 3, 1);
  rule.N = Matrix::Identity(6, 6).rightCols(5);
  rule.rho_start = random_vector(random, system.commands.size(), 1);
  rule.rho_rate = random_vector(random, system.commands.size(), 1);
  rule.W_start = rule.W_rate = Vector::Zero(system.load_size);
  return rule;
}

TEST(ShapeSwitches, HaveExactGradientsAlongAPathWithTurnedBodies) {
  std::mt19937 random(81);
  for (int trial = 0; trial < 10; ++trial) {
    const model::Mechanism mechanism = touching_bodies(random);
    ASSERT_EQ(model::problems_in(mechanism), std::vector<std::string>{});
    const statics::System system = statics::prepare(mechanism);
    const PathProblem problem(system, moving_rule(system, random));
    ASSERT_EQ(problem.double_covers().size(), 2u);
    ASSERT_EQ(problem.switch_count(), 9);
    Vector y = random_vector(random, problem.size(), 0.6);
    for (const Index q : problem.double_covers())
      y.segment<4>(q) = (0.8 + 0.05 * trial) * quaternion_of(2 * random_unit(random));
    Matrix by_y;
    Vector by_lambda, g;
    ASSERT_TRUE(problem.switch_gradients(y, 0.4, by_y, by_lambda));
    for (Index j = 0; j <= problem.size(); ++j) {
      const auto along = [&](double value) -> std::optional<Vector> {
        Vector moved = y;
        if (j < problem.size()) moved[j] = value;
        problem.switches(moved, j < problem.size() ? 0.4 : value, g);
        return g;
      };
      const auto column = six_point_derivative(along, j < problem.size() ? y[j] : 0.4, 0x1p-11);
      const Vector exact = j < problem.size() ? Vector(by_y.col(j)) : by_lambda;
      EXPECT_LT((*column - exact).norm(), 1e-9 * (1 + by_y.squaredNorm())) << "column " << j;
    }
  }
}

}  // namespace
}  // namespace springfold::analysis
