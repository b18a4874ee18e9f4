// Memory from the heap: none for the equations of a path, and for a step only what is kept of it.
#include <gtest/gtest.h>

#include "allocations.hpp"
#include "analysis/path_problem.hpp"
#include "command_mechanisms.hpp"
#include "springfold/continuation/trace.hpp"

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
long allocations = 0;
// Every allocation of this program is counted, Eigen's too.
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

namespace springfold::analysis {
namespace {

/// The tool pushed by lambda along a direction, or moved where `held`.
PathProblem problem_of(const model::SpringLaw& knee, bool held) {
  const statics::System system = statics::prepare(orthoglide(knee));
  const Vector along = Vector{{1, -0.3}}.normalized(), none = Vector::Zero(2);
  PathRule rule{.t_start = none, .t_rate = held ? along : none};
  rule.N = held ? Matrix(Vector{{-along[1], along[0]}}) : Matrix(Matrix::Identity(2, 2));
  rule.rho_start = system.commands;
  rule.rho_rate = none;
  rule.W_start = none;
  rule.W_rate = held ? none : along;
  return {system, rule};
}

TEST(EquationsOfAPath, NeedNoMemoryAfterTheFirstTime) {
  for (const bool held : {false, true}) {
    const PathProblem problem = problem_of(linear(0.05), held);
    Vector y = Vector::Constant(problem.size(), 0.05), F, b;
    Matrix A;
    ASSERT_TRUE(problem.residual(y, 0, {}, F) && problem.derivatives(y, 0, {}, A, b));
    const long before = allocations;
    bool inside = true;
    for (int k = 1; k <= 50; ++k) {
      y[0] = 1e-3 * k;
      inside = problem.residual(y, y[0], {}, F) && problem.derivatives(y, y[0], {}, A, b) && inside;
    }
    EXPECT_EQ(allocations, before) << (held ? "held" : "free");
    EXPECT_TRUE(inside);
    const std::vector<int> counted(10);
    EXPECT_GT(allocations, before);  // the counter counts
  }
}

/// Allocations of a trace with so many points.
/// The piece on whose side of all switches a point lies.
Piece piece_at(const PathProblem& problem, const Vector& y) {
  Vector g;
  Piece piece;
  EXPECT_TRUE(problem.switches(y, 0, g));
  for (const double value : g) piece.push_back(static_cast<std::int8_t>(value > 0 ? 1 : -1));
  return piece;
}

/// A straight column of links with springs between them, pushed askew. In space they turn about x, y and z one after the
/// other.
PathProblem column(int links, model::TaskSpace space = model::TaskSpace::xy) {
  using namespace model;
  const Index d = dimension(space);
  Mechanism m;
  m.bodies.push_back({"tip", space, Vector::Unit(d, 0)});
  Chain chain{.name = "column"};
  for (int i = 0; i < links; ++i) {
    Joint joint{
        .name = "j" + std::to_string(i + 1), .role = JointRole::preloaded, .spring = linear(links)};
    if (space == TaskSpace::spatial) joint.axis = Vec3<double>::Unit(i % 3);
    chain.elements.push_back(joint);
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX() / links}});
  }
  m.chains.push_back(chain);
  const statics::System system = statics::prepare(m);
  const Vector none = Vector::Zero(d);
  PathRule rule{.t_start = none, .t_rate = none};
  rule.N = Matrix::Identity(d, d);
  rule.rho_start = rule.rho_rate = system.commands;
  rule.W_start = none;
  rule.W_rate = -Vector::Unit(d, 0) - 0.1 * Vector::Unit(d, 1);
  return {system, rule};
}

/// A chain bent into a bow, from the origin to (1, 0); headings change by `bend` all in all.
model::Chain bow(int links, double bend) {
  using namespace model;
  const auto turn = [](double angle) {
    return RigidLink{{rotation_about<double>(Vec3<double>::UnitZ(), angle), Vec3<double>::Zero()}};
  };
  const double between = -bend / links, first = (bend + between) / 2;
  double span = 0;
  for (int i = 0; i < links; ++i) span += std::cos(first + i * between);
  Chain chain{.name = "bow", .elements = {turn(first)}};
  for (int i = 0; i < links; ++i) {
    chain.elements.push_back(Joint{.name = "j" + std::to_string(i + 1),
                                   .role = JointRole::preloaded,
                                   .spring = linear(links)});
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX() / span}});
    chain.elements.push_back(turn(between));
  }
  chain.elements.push_back(turn(first - between));
  return chain;
}

