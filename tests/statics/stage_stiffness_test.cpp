// Stiffness and stability in stages against the dense matrix, on chains of any length.
#include "springfold/statics/stage_stiffness.hpp"

#include "staged.hpp"

namespace springfold::statics {
namespace {

struct InStages {
  StageJacobians stages;
  StructuredMatrix A{};
  StagedStiffness stiffness{};

  InStages(const Both& both, Index body) : stages{both.system} {
    Vector r;
    EXPECT_TRUE(stages.matrix(both.system, both.piece, both.z, both.inputs, {}, {}, r, A));
    stiffness = stiffness_in_stages(both.system, stages, A, body);
  }
};

/// Relative to the largest entry; an undefined one is empty on both sides.
void expect_near(const Matrix& ours, const Matrix& dense) {
  ASSERT_EQ(ours.size(), dense.size());
  if (dense.size() == 0) return;
  EXPECT_LT((ours - dense).cwiseAbs().maxCoeff(), 1e-8 * (1 + dense.cwiseAbs().maxCoeff()));
}

TEST(StiffnessInStages, IsThatOfTheDenseMatrixForAllKindsOfBodies) {
  std::mt19937 random(51);
  for (const auto& [bodies, chains] : kinds)
    for (const int joints : {9, 20}) {
      const Sort sort{in_plane(bodies), joints, false, true};
      Both both(random, random_mechanism(random, sort, bodies, chains));
      both.inputs.W.setZero();  // moments about fixed axes have no potential
      const auto count = static_cast<Index>(bodies.size());
      Workspace work;
      Vector r;
      Matrix A;
      ASSERT_TRUE(equilibrium_matrix(both.system, both.piece, both.z, both.inputs, work, r, A));
      const Condensed dense = condense(both.system, A, work);
      const InStages ours(both, count);
      const Matrix& K = dense.platform.K;
      // Nearly singular chains have no digits to compare.
      if (K.size() == 0 || K.cwiseAbs().maxCoeff() > 1e5) continue;
      expect_near(ours.stiffness.condensed.platform.K, K);
      expect_near(ours.stiffness.condensed.platform.eigenvalues, dense.platform.eigenvalues);
      EXPECT_EQ(ours.stiffness.condensed.stability.force_controlled,
                dense.stability.force_controlled);
      EXPECT_EQ(ours.stiffness.condensed.stability.pose_controlled,
                dense.stability.pose_controlled);
      expect_near(ours.stiffness.body, body_stiffness(both.system, A, dense.platform, count));
      ASSERT_EQ(ours.stiffness.chains.size(), chains.size());
      for (std::size_t i = 0; i < chains.size(); ++i) {
        const auto chain = chain_stiffness(both.system, i, A, work);
        // Of chains that a body carries chain_stiffness() leaves out what their own loads do to it.
        const bool from_base = chains[i].first == 0;
        SCOPED_TRACE("chain " + std::to_string(i) + " from " + std::to_string(chains[i].first) +
                     " to " + std::to_string(chains[i].second));
        if (chain && from_base) expect_near(ours.stiffness.chains[i], *chain);
      }
    }
}

/// A straight column pressed along itself is rigid that way; across it gives way like a beam.
TEST(StiffnessInStages, OfAStraightColumnIsACompliance) {
  constexpr int links = 60;
  model::Mechanism m;
  m.bodies = {{"tip", TaskSpace::xy, Vector{{1, 0}}}};
  m.chains = {{.name = "column"}};
  for (int i = 0; i < links; ++i) {
    m.chains[0].elements.push_back(model::Joint{.name = "j" + std::to_string(i),
                                                .role = JointRole::preloaded,
                                                .spring = model::LinearSpring{double(links), 0}});
    m.chains[0].elements.push_back(
        model::RigidLink{{model::Mat3<double>::Identity(), {1.0 / links, 0, 0}}});
  }
  const System system = prepare(m);
  const Both both(m, guess(system));
  const InStages ours(both, 1);
  EXPECT_EQ(ours.stiffness.body.size(), 0);
  ASSERT_EQ(ours.stiffness.compliance.rows(), 2);
  // Lever arms k / N of springs N under a unit force across the tip.
  double across = 0;
  for (int k = 1; k <= links; ++k) across += std::pow(double(k) / links, 2) / links;
  EXPECT_NEAR(ours.stiffness.compliance(1, 1), across, 1e-12);
  EXPECT_NEAR(ours.stiffness.compliance(0, 0), 0, 1e-12);
  EXPECT_EQ(ours.stiffness.condensed.stability.force_controlled, 0);
}

}  // namespace
}  // namespace springfold::statics
