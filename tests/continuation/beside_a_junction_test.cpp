// What lies on a branch just beside the junction that it leaves: nearer than the first point of its trace.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Energy -l x^2/2 + (m - l) y^2/2 + x^4/4 + b x^2 y^2/2 + y^4/4. The branch x^2 = l, y = 0 of the first mode is
/// crossed by another one at x^2 = d^2 for b = 1 - m / d^2.
struct MixedModes {
  double d = 1, m = 0.01, more = 0;  ///< `more` holds y
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  double b() const { return 1 - m / (d * d); }
  bool residual(const Vector& z, double l, Vector& F) const {
    const double x = z[0], y = z[1];
    F = Vector{{(x * x + b() * y * y - l) * x, (m + more - l + y * y + b() * x * x) * y}};
    return true;
  }
  bool derivatives(const Vector& z, double l, Matrix& H, Vector& F_lambda) const {
    const double x = z[0], y = z[1];
    H = Matrix{{3 * x * x + b() * y * y - l, 2 * b() * x * y},
               {2 * b() * x * y, m + more - l + 3 * y * y + b() * x * x}};
    F_lambda = -z;
    return true;
  }
};

/// The same with a spring k that holds y on its positive side alone, and rests along y = 0: half of a branch leaves
/// where each of both pieces is singular, at x^2 = d^2 and at x^2 = d^2 (m + k) / m.
struct MixedHalves {
  double d = 1, m = 0.01, k = 0.003;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  static Index switch_count() { return 1; }
  MixedModes smooth(const Piece& piece) const {
    return {.d = d, .m = m, .more = piece[0] > 0 ? k : 0};
  }
  bool residual(const Vector& z, double l, const Piece& piece, Vector& F) const {
    return smooth(piece).residual(z, l, F);
  }
  bool derivatives(const Vector& z, double l, const Piece& piece, Matrix& H,
                   Vector& F_lambda) const {
    return smooth(piece).derivatives(z, l, H, F_lambda);
  }
  static bool switches(const Vector& z, double, Vector& g) {
    g = Vector::Constant(1, z[1]);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{0, 1}};
    dg_dlambda = Vector::Zero(1);
    return true;
  }
};

/// (x^2 - l) x = 0.
struct PlainPitchfork {
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  static bool residual(const Vector& z, double l, Vector& F) {
    F = Vector::Constant(1, (z[0] * z[0] - l) * z[0]);
    return true;
  }
  static bool derivatives(const Vector& z, double l, Matrix& H, Vector& F_lambda) {
    H = Matrix::Constant(1, 1, 3 * z[0] * z[0] - l);
    F_lambda = -z;
    return true;
  }
};

constexpr double near_places[] = {0.5, 0.1, 0.02, 0.01, 0.005, 0.002, 0.001};

Diagram around_zero(ProblemView problem, std::vector<Event> events, int depth,
                    const Piece& piece = {}) {
  events.push_back(lambda_reaches(0.4));
  events.push_back(lambda_reaches(-0.2));
  DiagramOptions options;
  options.maximum_depth = depth;
  return trace_diagram(problem, {{Vector::Zero(problem.size()), -0.1, piece}}, events, options);
}

std::vector<const Branch*> first_branches(const Diagram& diagram) {
  std::vector<const Branch*> list;
  for (const Branch& branch : diagram.branches)
    if (branch.junction >= 0 &&
        diagram.junctions[static_cast<std::size_t>(branch.junction)].point.x.norm() < 1e-9 &&
        std::abs(diagram.junctions[static_cast<std::size_t>(branch.junction)].point.lambda) < 1e-9)
      list.push_back(&branch);
  return list;
}

Event place_is(double x, EventAction action) {
  return {.name = "place",
          .value = [x](const CurvePoint& p) { return std::abs(p.x[0]) - x; },
          .action = action,
          .tag = 7};
}

TEST(BesideAJunction, BranchPointsAreJunctionsAsFarAwayOnesAre) {
  for (const double d : near_places) {
    SCOPED_TRACE(d);
    const Diagram diagram = around_zero(MixedModes{.d = d}, {}, 1);
    const auto branches = first_branches(diagram);
    ASSERT_EQ(branches.size(), 2U);
    for (const Branch* branch : branches) {
      const auto crossings = hits_of(branch->curve, HitKind::branch_point);
      ASSERT_EQ(crossings.size(), 1U);
      const Hit& hit = crossings[0];
      EXPECT_NEAR(std::abs(hit.point.x[0]), d, 1e-10);
      EXPECT_LE(std::abs(hit.point.s - std::hypot(d, d * d)), 0.2 * d);
      ASSERT_GE(hit.junction, 0);
      const Junction& junction = diagram.junctions[static_cast<std::size_t>(hit.junction)];
      EXPECT_EQ(junction.ways.size(), 4U);
      EXPECT_TRUE(junction.complete);
      const Way& on = junction.ways[static_cast<std::size_t>(hit.way_on)];
      EXPECT_GT(on.point.tangent.dx[0] * hit.point.x[0], 0);
    }
  }
}

