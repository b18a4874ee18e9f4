// What a curve must not depend on: step lengths, direction of travel, units, the day of the week.
#include <gtest/gtest.h>

#include <cstring>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// A curve with something to find, from one end to the other.
struct Journey {
  std::string name{};
  std::function<Curve(const TraceOptions&)> forward{}, backward{};
};

template <class P>
Journey journey(std::string name, const P& problem, const StartPoint& first, double to,
                const StartPoint& last, double back_to, std::vector<Event> events = {}) {
  const auto go = [problem, events](const StartPoint& from, double end) {
    return [problem, events, from, end](const TraceOptions& options) {
      std::vector<Event> all = events;
      all.push_back(x_reaches(end));
      return follow(problem, from, all, options);
    };
  };
  return {std::move(name), go(first, to), go(last, back_to)};
}

StartPoint on_graph(const ScalarProblem& problem, double x, double dx) {
  return at(x, problem.F(x, 0), dx, 0);
}

StartPoint on_line(const PiecewiseLine& line, double x, double dx) {
  Vector F;
  line.residual(Vector::Constant(1, x), 0, line.piece_at(x), F);
  return at(x, F[0], dx, 0, line.piece_at(x));
}

std::vector<Journey> journeys() {
  const ScalarProblem ladder = fold_ladder(), fold = cusp(0.3), bent = strut(0.05);
  const PiecewiseLine line{1, {{-3, 0, 1}, {2.5, 0.5, 1}, {-1, 1, 1}, {2, 1.5, 1}, {4, -0.4, -1}}};
  const auto bent_at = [](double t, double dx) { return at(t, (t - 0.05) / std::sin(t), dx, 0); };
  const Event marked{"mark", [](const CurvePoint& p) { return p.x[0] - 0.123; }};
  return {
      journey("ladder", ladder, on_graph(ladder, -3, 1), 3, on_graph(ladder, 3, -1), -3, {marked}),
      journey("cusp", fold, on_graph(fold, -1, 1), 1, on_graph(fold, 1, -1), -1, {marked}),
      journey("strut", bent, bent_at(-2, 1), -0.2, bent_at(-0.2, -1), -2),
      journey("crossing", transcritical(), at(-1, -1, 1, 1), 1, at(1, 1, -1, -1), -1),
      journey("line", line, on_line(line, -1, 1), 2, on_line(line, 2, -1), -1, {marked})};
}

/// Special points without the end of the journey.
std::vector<Hit> points_before_end(const Curve& curve) {
  EXPECT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
  std::vector<Hit> hits = curve.hits;
  if (!hits.empty()) hits.pop_back();
  return hits;
}

TEST(SpecialPoints, DoNotDependOnTheStepLimits) {
  for (const Journey& j : journeys()) {
    SCOPED_TRACE(j.name);
    const auto reference = points_before_end(j.forward({}));
    ASSERT_FALSE(reference.empty());
    for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
      SCOPED_TRACE(factor);
      TraceOptions options;
      options.step.initial *= factor;
      options.step.maximum *= factor;
      expect_same_hits(points_before_end(j.forward(options)), reference, 1e-9);
    }
  }
}

TEST(SpecialPoints, AreTheSameOnTheWayBack) {
  for (const Journey& j : journeys()) {
    SCOPED_TRACE(j.name);
    auto back = points_before_end(j.backward({}));
    std::reverse(back.begin(), back.end());
    expect_same_hits(back, points_before_end(j.forward({})), 1e-9);
  }
}

TEST(Curve, LeadsThereAndBackAgain) {
  for (const ScalarProblem& problem : {fold_ladder(), cusp(0.3)}) {
    const StartPoint start = on_graph(problem, -1, 1);
    const Curve there = follow(problem, start, {x_reaches(1)});
    const CurvePoint& end = there.hits.back().point;
    const StartPoint turned{end.x, end.lambda, {}, {-end.tangent.dx, -end.tangent.dlambda}};
    const Curve back = follow(problem, turned, {x_reaches(-1)});
    ASSERT_EQ(back.stop, StopReason::event);
    EXPECT_NEAR(back.hits.back().point.lambda, start.lambda, 1e-12);
    EXPECT_NEAR(back.hits.back().point.x[0], -1, 1e-12);
  }
}

bool same_bits(const Vector& a, const Vector& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

bool same_bits(const CurvePoint& a, const CurvePoint& b) {
  return same_bits(a.x, b.x) && same_bits(a.tangent.dx, b.tangent.dx) &&
         std::memcmp(&a.lambda, &b.lambda, sizeof a.lambda) == 0 &&
         std::memcmp(&a.s, &b.s, sizeof a.s) == 0 && a.piece == b.piece && a.negative == b.negative;
}

TEST(Curve, IsTheSameToTheLastBitEveryTime) {
  for (const Journey& j : journeys()) {
    SCOPED_TRACE(j.name);
    const Curve a = j.forward({}), b = j.forward({});
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i)
      EXPECT_TRUE(same_bits(a.points[i], b.points[i])) << "point " << i;
    ASSERT_EQ(a.hits.size(), b.hits.size());
    for (std::size_t i = 0; i < a.hits.size(); ++i)
      EXPECT_TRUE(same_bits(a.hits[i].point, b.hits[i].point)) << a.hits[i].name;
    ASSERT_EQ(a.log.size(), b.log.size());
    for (std::size_t i = 0; i < a.log.size(); ++i) EXPECT_EQ(a.log[i].reason, b.log[i].reason);
  }
}

