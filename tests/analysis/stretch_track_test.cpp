// The state of a stretch at a given lambda, between its rows.
#include "analysis/stretch_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace springfold::analysis {
namespace {

/// Rows of the curve x = s, lambda = 1 - s^2, up to a little beyond the point where it turns back.
StretchTrack half_branch() {
  StretchTrack track;
  for (const double s : {-0.8, -0.55, -0.31, 0.0, 0.05}) {
    track.s.push_back(s);
    track.lambda.push_back(1 - s * s);
    track.x.push_back(Vector::Constant(1, s));
    track.is_stable.push_back(s <= 0);
  }
  return track;
}

TEST(StretchTrack, HasItsStateBesideAPointWhereItTurnsBack) {
  for (const double away : {1e-2, 1e-4, 1e-6}) {
    const auto state = state_near(half_branch(), 1 - away);
    ASSERT_TRUE(state);
    EXPECT_NEAR((*state)[0], -std::sqrt(away), 1e-12);  // by lambda itself: near zero
  }
}

TEST(StretchTrack, HasNoStateBeyondItsEnds) {
  EXPECT_FALSE(state_near(half_branch(), 1.01));
  EXPECT_FALSE(state_near(half_branch(), 0.3));
}

TEST(StretchTrack, GoesThroughNoKink) {
  // x = 0 up to s = 1, then x = 3 (s - 1); lambda = s.
  StretchTrack track;
  for (const auto& [s, x] :
       {std::pair{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {2.0, 3.0}, {3.0, 6.0}}) {
    track.s.push_back(s);
    track.lambda.push_back(s);
    track.x.push_back(Vector::Constant(1, x));
    track.is_stable.push_back(true);
  }
  EXPECT_NEAR((*state_near(track, 0.7))[0], 0, 1e-14);
  EXPECT_NEAR((*state_near(track, 1.3))[0], 0.9, 1e-13);
  EXPECT_NEAR((*state_near(track, 1.0))[0], 0, 1e-14);
}

}  // namespace
}  // namespace springfold::analysis