TEST(BesideAJunction, BranchesThatCrossThereAreTraced) {
  for (const double d : near_places) {
    SCOPED_TRACE(d);
    const Diagram diagram = around_zero(MixedModes{.d = d}, {}, 2);
    const auto mixed =
        std::count_if(diagram.branches.begin(), diagram.branches.end(), [](const Branch& branch) {
          return std::any_of(branch.curve.points.begin(), branch.curve.points.end(),
                             [](const CurvePoint& p) { return std::abs(p.x[0] * p.x[1]) > 1e-12; });
        });
    EXPECT_EQ(mixed, 4);
  }
}

TEST(BesideAJunction, HalfBranchesBesideSpringsThatRestAreMet) {
  for (const Piece& side : {Piece{1}, Piece{-1}})
    for (const double d : {0.1, 0.01, 0.005, 0.0018, 0.0015, 0.001}) {
      SCOPED_TRACE(d);
      const MixedHalves problem{.d = d};
      const Diagram diagram = around_zero(problem, {}, 2, side);
      const auto branches = first_branches(diagram);
      ASSERT_EQ(branches.size(), 2U);
      for (const Branch* branch : branches) {
        std::vector<double> found;
        for (const Hit& hit : hits_of(branch->curve, HitKind::branching_kink)) {
          found.push_back(std::abs(hit.point.x[0]));
          ASSERT_EQ(hit.leaving.size(), 2U);
          EXPECT_GT(hit.leaving[0].tangent.dx[0] * hit.point.x[0], 0) << "straight on";
          EXPECT_GE(hit.junction, 0);
        }
        ASSERT_EQ(found.size(), 2U);
        EXPECT_NEAR(found[0], d, 1e-9);
        EXPECT_NEAR(found[1], d * std::sqrt((problem.m + problem.k) / problem.m), 1e-9);
      }
    }
}

TEST(BesideAJunction, BranchPointsThatCannotBeToldFromTheirSurroundingsAreSaidToBeUnresolved) {
  for (const double d : {0.002, 0.0015, 0.001, 0.0007}) {
    SCOPED_TRACE(d);
    const Diagram diagram = around_zero(MixedModes{.d = d, .m = 0.3}, {}, 1);
    ASSERT_EQ(first_branches(diagram).size(), 2U);
    for (const Branch* branch : first_branches(diagram)) {
      const auto& hits = branch->curve.hits;
      EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [d](const Hit& hit) {
        return (hit.kind == HitKind::branch_point || hit.kind == HitKind::unresolved) &&
               std::abs(std::abs(hit.point.x[0]) - d) < 0.2 * d;
      }));
    }
  }
}

TEST(BesideAJunction, EventsAreMetAndEndTheBranch) {
  for (const double d : near_places) {
    SCOPED_TRACE(d);
    for (const EventAction action : {EventAction::record, EventAction::stop}) {
      const Diagram diagram = around_zero(PlainPitchfork{}, {place_is(d, action)}, 1);
      const auto branches = first_branches(diagram);
      ASSERT_EQ(branches.size(), 2U);
      for (const Branch* branch : branches) {
        const auto events = hits_of(branch->curve, HitKind::user);
        ASSERT_FALSE(events.empty());
        EXPECT_EQ(events[0].name, "place");
        EXPECT_EQ(events[0].tag, 7);
        EXPECT_NEAR(std::abs(events[0].point.x[0]), d, 1e-10);
        EXPECT_GT(events[0].point.tangent.dx[0] * events[0].point.x[0], 0);
        const bool stops = action == EventAction::stop;
        EXPECT_EQ(events.size(), stops ? 1U : 2U);
        EXPECT_EQ(branch->curve.stop, StopReason::event);
        EXPECT_EQ(branch->curve.stop_detail, stops ? "place" : lambda_reaches(0.4).name);
        for (const CurvePoint& p : branch->curve.points)
          EXPECT_TRUE(!stops || std::abs(p.x[0]) < d + 1e-10);
      }
    }
  }
}

}  // namespace
}  // namespace springfold::continuation
