// What is kept where a problem does not want to be asked any more, wherever that happens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "springfold/continuation/between.hpp"
#include "springfold/continuation/diagram.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Two modes that buckle at 1 and 2 and know nothing of each other: x (1 - l + x^2) = 0, y (2 - l + y^2) = 0. From a
/// given number of questions on it answers none.
struct PatientModes {
  mutable long left = -1;  ///< questions that are still answered; < 0: all
  mutable long asked = 0;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  void count() const {
    ++asked;
    if (left == 0) throw Interrupted{};
    if (left > 0) --left;
  }
  bool residual(const Vector& z, double l, Vector& F) const {
    count();
    F = Vector{{z[0] * (1 - l + z[0] * z[0]), z[1] * (2 - l + z[1] * z[1])}};
    return true;
  }
  bool derivatives(const Vector& z, double l, Matrix& H, Vector& F_lambda) const {
    count();
    H = Matrix{{1 - l + 3 * z[0] * z[0], 0}, {0, 2 - l + 3 * z[1] * z[1]}};
    F_lambda = -z;
    return true;
  }
};

const std::vector<Event>& range() {
  static const std::vector<Event> events{lambda_reaches(0), lambda_reaches(4)};
  return events;
}

Diagram diagram_of(const PatientModes& problem, long questions = -1) {
  problem.left = questions;
  problem.asked = 0;
  DiagramOptions options;
  options.maximum_depth = 2;
  return trace_diagram(problem, {{Vector::Zero(2), 0.5, {}}}, range(), options);
}

/// Along x of the first mode, from where it is 1/2, to lambda = 4.
Curve first_mode(const PatientModes& problem, long questions = -1) {
  problem.left = questions;
  problem.asked = 0;
  const double slant = 1 / std::sqrt(2.0);
  const Ray ray{{}, {Vector{{slant, 0}}, slant}, {}, {}, {}};
  return trace(problem, Vector{{0.5, 0}}, 1.25, ray, range(), {});
}

/// Are the points of `part` those with which `whole` begins?
bool begins_like(const Curve& whole, const Curve& part) {
  if (part.points.size() > whole.points.size()) return false;
  for (std::size_t i = 0; i < part.points.size(); ++i)
    if (part.points[i].x != whole.points[i].x || part.points[i].lambda != whole.points[i].lambda)
      return false;
  return true;
}

TEST(Interrupted, ADiagramKeepsTheBranchesThatItHasWhereverItIs) {
  const PatientModes problem;
  const Diagram whole = diagram_of(problem);
  const long all = problem.asked;
  ASSERT_GE(whole.branches.size(), 8u);
  ASSERT_TRUE(whole.doubts.empty());
  std::size_t most = 0;
  for (long k = 0; k < all; k += 1 + k / 50) {
    const Diagram part = diagram_of(problem, k);
    ASSERT_LE(part.branches.size(), whole.branches.size());
    ASSERT_GE(part.branches.size() + 1, most) << k;
    most = std::max(most, part.branches.size());
    long open = 0, stopped = 0;
    for (std::size_t i = 0; i < part.branches.size(); ++i) {
      const Curve& curve = part.branches[i].curve;
      ASSERT_FALSE(curve.points.empty()) << k;
      if (curve.stop == StopReason::observer)
        ++stopped;
      else
        EXPECT_TRUE(begins_like(whole.branches[i].curve, curve)) << k << " " << i;
    }
    for (const Junction& junction : part.junctions) {
      open += !junction.complete;
      for (const Way& way : junction.ways) {
        open += way.branch < 0;
        ASSERT_LT(way.branch, static_cast<int>(part.branches.size())) << k;
      }
    }
    EXPECT_TRUE(open + stopped > 0 || part.branches.size() < whole.branches.size()) << k;
    EXPECT_LE(stopped, 1) << "only the branch that was being traced " << k;
  }
  EXPECT_EQ(most, whole.branches.size());
}

TEST(Interrupted, ACurveKeepsThePointsThatWereAccepted) {
  const PatientModes problem;
  const Curve whole = first_mode(problem);
  const long all = problem.asked;
  ASSERT_EQ(whole.stop, StopReason::event);
  ASSERT_GT(whole.points.size(), 20u);
  std::size_t most = 0;
  constexpr long before_the_first_step = 20;
  for (long k = before_the_first_step; k < all; k += 1 + k / 50) {
    const Curve part = first_mode(problem, k);
    EXPECT_EQ(part.stop, StopReason::observer) << k;
    EXPECT_TRUE(begins_like(whole, part)) << k;
    most = std::max(most, part.points.size());
  }
  EXPECT_GE(most + 4, whole.points.size());
}

TEST(Interrupted, PointsBetweenThoseOfStepsAreKeptAsFarAsTheyAre) {
  const PatientModes problem;
  const Curve curve = first_mode(problem);
  problem.asked = 0;
  const std::size_t all = points_between(problem, curve, 0.001, {}).points.size();
  problem.left = problem.asked / 2;
  const auto part = points_between(problem, curve, 0.001, {});
  EXPECT_GT(part.points.size(), all / 4);
  EXPECT_LT(part.points.size(), all);
}

}  // namespace
}  // namespace springfold::continuation
