// Whole bifurcation diagrams against closed forms: how many branches, where they meet, each once.
#include "springfold/continuation/diagram.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using std::numbers::pi;

std::vector<Event> between(double low, double high) {
  return {lambda_reaches(low), lambda_reaches(high)};
}

/// Every traced curve meets the laws; every way of every junction is traced at most once.
Diagram whole(ProblemView problem, const std::vector<DiagramStart>& starts,
              const std::vector<Event>& events, const DiagramOptions& options = {}) {
  Diagram diagram = trace_diagram(problem, starts, events, options);
  for (const Branch& branch : diagram.branches)
    for (const CurvePoint& p : branch.curve.points) {
      Vector F;
      EXPECT_TRUE(problem.residual(p.x, p.lambda, p.piece, F));
      EXPECT_LE(F.norm(), 1e-11);
    }
  return diagram;
}

bool every_way_is_traced(const Diagram& diagram) {
  for (const Junction& junction : diagram.junctions)
    for (const Way& way : junction.ways)
      if (way.branch < 0) return false;
  return true;
}

long count(const Diagram& diagram, StopReason stop) {
  return std::count_if(diagram.branches.begin(), diagram.branches.end(),
                       [stop](const Branch& branch) { return branch.curve.stop == stop; });
}

/// 1/2 (m1 - l) x^2 + 1/2 (m2 - l) y^2 + 1/4 (a x^4 + 2 b x^2 y^2 + c y^4): two modes and their
/// interaction.
struct Modes {
  double m1 = 0, m2 = 0, a = 1, b = 0, c = 1;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& z, double l, Vector& F) const {
    const double x = z[0], y = z[1];
    F = Vector{{(m1 - l) * x + a * x * x * x + b * x * y * y,
                (m2 - l) * y + c * y * y * y + b * x * x * y}};
    return true;
  }
  bool derivatives(const Vector& z, double l, Matrix& H, Vector& F_lambda) const {
    const double x = z[0], y = z[1];
    H = Matrix{{m1 - l + 3 * a * x * x + b * y * y, 2 * b * x * y},
               {2 * b * x * y, m2 - l + 3 * c * y * y + b * x * x}};
    F_lambda = -z;
    return true;
  }
};

/// Two springs from (-1, 0) and (1, 0) to a loaded point (x, y), unstretched at (0, +-h).
struct Truss {
  double h = 3;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool add(const Vector& z, Vector* F, Matrix* H) const {
    const double L0 = std::hypot(1.0, h);
    for (const double side : {-1.0, 1.0}) {
      const Vector d{{z[0] - side, z[1]}};
      const double L = d.norm();
      if (!(L > 0)) return false;
      if (F) *F += (1 - L0 / L) * d;
      if (H) *H += (1 - L0 / L) * Matrix::Identity(2, 2) + L0 / (L * L * L) * d * d.transpose();
    }
    return true;
  }
  bool residual(const Vector& z, double l, Vector& F) const {
    F = Vector{{0, l}};
    return add(z, &F, nullptr);
  }
  bool derivatives(const Vector& z, double, Matrix& H, Vector& F_lambda) const {
    H = Matrix::Zero(2, 2);
    F_lambda = Vector{{0, 1}};
    return add(z, nullptr, &H);
  }
};

/// sin x = lambda, with x an angle.
struct Angle {
  static Index size() { return 1; }
  static Vector periods() { return Vector::Constant(1, 2 * pi); }
  static bool residual(const Vector& x, double l, Vector& F) {
    F = Vector::Constant(1, std::sin(x[0]) - l);
    return true;
  }
  static bool derivatives(const Vector& x, double, Matrix& H, Vector& F_lambda) {
    H = Matrix::Constant(1, 1, std::cos(x[0]));
    F_lambda = Vector::Constant(1, -1);
    return true;
  }
};

TEST(ClosedCurve, IsTracedOnceWithEachLimitPointOnce) {
  const Diagram diagram = whole(circle(), {{Vector{{0.6}}, 0.8}}, {});
  ASSERT_EQ(diagram.branches.size(), 1u);
  const Curve& curve = diagram.branches[0].curve;
  EXPECT_EQ(curve.stop, StopReason::closed);
  EXPECT_EQ(hits_of(curve, HitKind::limit_point).size(), 2u);
  EXPECT_NEAR(curve.points.back().x[0], 0.6, 1e-10);
  EXPECT_NEAR(curve.points.back().s, 2 * pi, 0.05);
  EXPECT_TRUE(diagram.doubts.empty());
}

TEST(ClosedCurve, ThatStartsAtALimitPointEndsThereAfterOneLap) {
  const ScalarProblem problem = circle();
  for (const double longest : {0.01, 0.05, 0.1}) {
    const Curve curve = follow(problem, at(0, 1, 1, 0), {}, steps_up_to(longest));
    EXPECT_EQ(curve.stop, StopReason::closed);
    EXPECT_LT(curve.points.back().s, 6.3);
    EXPECT_EQ(hits_of(curve, HitKind::limit_point).size(), 2u) << "the start's own one too";
  }
}

