// Two branches that cross under a small angle lie closer together than a step is off its tangent: the next step must go
// on along the branch that was followed, and the crossing must be seen.
#include "crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

struct Passage {
  double angle, bend, place, start;
  bool tilted;  ///< the branch p = angle l is followed
};

class SmallAngle : public testing::TestWithParam<Passage> {};

TEST_P(SmallAngle, IsCrossedOnTheBranchThatWasFollowedAndSeen) {
  const Passage& p = GetParam();
  const Crossing problem{p.angle, p.bend, p.place};
  const auto branch = [&](double l) { return p.bend * l * l / 2 + (p.tilted ? p.angle * l : 0); };
  const TraceOptions options;
  const StartPoint start = at(branch(p.start), p.place + p.start, 0, 1);
  const Curve curve = trace(problem, start.x, start.lambda, ray_of(problem, start, options),
                            {lambda_reaches(p.place + 1.2)}, options);
  ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
  for (const CurvePoint& point : curve.points)
    EXPECT_NEAR(point.x[0], branch(point.lambda - p.place), 1e-7) << "at s = " << point.s;
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::branch_point);
  EXPECT_NEAR(curve.hits[0].point.lambda, p.place, 1e-10 / std::min(1.0, 30 * p.angle));
}

// The first three were passed on the wrong branch, without a word, by engines that corrected from the tangent.
INSTANTIATE_TEST_SUITE_P(Crossings, SmallAngle,
                         testing::Values(Passage{0.0050431266008333633, -2.8955544588391997,
                                                 -0.063412876736054002, -0.30088974844983496,
                                                 false},
                                         Passage{0.010752398386990408, 2.5630953108294712,
                                                 0.092460232957076505, -0.71911135657306469, true},
                                         Passage{0.003, 1.5, 0.1, -0.4, false},
                                         Passage{0.001, -2, 0, -0.6, true},
                                         Passage{0.001, 0.3, -0.2, -0.9, false}));

TEST(SmallAngle, HasAJunctionInADiagram) {
  const Crossing problem{0.005, -1.7, 0.3};
  const double l = -0.5;
  const Diagram diagram =
      trace_diagram(problem, {{.x = Vector::Constant(1, -1.7 * l * l / 2), .lambda = 0.3 + l}},
                    {lambda_reaches(-0.9), lambda_reaches(1.5)}, {});
  ASSERT_EQ(diagram.junctions.size(), 1u);
  EXPECT_EQ(diagram.junctions.front().ways.size(), 4u);
  EXPECT_TRUE(diagram.doubts.empty()) << diagram.doubts.front();
}

/// Where the ways begin the curves bend by more than they are apart: from 4 to 40 times as much.
TEST(SmallAngle, HasWaysWithTangentsOfBothCurvesOnAPathThatBends) {
  for (const double angle : {4e-4, 1e-3})
    for (const double bend : {2.0, 8.0}) {
      const Crossing problem{angle, bend, 0};
      const double l = -0.83;
      const Diagram diagram =
          trace_diagram(problem, {{.x = Vector::Constant(1, bend * l * l / 2), .lambda = l}},
                        {lambda_reaches(-1), lambda_reaches(1)}, {});
      ASSERT_TRUE(diagram.doubts.empty()) << diagram.doubts.front();
      ASSERT_EQ(diagram.junctions.size(), 1u);
      const auto& ways = diagram.junctions.front().ways;
      ASSERT_EQ(ways.size(), 4u);
      for (const double slope : {0.0, angle})
        for (const double sense : {-1.0, 1.0})
          EXPECT_EQ(std::count_if(ways.begin(), ways.end(),
                                  [&](const Way& way) {
                                    const Direction& d = way.point.tangent;
                                    return d.dlambda * sense > 0 &&
                                           std::abs(d.dx[0] / d.dlambda - slope) < 1e-9;
                                  }),
                    1)
              << angle << ", " << bend;
      int ends = 0;  // of the curve that the start does not lie on
      for (const Branch& branch : diagram.branches) {
        const CurvePoint& end = branch.curve.hits.back().point;
        const double off = end.x[0] - bend * end.lambda * end.lambda / 2;
        if (std::abs(off - angle * end.lambda) < 1e-10) ++ends;
      }
      EXPECT_EQ(ends, 2) << angle << ", " << bend;
    }
}

/// V = z^4 / 4 - (gap / 2)^2 z^2 / 2 - lambda z: limit points at z = -+ gap / (2 sqrt 3), unstable between them.
struct NearFolds {
  double gap = 0.02;
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = Vector::Constant(1, x[0] * x[0] * x[0] - gap * gap / 4 * x[0] - lambda);
    return true;
  }
  bool derivatives(const Vector& x, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix::Constant(1, 1, 3 * x[0] * x[0] - gap * gap / 4);
    dF_dlambda = Vector::Constant(1, -1);
    return true;
  }
};

TEST(NeighbouringEvents, HaveAPointBetweenThemThatKnowsTheIndexThere) {
  const NearFolds problem;
  const auto load = [&](double x) { return x * x * x - problem.gap * problem.gap / 4 * x; };
  const TraceOptions options;
  const StartPoint start = at(-1, load(-1), 1, 0);
  const Curve curve = trace(problem, start.x, start.lambda, ray_of(problem, start, options),
                            {x_reaches(1)}, options);
  std::vector<const Hit*> folds;
  for (const Hit& hit : curve.hits)
    if (hit.kind == HitKind::limit_point) folds.push_back(&hit);
  ASSERT_EQ(folds.size(), 2u);
  bool seen = false;
  for (const CurvePoint& p : curve.points) {
    if (p.s <= folds[0]->point.s || p.s >= folds[1]->point.s) {
      EXPECT_EQ(p.negative, 0);
      continue;
    }
    seen = true;
    EXPECT_EQ(p.negative, 1);
    EXPECT_NEAR(load(p.x[0]), p.lambda, 1e-12);
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace springfold::continuation
