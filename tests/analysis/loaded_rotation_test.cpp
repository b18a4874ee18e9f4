// Loads, weights and line springs on spatial bodies whose free rotations are quaternions.
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/column.hpp"
#include "analysis/path_problem.hpp"
#include "analysis/quaternion.hpp"
#include "model/random_chain.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/model/elastic_link.hpp"

namespace springfold::analysis {
namespace {

using model::LoadKind;
using model::random_pose;
using model::random_unit;
using model::random_vector;

void add_random_link(std::mt19937& random, model::Chain& chain) {
  using enum model::ElasticDirection;
  Matrix B(6, 6);
  for (Index i = 0; i < 6; ++i) B.col(i) = random_vector(random, 6, 1);
  const Matrix K = B * B.transpose() + Matrix::Identity(6, 6);
  add_elastic_link(chain, "e", 0.5, {Tx, Ty, Tz, Rx, Ry, Rz}, 0.5 * (K + K.transpose()),
                   Vector::Zero(6), Vector::Zero(6));
}

/// Two spatial bodies, base - first - second - base; points in front of, between and without joints.
model::Mechanism two_loaded_bodies(std::mt19937& random) {
  model::Mechanism m;
  for (const char* name : {"first", "second"})
    m.bodies.push_back({.name = name,
                        .task_space = model::TaskSpace::spatial,
                        .pose = Vector::Zero(6),
                        .mass = 0.7,
                        .centre = random_vector(random, 3, 1)});
  for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
    model::Chain chain{.name = "c" + std::to_string(to), .from = from, .to = to};
    chain.from_attachment = random_pose(random, false);
    chain.to_attachment = random_pose(random, false);
    if (from != 2)
      add_random_link(random, chain);
    else
      chain.elements = {model::RigidLink{random_pose(random, false)}};
    chain.points = {{.name = "front", .elements_before = 0, .at = random_vector(random, 3, 1)},
                    {.name = "end",
                     .elements_before = chain.elements.size(),
                     .at = random_vector(random, 3, 1),
                     .mass = 0.4}};
    m.chains.push_back(chain);
  }
  m.gravity = random_vector(random, 3, 1);
  return m;
}

/// Every kind of load at every kind of point, constant and growing, and line springs.
void load_everywhere(std::mt19937& random, model::Mechanism& m) {
  std::vector<model::Anchor> anchors = {{.body = 1}, {.body = 2}};
  for (Index chain = 0; chain < 3; ++chain)
    for (const std::size_t point : {0u, 1u}) anchors.push_back({.chain = chain, .point = point});
  for (model::Anchor& anchor : anchors) anchor.at = random_vector(random, 3, 1);
  bool grows = false;
  for (const model::Anchor& on : anchors)
    for (const LoadKind kind : {LoadKind::force, LoadKind::moment})
      for (const bool follows : {false, true})
        m.loads.push_back({.on = on,
                           .kind = kind,
                           .follows = follows,
                           .with_lambda = grows = !grows,
                           .vector = random_vector(random, 3, 1)});
  std::swap(m.loads[0].with_lambda, m.loads[1].with_lambda);
  for (std::size_t i = 0; i + 1 < anchors.size(); ++i)
    m.line_springs.push_back(
        {.from = anchors[i], .to = anchors[i + 1], .stiffness = 1.3, .free = i % 2 == 0 ? 0 : 0.4});
}

PathRule rule_for(const statics::System& system, Index body) {
  PathRule rule{.body = body, .t_start = Vector::Zero(6), .t_rate = Vector::Zero(6)};
  rule.N = Matrix::Identity(6, 6);
  rule.rho_start = rule.rho_rate = Vector::Zero(system.commands.size());
  rule.W_start = rule.W_rate = Vector::Zero(system.load_size);
  const auto& loads = system.mechanism.loads;
  rule.load_start = rule.load_rate = Vector::Zero(static_cast<Index>(loads.size()));
  for (std::size_t i = 0; i < loads.size(); ++i)
    (loads[i].with_lambda ? rule.load_rate : rule.load_start)[static_cast<Index>(i)] = 1;
  rule.symmetric = false;
  return rule;
}

TEST(LoadedRotations, HaveExactDerivativesForBodiesTurnedByTwoRadians) {
  std::mt19937 random(71);
  for (int trial = 0; trial < 6; ++trial) {
    model::Mechanism mechanism = two_loaded_bodies(random);
    load_everywhere(random, mechanism);
    const statics::System system = statics::prepare(mechanism);
    const PathProblem problem(system, rule_for(system, 1 + trial % 2));
    ASSERT_EQ(problem.double_covers().size(), 2u);
    Vector y = random_vector(random, problem.size(), 0.6);
    for (const Index q : problem.double_covers())
      y.segment<4>(q) = (0.8 + 0.1 * trial) * quaternion_of(2 * random_unit(random));
    Matrix A;
    Vector b, F;
    ASSERT_TRUE(problem.derivatives(y, 0.4, {}, A, b));
    for (Index j = 0; j <= problem.size(); ++j) {
      const auto along = [&](double value) -> std::optional<Vector> {
        Vector moved = y;
        if (j < problem.size()) moved[j] = value;
        problem.residual(moved, j < problem.size() ? 0.4 : value, {}, F);
        return F;
      };
      const auto column = six_point_derivative(along, j < problem.size() ? y[j] : 0.4, 0x1p-9);
      const Vector exact = j < problem.size() ? Vector(A.col(j)) : b;
      EXPECT_LT((*column - exact).norm(), 1e-9 * A.norm()) << "column " << j;
    }
  }
}

TEST(LoadedRotations, GiveTheResidualOfTheRotationVector) {
  std::mt19937 random(72);
  model::Mechanism mechanism = two_loaded_bodies(random);
  load_everywhere(random, mechanism);
  const statics::System system = statics::prepare(mechanism);
  const PathProblem problem(system, rule_for(system, 1));
  Vector z = random_vector(random, system.size, 1.0);
  for (const auto& rotation : problem.free_rotations())
    z.segment<3>(rotation.z) = 2 * random_unit(random);
  const Vector y = problem.reduce(z);
  statics::Workspace work;
  Vector r, F;
  equilibrium_residual(system, {}, z, problem.inputs(0.7), work, r);
  problem.residual(y, 0.7, {}, F);
  EXPECT_LT((F.head(system.first_pose) - r.head(system.first_pose)).norm(), 1e-12);
  for (const auto& rotation : problem.free_rotations()) {
    const model::Vec3<double> rate = random_vector(random, 3, 1);
    const model::Vec3<double> omega =
        model::left_jacobian<double>(model::Vec3<double>(z.segment<3>(rotation.z))) * rate;
    const Quaternion dq = 0.25 * rate_of(y.segment<4>(rotation.y)).transpose() * omega;
    EXPECT_NEAR(F.segment<4>(rotation.y).dot(dq), r.segment<3>(rotation.z).dot(rate), 1e-12);
  }
}

// An arm of length l on a hinge about a slanted axis with a spring c; at the distance d beyond its
// end a follower force lambda across it and a dead force P along y of the hinge:
//
//     c t = (l + d) (lambda + P cos t),   dM/dt = c + P (l + d) sin t.
//
// The body's own frame stands turned by 2 rad or not at all.
class SlantedArm : public testing::TestWithParam<double> {
 protected:
  static constexpr double c = 2, l = 0.8, d = 0.3, P = 0.5;
  const Rotation slant = model::rotation_about<double>(model::Vec3<double>(2, -1, 2) / 3, 1.1);
  const Rotation own = model::rotation_about<double>(model::Vec3<double>(1, 2, -2) / 3, GetParam());
  const double t0 = [] {
    double t = 0;
    for (int i = 0; i < 50; ++i)
      t -= (c * t - (l + d) * P * std::cos(t)) / (c + (l + d) * P * std::sin(t));
    return t;
  }();

