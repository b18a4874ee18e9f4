// What does not fit together is refused where it enters.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "kink_problems.hpp"
#include "springfold/continuation/between.hpp"
#include "springfold/continuation/davidenko.hpp"
#include "springfold/continuation/diagram.hpp"
#include "springfold/continuation/response.hpp"
#include "springfold/continuation/search.hpp"
#include "springfold/continuation/verification.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

const Vector zero_vector = Vector::Zero(1);
const Ray ray_up{above({true}), {Vector::Zero(1), 1}};

TEST(EntryChecks, PointsOfAWrongSizeAreRefused) {
  const OneSidedModes problem;
  EXPECT_THROW(rays_from(problem, Vector::Zero(2), 0, above({true}), {}), std::invalid_argument);
  EXPECT_THROW(trace(problem, Vector(0), 0, ray_up, {}, {}), std::invalid_argument);
  EXPECT_THROW(davidenko(problem, Vector::Zero(3), 0, ray_up, {}, {}), std::invalid_argument);
  EXPECT_THROW(trace_diagram(problem, {{Vector::Zero(2), 0, above({true})}}, {}, {}),
               std::invalid_argument);
}

TEST(EntryChecks, PiecesOfAWrongSizeAreRefused) {
  const OneSidedModes problem;
  EXPECT_THROW(rays_from(problem, zero_vector, 0, {}, {}), std::invalid_argument);
  EXPECT_THROW(rays_from(problem, zero_vector, 0, Piece{0}, {}), std::invalid_argument);
}

TEST(EntryChecks, APieceOfAProblemWithoutSwitchesIsRefused) {
  const auto problem = circle();
  const Vector x{{0.6}};
  const Piece piece{1};
  EXPECT_THROW(rays_from(problem, x, 0.8, piece, {}), std::invalid_argument);
  EXPECT_THROW(trace(problem, x, 0.8, Ray{piece, {Vector{{0.8}}, -0.6}}, {}, {}),
               std::invalid_argument);
  EXPECT_THROW(trace_diagram(problem, {{x, 0.8, piece}}, {}, {}), std::invalid_argument);
}

TEST(EntryChecks, AnEventWithoutAFunctionIsNamed) {
  const auto problem = circle();
  const Vector x{{0.6}};
  const std::vector<Event> events{{.name = "half-way"}};
  const Ray ray{{}, {Vector{{0.8}}, -0.6}};
  const auto text = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const std::string wanted = "the event \"half-way\" has no function `value`";
  EXPECT_EQ(text([&] { trace(problem, x, 0.8, ray, events, {}); }), wanted);
  EXPECT_EQ(text([&] { davidenko(problem, x, 0.8, ray, events, {}); }), wanted);
  EXPECT_EQ(text([&] { trace_diagram(problem, {{x, 0.8, {}}}, events, {}); }), wanted);
}

TEST(EntryChecks, AnEmptyRayIsRefused) {
  const OneSidedModes problem;
  EXPECT_THROW(trace(problem, zero_vector, 0, Ray{above({true}), {}, {}, {}}, {}, {}),
               std::invalid_argument);
  EXPECT_THROW(
      trace(problem, zero_vector, 0, Ray{above({true}), {Vector::Zero(1), 0}, {}, {}}, {}, {}),
      std::invalid_argument);
}

TEST(EntryChecks, OptionsThatCannotBeUsedAreRefused) {
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");
  std::vector<TraceOptions> wrong(8);
  wrong[0].step.maximum = -1;
  wrong[1].step.maximum = infinite;
  wrong[2].step.aim = 2;
  wrong[3].step.turn = 4;
  wrong[4].location_tolerance = -1;
  wrong[5].location_tolerance = nan;
  wrong[6].simultaneous = nan;
  wrong[7].simultaneous = -1;
  for (const TraceOptions& options : wrong) {
    EXPECT_EQ(problems_in(options).size(), 1U);
    EXPECT_THROW(trace(OneSidedModes{}, zero_vector, 0, ray_up, {}, options),
                 std::invalid_argument);
  }
}

TEST(EntryChecks, OptionsOfADiagramThatCannotBeUsedAreRefused) {
  std::vector<DiagramOptions> wrong(5);
  wrong[0].maximum_depth = -1;
  wrong[1].maximum_branches = -1;
  wrong[2].same_place = -1;
  wrong[3].same_place = std::nan("");
  wrong[4].trace.maximum_points = 0;
  for (const DiagramOptions& options : wrong)
    EXPECT_THROW(trace_diagram(OneSidedModes{}, {{zero_vector, 0, above({true})}}, {}, options),
                 std::invalid_argument);
}

