#include "null_modes.hpp"

#include <cmath>
#include <optional>
#include <random>

#include "random_fraction.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/finite.hpp"

namespace springfold::analysis {
namespace {

/// Below it a vector is what rounding leaves of none: of its longest entry, in the metric.
constexpr double no_motion = 1e-9;

/// dF/dy with borders,
///
///     M = | dF/dy  B |
///         | C^T    0 |,     regular for almost all B and C as wide as the kernel.
class BorderedJacobian {
 public:
  static std::optional<BorderedJacobian> at(const PathProblem& problem,
                                            const continuation::CurvePoint& point) {
    BorderedJacobian J;
    Vector dF_dlambda;
    const bool known =
        problem.structured()
            ? problem.structured_derivatives(point.x, point.lambda, point.piece,
                                             J.structured_.emplace(), dF_dlambda)
            : problem.derivatives(point.x, point.lambda, point.piece, J.dense_, dF_dlambda);
    if (!known || !all_finite(J.dense_)) return std::nullopt;
    return J;
  }

  /// The first rows of M^-1 (0, I), or of M^-T (0, I).
  std::optional<Matrix> kernel(const Matrix& B, const Matrix& C, bool transposed) const {
    const Index n = B.rows(), k = B.cols();
    Matrix X = Matrix::Zero(n + k, k);
    X.bottomRows(k).setIdentity();
    if (structured_) {
      if (!structured_->solve({B, C, Matrix::Zero(k, k)}, X, transposed)) return std::nullopt;
    } else {
      Matrix M = Matrix::Zero(n + k, n + k);
      M.topLeftCorner(n, n) = dense_;
      M.topRightCorner(n, k) = B;
      M.bottomLeftCorner(k, n) = C.transpose();
      if (transposed) M.transposeInPlace();
      X = Lu(M).solve(X).eval();
    }
    if (!all_finite(X)) return std::nullopt;
    return X.topRows(n);
  }

 private:
  Matrix dense_{};
  std::optional<StructuredMatrix> structured_{};
};

Matrix irregular_columns(Index rows, Index columns) {
  std::mt19937_64 random(1);
  Matrix X(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) X(i, j) = 2 * random_fraction(random) - 1;
  return orthonormal_columns(X);
}

/// Largest entry positive: the sign of a null vector says nothing.
Vector turned(const Vector& v, const Vector& metric) {
  Index largest = 0;
  v.cwiseProduct(metric).cwiseAbs().maxCoeff(&largest);
  return v[largest] < 0 ? Vector(-v) : v;
}

}  // namespace

std::vector<Vector> null_modes(const PathProblem& problem, const continuation::CurvePoint& point,
                               Index count) {
  const Index n = point.x.size();
  const auto J = BorderedJacobian::at(problem, point);
  if (!J || count < 1 || count > n) return {};
  // The first borders are any; those that lie in the kernels themselves make the best of what is nearly singular.
  const Matrix any = irregular_columns(n, count);
  const auto left = J->kernel(any, any, true), right = J->kernel(any, any, false);
  if (!left || !right) return {};
  const auto found = J->kernel(orthonormal_columns(*left), orthonormal_columns(*right), false);
  if (!found) return {};
  const Vector metric = problem.metric();
  std::vector<Vector> modes;
  for (Index k = 0; k < count; ++k) {
    Vector v = found->col(k).normalized();
    for (const Vector& mode : modes) v -= mode * mode.dot(metric.cwiseProduct(v));
    const double length = std::sqrt(v.dot(metric.cwiseProduct(v)));
    if (!(length > no_motion)) continue;
    modes.push_back(turned(v / length, metric));
  }
  return modes;
}

}  // namespace springfold::analysis
