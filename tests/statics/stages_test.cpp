// The equilibrium in stages against the dense matrix.
#include "staged.hpp"

namespace springfold::statics {
namespace {

TEST(Stages, EliminatingTheAuxiliaryVariablesLeavesTheDenseMatrix) {
  std::mt19937 random(1);
  for (const auto& [bodies, chains] : kinds)
    for (const int joints : {1, 2, 5, 9, 23})
      for (const bool loaded : {false, true}) {
        const Sort sort{in_plane(bodies), joints, false, loaded};
        const Both both(random, random_mechanism(random, sort, bodies, chains));
        expect_equal(both, random);
      }
}

TEST(Stages, CoupledSpringsStayInOneStage) {
  std::mt19937 random(2);
  for (const auto& [bodies, chains] : kinds) {
    const Sort sort{in_plane(bodies), 4, true, true};
    const Both both(random, random_mechanism(random, sort, bodies, chains));
    EXPECT_TRUE(has_stage_form(both.system, 0));
    expect_equal(both, random);
  }
}

TEST(Stages, LengthOfTheStagesDoesNotMatter) {
  std::mt19937 random(3);
  for (const Index coordinates : {1, 2, 7, 100}) {
    const Sort sort{false, 12, true, true};
    const auto m = random_mechanism(random, sort, {TaskSpace::spatial}, {{0, 1}, {0, 1}});
    expect_equal(Both(random, m, {.coordinates = coordinates}), random);
  }
}

TEST(Stages, ChainsWithoutStageFormAreOneDenseFront) {
  std::mt19937 random(4);
  const Sort sort{false, 6, true, true};
  model::Mechanism m = random_mechanism(random, sort, {TaskSpace::spatial, TaskSpace::planar},
                                        {{0, 1}, {1, 2}, {0, 2}});
  m.line_springs.push_back({.name = "s", .stiffness = 3, .free = 0.2});
  m.line_springs[0].from.chain = 1;
  m.line_springs[0].from.point = 2;
  m.line_springs[0].to.body = 1;
  m.line_springs.push_back({.name = "t", .from = {.body = 2}, .to = {.body = 1}, .stiffness = 2});
  m.bodies[0].mass = 1.5;
  m.bodies[0].centre = {0.2, 0.3, 0.1};
  model::Load follower{.name = "g", .on = {.body = 1, .at = {1, 0, 0}}, .follows = true};
  follower.vector = {1, 2, 3};
  m.loads.push_back(follower);  // without potential: A is not symmetric
  const Both both(random, m);
  EXPECT_TRUE(has_stage_form(both.system, 0));
  EXPECT_FALSE(has_stage_form(both.system, 1));
  EXPECT_TRUE(has_stage_form(both.system));
  EXPECT_GT((both.A - both.A.transpose()).norm(), 0.1);
  expect_equal(both, random);
  expect_solved(both, random_borders(random, both.plan.size(), 1), random);
}

TEST(Stages, WhatIsNotSymmetricAlongAChainHasNoStageForm) {
  std::mt19937 random(5);
  const Sort sort{false, 6, false, true};
  for (const auto kind : {model::LoadKind::force, model::LoadKind::moment}) {
    model::Mechanism m = random_mechanism(random, sort, {TaskSpace::spatial}, {{0, 1}});
    m.loads[0].kind = kind;
    m.loads[0].follows = true;
    EXPECT_FALSE(has_stage_form(prepare(m)));
    EXPECT_FALSE(has_stage_form(prepare(m), 0));
  }
  model::Mechanism m = random_mechanism(random, sort, {TaskSpace::spatial}, {{0, 1}, {0, 1}});
  m.line_springs.push_back({.name = "s", .stiffness = 3});
  m.line_springs[0].from.chain = 0;
  m.line_springs[0].to.chain = 1;
  EXPECT_FALSE(has_stage_form(prepare(m)));
}

TEST(Stages, MomentsAlongAPlanarChainKeepItsStages) {
  std::mt19937 random(6);
  const Sort sort{true, 15, false, true};
  model::Mechanism m = random_mechanism(random, sort, {TaskSpace::planar}, {{0, 1}, {1, 0}});
  m.loads[0].kind = m.loads[1].kind = model::LoadKind::moment;
  m.loads[1].follows = true;
  const Both both(random, m);
  ASSERT_TRUE(has_stage_form(both.system));
  expect_equal(both, random);
}

TEST(Stages, SolutionsAndCountsAreThoseOfTheDenseMatrix) {
  std::mt19937 random(7);
  for (const auto& [bodies, chains] : kinds)
    for (const int joints : {7, 20, 60}) {
      const Sort sort{in_plane(bodies), joints, joints == 20, joints != 7};
      const Both both(random, random_mechanism(random, sort, bodies, chains));
      // Moments on spatial bodies have no potential; random joints may move without stiffness.
      const auto dense = inertia_of(0.5 * (both.A + both.A.transpose()));
      for (const Index k : {0, 1, 3})
        if (k >= dense->zero)
          expect_solved(both, random_borders(random, both.plan.size(), k), random);
      StageSolver solver(both.plan);
      ASSERT_TRUE(solver.factorise(both.matrix));
      EXPECT_EQ(solver.inertia(), dense);
    }
}

/// Root unknowns that are not the poses: t = T y.
TEST(Stages, PosesMayDependOnOtherUnknowns) {
  std::mt19937 random(8);
  const Sort sort{false, 9, false, true};
  Both both(random, random_mechanism(random, sort, {TaskSpace::spatial, TaskSpace::planar},
                                     {{0, 1}, {1, 2}, {2, 0}}));
  // The first body moves along two directions, the second has three unknowns for its three.
  Matrix T = Matrix::Zero(9, 5);
  T.topLeftCorner(6, 2) = random_vector(random, 12, 1).reshaped(6, 2);
  T.bottomRightCorner(3, 3) = random_vector(random, 9, 1).reshaped(3, 3);
  const Matrix added = random_vector(random, 25, 1).reshaped(5, 5);
  both.plan = plan_stages(both.system, {{0, 1}, {2, 3, 4}});
  ASSERT_TRUE(equilibrium_stages(both.plan, both.system, both.piece, both.z, both.inputs, T, added,
                                 both.residual, both.matrix));
  const Index x = both.system.first_pose;
  Matrix Q = Matrix::Zero(both.system.size, x + 5);
  Q.topLeftCorner(x, x).setIdentity();
  Q.bottomRightCorner(9, 5) = T;
  Matrix A = Q.transpose() * both.A * Q;
  A.bottomRightCorner(5, 5) += added;
  EXPECT_LT((both.schur() - A).cwiseAbs().maxCoeff(), 1e-12 * A.cwiseAbs().maxCoeff());
}

TEST(Stages, MagnitudesBoundTheTermsOfTheProduct) {
  std::mt19937 random(12);
  for (const auto& [bodies, chains] : kinds) {
    const Sort sort{in_plane(bodies), 9, true, true};
    const Both both(random, random_mechanism(random, sort, bodies, chains));
    const Vector dz = random_vector(random, both.system.size, 1);
    const Vector sizes = stage_magnitudes(both.plan, both.system, both.matrix, dz);
    const Vector dense = both.A.cwiseAbs() * dz.cwiseAbs();
    EXPECT_GE((sizes - dense).minCoeff(), -1e-12 * dense.maxCoeff());
    EXPECT_LT(sizes.maxCoeff(), 4 * dense.maxCoeff());
  }
}

}  // namespace
}  // namespace springfold::statics
