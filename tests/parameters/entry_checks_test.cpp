// What does not fit together is refused where it enters.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <stdexcept>

#include "continuation/kink_problems.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {
namespace {

const Vector one_zero = Vector::Zero(1);

/// As many modes as mu says.
Family modes_by_number() {
  const auto held = std::make_shared<OneSidedModes>();
  return {.at = [held](double mu) -> std::optional<ProblemView> {
    held->n = static_cast<Index>(mu);
    held->a = Vector::Ones(held->n);
    held->c = Vector::Constant(held->n, 0.5);
    return ProblemView(*held);
  }};
}

TEST(EntryChecksOfFamilies, AFamilyWhoseProblemsChangeTheirSizeIsRefused) {
  CriticalStart start{.kind = CriticalKind::limit_point, .x = one_zero, .lambda = 1.5, .mu = 1};
  start.piece = above({true});
  EXPECT_THROW(follow_critical(modes_by_number(), start, true, {}, {}), std::invalid_argument);
  start.mu = 2;
  EXPECT_THROW(follow_critical(modes_by_number(), start, true, {}, {}), std::invalid_argument);
  EXPECT_THROW(polish_critical(Family{}, start), std::invalid_argument);
}

TEST(EntryChecksOfFamilies, ASpecialPointThatDoesNotExistIsRefused) {
  CriticalStart start{.kind = CriticalKind::surface, .x = one_zero, .lambda = 1.5, .mu = 1};
  start.piece = above({true});
  start.switching = 1;
  EXPECT_THROW(critical_rate(modes_by_number(), start), std::invalid_argument);
  start.kind = CriticalKind::branch_point;
  start.corank = 2;
  EXPECT_THROW(critical_rate(modes_by_number(), start), std::invalid_argument);
}

}  // namespace
}  // namespace springfold::continuation
