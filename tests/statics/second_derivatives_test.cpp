// Second derivatives of the equilibrium against differences of the first ones.
#include "springfold/statics/second_derivatives.hpp"

#include "springfold/core/differences.hpp"
#include "staged.hpp"

namespace springfold::statics {
namespace {

Vector one_below_the_other(const Vector& a, const Vector& b) {
  Vector both(a.size() + b.size());
  both << a, b;
  return both;
}

/// w^T [dr/dz dr/drho] on the line through both.z along `b`, and its derivative by differences.
std::optional<Vector> by_differences(const Both& both, const Vector& w, const StateDirection& b) {
  return six_point_derivative(
      [&](double t) -> std::optional<Vector> {
        Workspace work;
        Vector r;
        Matrix A, dR_drho;
        Inputs inputs = both.inputs;
        inputs.rho += t * b.rho;
        if (!equilibrium_matrix(both.system, both.piece, both.z + t * b.z, inputs, work, r, A,
                                &dR_drho))
          return std::nullopt;
        return one_below_the_other(A.transpose() * w, dR_drho.transpose() * w);
      },
      0, 0x1p-7);
}

/// @returns the size of what was compared
double expect_those_of_differences(const Both& both, std::mt19937& random) {
  EXPECT_TRUE(has_second_derivatives(both.system));
  const Vector w = random_vector(random, both.system.size, 1);
  const StateDirection b{random_vector(random, both.system.size, 1),
                         random_vector(random, both.inputs.rho.size(), 1)};
  Workspace work;
  StateDirection exact;
  put_second_derivatives(both.system, both.piece, both.z, both.inputs.rho, w, b, work, exact);
  const auto expected = by_differences(both, w, b);
  if (!expected) {
    ADD_FAILURE() << "no differences";
    return 0;
  }
  EXPECT_LT((one_below_the_other(exact.z, exact.rho) - *expected).lpNorm<Eigen::Infinity>(),
            1e-10 * (1 + expected->lpNorm<Eigen::Infinity>()));
  return expected->norm();
}

const std::vector<std::pair<std::vector<TaskSpace>, std::vector<std::pair<Index, Index>>>> plane{
    {{TaskSpace::xy}, {{0, 1}, {0, 1}}},
    {{TaskSpace::planar}, {{0, 1}, {0, 1}, {0, 1}}},
    {{TaskSpace::planar, TaskSpace::planar}, {{0, 1}, {1, 2}, {0, 2}}},
    {{TaskSpace::planar, TaskSpace::xy}, {{0, 1}, {1, 2}, {2, 0}}}};

TEST(SecondDerivatives, OfChainsInThePlaneAreThoseOfDifferences) {
  std::mt19937 random(11);
  int seen = 0;  // chains of sliders alone have none
  for (const auto& [bodies, chains] : plane)
    for (const int joints : {1, 2, 5, 9})
      for (int repeat = 0; repeat < 3; ++repeat) {
        const Sort sort{true, joints, false, false};
        const Both both(random, random_mechanism(random, sort, bodies, chains));
        if (expect_those_of_differences(both, random) > 0.1) ++seen;
      }
  EXPECT_GT(seen, 40);
}

TEST(SecondDerivatives, OfSpringsThatAreNotStraightAreThoseOfDifferences) {
  std::mt19937 random(12);
  model::Mechanism m =
      random_mechanism(random, Sort{true, 4, false, false}, {TaskSpace::planar}, {{0, 1}, {0, 1}});
  int curved = 0;
  for (model::Chain& chain : m.chains)
    for (model::Element& element : chain.elements)
      if (auto* joint = std::get_if<model::Joint>(&element); joint && joint->spring) {
        joint->spring = model::PolynomialSpring{.coefficients = {0.1, 1, 0.5, 0.7}};
        ++curved;
      }
  ASSERT_GT(curved, 2);
  EXPECT_GT(expect_those_of_differences({random, m}, random), 0.1);
}

TEST(SecondDerivatives, AreNotGivenForMechanismsInSpaceOrWithLoadsAtPoints) {
  std::mt19937 random(13);
  const auto system_of = [&](const Sort& sort, TaskSpace space) {
    return prepare(random_mechanism(random, sort, {space}, {{0, 1}, {0, 1}}));
  };
  EXPECT_FALSE(has_second_derivatives(system_of({false, 3, false, false}, TaskSpace::spatial)));
  EXPECT_FALSE(has_second_derivatives(system_of({true, 3, false, true}, TaskSpace::planar)));
  EXPECT_TRUE(has_second_derivatives(system_of({true, 3, false, false}, TaskSpace::planar)));
}

}  // namespace
}  // namespace springfold::statics
