// Sections, the compliance of a cantilever, coupled springs and their rules.
#include "springfold/model/elastic_link.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "springfold/model/closure.hpp"

namespace springfold::model {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using enum ElasticDirection;

using std::numbers::pi;

TEST(Sections, OfACircleHaveTheClosedForms) {
  const BeamSection s = round_section(0.02);
  EXPECT_NEAR(s.A, pi * 1e-4, 1e-18);
  EXPECT_NEAR(s.Iy, pi / 4 * 1e-8, 1e-22);
  EXPECT_EQ(s.Iz, s.Iy);
  EXPECT_NEAR(s.J, pi / 2 * 1e-8, 1e-22);
}

TEST(Sections, OfATubeAreThoseOfTheCircleLessTheBore) {
  const BeamSection tube = round_section(3, 2), out = round_section(3), in = round_section(2);
  EXPECT_NEAR(tube.A, out.A - in.A, 1e-15);
  EXPECT_NEAR(tube.Iy, out.Iy - in.Iy, 1e-14);
  EXPECT_NEAR(tube.J, out.J - in.J, 1e-14);
}

TEST(Sections, OfARectangleBendAboutTheirOwnAxes) {
  const BeamSection s = rectangular_section(2, 3);  // 2 along y, 3 along z
  EXPECT_DOUBLE_EQ(s.A, 6);
  EXPECT_DOUBLE_EQ(s.Iy, 2 * 27 / 12.0);
  EXPECT_DOUBLE_EQ(s.Iz, 3 * 8 / 12.0);
}

// Timoshenko and Goodier, art. 109: J = k a b^3 with k = 0.1406, 0.196, 0.229, 0.263, 0.281, 0.312
// for a/b = 1, 1.5, 2, 3, 4, 10, and 1/3 for a thin strip.
TEST(Sections, OfARectangleTwistAsStVenantFound) {
  for (const auto& [ratio, k] : {std::pair{1.0, 0.1406},
                                 {1.5, 0.196},
                                 {2.0, 0.229},
                                 {3.0, 0.263},
                                 {4.0, 0.281},
                                 {10.0, 0.312}})
    EXPECT_NEAR(rectangular_section(1, ratio).J / ratio, k, 6e-4) << "a/b = " << ratio;
  EXPECT_NEAR(rectangular_section(1, 1).J, 0.1405770149, 1e-10);
  EXPECT_DOUBLE_EQ(rectangular_section(1, 3).J, rectangular_section(3, 1).J);
  // b/a -> 0: (1 - 0.630249 b/a)/3.
  EXPECT_NEAR(rectangular_section(1, 1000).J / 1000, (1 - 0.630249e-3) / 3, 1e-9);
}

TEST(Cantilever, HasTheStiffnessOfTextbooks) {
  const BeamSection s{.A = 2, .Iy = 3, .Iz = 5, .J = 7};
  const double L = 0.5, E = 11, G = 4;
  const Matrix K = inverse_of(cantilever_compliance(L, E, G, s));
  EXPECT_NEAR(K(0, 0), E * s.A / L, 1e-12 * K.norm());
  EXPECT_NEAR(K(1, 1), 12 * E * s.Iz / (L * L * L), 1e-12 * K.norm());
  EXPECT_NEAR(K(1, 5), -6 * E * s.Iz / (L * L), 1e-12 * K.norm());
  EXPECT_NEAR(K(5, 5), 4 * E * s.Iz / L, 1e-12 * K.norm());
  EXPECT_NEAR(K(2, 4), 6 * E * s.Iy / (L * L), 1e-12 * K.norm());
  EXPECT_NEAR(K(3, 3), G * s.J / L, 1e-12 * K.norm());
  EXPECT_EQ(K, K.transpose());
}

TEST(Cantilever, GivesWayMoreIfItShears) {
  BeamSection s{.A = 2, .Iy = 3, .Iz = 5, .J = 7};
  const Matrix stiff = cantilever_compliance(0.5, 11, 4, s);
  s.Ay = 1.5;
  s.Az = 1.2;
  Matrix difference = cantilever_compliance(0.5, 11, 4, s) - stiff;
  EXPECT_NEAR(difference(1, 1), 0.5 / (4 * 1.5), 1e-15);
  EXPECT_NEAR(difference(2, 2), 0.5 / (4 * 1.2), 1e-15);
  difference(1, 1) = difference(2, 2) = 0;
  EXPECT_TRUE(difference.isZero(0));
}

// Two cantilevers in line are a cantilever of the whole length.
TEST(Cantilever, IsAsLongAsItsPartsInLine) {
  const BeamSection s{.A = 2, .Iy = 3, .Iz = 5, .J = 7};
  const Matrix part = cantilever_compliance(0.3, 11, 4, s);
  Matrix carried = Matrix::Identity(6, 6);  // of a twist at the first end to one at the second
  carried(1, 5) = 0.2;
  carried(2, 4) = -0.2;
  const Matrix sum = carried * part * carried.transpose() + cantilever_compliance(0.2, 11, 4, s);
  EXPECT_LT((sum - cantilever_compliance(0.5, 11, 4, s)).norm(), 1e-15);
}

TEST(ElasticLinks, PutTheirJointsBehindTheLinkInTheStatedOrder) {
  Chain chain;
  add_elastic_link(chain, "foot", 0.4, {Tx, Tz, Ry}, Matrix::Identity(3, 3),
                   Vector{{0.1, 0.2, 0.3}}, Vector::Zero(3));
  ASSERT_EQ(chain.elements.size(), 4u);
  EXPECT_EQ(std::get<RigidLink>(chain.elements[0]).transform.p[0], 0.4);
  const auto& third = std::get<Joint>(chain.elements[3]);
  EXPECT_EQ(third.name, "foot.Ry");
  EXPECT_EQ(third.kind, JointKind::revolute);
  EXPECT_EQ(third.axis, Vec3<double>::UnitY());
  EXPECT_EQ(third.initial, 0.3);
  EXPECT_EQ(std::get<Joint>(chain.elements[2]).name, "foot.Tz");
  EXPECT_THAT(chain.coupled_springs[0].elements, testing::ElementsAre(1, 2, 3));
}

TEST(ElasticLinks, MoveAsTheStatedProductOfMotions) {
  Mechanism m;
  m.bodies = {{"tip", TaskSpace::spatial, Vector::Zero(6)}};
  m.chains = {{.name = "c"}};
  add_elastic_link(m.chains[0], "e", 0.4, {Tx, Ty, Tz, Rx, Ry, Rz}, Matrix::Identity(6, 6),
                   Vector::Zero(6), Vector::Zero(6));
  ASSERT_THAT(problems_in(m), IsEmpty());
  const Vector q{{0.1, -0.2, 0.3, 0.5, -0.7, 1.1}};
  Vector v = Vector::Zero(12);
  v.head(6) = q;
  Closure<double> at;
  evaluate_closure<double>(compile(m, m.chains[0]), v, nullptr, at);
  const Mat3<double> R = rotation_about<double>(Vec3<double>::UnitX(), q[3]) *
                         rotation_about<double>(Vec3<double>::UnitY(), q[4]) *
                         rotation_about<double>(Vec3<double>::UnitZ(), q[5]);
  EXPECT_LT((at.e.head(3) - Vec3<double>(0.5, -0.2, 0.3)).norm(), 1e-15);
  EXPECT_LT((at.e.tail(3) - log_rotation<double>(R)).norm(), 1e-15);
}

Matrix matrix_2x2(double a, double b, double c, double d) {
  Matrix m(2, 2);
  m << a, b, c, d;
  return m;
}

TEST(StiffnessMatrices, AreRefusedWithTheEntryThatIsNotSymmetric) {
  EXPECT_EQ(problem_in(matrix_2x2(2, 0.5, 0.25, 1), Definiteness::semidefinite),
            "entry [1][2] is 0.5 and entry [2][1] is 0.25, need a symmetric matrix");
}

TEST(StiffnessMatrices, AreRefusedWithTheirNegativeEigenvalue) {
  // Scaled to a unit diagonal the off-diagonal entry is 1.5: eigenvalues -0.5 and 2.5.
  EXPECT_EQ(problem_in(matrix_2x2(4, 3, 3, 1), Definiteness::semidefinite),
            "its smallest eigenvalue is -0.5 (with the diagonal scaled to 1), need no negative "
            "eigenvalue");
  EXPECT_THAT(problem_in(matrix_2x2(-1, 0, 0, 1), Definiteness::semidefinite),
              HasSubstr("entry [1][1] is -1"));
  EXPECT_THAT(problem_in(matrix_2x2(0, 1, 1, 1), Definiteness::semidefinite),
              HasSubstr("negative eigenvalue"));
}

TEST(StiffnessMatrices, MayHaveDirectionsWithoutStiffness) {
  EXPECT_THAT(problem_in(matrix_2x2(1, 1, 1, 1), Definiteness::semidefinite), IsEmpty());
  EXPECT_THAT(problem_in(matrix_2x2(0, 0, 0, 1), Definiteness::semidefinite), IsEmpty());
}

TEST(ComplianceMatrices, MustGiveWayInAllTheirDirections) {
  EXPECT_THAT(problem_in(matrix_2x2(1, 1, 1, 1), Definiteness::definite),
              HasSubstr("need a positive one"));
  EXPECT_THAT(problem_in(matrix_2x2(0, 0, 0, 1), Definiteness::definite),
              HasSubstr("rigid, leave it out"));
}

TEST(CoupledSprings, DoNotDependOnUnitsToBeUsable) {
  const Vector units{{1e-6, 1e3, 1e6}};
  Matrix K(3, 3);
  K << 2, 1, 0.5, 1, 3, -1, 0.5, -1, 2;
  EXPECT_THAT(problem_in(units.asDiagonal() * K * units.asDiagonal(), Definiteness::definite),
              IsEmpty());
}

TEST(CoupledSprings, ActOnVirtualJointsWithoutASpringOnly) {
  Mechanism m;
  m.bodies = {{"tip", TaskSpace::xyz, Vector::Zero(3)}};
  m.chains = {{.name = "c"}};
  add_elastic_link(m.chains[0], "e", 1, {Tx, Ty}, Matrix::Identity(2, 2), Vector::Zero(2),
                   Vector::Zero(2));
  EXPECT_THAT(problems_in(m), IsEmpty());
  std::get<Joint>(m.chains[0].elements[1]).spring = LinearSpring{1, 0};
  EXPECT_THAT(problems_in(m), testing::ElementsAre(HasSubstr("chain[1].elements[2]: stiffness:")));
  std::get<Joint>(m.chains[0].elements[1]).spring.reset();
  m.chains[0].coupled_springs[0].stiffness(0, 1) = 3;
  EXPECT_THAT(problems_in(m), testing::ElementsAre(HasSubstr("need a symmetric matrix")));
}

}  // namespace
}  // namespace springfold::model
