// A fold of one piece exactly on the switching surface: reported once, as what the whole passage is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kink_problems.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::ElementsAre;

struct FoldPassage {
  Cubic left{}, right{};
  HitKind kind = HitKind::kink;
};

/// lambda near 0 is a x, b x^2 or c x^3 on each side; it turns back where its sense differs.
const std::vector<FoldPassage> passages{
    {{.b = -1}, {.a = -1}, HitKind::corner},  // arrives at its maximum
    {{.b = -1}, {.a = 1}, HitKind::kink},
    {{.b = 1}, {.a = -1}, HitKind::kink},
    {{.b = 1}, {.a = 1}, HitKind::corner},
    {{.a = 1}, {.b = -1}, HitKind::corner},  // leaves at its maximum
    {{.a = 1}, {.b = 1}, HitKind::kink},
    {{.a = -1}, {.b = 1}, HitKind::corner},
    {{.b = -1}, {.b = -3}, HitKind::corner},  // both: the curvature jumps
    {{.b = -1}, {.b = 2}, HitKind::kink},
    {{.c = 1}, {.a = 1}, HitKind::kink},  // arrives at an inflection
    {{.c = 1}, {.a = -1}, HitKind::corner},
    {{.c = 1}, {.b = -1}, HitKind::corner}};

Curve follow_passage(const FoldPassage& p, double from, double to, const TraceOptions& options) {
  const TwoGraphs problem = two_graphs(p.left, p.right);
  const double lambda = from < 0 ? p.left(from) : p.right(from);
  const Piece piece = above({from > 0});
  return follow(problem, at(from, lambda, to - from, 0, piece), {x_reaches(to)}, options);
}

TEST(KinkFold, OnTheSurfaceIsReportedOnceAsCornerOrKink) {
  for (std::size_t i = 0; i < passages.size(); ++i)
    for (const double direction : {1.0, -1.0})
      for (const double longest : {0.05, 0.013, 0.2}) {
        SCOPED_TRACE("passage " + std::to_string(i) + " direction " + std::to_string(direction) +
                     " steps " + std::to_string(longest));
        const Curve curve =
            follow_passage(passages[i], -0.7 * direction, 0.6 * direction, steps_up_to(longest));
        ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
        ASSERT_EQ(curve.hits.size(), 2u);
        EXPECT_EQ(curve.hits[0].kind, passages[i].kind);
        EXPECT_NEAR(curve.hits[0].point.x[0], 0, 1e-12);
        EXPECT_NEAR(curve.hits[0].point.lambda, 0, 1e-12);
      }
}

TEST(KinkFold, HasTheNegativeEigenvaluesOfBothSides) {
  for (const FoldPassage& p : passages)
    for (const double direction : {1.0, -1.0}) {
      const Curve curve = follow_passage(p, -0.7 * direction, 0.6 * direction, {});
      const auto negative = [&](double x) {
        return (x < 0 ? p.left.slope()(x) : p.right.slope()(x)) < 0 ? 1 : 0;
      };
      ASSERT_EQ(curve.hits.size(), 2u);
      EXPECT_EQ(curve.hits[0].point.negative, negative(-1e-3 * direction));
      EXPECT_EQ(curve.hits[0].leaving.at(0).negative, negative(1e-3 * direction));
      for (const CurvePoint& point : curve.points)
        EXPECT_EQ(point.negative, negative(point.x[0])) << point.x[0];
    }
}

TEST(KinkFold, NearTheSurfaceIsALimitPointBesideIt) {
  for (const double flatness : {1.0, 0.1, 0.01})
    for (const double gap : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      SCOPED_TRACE(std::to_string(gap) + " of a curvature of " + std::to_string(flatness));
      // lambda = -flatness (2 gap x + x^2): turns at x = -gap
      for (const double after : {-2.0, 1.0}) {
        const FoldPassage p{{.a = -2 * gap * flatness, .b = -flatness}, {.a = after}};
        const Curve curve = follow_passage(p, -0.5, 0.5, {});
        ASSERT_EQ(curve.hits.size(), 3u);
        EXPECT_EQ(curve.hits[0].kind, HitKind::limit_point);
        EXPECT_NEAR(curve.hits[0].point.x[0], -gap, 1e-10);
        EXPECT_EQ(curve.hits[1].kind, after > 0 ? HitKind::corner : HitKind::kink);
        EXPECT_NEAR(curve.hits[1].point.x[0], 0, 1e-12);
      }
    }
}

}  // namespace
}  // namespace springfold::continuation
