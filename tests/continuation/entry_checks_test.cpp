// What does not fit together is refused where it enters.
#include <gtest/gtest.h>

#include <stdexcept>

#include "kink_problems.hpp"
#include "springfold/continuation/davidenko.hpp"
#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

const Vector origin = Vector::Zero(1);
const Ray up{above({true}), {Vector::Zero(1), 1}};

TEST(EntryChecks, PointsOfAWrongSizeAreRefused) {
  const OneSidedModes problem;
  EXPECT_THROW(rays_from(problem, Vector::Zero(2), 0, above({true}), {}), std::invalid_argument);
  EXPECT_THROW(trace(problem, Vector(0), 0, up, {}, {}), std::invalid_argument);
  EXPECT_THROW(davidenko(problem, Vector::Zero(3), 0, up, {}, {}), std::invalid_argument);
  EXPECT_THROW(trace_diagram(problem, {{Vector::Zero(2), 0, above({true})}}, {}, {}),
               std::invalid_argument);
}

TEST(EntryChecks, PiecesOfAWrongSizeAreRefused) {
  const OneSidedModes problem;
  EXPECT_THROW(rays_from(problem, origin, 0, {}, {}), std::invalid_argument);
  EXPECT_THROW(rays_from(problem, origin, 0, Piece{0}, {}), std::invalid_argument);
}

TEST(EntryChecks, AnEmptyRayIsRefused) {
  const OneSidedModes problem;
  EXPECT_THROW(trace(problem, origin, 0, Ray{above({true}), {}, {}, {}}, {}, {}),
               std::invalid_argument);
  EXPECT_THROW(trace(problem, origin, 0, Ray{above({true}), {Vector::Zero(1), 0}, {}, {}}, {}, {}),
               std::invalid_argument);
}

TEST(EntryChecks, OptionsThatCannotBeUsedAreRefused) {
  TraceOptions options;
  options.step.maximum = -1;
  EXPECT_THROW(trace(OneSidedModes{}, origin, 0, up, {}, options), std::invalid_argument);
}

struct WrongMetric : OneSidedModes {
  static Vector metric() { return Vector::Ones(3); }
};

TEST(EntryChecks, AProblemWhoseMembersDisagreeIsRefused) {
  EXPECT_THROW(rays_from(WrongMetric{}, origin, 0, above({true}), {}), std::invalid_argument);
}

}  // namespace
}  // namespace springfold::continuation
