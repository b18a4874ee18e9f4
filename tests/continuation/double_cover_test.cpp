// Four unknowns that are the same point with all signs changed.
#include <gmock/gmock.h>

#include "continuation/points/coincide.hpp"
#include "springfold/continuation/search.hpp"

namespace springfold::continuation {
namespace {

/// Gradient of (|q|^2 - 1)^2 / 4 + q^T D q / 2, D = diag(0, 0.1, 0.2, 0.3): zero at q = 0 and at four
/// pairs +-q on the axes, |q|^2 = 1 - d.
struct Axes {
  bool covered = true;
  static Index size() { return 4; }
  static Vector weights() { return Vector{{0, 0.1, 0.2, 0.3}}; }
  bool residual(const Vector& q, double, Vector& F) const {
    F = (q.squaredNorm() - 1) * q + weights().cwiseProduct(q);
    return true;
  }
  bool derivatives(const Vector& q, double, Matrix& A, Vector& b) const {
    A = (q.squaredNorm() - 1) * Matrix::Identity(4, 4) + 2 * q * q.transpose();
    A.diagonal() += weights();
    b = Vector::Zero(4);
    return true;
  }
  std::vector<Index> double_covers() const {
    return covered ? std::vector<Index>{0} : std::vector<Index>{};
  }
};

TEST(DoubleCovers, AreFoundOnceByASearch) {
  const SearchOptions options{
      .low = Vector::Constant(4, -1.5), .high = Vector::Constant(4, 1.5), .starts = 200};
  const SearchResult once = search_at(Axes{}, 0, {}, options);
  EXPECT_EQ(once.solutions.size(), 5u);
  const SearchResult twice = search_at(Axes{.covered = false}, 0, {}, options);
  EXPECT_EQ(twice.solutions.size(), 9u);
  // Known with one sign, known with both.
  EXPECT_TRUE(search_at(Axes{}, 0, once.solutions, options).solutions.empty());
  std::vector<Vector> turned;
  for (const Vector& q : once.solutions) turned.push_back(-q);
  EXPECT_TRUE(search_at(Axes{}, 0, turned, options).solutions.empty());
}

TEST(DoubleCovers, AreTheSamePointWithOtherSignsAndTheTangentWithThem) {
  const Axes axes;
  const TraceOptions options;
  const Walker walker{axes, Vector::Ones(4), options};
  CurvePoint a;
  a.x = Vector{{0.5, -0.5, 0.5, 0.5}};
  a.tangent = {Vector{{0.5, 0.5, 0.5, -0.5}}, 0.1};
  CurvePoint b = a;
  b.x = -a.x;
  b.tangent.dx = -a.tangent.dx;
  EXPECT_TRUE(coincide(walker, a, b));
  EXPECT_EQ(length_of(walker, between(walker, a, b)), 0);
  b.tangent.dx = Vector{{0.5, -0.5, -0.5, 0.5}};
  EXPECT_FALSE(coincide(walker, a, b));
}

}  // namespace
}  // namespace springfold::continuation