TEST(ClosedCurve, OfAnAngleEndsAfterOneTurn) {
  const Diagram diagram = whole(Angle{}, {{Vector{{0.1}}, std::sin(0.1)}}, {});
  ASSERT_EQ(diagram.branches.size(), 1u);
  const Curve& curve = diagram.branches[0].curve;
  EXPECT_EQ(curve.stop, StopReason::closed);
  EXPECT_EQ(curve.hits.size(), 2u);
  EXPECT_NEAR(std::abs(curve.points.back().x[0] - curve.points.front().x[0]), 2 * pi, 1e-9);
}

TEST(Diagram, OfAPitchforkHasItsTwoArms) {
  const auto problem = pitchfork();
  const Diagram diagram = whole(problem, {{Vector{{0.0}}, -0.5}}, between(-1, 1));
  ASSERT_EQ(diagram.junctions.size(), 1u);
  EXPECT_EQ(diagram.junctions[0].ways.size(), 4u);
  ASSERT_EQ(diagram.branches.size(), 4u);  // both directions of the trivial branch, two arms
  EXPECT_TRUE(every_way_is_traced(diagram));
  EXPECT_TRUE(diagram.doubts.empty()) << diagram.doubts.front();
  for (const std::size_t arm : {2u, 3u}) {
    const Branch& branch = diagram.branches[arm];
    EXPECT_EQ(branch.junction, 0);
    EXPECT_EQ(branch.depth, 1);
    EXPECT_EQ(branch.curve.stop, StopReason::event);
    EXPECT_NEAR(branch.curve.points.front().x[0], 0, 1e-10) << "begins at the branch point itself";
    double s = -1;
    for (const CurvePoint& p : branch.curve.points) {
      EXPECT_NEAR(p.lambda, p.x[0] * p.x[0], 1e-10);
      EXPECT_GT(p.s, s);
      s = p.s;
    }
  }
  EXPECT_LT(
      diagram.branches[2].curve.points.back().x[0] * diagram.branches[3].curve.points.back().x[0],
      0);
}

TEST(Diagram, OfCrossingLinesHasBothLines) {
  const Diagram diagram = whole(transcritical(), {{Vector{{0.0}}, -0.5}}, between(-1, 1));
  EXPECT_EQ(diagram.branches.size(), 4u);
  EXPECT_EQ(count(diagram, StopReason::event), 4);
  EXPECT_TRUE(every_way_is_traced(diagram));
}

TEST(Diagram, FromABranchPointHasAllItsBranches) {
  const Diagram diagram = whole(pitchfork(), {{Vector{{0.0}}, 0}}, between(-1, 1));
  EXPECT_EQ(diagram.junctions.size(), 1u);
  EXPECT_EQ(diagram.branches.size(), 4u);
  EXPECT_TRUE(every_way_is_traced(diagram));
  for (const Branch& branch : diagram.branches) EXPECT_EQ(branch.depth, 0);
}

TEST(Diagram, WithoutDepthStaysOnItsBranchAndSaysWhatItLeftOut) {
  DiagramOptions options;
  options.maximum_depth = 0;
  const Diagram diagram = whole(pitchfork(), {{Vector{{0.0}}, -0.5}}, between(-1, 1), options);
  EXPECT_EQ(diagram.branches.size(), 2u);
  EXPECT_EQ(diagram.not_followed, 2);
  EXPECT_FALSE(diagram.doubts.empty());
}

TEST(Diagram, OfTwoModesHasTheirSecondaryBranches) {
  // X branch from l = 0 loses stability to a mixed branch at (a m2 - b m1)/(a - b), the Y branch
  // from l = 0.2 at (c m1 - b m2)/(c - b).
  const Modes modes{.m1 = 0, .m2 = 0.2, .a = 1, .b = 0.5, .c = 1};
  const Diagram diagram = whole(modes, {{Vector{{0.0, 0.0}}, -0.5}}, between(-1, 1));
  // On the trivial branch two; on the X arms one each at 0.4; the Y branch has none (-0.2 < 0.2).
  ASSERT_EQ(diagram.junctions.size(), 4u);
  EXPECT_TRUE(every_way_is_traced(diagram));
  EXPECT_TRUE(diagram.doubts.empty()) << diagram.doubts.front();
  // Trivial 2, X 2, Y 2, mixed 2 x 2.
  EXPECT_EQ(diagram.branches.size(), 10u);
  EXPECT_EQ(count(diagram, StopReason::event), 10);
  for (const Junction& junction : diagram.junctions)
    if (junction.depth == 1) {
      EXPECT_NEAR(junction.point.lambda, 0.4, 1e-10);
      EXPECT_NEAR(std::abs(junction.point.x[0]), std::sqrt(0.4), 1e-10);
    }
}

