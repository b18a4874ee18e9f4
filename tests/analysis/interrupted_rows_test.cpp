// A curve whose rows are being filled when they are not wanted any more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/planar_orthoglide.hpp"

namespace springfold {
namespace {

using analysis::StudyResult;
using testing::HasSubstr;

std::vector<std::string> event_labels(const StudyResult& result) {
  std::vector<std::string> labels;
  for (const auto& event : result.branches.front().events) labels.push_back(event.label);
  return labels;
}

TEST(InterruptedRows, KeepTheTracedCurveWithItsSpecialPointsAndTheirCounts) {
  const auto mechanism = planar_orthoglide(linear_knee(0));
  auto study = diagonal_study(0.454);
  int traced = 0;
  const StudyResult steps = run_study(mechanism, study, nullptr, [&](int points, double) {
    traced = points;
    return true;
  });
  ASSERT_TRUE(complete(steps));
  // The curve is traced: whoever asks again with the same number of points fills rows.
  study.trace.spacing = 1e-5;
  int last = 0;
  const StudyResult part = run_study(mechanism, study, nullptr, [&](int points, double) {
    const bool fills = points == traced && last == points;
    last = points;
    return !fills;
  });
  EXPECT_FALSE(complete(part));
  EXPECT_THAT(part.branches.front().forward.reason, HasSubstr("interrupted"));
  EXPECT_EQ(event_labels(part), event_labels(steps));
  ASSERT_GE(part.branches.front().samples.size(), steps.branches.front().samples.size());
  for (std::size_t i = 0; i < steps.branches.front().events.size(); ++i)
    for (const char* name : {"lambda", "tool.x", "index", "index_force"})
      EXPECT_EQ(at_event(part, part.branches.front().events[i], name),
                at_event(steps, steps.branches.front().events[i], name))
          << name << " of event " << i;
}

}  // namespace
}  // namespace springfold
