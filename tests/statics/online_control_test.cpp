// The on-line solver: warm starts, and no memory from the heap after the first solve.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "allocations.hpp"
#include "examples.hpp"
#include "springfold/statics/kinetostatic_control.hpp"

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
long allocations = 0;
// Every allocation of this program is counted, Eigen's too.
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace springfold::statics {
namespace {

Vector on_circle(double angle) { return Vector{{0.35 * std::cos(angle), 0.35 * std::sin(angle)}}; }

ControlSolver solver_for(const System& system) {
  return control_solver(system, {}, guess(system), system.commands);
}

TEST(OnlineControl, FollowsACircleFromWarmStartsInFourIterations) {
  const System system = prepare(orthoglide(model::LinearSpring{0.05, 0}, 0, 0));
  ControlSolver solver = solver_for(system);
  const Vector W{{0.01, -0.02}};
  ASSERT_TRUE(solve_control(system, solver, on_circle(0), W));
  for (int k = 1; k <= 360; ++k) {
    ASSERT_TRUE(solve_control(system, solver, on_circle(k * std::numbers::pi / 180), W));
    EXPECT_LE(solver.iterations, 4);
    EXPECT_LT(solver.residual, 1e-12);
  }
}

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
TEST(OnlineControl, AllocatesNothingAfterTheFirstSolve) {
  for (const model::SpringLaw& knee :
       {model::SpringLaw{model::LinearSpring{0.05, 0}},
        model::SpringLaw{model::OneSidedSpring{0.5, std::numbers::pi / 12,
                                               model::OneSidedSpring::Side::above}}}) {
    const System system = prepare(orthoglide(knee, 0, 0));
    ControlSolver solver = solver_for(system);
    const Vector W{{0.01, -0.02}};
    Vector target = on_circle(0);
    ASSERT_TRUE(solve_control(system, solver, target, W));
    const long before = allocations;
    bool found = true;
    for (int k = 1; k <= 100; ++k) {
      target[0] = 0.35 * std::cos(0.02 * k);
      target[1] = 0.35 * std::sin(0.02 * k);
      found = solve_control(system, solver, target, W) && found;
    }
    EXPECT_EQ(allocations, before);
    EXPECT_TRUE(found);
    const std::vector<int> counted(10);
    EXPECT_GT(allocations, before);  // the counter counts
  }
}

TEST(OnlineControl, OfASpatialPlatformAllocatesNothingEither) {
  model::Mechanism m;
  m.bodies = {{"plate", model::TaskSpace::spatial, Vector::Zero(6)}};
  m.bodies[0].pose[2] = 1;
  for (int leg = 0; leg < 6; ++leg) {
    // Universal joint, drive along the leg, spherical joint: base and plate of different turns.
    const double base = leg * std::numbers::pi / 3, plate = base + (leg % 2 == 0 ? 0.5 : -0.5);
    model::Chain chain{.name = "leg" + std::to_string(leg)};
    chain.from_attachment.p = {std::cos(base), std::sin(base), 0};
    chain.to_attachment.p = {0.6 * std::cos(plate), 0.6 * std::sin(plate), 0};
    const auto turn = [](const char* name, const Vec3& axis) {
      return model::Joint{.name = name, .axis = axis};
    };
    const Vec3 way = chain.to_attachment.p + Vec3(0, 0, 1) - chain.from_attachment.p;
    chain.elements = {turn("ux", Vec3::UnitX()),
                      turn("uy", Vec3::UnitY()),
                      model::Joint{.name = "drive",
                                   .kind = model::JointKind::prismatic,
                                   .axis = way.normalized(),
                                   .role = model::JointRole::actuated,
                                   .spring = model::LinearSpring{100, 0},
                                   .command = way.norm()},
                      turn("sx", Vec3::UnitX()),
                      turn("sy", Vec3::UnitY()),
                      turn("sz", Vec3::UnitZ())};
    m.chains.push_back(chain);
  }
  const System system = prepare(m);
  ControlSolver solver = solver_for(system);
  Vector target = m.bodies[0].pose, W = Vector::Zero(6);
  W[2] = -5;
  W[3] = 0.1;
  ASSERT_TRUE(solve_control(system, solver, target, W));
  const long before = allocations;
  bool found = true;
  for (int k = 1; k <= 20; ++k) {
    target[0] = 0.005 * k;
    target[4] = 0.004 * k;
    found = solve_control(system, solver, target, W) && found;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(found);
}
#endif

}  // namespace
}  // namespace springfold::statics
