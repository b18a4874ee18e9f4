// Mechanisms without chains: bodies held by line springs alone.
#include <gtest/gtest.h>

#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/stages.hpp"
#include "springfold/statics/stiffness.hpp"

namespace springfold::statics {
namespace {

using model::TaskSpace;

/// A body at the origin on three pairs of springs of zero free length, opposite to each other:
/// stiffness (k1 + k1', ...) along the axes.
model::Mechanism point_on_springs() {
  model::Mechanism m;
  m.bodies = {{"point", TaskSpace::xyz, Vector::Zero(3)}};
  for (Index axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const model::Vec3<double> at = side * model::Vec3<double>::Unit(axis);
      const std::string name = std::string(1, "xyz"[axis]) + (side > 0 ? "+" : "-");
      m.line_springs.push_back(
          {name, {.body = 0, .at = at}, {.body = 1}, 1.0 + static_cast<double>(axis), 0});
    }
  return m;
}

TEST(BodiesOnSprings, AreUsableMechanisms) {
  EXPECT_TRUE(problems_in(point_on_springs()).empty());
  EXPECT_TRUE(has_stage_form(prepare(point_on_springs())));
}

// Springs of zero free length: K = 2 sum k I, x = K^-1 f.
TEST(BodiesOnSprings, MoveByTheirCompliance) {
  const System system = prepare(point_on_springs());
  ASSERT_EQ(system.size, 3);
  EXPECT_EQ(system.closure_count(), 0);
  StartProblem problem{.z = guess(system)};
  problem.inputs = {system.commands, Vector::Zero(3), {}};
  problem.inputs.W << 3, -6, 9;
  const FirstEquilibrium first = first_equilibrium(system, problem);
  ASSERT_EQ(first.status, StartStatus::found);
  const double k = 2 * (1 + 2 + 3);
  EXPECT_LT((first.z - problem.inputs.W / k).norm(), 1e-14);
}

TEST(BodiesOnSprings, HaveStiffnessComplianceAndNoUnstableMode) {
  const System system = prepare(point_on_springs());
  Workspace work;
  Vector r;
  Matrix A;
  const Inputs inputs{system.commands, Vector::Zero(3), {}};
  ASSERT_TRUE(equilibrium_matrix(system, {}, Vector::Zero(3), inputs, work, r, A));
  const Condensed condensed = condense(system, A, work);
  EXPECT_LT((condensed.platform.K - 12 * Matrix::Identity(3, 3)).norm(), 1e-14);
  EXPECT_EQ(condensed.stability.force_controlled, 0);
  EXPECT_EQ(condensed.stability.pose_controlled, 0);
  const auto C = body_compliance(system, A, 1, true);
  ASSERT_TRUE(C);
  EXPECT_LT((*C - Matrix::Identity(3, 3) / 12).norm(), 1e-15);
  EXPECT_LT((tangent_stiffness(system, A, work) - 12 * Matrix::Identity(3, 3)).norm(), 1e-14);
  EXPECT_EQ(zero_modes(system, A), 0);
}

// A plate on three bars through one point turns freely about it.
TEST(BodiesOnSprings, ShowTheMotionThatNoSpringResists) {
  model::Mechanism m;
  m.bodies = {{"plate", TaskSpace::planar, Vector::Zero(3)}};
  for (const double angle : {0.0, 2.0, 4.0}) {
    const model::Vec3<double> at{std::cos(angle), std::sin(angle), 0};
    m.line_springs.push_back({"s", {.body = 0, .at = 2 * at}, {.body = 1, .at = at}, 1, 1});
  }
  const System system = prepare(m);
  Workspace work;
  Vector r;
  Matrix A;
  ASSERT_TRUE(equilibrium_matrix(system, {}, Vector::Zero(3),
                                 {system.commands, Vector::Zero(3), {}}, work, r, A));
  EXPECT_EQ(zero_modes(system, A), 1);
}

}  // namespace
}  // namespace springfold::statics
