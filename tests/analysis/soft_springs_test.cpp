// The planar Orthoglide with springs in its passive joints that are much softer, or stiffer, than its drives, against
// its closed form: K = L = 1, sin a = y, sin b = x, e1 = x - rho + cos a, e2 = y - rho + cos b,
//
//     F_x = e1 + (Kv b - e2 sin b) / cos b,    F_y with x, y and a, b and e1, e2 exchanged.
//
// On the diagonal the force along it is sqrt 2 F_x, limit points are zeros of dF_x/dx + dF_x/dy, branch points of the
// difference.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/planar_orthoglide.hpp"

namespace springfold {
namespace {

using analysis::ControlMode;
using analysis::EventKind;

struct ClosedForm {
  double Kv = 0, rho = 0;

  ClosedForm(double stiffness, double start) : Kv{stiffness} {
    const double a = std::asin(start);
    rho = start + std::cos(a) + Kv * a / std::cos(a) / (1 - std::tan(a));
  }
  double force(double s) const {
    const double a = std::asin(s), e = s - rho + std::cos(a);
    return std::numbers::sqrt2 * (e + (Kv * a - e * std::sin(a)) / std::cos(a));
  }
  double by_x(double s) const {
    const double a = std::asin(s), c = std::cos(a), e = s - rho + c;
    const double n = Kv * a - e * std::sin(a), n_b = Kv + std::sin(a) * std::sin(a) - e * c;
    return 1 + (n_b / c + n * std::sin(a) / (c * c)) / c;
  }
  static double by_y(double s) { return -2 * std::tan(std::asin(s)); }
  double along(double s) const { return by_x(s) + by_y(s); }
  double across(double s) const { return by_x(s) - by_y(s); }
};

constexpr double knee = 80 * std::numbers::pi / 180;

/// Zeros within the range of the knees, by signs on a fine grid and bisection.
template <class Function>
std::vector<double> zeros(const Function& f) {
  constexpr int cells = 4000;
  const double end = std::sin(knee);
  std::vector<double> found;
  for (int i = 0; i < cells; ++i) {
    double a = end * (2.0 * i / cells - 1), b = end * (2.0 * (i + 1) / cells - 1);
    if ((f(a) > 0) == (f(b) > 0)) continue;
    for (int k = 0; k < 80; ++k) {
      const double m = 0.5 * (a + b);
      ((f(m) > 0) == (f(a) > 0) ? a : b) = m;
    }
    found.push_back(0.5 * (a + b));
  }
  return found;
}

class SoftSprings : public testing::TestWithParam<double> {};

/// Every place has one event of the kind, and there are no others of it.
void expect_events(const analysis::StudyResult& result, EventKind kind,
                   const std::vector<double>& places, const ClosedForm& truth) {
  const auto found = events_of_kind(result, kind);
  EXPECT_EQ(found.size(), places.size());
  for (const double place : places) {
    const auto near = std::find_if(found.begin(), found.end(), [&](const auto& event) {
      return std::abs(at_event(result, event, "tool.x") - place) <= 1e-9;
    });
    ASSERT_NE(near, found.end()) << code_of(kind) << " at " << place;
    EXPECT_NEAR(at_event(result, *near, "tool.y"), place, 1e-9);
    EXPECT_NEAR(at_event(result, *near, "force"), truth.force(place),
                1e-9 * std::max(1.0, truth.Kv));
  }
}

/// The number of unstable modes under dead load changes where the closed form says so.
void expect_index(const analysis::StudyResult& result, const ClosedForm& truth,
                  const std::vector<double>& places) {
  for (const auto& sample : result.branches.front().samples) {
    const double s = sample.values[column(result, "tool.x")];
    const bool critical =
        std::any_of(places.begin(), places.end(), [s](double p) { return std::abs(p - s) < 1e-7; });
    if (critical) continue;
    EXPECT_EQ(sample.values[column(result, "index_force")],
              (truth.along(s) < 0) + (truth.across(s) < 0))
        << s;
  }
}

TEST_P(SoftSprings, HaveEverySpecialPointOfTheClosedFormUnderEveryControl) {
  for (const double start : {0.0, -0.454, 0.454}) {
    const ClosedForm truth(GetParam(), start);
    const auto limits = zeros([&](double s) { return truth.along(s); });
    const auto branchings = zeros([&](double s) { return truth.across(s); });
    std::vector<double> all = limits;
    all.insert(all.end(), branchings.begin(), branchings.end());
    for (const ControlMode control : {ControlMode::load, ControlMode::mixed, ControlMode::pose}) {
      SCOPED_TRACE(testing::Message() << to_string(control) << " from " << start);
      analysis::Study study = diagonal_study(start);
      study.control = control;
      const auto result = run_study(planar_orthoglide(linear_knee(GetParam())), study);
      ASSERT_TRUE(complete(result));
      const auto& samples = result.branches.front().samples;
      EXPECT_LE(samples.size(), 400u);
      EXPECT_NEAR(std::abs(samples.front().values[column(result, "leg_x.knee")]), knee, 1e-9);
      EXPECT_NEAR(std::abs(samples.back().values[column(result, "leg_x.knee")]), knee, 1e-9);
      expect_events(result, EventKind::limit_point, limits, truth);
      const bool held = control == ControlMode::pose;  // nothing branches, but stability changes
      expect_events(result, held ? EventKind::stability_change : EventKind::branch_point,
                    branchings, truth);
      EXPECT_TRUE(events_of_kind(result, EventKind::unresolved).empty());
      expect_index(result, truth, all);
    }
  }
}

/// At -sqrt(1/2) the branch point is at the start itself. The unit of lambda that it promises beside it is a thousand
/// times too small for the rest of the curve.
TEST(StartBesideACriticalPoint, LeadsToEverySpecialPointAsAnyOther) {
  for (const double Kv : {0.0, 1e-6, 0.01})
    for (const ControlMode control : {ControlMode::load, ControlMode::mixed}) {
      SCOPED_TRACE(testing::Message() << to_string(control) << " with " << Kv);
      constexpr double start = -0.716;
      const ClosedForm truth(Kv, start);
      analysis::Study study = diagonal_study(start);
      study.control = control;
      const auto result = run_study(planar_orthoglide(linear_knee(Kv)), study);
      ASSERT_TRUE(complete(result));
      EXPECT_LE(result.branches.front().samples.size(), 500u);
      expect_events(result, EventKind::limit_point, zeros([&](double s) { return truth.along(s); }),
                    truth);
      expect_events(result, EventKind::branch_point,
                    zeros([&](double s) { return truth.across(s); }), truth);
    }
}

INSTANTIATE_TEST_SUITE_P(FromNothingToStiff, SoftSprings,
                         testing::Values(0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05,
                                         0.1, 1, 1e3));

}  // namespace
}  // namespace springfold
