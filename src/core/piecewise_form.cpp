#include "springfold/core/piecewise_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "springfold/core/decompositions.hpp"

namespace springfold {
namespace {

/// Forms whose entries are about one are exact to this: the places at which they are asked for are
/// located to 1e-10.
constexpr double form_rounding = 1e-9;

/// Singular values of compliances below this share of the largest are rounding of their solutions.
constexpr double compliance_rounding = 1e-11;

constexpr double narrow = 1e-9;    ///< cones narrower than this have no interior
constexpr double settled = 1e-13;  ///< what is left to gain of rows and columns of length one

/// Rows of length one; without those that are zero beside the others.
Matrix unit_rows(const Matrix& rows) {
  const Vector sizes = rows.rowwise().norm();
  const double largest = sizes.size() > 0 ? sizes.maxCoeff() : 0;
  std::vector<Index> kept;
  for (Index j = 0; j < rows.rows(); ++j)
    if (sizes[j] > narrow * largest) kept.push_back(j);
  if (kept.empty()) return Matrix(0, rows.cols());
  return Vector(sizes(kept).cwiseInverse()).asDiagonal() * rows(kept, Eigen::all);
}

/// Irregular numbers in (-1, 1), always the same.
double irregular(Index i) {
  constexpr double golden = 0.6180339887498949;
  return 2 * std::fmod(golden * static_cast<double>(i + 1), 1.0) - 1;
}

/// A metric without symmetries, near to 1.
Matrix generic_metric(Index r) {
  Matrix B = Matrix::Identity(r, r);
  for (Index i = 0; i < r; ++i)
    for (Index j = 0; j <= i; ++j) {
      const double entry = 0.3 / static_cast<double>(r) * irregular(i * r + j);
      B(i, j) += entry;
      if (j < i) B(j, i) += entry;
    }
  return B;
}

/// B^-1/2 of a positive definite B.
Matrix inverse_root(const Matrix& B) {
  const SymmetricEigen eigen = symmetric_eigen(B);
  return eigen.vectors * eigen.values.cwiseSqrt().cwiseInverse().asDiagonal() *
         eigen.vectors.transpose();
}

/// Rows and columns divided so that the form with all its jumps has a diagonal of about one.
PiecewiseForm of_one_size(PiecewiseForm form) {
  const Index r = form.H.rows();
  const Matrix all = form.H.cwiseAbs() + form.directions.cwiseAbs().transpose() *
                                             form.jumps.cwiseAbs().asDiagonal() *
                                             form.directions.cwiseAbs();
  Vector size(r);
  for (Index i = 0; i < r; ++i) size[i] = all(i, i) > 0 ? 1 / std::sqrt(all(i, i)) : 1.0;
  form.H = (size.asDiagonal() * form.H * size.asDiagonal()).eval();
  form.directions = (form.directions * size.asDiagonal()).eval();
  return form;
}

double value_of(const PiecewiseForm& form, const Vector& v) {
  const Vector y = (form.directions * v).cwiseMax(0);
  return v.dot(form.H * v) + form.jumps.dot(y.cwiseAbs2());
}

/// Least value over all eigenvectors of all pieces, and the counts of those with an interior.
class Pieces {
 public:
  explicit Pieces(const PiecewiseForm& form)
      : form_{form},
        inverse_(inverse_root(generic_metric(form.H.rows()))),
        all_have_room_{all_cones_have_room(form.directions)} {}

  void look_at(unsigned pattern, FormJudgement& result) {
    const Index k = form_.directions.rows();
    Matrix H = form_.H, sides = form_.directions;
    for (Index j = 0; j < k; ++j) {
      const bool acts = ((pattern >> j) & 1u) != 0;
      if (acts) H += form_.jumps[j] * sides.row(j).transpose() * sides.row(j);
      if (!acts) sides.row(j) *= -1;
    }
    // B^-1/2 H B^-1/2 has the eigenvalues of the pair (H, B).
    const Matrix C = inverse_ * H * inverse_;
    const SymmetricEigen eigen = symmetric_eigen(0.5 * (C + C.transpose()));
    Index negative = 0;
    for (Index i = 0; i < C.rows(); ++i) {
      negative += eigen.values[i] < 0 ? 1 : 0;
      if (eigen.values[i] > form_rounding) continue;
      const Vector v = inverse_ * eigen.vectors.col(i);
      result.least = std::min({result.least, value_of(form_, v), value_of(form_, -v)});
    }
    if (k > 0 && !all_have_room_ && !inside_cone(sides)) return;
    result.fewest = seen_ ? std::min(result.fewest, negative) : negative;
    result.most = std::max(result.most, negative);
    seen_ = true;
  }

