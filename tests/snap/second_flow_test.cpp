// The overdamped motion a second time, by Boost.Odeint: another integrator, explicit, with dense output.
#include <gtest/gtest.h>

#include <boost/numeric/odeint.hpp>
#include <numbers>

#include "analysis/fall.hpp"
#include "analysis/flow.hpp"
#include "snap/energies.hpp"

namespace springfold::analysis {
namespace {

namespace odeint = boost::numeric::odeint;
using test::degree;
using State = std::vector<double>;

/// Where x' = f(x) comes to rest, polished; nothing if it does not.
std::optional<RestState> landing_by_odeint(const Landscape& landscape, const Vector& from) {
  const Motion motion{landscape};
  const auto rate = [&](const State& x, State& dx, double) {
    const Vector at = Eigen::Map<const Vector>(x.data(), static_cast<Index>(x.size()));
    const auto found = overdamped_rate(motion, at, Piece{});
    dx.assign(x.size(), std::numeric_limits<double>::quiet_NaN());
    if (found) std::copy(found->rate.begin(), found->rate.end(), dx.begin());
  };
  auto stepper = odeint::make_dense_output(1e-10, 1e-10, odeint::runge_kutta_dopri5<State>());
  State x(from.begin(), from.end()), dx;
  stepper.initialize(x, 0.0, 1e-3);
  constexpr int most = 100000;
  constexpr double nearly_at_rest = 1e-8;
  for (int k = 0; k < most; ++k) {
    stepper.do_step(rate);
    stepper.calc_state((stepper.previous_time() + stepper.current_time()) / 2, x);
    rate(x, dx, 0);
    const double speed = Eigen::Map<const Vector>(dx.data(), static_cast<Index>(dx.size())).norm();
    if (speed > nearly_at_rest) continue;
    // Beside the critical state the motion is as slow as that too.
    const auto state =
        rest_near(landscape, Eigen::Map<const Vector>(x.data(), static_cast<Index>(x.size())));
    if (state && is_minimum(*state)) return state;
  }
  return std::nullopt;
}

void expect_same_landing(const Landscape& landscape, const Vector& critical) {
  const auto ways = departures(landscape, critical, {Piece{}}).list;
  ASSERT_FALSE(ways.empty());
  for (const Departure& way : ways) {
    // Nearer to the critical state nothing but its stiff motions counts for an explicit integrator.
    const Vector from = way.x + 0.1 * way.along;
    const Flow stiff = flow_by_cvode({landscape}, from);
    ASSERT_EQ(stiff.end, Flow::End::rest);
    const auto other = landing_by_odeint(landscape, from);
    ASSERT_TRUE(other.has_value());
    EXPECT_LT((other->x - stiff.state.x).norm(), 1e-9);
  }
}

TEST(SecondFlow, LandsWhereTheFirstDoesFromABranchPointOfAnArch) {
  const auto arch = test::shallow_arch(3);
  expect_same_landing(test::landscape_of(arch, 3 + 3 * std::sqrt(5.0)),
                      Eigen::Vector2d(std::sqrt(5.0), 0));
}

TEST(SecondFlow, LandsWhereTheFirstDoesFromTheLimitPointOfTrusses) {
  const auto trusses = test::trusses_in_series({45 * degree, 46 * degree});
  expect_same_landing(test::landscape_of(trusses, 0.26502825343741),
                      Eigen::Vector2d(0.49017547146604, 0.37277119270476));
}

}  // namespace
}  // namespace springfold::analysis