/// Bows that meet in a planar body, pushed together.
PathProblem bows(int links, int fewer) {
  model::Mechanism m;
  m.bodies.push_back({"joint", model::TaskSpace::planar, Vector{{1, 0, 0}}});
  m.chains = {bow(links, 1), bow(fewer, -1), bow(links, 2)};
  for (std::size_t i = 0; i < m.chains.size(); ++i) m.chains[i].name += std::to_string(i + 1);
  const statics::System system = statics::prepare(m);
  const Vector none = Vector::Zero(3);
  PathRule rule{.t_start = none, .t_rate = none, .N = Matrix::Identity(3, 3)};
  rule.rho_start = rule.rho_rate = system.commands;
  rule.W_start = none;
  rule.W_rate = Vector{{-1, -0.1, 0}};
  return {system, rule};
}

long allocations_for(const PathProblem& problem, int points,
                     const std::vector<continuation::Event>& events = {}) {
  continuation::TraceOptions options;
  options.step.initial = options.step.maximum = 1e-3;
  options.maximum_points = points;
  const Vector start = problem.reduce(statics::guess(problem.layout()));
  const auto rays = continuation::rays_from(problem, start, 0, piece_at(problem, start), options);
  const long before = allocations;
  const auto curve = continuation::trace(problem, start, 0, rays.rays.front(), events, options);
  EXPECT_EQ(curve.points.size(), static_cast<std::size_t>(points)) << curve.stop_detail;
  EXPECT_TRUE(curve.hits.empty() && curve.log.empty());
  return allocations - before;
}

/// Of one step, beyond the list of points, which grows a few times.
double per_step(const PathProblem& problem, const std::vector<continuation::Event>& events = {}) {
  constexpr int few = 50, many = 250;
  allocations_for(problem, many,
                  events);  // the problem keeps memory of its own, as much as it needs on the way
  const long extra = allocations_for(problem, many, events) - allocations_for(problem, few, events);
  return static_cast<double>(extra) / (many - few);
}

/// The position and the tangent of the point that is kept, and its piece where there are switches.
TEST(AStep, AsksForNoMemoryButThatOfThePointItKeeps) {
  constexpr double point = 2, list = 0.05;
  EXPECT_LE(per_step(problem_of(linear(0.05), false)), point + list);
  EXPECT_LE(per_step(problem_of(linear(0.05), true)), point + list);
  EXPECT_LE(per_step(column(30)), point + list);
  EXPECT_LE(per_step(problem_of(one_sided(0.05, 0.8), false)), point + 1 + list);
}

TEST(AStep, AsksForNoMoreWhereAChainIsEvaluatedInStages) {
  using enum model::TaskSpace;
  constexpr double point = 2, list = 0.05;
  for (const auto& [links, space] :
       {std::pair{60, xy}, std::pair{200, xy}, std::pair{60, planar}, std::pair{60, spatial}}) {
    const PathProblem problem = column(links, space);
    ASSERT_TRUE(problem.structured());
    EXPECT_LE(per_step(problem), point + list)
        << links << " links, " << model::dimension(space) << " coordinates of the tip";
  }
  const PathProblem closed = bows(60, 5);
  ASSERT_TRUE(closed.structured());
  EXPECT_LE(per_step(closed), point + list);
}

TEST(AStep, AsksForNoneWhereEventsAreWatchedEither) {
  const std::vector<continuation::Event> far{
      {"far", [](const continuation::CurvePoint& p) { return p.lambda - 5; }}};
  EXPECT_LE(per_step(problem_of(linear(0.05), false), far), 2.05);
}

}  // namespace
}  // namespace springfold::analysis
#endif
