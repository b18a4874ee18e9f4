// Two branches that are mirror images of each other have the same counts of unstable modes, from their first rows on.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "cases/number_text.hpp"
#include "io/counts_beside.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyResult;

/// Elastic beams of length 1 under a dead load, on a foot of stiffness 1 or clamped.
StudyResult pressed_beam(bool has_foot, double EA, double EI, int segments, double last_load) {
  const std::string foot =
      has_foot ? "{ joint = \"revolute\", axis = \"z\", name = \"foot\", role = \"preloaded\", "
                 "spring = { law = \"linear\", stiffness = 1 } }, "
               : "";
  return run("[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = "
             "\"mast\"\nelements = [" +
             foot +
             "{ rigid = { rotate = { axis = \"z\", angle = \"90*deg\" } } }, { elastic = "
             "\"beam\", length = 1, E = 1, A = " +
             number(EA) + ", Iz = " + number(EI) + ", segments = " + std::to_string(segments) +
             " }]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\n"
             "until = { lambda = [-0.5, " +
             number(last_load) + "], top.x = [-0.6, 0.6] }\nbranches = { depth = 1 }\n")
      .of("press");
}

/// A symmetric column buckles into two states that are stable from the branch point on: the load grows with the square
/// of the deflection, K ~ 2 (lambda - lambda_c) > 0.
void expect_stable_branches(const StudyResult& result) {
  ASSERT_EQ(result.branches.size(), 3u);
  for (const std::size_t b : {std::size_t{1}, std::size_t{2}}) {
    const Branch& bent = result.branches[b];
    for (const char* count : {"index", "index_force", "index_driven"}) {
      for (std::size_t i = 0; i < bent.samples.size(); ++i)
        EXPECT_EQ(value(result, bent, i, count), 0)
            << count << " in row " << i << " of branch " << b + 1;
      for (const auto& event : bent.events) {
        const CountsBeside counts = counts_beside(result, bent, event, count);
        EXPECT_EQ(counts.before, 0) << event.label;
        EXPECT_EQ(counts.after, 0) << event.label;
      }
    }
  }
}

TEST(MirrorBranches, OfABarOnAFlexureAreBothStableFromTheirFirstRowsOn) {
  for (const double EI : {10.0, 1e3, 3e4})
    for (const double ratio : {10.0, 1e3})
      for (const int segments : {1, 2}) {
        SCOPED_TRACE(testing::Message() << EI << ", " << ratio << ", " << segments);
        expect_stable_branches(pressed_beam(true, ratio * EI, EI, segments, 2.5));
      }
}

TEST(MirrorBranches, OfAClampedColumnAreBothStableFromTheirFirstRowsOn) {
  for (const int segments : {2, 4})
    for (const double EA : {1e2, 1e4}) {
      SCOPED_TRACE(testing::Message() << segments << ", " << EA);
      expect_stable_branches(pressed_beam(false, EA, 1, segments, 4));
    }
}

TEST(MirrorBranches, CountsChangeBesideTheBranchPointOfTheStraightColumnOnly) {
  const StudyResult result = pressed_beam(true, 1e6, 1e3, 1, 2.5);
  const Branch& straight = result.branches.at(0);
  const auto& events = straight.events;
  const auto at = std::find_if(events.begin(), events.end(), [](const auto& e) {
    return e.kind == analysis::EventKind::branch_point;
  });
  ASSERT_NE(at, events.end());
  for (std::size_t i = 0; i < straight.samples.size(); ++i)
    EXPECT_EQ(value(result, straight, i, "index"), i <= at->row ? 0 : 1) << "row " << i;
}

}  // namespace
}  // namespace springfold::io