  StudyResult traced() const {
    model::Mechanism m;
    model::Chain chain{.name = "arm"};
    chain.from_attachment.R = slant;
    chain.elements = {model::Joint{.name = "h",
                                   .role = model::JointRole::preloaded,
                                   .spring = model::LinearSpring{c, 0},
                                   .initial = t0},
                      model::RigidLink{{Rotation::Identity(), {l, 0, 0}}}};
    chain.to_attachment.R = own.transpose();
    const Rotation turned = slant * model::rotation_about<double>({0, 0, 1}, t0);
    Vector pose(6);
    pose << turned * model::Vec3<double>(l, 0, 0),
        model::log_rotation<double>(Rotation(turned * own));
    m.bodies = {{.name = "tip", .task_space = model::TaskSpace::spatial, .pose = pose}};
    m.chains = {chain};
    const model::Anchor on{.body = 1, .at = own.transpose() * model::Vec3<double>(d, 0, 0)};
    m.loads = {{.name = "follower",
                .on = on,
                .follows = true,
                .with_lambda = true,
                .vector = own.transpose() * model::Vec3<double>(0, 1, 0)},
               {.name = "dead", .on = on, .vector = slant * model::Vec3<double>(0, P, 0)}};
    Study study{.name = "wind", .control = ControlMode::load};
    study.until = {{"lambda", 0, 13}};
    study.trace.maximum_step = 0.2;
    return run_study(m, study);
  }
};

TEST_P(SlantedArm, IsWoundUpAsTheClosedFormSays) {
  const StudyResult result = traced();
  ASSERT_TRUE(complete(result)) << result.branches.front().forward.reason;
  EXPECT_THAT(result.non_conservative, testing::ElementsAre("follower force follower"));
  const std::size_t rows = result.branches.front().samples.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const double t = value(result, row, "arm.h"), lambda = value(result, row, "lambda");
    EXPECT_NEAR(c * t, (l + d) * (lambda + P * std::cos(t)), 1e-10);
    EXPECT_NEAR(value(result, row, "T_det"), c + P * (l + d) * std::sin(t), 1e-10);
    const Rotation R = slant * model::rotation_about<double>({0, 0, 1}, t);
    const model::Vec3<double> tip(value(result, row, "tip.x"), value(result, row, "tip.y"),
                                  value(result, row, "tip.z"));
    const model::Vec3<double> phi(value(result, row, "tip.rx"), value(result, row, "tip.ry"),
                                  value(result, row, "tip.rz"));
    EXPECT_LT((tip - l * R.col(0)).norm(), 1e-10);
    EXPECT_LT((model::exp_rotation<double>(phi) - R * own).norm(), 1e-9);
  }
  EXPECT_NEAR(value(result, rows - 1, "lambda"), 13, 1e-12);
  EXPECT_GT(value(result, rows - 1, "arm.h"), 6.5);
}

INSTANTIATE_TEST_SUITE_P(OwnFrame, SlantedArm, testing::Values(0.0, 2.0));

}  // namespace
}  // namespace springfold::analysis
