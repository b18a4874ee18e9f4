// Jumps of energies whose answers are known in closed form: where they land, what they release, and
// whether damping and masses have a say.
#include "snap/energies.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "analysis/fall.hpp"
#include "analysis/flow.hpp"

namespace springfold::analysis {
namespace {

using test::degree;
using test::landscape_of;
using test::shallow_arch;
using test::trusses_in_series;

constexpr double fold_45 = 0.26502825343741, travel_45 = 0.49017547146604;

struct Landed {
  std::vector<Fall> falls{};
  std::vector<Departure> ways{};
  std::vector<RestState> states{};
  double energy = 0;
};

Landed jump(const Landscape& landscape, const Vector& critical) {
  Landed result;
  result.energy = landscape.energy(critical);
  result.ways = departures(landscape, critical, {Piece{}}).list;
  StateBook book(landscape);
  for (const Departure& way : result.ways) book.ways_down(way.x);
  book.search({});
  for (const Departure& way : result.ways) result.falls.push_back(fall(book, way, result.energy));
  result.states = book.states();
  return result;
}

TEST(Snap, AShallowArchJumpsFromItsBranchPointToBothSidesAndLandsOnce) {
  const auto arch = shallow_arch(3);
  const double p = 3 + 3 * std::sqrt(5.0);
  const Landscape landscape = landscape_of(arch, p);
  // On the branch point S = -4: q1^2 = 5.
  const Landed landed = jump(landscape, Eigen::Vector2d(std::sqrt(5.0), 0));
  ASSERT_EQ(landed.falls.size(), 2u);
  for (const Fall& fall : landed.falls) {
    EXPECT_EQ(fall.verdict, SnapVerdict::unambiguous);
    const RestState& landing = landed.states[fall.landing.value()];
    EXPECT_NEAR(landing.x[0], -3.1795868015587, 1e-12);
    EXPECT_NEAR(landing.x[1], 0, 1e-12);
    EXPECT_NEAR(landed.energy - landing.energy, 37.466531971747, 1e-11);
  }
}

TEST(Snap, OneTrussSnapsToTheOnlyStateBelow) {
  const auto truss = trusses_in_series({45 * degree});
  const Landscape landscape = landscape_of(truss, fold_45);
  const Landed landed = jump(landscape, Vector::Constant(1, travel_45));
  ASSERT_EQ(landed.falls.size(), 1u);
  EXPECT_EQ(landed.falls[0].verdict, SnapVerdict::unambiguous);
  const RestState& landing = landed.states[landed.falls[0].landing.value()];
  EXPECT_NEAR(landing.x[0], 2.2297397072209, 1e-11);
  EXPECT_NEAR(landed.energy - landing.energy, 0.51698086561453, 1e-12);
}

/// The upper truss at rest before its limit point, and snapped.
TEST(Snap, WithASteeperTrussOnTopItDependsOnDampingAndMasses) {
  const auto trusses = trusses_in_series({45 * degree, 46 * degree});
  const Landscape landscape = landscape_of(trusses, fold_45);
  const Landed landed = jump(landscape, Eigen::Vector2d(travel_45, 0.37277119270476));
  ASSERT_EQ(landed.falls.size(), 1u);
  const Fall& fall = landed.falls[0];
  EXPECT_EQ(fall.verdict, SnapVerdict::depends);
  ASSERT_EQ(fall.minima.size(), 2u);
  const RestState& first = landed.states[fall.minima[0]];
  const RestState& second = landed.states[fall.minima[1]];
  EXPECT_NEAR(first.x[0], 2.2297397072209, 1e-10);
  EXPECT_NEAR(first.x[1], 0.37277119270476, 1e-10);
  EXPECT_NEAR(landed.energy - first.energy, 0.51698086561453, 1e-11);
  EXPECT_NEAR(second.x[1], 2.2956874378282, 1e-10);
  EXPECT_NEAR(first.energy - second.energy, 0.53854642672776, 1e-10);
  ASSERT_FALSE(fall.saddles.empty());
  const RestState& saddle = landed.states[fall.saddles[0]];
  EXPECT_NEAR(saddle.x[1], 0.64879431788789, 1e-10);
  EXPECT_NEAR(saddle.energy - first.energy, 0.0042761391852620, 1e-10);
}

TEST(Snap, AStableBranchPointIsNotLeft) {
  // x^4/4 + y^2: flat to third order, stable.
  const test::EnergyProblem pitchfork{
      .V = [](const Vector& x,
              double l) { return std::pow(x[0], 4) / 4 - l * x[0] * x[0] / 2 + x[1] * x[1]; },
      .gradient =
          [](const Vector& x, double l) {
            return Vector(Eigen::Vector2d(std::pow(x[0], 3) - l * x[0], 2 * x[1]));
          },
      .hessian =
          [](const Vector& x, double l) {
            return Matrix(Eigen::Vector2d(3 * x[0] * x[0] - l, 2).asDiagonal());
          },
      .n = 2};
  const Landscape landscape = landscape_of(pitchfork, 0);
  const Departures ways = departures(landscape, Vector::Zero(2), {Piece{}});
  EXPECT_TRUE(ways.list.empty());
  EXPECT_FALSE(ways.is_flat);
}

TEST(Snap, WithoutAStateBelowItRunsAway) {
  const test::EnergyProblem fold{
      .V = [](const Vector& x, double l) { return -std::pow(x[0], 3) / 3 - l * x[0]; },
      .gradient = [](const Vector& x, double l) { return Vector::Constant(1, -x[0] * x[0] - l); },
      .hessian = [](const Vector& x, double) { return Matrix::Constant(1, 1, -2 * x[0]); },
      .n = 1};
  const Landed landed = jump(landscape_of(fold, 0), Vector::Zero(1));
  ASSERT_EQ(landed.falls.size(), 1u);
  EXPECT_EQ(landed.falls[0].verdict, SnapVerdict::runs_away);
}

TEST(Flow, OverdampedMotionDissipatesWhatIsReleased) {
  const auto arch = shallow_arch(3);
  const Landscape landscape = landscape_of(arch, 3 + 3 * std::sqrt(5.0));
  const auto ways = departures(landscape, Eigen::Vector2d(std::sqrt(5.0), 0), {Piece{}}).list;
  ASSERT_FALSE(ways.empty());
  const Flow stiff = flow_by_cvode({landscape}, ways[0].x);
  ASSERT_EQ(stiff.end, Flow::End::rest);
  const double released = landscape.energy(ways[0].x) - stiff.state.energy;
  EXPECT_NEAR(stiff.dissipated, released, 1e-6 * released);
}

/// With relative dampers c dw_i/dt and masses at the middle and the top node. Dampings well on either side of where the
/// answer changes; a fourth-order Runge-Kutta integration of the same two equations of motion, written apart from this
/// program, gives the same four answers.
TEST(Flow, MassesAndDampingDecideWhetherTheSecondTrussSnaps) {
  const auto trusses = trusses_in_series({45 * degree, 46 * degree});
  const Landscape landscape = landscape_of(trusses, fold_45);
  const Vector from =
      Eigen::Vector2d(travel_45 + 1e-3 * (2.2297397072209 - travel_45), 0.37277119270476);
  const auto second_goes = [&](double middle, double top, double c) {
    const Motion motion{landscape,
                        [=](const Vector&) {
                          Matrix first(1, 2), both(1, 2);
                          first << 1, 0;
                          both << 1, 1;
                          return std::vector<MassPoint>{{middle, first}, {top, both}};
                        },
                        c};
    const Flow flow = flow_by_cvode(motion, from);
    EXPECT_EQ(flow.end, Flow::End::rest);
    return flow.state.x[1] > 1;
  };
  EXPECT_FALSE(second_goes(1, 1, 1.2));
  EXPECT_TRUE(second_goes(1, 1, 0.35));
  EXPECT_FALSE(second_goes(1, 0.1, 0.32));
  EXPECT_TRUE(second_goes(1, 0.1, 0.25));
  const Flow overdamped = flow_by_cvode({landscape}, from);
  ASSERT_EQ(overdamped.end, Flow::End::rest);
  EXPECT_LT(overdamped.state.x[1], 1);
}

}  // namespace
}  // namespace springfold::analysis
