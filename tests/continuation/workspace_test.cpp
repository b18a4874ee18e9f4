// A walk evaluates and factorises nothing twice.
#include "continuation/points/workspace.hpp"

#include <map>
#include <utility>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Another problem whose evaluations are counted place by place.
template <class P>
struct CountedCalls {
  P problem{};
  using Places = std::map<std::pair<std::vector<double>, double>, int>;
  mutable Places linearised{};
  mutable int together = 0;

  Index size() const { return problem.size(); }
  bool symmetric() const { return problem.symmetric(); }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    return problem.residual(x, lambda, F);
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    ++linearised[{{x.begin(), x.end()}, lambda}];
    return problem.derivatives(x, lambda, dF_dx, dF_dlambda);
  }
  bool equations(const Vector& x, double lambda, Vector& F, Matrix& dF_dx,
                 Vector& dF_dlambda) const {
    ++together;
    return residual(x, lambda, F) && derivatives(x, lambda, dF_dx, dF_dlambda);
  }
};

TEST(AWalk, LinearisesNoPlaceTwice) {
  CountedCalls<ScalarProblem> counted{graph([](double x) { return x + 0.1 * std::sin(x); },
                                            [](double x) { return 1 + 0.1 * std::cos(x); })};
  TraceOptions options;
  options.maximum_points = 60;
  const Vector start = Vector::Constant(1, 0.3);
  const double lambda = 0.3 + 0.1 * std::sin(0.3);
  const Ray ray = ray_of(counted, {start, lambda, {}, {start, 1}}, options);
  counted.linearised.clear();
  counted.together = 0;
  const Curve curve = trace(counted, start, lambda, ray, {}, options);
  ASSERT_TRUE(curve.hits.empty() && curve.log.empty());
  int most = 0;
  for (const auto& [place, times] : counted.linearised)
    if (place.second > lambda + 1e-9) most = std::max(most, times);
  EXPECT_EQ(most, 1);
  // A guess or two and the point itself, of every step and of its middle.
  const auto steps = static_cast<int>(curve.points.size()) - 1;
  EXPECT_LE(counted.together, 2 * 3 * steps);
  EXPECT_GE(counted.together, 2 * 2 * steps);
}

TEST(AWalk, IsTheSameWhetherEquationsAreEvaluatedTogetherOrApart) {
  const CountedCalls<TwoModes> together{{1, 1.4}};
  const TwoModes apart{1, 1.4};
  const StartPoint start{Vector{{0, 0}}, 0.5, {}, {Vector{{0, 0}}, 1}};
  const Curve a = follow(together, start, {lambda_reaches(2)}),
              b = follow(apart, start, {lambda_reaches(2)});
  EXPECT_GT(together.together, 0);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i].x, b.points[i].x);
  expect_same_hits(a.hits, b.hits, 1e-300);
}

TEST(AWalk, AsksForNoFurtherDerivativesForAnEventThatIsZeroAllAlongAStraightBranch) {
  const StartPoint start{Vector{{0, 0}}, 0.1, {}, {Vector{{0, 0}}, 1}};
  const Event zero{"zero", [](const CurvePoint& p) { return p.x[0] + p.tangent.dx[1]; }};
  const CountedCalls<TwoModes> with{{1, 1.4}}, without{{1, 1.4}};
  const Curve a = follow(with, start, {zero, lambda_reaches(0.7)}),
              b = follow(without, start, {lambda_reaches(0.7)});
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_GT(a.points.size(), 10u);
  EXPECT_EQ(with.together, without.together);
  EXPECT_EQ(with.linearised.size(), without.linearised.size());
}

TEST(AWalk, OverwritesThePlaceThatHasNotBeenAskedForTheLongest) {
  const ScalarProblem line = graph([](double x) { return x; }, [](double) { return 1.0; });
  const auto memory = workspace();
  const auto ask = [&](double x) {
    return linearised_at(line, *memory, Vector::Constant(1, x), x, {});
  };
  LinearisedPoint* const first = ask(0);
  for (int k = 1; k < 12; ++k) ask(k);
  EXPECT_EQ(ask(0), first);  // the first that came, and the last that was asked for
  for (int k = 20; k < 31; ++k) EXPECT_NE(ask(k), first) << k;
  EXPECT_EQ(first->x[0], 0);
  EXPECT_EQ(ask(0), first);
}

TEST(APoint, ThatIsNotSetYetIsNotTheSameAsOneAtTheOrigin) {
  const CurvePoint none{};
  CurvePoint origin{};
  origin.x = Vector::Zero(3);
  EXPECT_FALSE(is_same(none, origin));
  CurvePoint with_tangent = origin;
  with_tangent.tangent.dx = Vector::Zero(3);
  EXPECT_FALSE(is_same(origin, with_tangent));
  EXPECT_TRUE(is_same(with_tangent, CurvePoint{with_tangent}));
}

}  // namespace
}  // namespace springfold::continuation