 private:
  const PiecewiseForm& form_;
  Matrix inverse_;  ///< of the square root of the metric
  bool all_have_room_;
  bool seen_ = false;
};

}  // namespace

Vector nonnegative_least_squares(const Matrix& A, const Vector& b) {
  const Index m = A.cols();
  Vector w = Vector::Zero(m);
  std::vector<Index> used;
  for (Index round = 0; round < 10 * m + 10; ++round) {
    const Vector gain = A.transpose() * (b - A * w);
    Index best = -1;
    for (Index j = 0; j < m; ++j)
      if (std::find(used.begin(), used.end(), j) == used.end() && gain[j] > settled &&
          (best < 0 || gain[j] > gain[best]))
        best = j;
    if (best < 0) break;
    used.push_back(best);
    while (!used.empty()) {
      const Vector z = least_squares(A(Eigen::all, used), b);
      if (z.minCoeff() > 0) {
        w.setZero();
        w(used) = z;
        break;
      }
      double step = 1;
      for (std::size_t i = 0; i < used.size(); ++i) {
        const double have = w[used[i]], want = z[static_cast<Index>(i)];
        if (want <= 0 && have > want) step = std::min(step, have / (have - want));
      }
      const Vector before = w(used);
      w(used) = before + step * (z - before);
      std::erase_if(used, [&](Index j) {
        if (w[j] > settled) return false;
        w[j] = 0;
        return true;
      });
    }
  }
  return w;
}

std::optional<Vector> inside_cone(const Matrix& rows) {
  if (rows.cols() == 0) return std::nullopt;
  const Matrix unit = unit_rows(rows);
  if (unit.rows() == 0) return Vector::Unit(rows.cols(), 0);
  // The point of the convex hull of the rows that is nearest to 0 separates them from 0, or is 0.
  Matrix A(unit.cols() + 1, unit.rows());
  A << unit.transpose(), Matrix::Ones(1, unit.rows());
  const Vector w = nonnegative_least_squares(A, Vector::Unit(A.rows(), A.rows() - 1));
  if (!(w.sum() > 0)) return std::nullopt;
  const Vector v = unit.transpose() * w / w.sum();
  const double size = v.norm();
  if (!(size > narrow) || !((unit * v).minCoeff() > narrow * size)) return std::nullopt;
  return v / size;
}

bool all_cones_have_room(const Matrix& rows) {
  if (rows.cols() == 0) return false;
  const Matrix unit = unit_rows(rows);
  const Index k = unit.rows();
  if (k == 0) return true;
  if (k > rows.cols()) return false;
  // v with unit v = s has a length of at most |s| / least singular value, and |s|^2 = k.
  const Vector values = jacobi_svd(unit).values;
  return values[k - 1] > narrow * std::sqrt(static_cast<double>(k));
}

bool is_subspace(const Matrix& rows) {
  // No v with rows v >= 0 but != 0 exists if and only if some w > 0 has rows^T w = 0 (Stiemke 1915).
  const Matrix unit = unit_rows(rows);
  if (unit.rows() == 0) return true;
  const Vector ones = unit.colwise().sum().transpose();
  const Vector w = nonnegative_least_squares(unit.transpose(), -ones);
  return (unit.transpose() * w + ones).norm() <= narrow;
}

FormJudgement judge(const PiecewiseForm& given) {
  const Index k = given.directions.rows(), r = given.H.rows();
  if (r == 0) return {.verdict = Definiteness::positive, .least = 1};
  if (k > most_cones || !given.H.allFinite() || !given.jumps.allFinite()) return {};
  const PiecewiseForm form = of_one_size(given);
  FormJudgement result{.least = std::numeric_limits<double>::infinity()};
  Pieces pieces(form);
  for (unsigned pattern = 0; pattern < (1u << k); ++pattern) pieces.look_at(pattern, result);
  result.verdict = result.least < -form_rounding  ? Definiteness::not_positive
                   : result.least > form_rounding ? Definiteness::positive
                                                  : Definiteness::undecided;
  return result;
}

std::optional<CondensedForm> condensed_form(const Matrix& G, Index negative, const Vector& jumps,
                                            const Vector& sides) {
  const Index k = G.rows();
  if (!G.allFinite()) return std::nullopt;
  Vector size(k);  // coordinates of one size
  for (Index j = 0; j < k; ++j) {
    const double row = G.row(j).cwiseAbs().maxCoeff();
    size[j] = row > 0 ? 1 / std::sqrt(row) : 1.0;
  }
  const Matrix scaled = size.asDiagonal() * (0.5 * (G + G.transpose())) * size.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  const Vector& values = eigen.values;
  const double least = compliance_rounding * std::max(values.cwiseAbs().maxCoeff(), 1e-300);
  std::vector<Index> range;
  Index below = 0;
  for (Index i = 0; i < k; ++i) {
    if (!(std::abs(values[i]) > least)) continue;
    range.push_back(i);
    below += values[i] < 0 ? 1 : 0;
  }
  CondensedForm result{.across = negative - below};
  const Matrix V = eigen.vectors(Eigen::all, range);
  const Vector inverse = values(range).cwiseInverse();
  result.form.directions = size.cwiseInverse().asDiagonal() * V;
  result.form.jumps = jumps;
  result.form.H = inverse.asDiagonal();
  for (Index j = 0; j < k; ++j)  // G is of one piece, H of that in which no spring acts
    if (sides[j] > 0)
      result.form.H -=
          jumps[j] * result.form.directions.row(j).transpose() * result.form.directions.row(j);
  return result;
}

}  // namespace springfold
