// Spatial bodies that turn as far as they like: quaternions behind rotation vectors.
#include <gmock/gmock.h>

#include <numbers>

#include "analysis/column.hpp"
#include "analysis/path_problem.hpp"
#include "analysis/quaternion.hpp"
#include "model/random_chain.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/model/elastic_link.hpp"
#include "statics/allocations.hpp"

namespace springfold::analysis {
namespace {

using model::random_pose;
using model::random_unit;
using model::random_vector;

using std::numbers::pi;

Quaternion random_quaternion(std::mt19937& random) {
  Quaternion q = random_vector(random, 4, 1.0);
  return q * (0.7 + 0.3 * std::abs(random_vector(random, 1, 1.0)[0])) / q.norm();
}

TEST(Quaternions, AreTheRotationsOfTheirRotationVectors) {
  std::mt19937 random(61);
  for (int trial = 0; trial < 200; ++trial) {
    const RotationVector phi = 2 * pi * (trial / 200.0) * random_unit(random);
    const Quaternion q = quaternion_of(phi);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT((rotation_of(q) - model::exp_rotation<double>(phi)).norm(), 1e-14);
    EXPECT_LT((rotation_vector_of(q) - phi).norm(), 1e-13);
    EXPECT_LT((rotation_of(-3 * q) - rotation_of(q)).norm(), 1e-14);
  }
}

TEST(Quaternions, TurnAtTheirRateAndCurvature) {
  std::mt19937 random(62);
  for (int trial = 0; trial < 200; ++trial) {
    const Quaternion q = random_quaternion(random), d = random_vector(random, 4, 1.0);
    const model::Vec3<double> r = random_vector(random, 3, 1.0);
    const auto turned = [&](double h) -> std::optional<Vector> {
      return Vector(model::log_rotation<double>(
          Rotation(rotation_of(q + h * d) * rotation_of(q).transpose())));
    };
    const auto rate = [&](double h) { return six_point_derivative(turned, h, 0x1p-9); };
    EXPECT_LT((*rate(0) - rate_of(q) * d).norm(), 1e-10);
    const auto second = six_point_derivative(rate, 0.0, 0x1p-6);
    EXPECT_NEAR(r.dot(*second), d.dot(curvature_of(q, r) * d), 1e-6);
    EXPECT_EQ(curvature_of(q, r), curvature_of(q, r).transpose());
    EXPECT_LT((rate_of(q) * q).norm(), 1e-15);
  }
}

TEST(Turns, GoOnBeyondAWholeTurnAboutAFixedAxis) {
  const RotationVector axis = RotationVector(1, -2, 2) / 3;
  RotationVector phi = RotationVector::Zero();
  for (double angle = 0.3; angle < 30; angle += 0.3) {
    phi = nearest_turn(rotation_vector_of(quaternion_of(angle * axis)), phi);
    EXPECT_LT((phi - angle * axis).norm(), 1e-11);
  }
}

/// Two spatial bodies, base - first - second - base, with random elastic links.
model::Mechanism two_bodies(std::mt19937& random) {
  using enum model::ElasticDirection;
  model::Mechanism m;
  for (const char* name : {"first", "second"})
    m.bodies.push_back({name, model::TaskSpace::spatial, Vector::Zero(6)});
  for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
    model::Chain chain{.name = "c" + std::to_string(to), .from = from, .to = to};
    chain.from_attachment = random_pose(random, false);
    chain.to_attachment = random_pose(random, false);
    if (from != 2) {
      Matrix B(6, 6);
      for (Index i = 0; i < 6; ++i) B.col(i) = random_vector(random, 6, 1);
      const Matrix K = B * B.transpose() + Matrix::Identity(6, 6);
      add_elastic_link(chain, "e", 0.5, {Tx, Ty, Tz, Rx, Ry, Rz}, 0.5 * (K + K.transpose()),
                       Vector::Zero(6), Vector::Zero(6));
    } else {  // begins at a body, and has no joint in front of its link
      chain.elements = {model::RigidLink{random_pose(random, false)}};
    }
    m.chains.push_back(chain);
  }
  return m;
}

PathRule load_rule(const statics::System& system, Index body) {
  PathRule rule{.body = body, .t_start = Vector::Zero(6), .t_rate = Vector::Zero(6)};
  rule.N = Matrix::Identity(6, 6);
  rule.rho_start = rule.rho_rate = Vector::Zero(system.commands.size());
  rule.W_start = rule.W_rate = Vector::Zero(system.load_size);
  rule.W_rate[1] = 1;
  rule.W_start[8] = 0.3;
  return rule;
}

TEST(FreeRotations, HaveExactSymmetricDerivativesAtAnyRotation) {
  std::mt19937 random(63);
  for (int trial = 0; trial < 10; ++trial) {
    const statics::System system = statics::prepare(two_bodies(random));
    for (const Index body : {1, 2}) {
      const PathProblem problem(system, load_rule(system, body));
      ASSERT_EQ(problem.size(), system.size + 2);
      Vector y = random_vector(random, problem.size(), 0.6);
      for (const Index q : problem.double_covers()) y.segment<4>(q) = random_quaternion(random);
      Matrix A;
      Vector b, F;
      ASSERT_TRUE(problem.derivatives(y, 0.4, {}, A, b));
      EXPECT_LT((A - A.transpose()).norm(), 1e-12 * A.norm());
      for (Index j = 0; j <= problem.size(); ++j) {
        const auto along = [&](double value) -> std::optional<Vector> {
          Vector moved = y;
          if (j < problem.size()) moved[j] = value;
          problem.residual(moved, j < problem.size() ? 0.4 : value, {}, F);
          return F;
        };
        const double at = j < problem.size() ? y[j] : 0.4;
        const auto column = six_point_derivative(along, at, 0x1p-9);
        const Vector exact = j < problem.size() ? Vector(A.col(j)) : b;
        EXPECT_LT((*column - exact).norm(), 1e-9 * A.norm()) << "column " << j;
      }
    }
  }
}

TEST(FreeRotations, GiveTheSameNumbersWithDerivativesAndWithout) {
  std::mt19937 random(66);
  const statics::System system = statics::prepare(two_bodies(random));
  const PathProblem problem(system, load_rule(system, 2));
  Vector y = random_vector(random, problem.size(), 0.6), F, F_alone, b;
  for (const Index q : problem.double_covers()) y.segment<4>(q) = random_quaternion(random);
  Matrix A;
  ASSERT_TRUE(problem.equations(y, 0.4, {}, F, A, b) && problem.residual(y, 0.4, {}, F_alone));
  EXPECT_EQ(F, F_alone);
}

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
TEST(FreeRotations, AreEvaluatedWithoutMemoryFromTheHeap) {
  std::mt19937 random(65);
  const statics::System system = statics::prepare(two_bodies(random));
  const PathProblem problem(system, load_rule(system, 1));
  Vector y = random_vector(random, problem.size(), 0.6), F, b;
  for (const Index q : problem.double_covers()) y.segment<4>(q) = random_quaternion(random);
  Matrix A;
  ASSERT_TRUE(problem.residual(y, 0.4, {}, F) && problem.derivatives(y, 0.4, {}, A, b));
  const long before = allocations;
  const bool inside = problem.residual(y, 0.5, {}, F) && problem.derivatives(y, 0.5, {}, A, b);
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(inside);
}
#endif

TEST(FreeRotations, GiveTheResidualOfTheRotationVector) {
  std::mt19937 random(64);
  const statics::System system = statics::prepare(two_bodies(random));
  const PathProblem problem(system, load_rule(system, 1));
  const Vector z = random_vector(random, system.size, 1.0);
  const Vector y = problem.reduce(z);
  EXPECT_LT((problem.expand(y, 0) - z).norm(), 1e-14);
  statics::Workspace work;
  Vector r, F;
  equilibrium_residual(system, {}, z, problem.inputs(0.7), work, r);
  problem.residual(y, 0.7, {}, F);
  EXPECT_LT((F.head(system.first_pose) - r.head(system.first_pose)).norm(), 1e-13);
  // Work on the same motion: dq and the rotation vector's rate belong to one angular velocity.
  for (const auto& rotation : problem.free_rotations()) {
    const model::Vec3<double> rate = random_vector(random, 3, 1);
    const model::Vec3<double> omega =
        model::left_jacobian<double>(model::Vec3<double>(z.segment<3>(rotation.z))) * rate;
    const Quaternion q = y.segment<4>(rotation.y);
    const Quaternion dq = 0.25 * rate_of(q).transpose() * omega;
    EXPECT_NEAR(F.segment<4>(rotation.y).dot(dq), r.segment<3>(rotation.z).dot(rate), 1e-13);
  }
}

/// A drive turns an arm about a slanted axis; at its end an elastic link carries a body under a
/// constant force.
struct Carousel {
  model::Mechanism mechanism{};
  Study study{};
};

Carousel carousel(const Vector& load, double turns) {
  using enum model::ElasticDirection;
  Carousel c;
  const Rotation slant = model::rotation_about<double>({1, 0, 0}, 0.4);
  model::Chain chain{.name = "arm"};
  chain.from_attachment.R = slant;
  chain.elements = {model::Joint{.name = "drive", .role = model::JointRole::actuated},
                    model::RigidLink{{Rotation::Identity(), {0.5, 0, 0.2}}}};
  add_elastic_link(chain, "link", 0.4, {Tx, Ty, Tz, Rx, Ry, Rz},
                   model::inverse_of(model::cantilever_compliance(
                       0.4, 1, 1, {.A = 50, .Iy = 1, .Iz = 2, .J = 1.5})),
                   Vector::Zero(6), Vector::Zero(6));
  const model::Vec3<double> p = slant * model::Vec3<double>(0.9, 0, 0.2);
  Vector pose(6);
  pose << p, model::log_rotation<double>(slant);
  c.mechanism.bodies = {{"tool", model::TaskSpace::spatial, pose}};
  c.mechanism.chains = {chain};
  c.study = {.name = "turn", .control = ControlMode::actuator};
  c.study.direction = Vector::Unit(6, 0);
  c.study.constant_load = load;
  c.study.actuators = {{"arm.drive", 1}};
  c.study.until = {{"lambda", 0, 2 * pi * turns}};
  c.study.trace.maximum_step = 0.2;
  return c;
}

TEST(FreeRotations, GoRoundAndRoundWithoutSpecialPoints) {
  for (const double force : {0.0, 0.3}) {
    Carousel c = carousel(Vector{{0, -force, 0.5 * force, 0, 0, 0}}, 3);
    c.study.marks = {{"lambda", 1}, {"lambda", 1 + 2 * pi}, {"lambda", 1 + 4 * pi}};
    ASSERT_TRUE(problems_in(c.study, c.mechanism).empty());
    const StudyResult result = run_study(c.mechanism, c.study);
    ASSERT_TRUE(complete(result)) << result.branches.front().forward.reason;
    const Branch& branch = result.branches.front();
    std::vector<std::size_t> marked;
    for (const Event& event : branch.events) {
      EXPECT_TRUE(event.kind == EventKind::user_value || event.kind == EventKind::end_of_range);
      if (event.kind == EventKind::user_value) marked.push_back(event.row);
    }
    ASSERT_EQ(marked.size(), 3u);
    for (const char* name : {"tool.x", "tool.y", "tool.z", "stiffness", "arm.link.Rz"})
      for (const std::size_t k : {1u, 2u})
        EXPECT_NEAR(value(result, marked[k], name), value(result, marked[0], name), 1e-10) << name;
    for (std::size_t i = 0; i < branch.samples.size(); ++i) EXPECT_EQ(value(result, i, "index"), 0);
  }
}

/// Unloaded and about the axis x of a body that begins unturned: the rotation vector is lambda x.
Carousel spindle() {
  Carousel c = carousel(Vector::Zero(6), 3);
  model::Chain& chain = c.mechanism.chains[0];
  chain.from_attachment.R = Rotation::Identity();
  std::get<model::Joint>(chain.elements[0]).axis = {1, 0, 0};
  c.mechanism.bodies[0].pose << 0.9, 0, 0.2, 0, 0, 0;
  return c;
}

TEST(FreeRotations, AreReportedWithoutAJumpBeyondAWholeTurn) {
  const Carousel c = spindle();
  const StudyResult result = run_study(c.mechanism, c.study);
  ASSERT_TRUE(complete(result));
  const std::size_t rows = result.branches.front().samples.size();
  for (std::size_t i = 0; i < rows; ++i) {
    EXPECT_NEAR(value(result, i, "tool.rx"), value(result, i, "lambda"), 1e-9);
    EXPECT_NEAR(value(result, i, "tool.ry"), 0, 1e-9);
  }
  EXPECT_NEAR(value(result, rows - 1, "tool.rx"), 6 * pi, 1e-9);
}

// A force tilts the body: its axis wobbles, and near whole turns its rotation vector has any axis.
TEST(FreeRotations, GoOnCountingWhereTheAxisWobbles) {
  Carousel c = carousel(Vector{{0, -0.3, 0.2, 0, 0, 0}}, 3);
  c.mechanism.chains[0].from_attachment.R = Rotation::Identity();
  c.mechanism.bodies[0].pose << 0.9, 0, 0.2, 0, 0, 0;
  const StudyResult result = run_study(c.mechanism, c.study);
  ASSERT_TRUE(complete(result));
  const std::size_t rows = result.branches.front().samples.size();
  for (std::size_t i = 0; i < rows; ++i) {
    const double lambda = value(result, i, "lambda");
    if (std::abs(std::remainder(lambda, 2 * pi)) < 0.5) continue;
    EXPECT_NEAR(value(result, i, "tool.rz"), lambda, 0.15);
  }
}

TEST(FreeRotations, EndTheBranchInWordsWhereALimitOnThemLosesItsMeaning) {
  Carousel c = spindle();
  c.study.until.push_back({"tool.rx", -100, 100});
  const StudyResult result = run_study(c.mechanism, c.study);
  EXPECT_FALSE(complete(result));
  EXPECT_THAT(result.branches.front().forward.reason,
              testing::HasSubstr("not followed further: body tool comes near a whole turn"));
}

// Rigid links l = 1/4 on springs 1/l, the first one twice as stiff, rolled up by an end moment M:
// x = l sin(N d) / (2 sin(d/2)), y = l (1 - cos(N d)) / (2 sin(d/2)), d = M l.
TEST(FreeRotations, RollUpACantileverSeveralTimes) {
  using enum model::ElasticDirection;
  const int N = 4;
  const double l = 1.0 / N;
  Carousel c;
  model::Chain chain{.name = "beam"};
  for (int i = 0; i < N; ++i) {
    const Matrix K = Vector{{90, 90, 90, 5, 5, (i == 0 ? 2 : 1) / l}}.asDiagonal();
    add_elastic_link(chain, "e" + std::to_string(i), 0, {Tx, Ty, Tz, Rx, Ry, Rz}, K,
                     Vector::Zero(6), Vector::Zero(6));
    chain.elements.push_back(model::RigidLink{{Rotation::Identity(), {l, 0, 0}}});
  }
  c.mechanism.bodies = {{"tip", model::TaskSpace::spatial, Vector{{1, 0, 0, 0, 0, 0}}}};
  c.mechanism.chains = {chain};
  c.study = {.name = "roll", .control = ControlMode::load};
  c.study.direction = Vector::Unit(6, 5);
  c.study.until = {{"lambda", 0, 5 * pi}};
  c.study.trace.maximum_step = 0.2;
  const StudyResult result = run_study(c.mechanism, c.study);
  ASSERT_TRUE(complete(result)) << result.branches.front().forward.reason;
  const std::size_t rows = result.branches.front().samples.size();
  for (std::size_t i = 1; i < rows; ++i) {
    const double d = value(result, i, "lambda") * l;
    EXPECT_NEAR(value(result, i, "tip.x"), l * std::sin(N * d) / (2 * std::sin(d / 2)), 1e-11);
    EXPECT_NEAR(value(result, i, "tip.y"), l * (1 - std::cos(N * d)) / (2 * std::sin(d / 2)),
                1e-11);
    EXPECT_NEAR(value(result, i, "tip.rz"), (N - 0.5) * d, 1e-9);
  }
  EXPECT_GT(value(result, rows - 1, "tip.rz"), 4 * pi);
}

// A rotation vector of a whole turn seems balanced under any moment: such states are none.
TEST(FreeRotations, OfAWholeTurnAreNoEquilibria) {
  Carousel c = carousel(Vector{{0, -0.3, 0.2, 0, 0, 0}}, 1);
  c.study = {.name = "all", .kind = StudyKind::equilibria};
  c.study.constant_load = Vector{{0, -0.3, 0.2, 0, 0, 0}};
  c.study.search.starts = 60;
  ASSERT_TRUE(problems_in(c.study, c.mechanism).empty());
  const StudyResult result = run_study(c.mechanism, c.study);
  ASSERT_TRUE(result.equilibria);
  ASSERT_FALSE(result.equilibria->list.empty());
  for (const Equilibrium& equilibrium : result.equilibria->list) {
    Vector phi(3);
    for (std::size_t q = 0; q < result.quantities.size(); ++q)
      for (Index i = 0; i < 3; ++i)
        if (result.quantities[q].name ==
            std::array{"tool.rx", "tool.ry", "tool.rz"}[static_cast<std::size_t>(i)])
          phi[i] = equilibrium.sample.values[q];
    EXPECT_LE(phi.norm(), pi + 1e-6) << equilibrium.label;
    EXPECT_THAT(equilibrium.note, testing::Not(testing::HasSubstr("singular")));
  }
}

/// Bar of length 1 on a universal joint with springs 1, pressed by a dead load: a spatial body.
Carousel spatial_bar() {
  Carousel c;
  model::Chain chain{.name = "bar"};
  const model::LinearSpring spring{1, 0};
  chain.elements = {
      model::Joint{
          .name = "a", .axis = {1, 0, 0}, .role = model::JointRole::preloaded, .spring = spring},
      model::Joint{
          .name = "b", .axis = {0, 1, 0}, .role = model::JointRole::preloaded, .spring = spring},
      model::RigidLink{{Rotation::Identity(), {0, 0, 1}}}};
  c.mechanism.bodies = {{"tip", model::TaskSpace::spatial, Vector{{0, 0, 1, 0, 0, 0}}}};
  c.mechanism.chains = {chain};
  c.study = {.name = "press", .control = ControlMode::load};
  c.study.direction = Vector::Unit(6, 2) * -1;
  c.study.until = {{"lambda", 0, 1.3}, {"bar.a", -1.5, 1.5}, {"bar.b", -1.5, 1.5}};
  return c;
}

TEST(FreeRotations, LeaveADoublePointAllEightWays) {
  Carousel c = spatial_bar();
  c.study.branches.depth = 1;
  const StudyResult result = run_study(c.mechanism, c.study);
  ASSERT_FALSE(result.junctions.empty());
  EXPECT_EQ(result.junctions[0].multiplicity, 2);
  EXPECT_EQ(result.junctions[0].ways.size(), 10u);  // the straight state too
  EXPECT_EQ(result.branches.size(), 9u);
  EXPECT_TRUE(complete(result));
}

// D1: nine equilibria with angles below 90 degrees at P = 1.2. As quaternions each stands twice.
TEST(FreeRotations, AreFoundOnceInASearchAlthoughQuaternionsHaveTwoSigns) {
  Carousel c = spatial_bar();
  c.study.branches.search_at = {1.2};
  const StudyResult result = run_study(c.mechanism, c.study);
  std::vector<std::pair<double, double>> found;
  for (const Branch& branch : result.branches)
    for (const Sample& sample : branch.samples) {
      double lambda = 0, a = 0, b = 0;
      for (std::size_t q = 0; q < result.quantities.size(); ++q) {
        const std::string& name = result.quantities[q].name;
        if (name == "lambda") lambda = sample.values[q];
        if (name == "bar.a") a = sample.values[q];
        if (name == "bar.b") b = sample.values[q];
      }
      if (std::abs(lambda - 1.2) < 1e-12) found.emplace_back(a, b);
    }
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(std::hypot(found[i].first - found[j].first, found[i].second - found[j].second),
                1e-6);
  // The straight state, and four curves through it that carry two of the others each.
  EXPECT_EQ(result.branches.size(), 5u);
}

}  // namespace
}  // namespace springfold::analysis
