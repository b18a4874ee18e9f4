#include "local_boundary.hpp"

#include <Eigen/QR>

#include "least_change.hpp"

namespace springfold::analysis {

std::vector<Vector> offsets(Index tangents, Index two_sided, double h) {
  std::vector<Vector> all;
  for (Index i = 0; i < tangents; ++i) {
    all.emplace_back(h * Vector::Unit(tangents, i));
    all.emplace_back((i < two_sided ? -h : h / 2) * Vector::Unit(tangents, i));
    for (Index k = 0; k < i; ++k)
      all.emplace_back(h / 2 * (Vector::Unit(tangents, i) + Vector::Unit(tangents, k)));
  }
  return all;
}

void pass(LocalBoundary& boundary, const std::vector<Vector>& t, const Vector& y) {
  const Index m = boundary.tangents.cols();
  boundary.slope = Vector::Zero(m);
  boundary.curvature = Matrix::Zero(m, m);
  if (m == 0) return;
  Matrix rows(y.size(), y.size());
  for (Index r = 0; r < y.size(); ++r) {
    const Vector& at = t[static_cast<std::size_t>(r)];
    rows.row(r).head(m) = at.transpose();
    Index column = m;
    for (Index i = 0; i < m; ++i)
      for (Index k = 0; k <= i; ++k) rows(r, column++) = (i == k ? 0.5 : 1) * at[i] * at[k];
  }
  const Vector found = rows.colPivHouseholderQr().solve(y);
  boundary.slope = found.head(m);
  Index column = m;
  for (Index i = 0; i < m; ++i)
    for (Index k = 0; k <= i; ++k)
      boundary.curvature(i, k) = boundary.curvature(k, i) = found[column++];
}

Vector SmallProblem::least(const Vector& from, double unit) const {
  const Index n = at.size(), rows = here.g.size(), more = local != nullptr ? 1 : 0;
  const Vector low = of.low.cwiseMax((at.array() - radius).matrix());
  const Vector high = of.high.cwiseMin((at.array() + radius).matrix());
  Matrix combine = Matrix::Identity(n, n);
  InequalityProblem small{low, high, rows + more};
  Vector first = from;
  if (of.is_sum) {
    combine.resize(n, 2 * n);
    combine << Matrix::Identity(n, n), -Matrix::Identity(n, n);
    small.low.resize(2 * n);
    small.low << low.cwiseMax(0), (-high).cwiseMax(0);
    small.high.resize(2 * n);
    small.high << high.cwiseMax(0), (-low).cwiseMax(0);
    first.resize(2 * n);
    first << from.cwiseMax(0), (-from).cwiseMax(0);
  }
  small.low = (small.low - first) / unit;
  small.high = (small.high - first) / unit;
  small.at = [&](const Vector& w) {
    const Vector v = first + unit * w, x = combine * v;
    InequalityValues values{.g = Vector(rows + more), .dg = Matrix(rows + more, v.size())};
    values.f = of.is_sum ? w.sum() : w.dot(first + unit / 2 * w);
    values.df = of.is_sum ? Vector(Vector::Ones(v.size())) : v;
    values.g.head(rows) = (here.g + here.dg * (x - at)) / unit;
    values.dg.topRows(rows) = here.dg * combine;
    if (local != nullptr) {
      values.g[rows] = local->value(x) / unit;
      values.dg.row(rows) = local->rates(x).transpose() * combine;
    }
    return values;
  };
  const Vector w = search_minimum(small, Vector::Zero(first.size()));
  return combine * (first + unit * w);
}

}  // namespace springfold::analysis
