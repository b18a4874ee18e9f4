// Problems that give dF/dx without its entries: the same curves, also where entries would be too many.
#include <cmath>
#include <memory>
#include <numbers>

#include "springfold/continuation/between.hpp"
#include "springfold/core/frontal.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// n bars of length 1 with torsion springs 1 between them and at the foot, pressed by P along the first
/// direction and by e P across it; absolute angles x.
struct LinkColumn {
  Index n = 3;
  double across = 0;
  bool by_structure = true;

  Index size() const { return n; }
  static bool symmetric() { return true; }
  bool structured() const { return by_structure; }
  bool residual(const Vector& x, double P, Vector& F) const {
    F.resize(n);
    for (Index i = 0; i < n; ++i)
      F[i] = x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < n ? x[i + 1] - x[i] : 0) -
             P * (std::sin(x[i]) + across * std::cos(x[i]));
    return true;
  }
  double diagonal(const Vector& x, double P, Index i) const {
    return (i + 1 < n ? 2 : 1) - P * (std::cos(x[i]) - across * std::sin(x[i]));
  }
  Vector rate(const Vector& x) const { return -(x.array().sin() + across * x.array().cos()); }
  bool derivatives(const Vector& x, double P, Matrix& A, Vector& dF_dP) const {
    A.setZero(n, n);
    for (Index i = 0; i < n; ++i) {
      A(i, i) = diagonal(x, P, i);
      if (i > 0) A(i, i - 1) = A(i - 1, i) = -1;
    }
    dF_dP = rate(x);
    return true;
  }
  /// One front per bar and its lower neighbour.
  FrontalPattern pattern() const {
    FrontalPattern p;
    p.size = n;
    for (Index i = 0; i < n; ++i) {
      const std::vector<Index> both = i > 0 ? std::vector<Index>{i - 1, i} : std::vector<Index>{0};
      add_front(p, both, i + 1 == n);
    }
    return p;
  }
  bool structured_derivatives(const Vector& x, double P, StructuredMatrix& J, Vector& dF_dP) const {
    struct Held {
      FrontalPattern pattern;
      std::vector<double> values{};
      Frontal frontal;
    };
    const auto held = std::make_shared<Held>(Held{pattern(), {}, Frontal(pattern())});
    for (Index i = 0; i < n; ++i) {
      if (i > 0) held->values.insert(held->values.end(), {0, -1, -1});
      held->values.push_back(diagonal(x, P, i));
    }
    const auto times = [held](const std::vector<double>& values, const Vector& v) -> Vector {
      return springfold::product(held->pattern, values, Matrix(0, 0), {}, v);
    };
    J.largest = 4;
    J.product = [held, times](const Vector& v, Vector& Jv) { Jv = times(held->values, v); };
    J.magnitudes = [held, times](const Vector& v, Vector& result) {
      std::vector<double> sizes = held->values;
      for (double& size : sizes) size = std::abs(size);
      result = times(sizes, v.cwiseAbs());
    };
    J.solve = [held](const FrontalBorders& borders, Matrix& X, bool transposed) {
      if (!held->frontal.factorise(held->values, Matrix(0, 0), borders)) return false;
      return transposed ? held->frontal.solve_transposed(X) : held->frontal.solve(X);
    };
    J.inertia = [held, size = n]() -> std::optional<Inertia> {
      const FrontalBorders none{Matrix(size, 0), Matrix(size, 0), Matrix(0, 0)};
      if (!held->frontal.factorise(held->values, Matrix(0, 0), none)) return std::nullopt;
      return held->frontal.inertia();
    };
    dF_dP = rate(x);
    return true;
  }
};

Curve pressed(const LinkColumn& column, double P_end, double longest) {
  const TraceOptions options = steps_up_to(longest);
  const Ray ray =
      ray_of(column, {Vector::Zero(column.n), 0, {}, {Vector::Zero(column.n), 1}}, options);
  return trace(column, Vector::Zero(column.n), 0, ray, {lambda_reaches(P_end)}, options);
}

double buckling_load(Index n, int j) {
  return 4 * std::pow(std::sin((2 * j - 1) * std::numbers::pi / static_cast<double>(4 * n + 2)), 2);
}