/// The same problem with x in another unit and the metric that undoes it, and with its equations
/// in another unit.
struct InOtherUnits {
  ScalarProblem problem{};
  double x_unit = 1, F_unit = 1;
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    const bool defined = problem.residual(x_unit * x, lambda, F);
    F *= F_unit;
    return defined;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const bool defined = problem.derivatives(x_unit * x, lambda, dF_dx, dF_dlambda);
    dF_dx *= F_unit * x_unit;
    dF_dlambda *= F_unit;
    return defined;
  }
  Vector metric() const { return Vector::Constant(1, x_unit * x_unit); }
};

TEST(Curve, DoesNotDependOnUnitsThatTheMetricUndoes) {
  const ScalarProblem ladder = fold_ladder();
  const Curve reference = follow(ladder, on_graph(ladder, -1, 1), {x_reaches(1)});
  for (const double unit : {0x1p-6, 0x1p3, 0.3, 10.0}) {
    SCOPED_TRACE(unit);
    StartPoint start = on_graph(ladder, -1, 1);
    start.x /= unit;
    start.towards.dx /= unit;
    const Curve scaled =
        follow(InOtherUnits{.problem = ladder, .x_unit = unit}, start, {x_reaches(1 / unit)});
    ASSERT_EQ(scaled.points.size(), reference.points.size());
    for (std::size_t i = 0; i < scaled.points.size(); ++i) {
      EXPECT_NEAR(scaled.points[i].x[0] * unit, reference.points[i].x[0], 1e-8);
      EXPECT_NEAR(scaled.points[i].s, reference.points[i].s, 1e-8);
    }
    ASSERT_EQ(scaled.hits.size(), reference.hits.size());
    for (std::size_t i = 0; i < scaled.hits.size(); ++i)
      EXPECT_NEAR(scaled.hits[i].point.lambda, reference.hits[i].point.lambda, 1e-11);
  }
}

TEST(Curve, DoesNotDependOnTheUnitOfTheEquations) {
  const ScalarProblem ladder = fold_ladder();
  const Curve reference = follow(ladder, on_graph(ladder, -1, 1), {x_reaches(1)});
  for (const double unit : {0.125, 8.0, 0.3}) {
    SCOPED_TRACE(unit);
    const Curve scaled = follow(InOtherUnits{.problem = ladder, .F_unit = unit},
                                on_graph(ladder, -1, 1), {x_reaches(1)});
    expect_same_hits(scaled.hits, reference.hits, 1e-11);
  }
}

TEST(Curve, IsTheSameToTheLastBitInUnitsThatArePowersOfTwo) {
  const ScalarProblem ladder = fold_ladder();
  const Curve reference = follow(ladder, on_graph(ladder, -1, 1), {x_reaches(1)});
  for (const double x_unit : {0x1p-20, 0x1p-1, 0x1p13})
    for (const double F_unit : {1.0, x_unit, 0x1p-9}) {
      SCOPED_TRACE(std::to_string(x_unit) + ", " + std::to_string(F_unit));
      StartPoint start = on_graph(ladder, -1, 1);
      start.x /= x_unit;
      start.towards.dx /= x_unit;
      const InOtherUnits problem{.problem = ladder, .x_unit = x_unit, .F_unit = F_unit};
      const TraceOptions options;
      const Curve scaled = trace(problem, start.x, start.lambda, ray_of(problem, start, options),
                                 {x_reaches(1 / x_unit)}, options);
      ASSERT_EQ(scaled.points.size(), reference.points.size());
      for (std::size_t i = 0; i < scaled.points.size(); ++i) {
        CurvePoint p = scaled.points[i];
        p.x *= x_unit;
        p.tangent.dx *= x_unit;
        EXPECT_TRUE(same_bits(p, reference.points[i])) << "point " << i;
      }
      ASSERT_EQ(scaled.hits.size(), reference.hits.size());
      for (std::size_t i = 0; i < scaled.hits.size(); ++i)
        EXPECT_EQ(scaled.hits[i].point.lambda, reference.hits[i].point.lambda);
    }
}

TEST(Curve, WalksInAMetricThatLeavesOutUnknowns) {
  // x_2 is a force that follows: with weight zero it does not count in the arc length.
  struct Follower : TwoModes {
    Follower() : TwoModes{1, 1.4} {}
    static Vector metric() { return Vector{{1, 0}}; }
  };
  const StartPoint start{Vector{{-1, 0}}, 2, {}, {Vector{{1, 0}}, -1}};
  const Curve curve = follow(Follower{}, start, {x_reaches(-0.1)});
  ASSERT_EQ(curve.stop, StopReason::event);
  for (const CurvePoint& p : curve.points) EXPECT_NEAR(p.lambda, 1 + p.x[0] * p.x[0], 1e-12);
}

}  // namespace
}  // namespace springfold::continuation