TEST(Diagram, OfADoublePointHasTheMixedBranchesThatExist) {
  for (const double b : {0.3, 3.0, -0.5}) {
    const Modes modes{.m1 = 0, .m2 = 0, .a = 1, .b = b, .c = 1.5};
    const double D = modes.a * modes.c - b * b;
    const bool mixed = (modes.c - b) / D > 0 && (modes.a - b) / D > 0;
    const Diagram diagram = whole(modes, {{Vector{{0.0, 0.0}}, -0.5}}, between(-1, 1));
    ASSERT_EQ(diagram.junctions.size(), 1u) << b;
    EXPECT_EQ(diagram.junctions[0].multiplicity, 2);
    EXPECT_EQ(diagram.junctions[0].ways.size(), mixed ? 10u : 6u) << b;
    EXPECT_EQ(diagram.branches.size(), mixed ? 10u : 6u) << b;
    EXPECT_TRUE(every_way_is_traced(diagram)) << b;
  }
}

TEST(Diagram, OfATrussClosesItsSwayBranchesAndTracesEachOnce) {
  const Truss truss{};
  const double end = 1.2 * truss.h;
  const auto y = [](const CurvePoint& p) { return p.x[1]; };
  const std::vector<Event> range{
      stop_where("low", [=](const CurvePoint& p) { return y(p) + end; }),
      stop_where("high", [=](const CurvePoint& p) { return end - y(p); })};
  const Diagram diagram = whole(truss, {{Vector{{0.0, truss.h}}, 0}}, range);
  // Sway branch points where L^3 - L0 L^2 + L0 = 0: two heights, above and below.
  ASSERT_EQ(diagram.junctions.size(), 4u);
  EXPECT_TRUE(every_way_is_traced(diagram));
  // Straight path: two directions. The upper sway branch goes round both supports, through the lower
  // branch point and back: one lap. The four inner ones end in the supports.
  EXPECT_EQ(diagram.branches.size(), 7u);
  EXPECT_EQ(count(diagram, StopReason::joined), 1);
  EXPECT_EQ(count(diagram, StopReason::event), 2);
  EXPECT_EQ(count(diagram, StopReason::step_too_small), 4);
  EXPECT_EQ(diagram.doubts.size(), 4u);
  for (const Doubt& doubt : diagram.doubts)
    EXPECT_EQ(doubt.kind, DoubtKind::stopped_early) << doubt;
  for (const Branch& branch : diagram.branches)
    if (branch.curve.stop == StopReason::step_too_small) {
      EXPECT_NEAR(std::abs(branch.curve.points.back().x[0]), 1, 1e-4);
    }
}

TEST(Diagram, DoesNotTraceAStartTwice) {
  const Diagram diagram =
      whole(circle(), {{Vector{{0.6}}, 0.8}, {Vector{{-0.8}}, 0.6}, {Vector{{0.6}}, 0.8}}, {});
  EXPECT_EQ(diagram.branches.size(), 1u);
}

TEST(Diagram, FollowsAllWaysOutOfABranchingKink) {
  const BarsInSeries bars{.after = -0.5};
  const Diagram diagram = whole(bars, {{Vector{{0.2, 0.2}}, 0.4, Piece{-1, -1}}}, between(0, 3));
  ASSERT_EQ(diagram.junctions.size(), 1u);
  EXPECT_EQ(diagram.junctions[0].kind, HitKind::branching_kink);
  EXPECT_EQ(diagram.junctions[0].ways.size(), 4u);  // three ways out and the way back
  EXPECT_EQ(diagram.branches.size(), 5u);           // two directions of the start, three ways
  EXPECT_TRUE(every_way_is_traced(diagram));
}

TEST(Diagram, IsTheSameEveryTime) {
  const Modes modes{.m1 = 0, .m2 = 0.2, .a = 1, .b = 0.5, .c = 1};
  const Diagram a = whole(modes, {{Vector{{0.0, 0.0}}, -0.5}}, between(-1, 1));
  const Diagram b = whole(modes, {{Vector{{0.0, 0.0}}, -0.5}}, between(-1, 1));
  ASSERT_EQ(a.branches.size(), b.branches.size());
  for (std::size_t i = 0; i < a.branches.size(); ++i) {
    ASSERT_EQ(a.branches[i].curve.points.size(), b.branches[i].curve.points.size());
    for (std::size_t k = 0; k < a.branches[i].curve.points.size(); ++k)
      EXPECT_EQ(a.branches[i].curve.points[k].x, b.branches[i].curve.points[k].x);
  }
}

TEST(Diagram, HasNoMoreBranchesThanAskedForAndCountsTheTwoHalvesOfAStartAsOne) {
  const TwoModes modes{1, 1.4};
  for (const double lambda :
       {0.2, 1.0})  // a regular start, and one on a branch point with four ways
    for (const int most : {1, 2, 3}) {
      DiagramOptions options;
      options.maximum_branches = most;
      const Diagram diagram =
          trace_diagram(modes, {{.x = Vector::Zero(2), .lambda = lambda, .piece = {}}},
                        {lambda_reaches(0), lambda_reaches(2)}, options);
      EXPECT_EQ(diagram.branches.size(), static_cast<std::size_t>(lambda < 1 ? most + 1 : most));
      EXPECT_GT(diagram.not_followed, 0);
    }
}

}  // namespace
}  // namespace springfold::continuation