/// A unit circle whose residual, or matrix, has another size from lambda = 0.9 on.
struct GrowingCircle {
  Index more_rows = 0, more_columns = 0;
  static Index size() { return 1; }
  bool residual(const Vector& x, double l, Vector& F) const {
    F = Vector::Constant(l > 0.9 ? 1 + more_rows : 1, x[0] * x[0] + l * l - 1);
    return true;
  }
  bool derivatives(const Vector& x, double l, Matrix& J, Vector& by_l) const {
    J = Matrix::Constant(1, l > 0.9 ? 1 + more_columns : 1, 2 * x[0]);
    by_l = Vector::Constant(1, 2 * l);
    return true;
  }
};

TEST(EntryChecks, AProblemThatChangesItsSizesOnTheWayIsRefused) {
  const Vector x{{0.8}};
  const Ray ray{{}, {Vector{{-0.6}}, 0.8}};
  for (const auto& problem : {GrowingCircle{.more_rows = 1}, GrowingCircle{.more_rows = -1},
                              GrowingCircle{.more_columns = 1}})
    EXPECT_THROW(trace(problem, x, 0.6, ray, {}, {}), std::invalid_argument);
  EXPECT_EQ(trace(GrowingCircle{}, x, 0.6, ray, {}, {}).stop, StopReason::closed);
}

struct WrongMetric : OneSidedModes {
  static Vector metric() { return Vector::Ones(3); }
};

TEST(EntryChecks, AProblemWhoseMembersDisagreeIsRefused) {
  EXPECT_THROW(rays_from(WrongMetric{}, zero_vector, 0, above({true}), {}), std::invalid_argument);
}

TEST(EntryChecks, ASearchWantsABoxAndKnownSolutionsOfTheProblemsSize) {
  const OneSidedModes problem;
  const SearchOptions box{.low = Vector::Constant(1, -1), .high = Vector::Constant(1, 1)};
  EXPECT_NO_THROW(search_at(problem, 0, {zero_vector}, box));
  EXPECT_THROW(search_at(problem, 0, {}, {}), std::invalid_argument);
  EXPECT_THROW(search_at(problem, 0, {Vector::Zero(2)}, box), std::invalid_argument);
}

TEST(EntryChecks, ACurveOfAnotherProblemIsRefused) {
  Curve curve;
  curve.points = {{.x = Vector::Zero(2), .piece = above({true})}};
  EXPECT_THROW(points_between(OneSidedModes{}, curve, 0.1, {}), std::invalid_argument);
  EXPECT_THROW(verified_arcs(OneSidedModes{}, curve, {}), std::invalid_argument);
  EXPECT_THROW(points_between(OneSidedModes{}, {}, 0, {}), std::invalid_argument);
  EXPECT_THROW(response_at(OneSidedModes{}, Vector::Zero(2), 0, above({true})),
               std::invalid_argument);
}

/// Two springs of very different stiffness that give way by the same length.
struct StiffBesideSoft {
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  static bool residual(const Vector& x, double lambda, Vector& F) {
    F = Vector{{x[0] - lambda, soft * (x[1] - lambda)}};
    return true;
  }
  static bool derivatives(const Vector&, double, Matrix& dF_dx, Vector& dF_dlambda) {
    dF_dx = Matrix{{1, 0}, {0, soft}};
    dF_dlambda = Vector{{-1, -soft}};
    return true;
  }
  static constexpr double soft = 3e-13;
};

TEST(RaysFrom, AStartAmongStiffAndSoftSpringsAreTheTwoOfItsCurve) {
  const Rays rays = rays_from(StiffBesideSoft{}, Vector::Zero(2), 0, {}, {});
  EXPECT_TRUE(rays.complete) << rays.why;
  ASSERT_EQ(rays.rays.size(), 2u);
  for (const Ray& ray : rays.rays) {
    EXPECT_NEAR(ray.tangent.dx[0], ray.tangent.dlambda, 1e-13);
    EXPECT_NEAR(ray.tangent.dx[1], ray.tangent.dlambda, 1e-13);
  }
}

}  // namespace
}  // namespace springfold::continuation