TEST(StructuredProblem, ABentColumnHasTheSameCurveWithAndWithoutEntries) {
  for (const Index n : {1, 2, 7, 30}) {
    LinkColumn column{.n = n, .across = 0.02};
    const Curve with = pressed(column, 2 * buckling_load(n, 1), 0.05);
    column.by_structure = false;
    const Curve without = pressed(column, 2 * buckling_load(n, 1), 0.05);
    ASSERT_EQ(with.stop, StopReason::event);
    ASSERT_EQ(with.points.size(), without.points.size());
    for (std::size_t i = 0; i < with.points.size(); ++i) {
      EXPECT_LT((with.points[i].x - without.points[i].x).norm(), 1e-10);
      EXPECT_NEAR(with.points[i].lambda, without.points[i].lambda, 1e-10);
      EXPECT_LT((with.points[i].tangent.dx - without.points[i].tangent.dx).norm(), 1e-10);
      EXPECT_EQ(with.points[i].negative, without.points[i].negative);
    }
  }
}

TEST(StructuredProblem, AllBucklingLoadsOfTheStraightColumnAreFoundToTenDigits) {
  for (const Index n : {1, 3, 10, 40}) {
    const Curve curve = pressed({.n = n}, 4.5, 0.01);
    ASSERT_EQ(curve.stop, StopReason::event);
    ASSERT_EQ(static_cast<Index>(curve.hits.size()), n + 1);
    for (Index j = 0; j < n; ++j) {
      const Hit& hit = curve.hits[static_cast<std::size_t>(j)];
      EXPECT_EQ(hit.kind, HitKind::branch_point) << hit.name;
      EXPECT_EQ(hit.multiplicity, 1);
      EXPECT_NEAR(hit.point.lambda, buckling_load(n, static_cast<int>(j) + 1), 1e-11);
    }
    for (const CurvePoint& p : curve.points) {
      Index below = 0;
      while (below < n && buckling_load(n, static_cast<int>(below) + 1) < p.lambda) ++below;
      EXPECT_EQ(p.negative, below) << p.lambda;
    }
  }
}

TEST(StructuredProblem, ThousandsOfUnknownsAreTracedWithoutAnyMatrixOfEntries) {
  struct OnlyStructured : LinkColumn {
    static bool derivatives(const Vector&, double, Matrix&, Vector&) {
      ADD_FAILURE() << "entries were asked for";
      return false;
    }
  };
  OnlyStructured column;
  column.n = 1000;
  const double first = buckling_load(column.n, 1), second = buckling_load(column.n, 2);
  const TraceOptions options = steps_up_to(0.1 * first);
  const Vector zero = Vector::Zero(column.n);
  const Ray ray = ray_of(column, {zero, 0, {}, {zero, 1}}, options);
  const Curve curve = trace(column, zero, 0, ray, {lambda_reaches(1.2 * second)}, options);
  ASSERT_EQ(curve.hits.size(), 3U);
  EXPECT_EQ(curve.hits[0].kind, HitKind::branch_point);
  EXPECT_EQ(curve.hits[1].kind, HitKind::branch_point);
  // Rounding of the entries, some 1e-16, is all that can be asked for.
  EXPECT_NEAR(curve.hits[0].point.lambda, first, 1e-15);
  EXPECT_NEAR(curve.hits[1].point.lambda, second, 1e-15);
}

TEST(StructuredProblem, LambdaInPartsOfItselfShowsTheSameBucklingLoadsWithoutEntries) {
  struct Measured : LinkColumn {
    static LambdaMeasure lambda_measure() { return {0, 0.25}; }
    static bool derivatives(const Vector&, double, Matrix&, Vector&) {
      ADD_FAILURE() << "entries were asked for";
      return false;
    }
  };
  Measured column;
  column.n = 10;
  const TraceOptions options = steps_up_to(0.005);
  const Vector zero = Vector::Zero(column.n);
  const Ray ray = ray_of(column, {zero, 0, {}, {zero, 1}}, options);
  const Curve curve = trace(column, zero, 0, ray, {lambda_reaches(4.5)}, options);
  ASSERT_EQ(static_cast<Index>(curve.hits.size()), column.n + 1);
  for (Index j = 0; j < column.n; ++j)
    EXPECT_NEAR(curve.hits[static_cast<std::size_t>(j)].point.lambda,
                buckling_load(column.n, static_cast<int>(j) + 1), 1e-11);
}

TEST(StructuredProblem, PointsBetweenStepsAreTheSameAsWithEntries) {
  LinkColumn column{.n = 12, .across = 0.05};
  const Curve with = pressed(column, 2 * buckling_load(12, 1), 0.05);
  const Between between = points_between(column, with, 0.003, steps_up_to(0.05));
  column.by_structure = false;
  const Between dense = points_between(column, pressed(column, 2 * buckling_load(12, 1), 0.05),
                                       0.003, steps_up_to(0.05));
  ASSERT_EQ(between.points.size(), dense.points.size());
  for (std::size_t i = 0; i < dense.points.size(); ++i)
    EXPECT_LT((between.points[i].x - dense.points[i].x).norm(), 1e-10);
}

}  // namespace
}  // namespace springfold::continuation
