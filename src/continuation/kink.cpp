#include "springfold/continuation/kink.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "extended.hpp"
#include "kink_rays.hpp"
#include "springfold/continuation/locate.hpp"

namespace springfold::continuation {
namespace {

/// Tangents of the curves of one piece through a point, one of each opposite pair.
struct Tangents {
  std::vector<Direction> list{};
  double accuracy = 0;  ///< of the directions
  std::string why{};    ///< set: not all of them could be found
};

std::optional<Direction> unit(const Vector& v, const Vector& weights) {
  const Index n = v.size() - 1;
  Direction d{v.head(n), v[n]};
  const double length = std::sqrt(metric_product(weights, d, d));
  if (!(length > 1e-14 * v.norm())) return std::nullopt;
  d.dx /= length;
  d.dlambda /= length;
  return d;
}

Matrix extended(const Linearisation& at) {
  Matrix A(at.dF_dx.rows(), at.dF_dx.rows() + 1);
  A << at.dF_dx, at.dF_dlambda;
  return A;
}

/// Roots (c1 : c2) of a c1^2 + 2 b c1 c2 + c c2^2 = 0; none unless there are two different ones.
std::vector<std::pair<double, double>> projective_roots(double a, double b, double c) {
  const double size = std::max({std::abs(a), std::abs(b), std::abs(c)});
  const double discriminant = b * b - a * c;
  if (!(discriminant > 1e-8 * size * size)) return {};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  return {{q, a}, {c, q}};
}

/// Simple branch point of a piece: with the kernel e_1, e_2 of the extended Jacobian and its left
/// null vector w, the tangents c_1 e_1 + c_2 e_2 of the two branches solve
///
///     sum_ij c_i c_j  w . D^2F[e_i, e_j] = 0
///
/// (Keller 1977). Second derivatives by central differences of the exact first ones.
Tangents crossing_tangents(const Walker& walker, const CurvePoint& at, const Matrix& A) {
  const Index n = A.rows();
  Tangents result{.accuracy = 1e-6,
                  .why = "more than one curve, or none, passes through this point"};
  const Eigen::JacobiSVD<Matrix> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector w = svd.matrixU().col(n - 1);
  const Matrix kernel = svd.matrixV().rightCols(2);
  const double h = 1e-5 * std::max(1.0, at.x.norm());
  Matrix form(2, 2);
  for (Index i = 0; i < 2; ++i) {
    Linearisation plus, minus;
    const Vector e = h * kernel.col(i);
    if (!linearise_densely(walker.problem, at.x + e.head(n), at.lambda + e[n], at.piece, plus) ||
        !linearise_densely(walker.problem, at.x - e.head(n), at.lambda - e[n], at.piece, minus))
      return result;
    form.row(i) = w.transpose() * (extended(plus) - extended(minus)) * kernel / (2 * h);
  }
  if (!(form.cwiseAbs().maxCoeff() > 1e-7 * A.cwiseAbs().maxCoeff())) return result;
  for (const auto& [c1, c2] :
       projective_roots(form(0, 0), 0.5 * (form(0, 1) + form(1, 0)), form(1, 1)))
    if (const auto d = unit(c1 * kernel.col(0) + c2 * kernel.col(1), walker.weights))
      result.list.push_back(*d);
  if (result.list.size() == 2) result.why.clear();
  return result;
}

/// Size of the extended Jacobian a little away, where it need not vanish altogether.
double size_nearby(const Walker& walker, const CurvePoint& at) {
  Linearisation linear;
  const double h = 0.1 * std::max(1.0, at.x.norm());
  const Vector x = at.x.array() + h;
  if (!linearise_densely(walker.problem, x, at.lambda + h, at.piece, linear)) return 0;
  return extended(linear).cwiseAbs().maxCoeff();
}

/// The tangent where dF/dx is structured and no other branch is near: by inverse iteration with the
/// tangent itself as last row.
std::optional<Direction> regular_tangent(const Walker& walker, const CurvePoint& at,
                                         double full_rank) {
  Linearisation linear;
  if (!linearise(walker.problem, at.x, at.lambda, at.piece, linear)) return std::nullopt;
  const Index n = linear.dF_dlambda.size();
  auto tangent = unit(irregular_columns(n + 1, 1), walker.weights);
  for (int step = 0; tangent && step < 3; ++step)
    tangent = tangent_at(linear, walker.weights, *tangent);
  if (!tangent) return std::nullopt;
  const ExtendedMatrix E = extended_matrix(linear, walker.weights, *tangent);
  const double size = magnitudes(E, irregular_columns(n + 1, 1)).norm();
  if (!(least_singular_values(E, 1)[0] > full_rank * size)) return std::nullopt;
  if (tangent->dlambda < 0) {  // of the two opposite ones that in which lambda grows
    tangent->dx = -tangent->dx;
    tangent->dlambda = -tangent->dlambda;
  }
  return tangent;
}

/// The kernel of A is what the rows of A leave over: the last columns of Q in A^T P = Q R.
Tangents tangents_of_piece(const Walker& walker, const CurvePoint& at, bool on_surface,
                           double full_rank) {
  if (walker.problem.structured())
    if (auto tangent = regular_tangent(walker, at, full_rank))
      return {.list = {std::move(*tangent)}, .accuracy = 1e-9};
  if (walker.problem.structured() && at.x.size() > most_entries)
    return {.why =
                "more than one curve, or none, passes through this point, which has too many "
                "unknowns to look at their directions"};
  Linearisation linear;
  if (!linearise_densely(walker.problem, at.x, at.lambda, at.piece, linear))
    return {.why = "derivatives are not defined here"};
  const Index n = linear.dF_dx.rows();
  const Matrix A = extended(linear);
  if (n == 0) return {.list = {{Vector(0), 1.0}}};
  const Eigen::ColPivHouseholderQR<Matrix> qr(A.transpose());
  const auto pivot = [&](Index i) { return std::abs(qr.matrixQR()(i, i)); };
  const double least = full_rank * std::max(pivot(0), n <= 4 ? size_nearby(walker, at) : 0);
  if (!(pivot(n - 1) > least)) {
    const bool simple = n == 1 || pivot(n - 2) > least;
    if (on_surface && simple) return crossing_tangents(walker, at, A);
    return {.why = "more than one curve, or none, passes through this point"};
  }
  Vector last = Vector::Unit(n + 1, n);
  last.applyOnTheLeft(qr.householderQ());
  const auto d = unit(last, walker.weights);
  if (!d) return {.why = "the metric gives the tangent no length"};
  return {.list = {*d}, .accuracy = 1e-9};
}

enum class Side { in, out, rests, unclear };

/// To which side of the surfaces `grazed`, tangential here, does the curve of a piece bend?
/// rests: it stays within the surface.
std::vector<Side> sides_of(const Walker& walker, const CurvePoint& start,
                           const std::vector<Index>& grazed) {
  const double zero = walker.options.simultaneous, clear = 10 * zero;
  std::vector<Side> sides(grazed.size(), Side::unclear);
  for (const double ds : {1e-4, 1e-3, 1e-2}) {
    const auto point = point_at(walker, start, ds);
    Vector g;
    if (!point || !walker.problem.switches(point->x, point->lambda, g)) continue;
    for (std::size_t i = 0; i < grazed.size(); ++i) {
      if (sides[i] == Side::in || sides[i] == Side::out) continue;
      const double value = start.piece[static_cast<std::size_t>(grazed[i])] * g[grazed[i]];
      if (std::abs(value) > clear)
        sides[i] = value > 0 ? Side::in : Side::out;
      else
        sides[i] = std::abs(value) <= zero ? Side::rests : Side::unclear;
    }
  }
  return sides;
}

/// Collects rays; one that several pieces share because switches rest on it is kept once.
class Collector {
 public:
  Collector(const Walker& walker, const Piece& preferred)
      : walker_{walker}, preferred_{preferred} {}

  Rays result{};

  void doubt(std::string why) {
    result.complete = false;
    result.why = std::move(why);
  }

  /// True if this ray of this piece is known already from a piece beyond its resting switches.
  bool known(const Piece& piece, const Direction& d, double accuracy) {
    for (Ray& ray : result.rays) {
      if (!differ_only(ray.piece, piece, ray.resting) ||
          !same_direction(walker_.weights, ray.tangent, d, 10 * accuracy))
        continue;
      if (!ray.resting.empty() && differ_only(piece, preferred_, others(ray.resting)))
        ray.piece = piece;
      return true;
    }
    return false;
  }

 private:
  static bool differ_only(const Piece& a, const Piece& b, const std::vector<Index>& where) {
    for (std::size_t j = 0; j < a.size(); ++j)
      if (a[j] != b[j] &&
          std::find(where.begin(), where.end(), static_cast<Index>(j)) == where.end())
        return false;
    return true;
  }
  std::vector<Index> others(const std::vector<Index>& resting) const {
    std::vector<Index> rest;
    for (Index j = 0; j < static_cast<Index>(preferred_.size()); ++j)
      if (std::find(resting.begin(), resting.end(), j) == resting.end()) rest.push_back(j);
    return rest;
  }

  const Walker& walker_;
  const Piece& preferred_;
};

/// Keeps one direction of one piece if it leads into the piece.
void judge(const Walker& walker, const CurvePoint& ray, const std::vector<Index>& active,
           const Matrix& dg_dx, const Vector& dg_dlambda, double accuracy, Collector& collector) {
  std::vector<Index> grazed, resting;
  for (const Index j : active) {
    const double rate =
        ray.piece[static_cast<std::size_t>(j)] * switch_rate(dg_dx, dg_dlambda, j, ray.tangent);
    if (rate < -accuracy) return;
    if (rate <= accuracy) grazed.push_back(j);
  }
  if (collector.known(ray.piece, ray.tangent, accuracy)) return;
  if (!grazed.empty()) {
    const std::vector<Side> sides = sides_of(walker, ray, grazed);
    if (std::find(sides.begin(), sides.end(), Side::out) != sides.end()) return;
    for (std::size_t i = 0; i < grazed.size(); ++i) {
      if (sides[i] == Side::rests) resting.push_back(grazed[i]);
      if (sides[i] == Side::unclear)
        return collector.doubt("the curve grazes a switching surface: " +
                               walker.problem.switch_name(grazed[i]));
    }
  }
  collector.result.rays.push_back({ray.piece, ray.tangent, std::move(resting)});
}

}  // namespace

double switch_rate(const Matrix& dg_dx, const Vector& dg_dlambda, Index j, const Direction& along) {
  return dg_dx.row(j).dot(along.dx) + dg_dlambda[j] * along.dlambda;
}

bool same_direction(const Vector& weights, const Direction& a, const Direction& b,
                    double tolerance) {
  const Direction d{a.dx - b.dx, a.dlambda - b.dlambda};
  return metric_product(weights, d, d) <= tolerance * tolerance;
}

std::vector<Index> active_switches(const Walker& walker, const Vector& x, double lambda) {
  std::vector<Index> active;
  Vector g;
  if (!walker.problem.switches(x, lambda, g)) return active;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= walker.options.simultaneous) active.push_back(j);
  return active;
}

Rays rays_around(const Walker& walker, const CurvePoint& at, const std::vector<Index>& active,
                 double full_rank) {
  assert(active.size() <= 12);
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!active.empty() && !walker.problem.switch_gradients(at.x, at.lambda, dg_dx, dg_dlambda))
    return {.complete = false, .why = "switching functions are not defined here"};
  Collector collector(walker, at.piece);
  CurvePoint ray = at;
  for (unsigned pattern = 0; pattern < (1u << active.size()); ++pattern) {
    for (std::size_t k = 0; k < active.size(); ++k)
      ray.piece[static_cast<std::size_t>(active[k])] = (pattern >> k) & 1u ? 1 : -1;
    const Tangents tangents = tangents_of_piece(walker, ray, !active.empty(), full_rank);
    if (!tangents.why.empty()) collector.doubt(tangents.why);
    for (const Direction& tangent : tangents.list)
      for (const double sign : {1.0, -1.0}) {
        ray.tangent = {sign * tangent.dx, sign * tangent.dlambda};
        judge(walker, ray, active, dg_dx, dg_dlambda, tangents.accuracy, collector);
      }
  }
  return std::move(collector.result);
}

Rays rays_at(const Walker& walker, const Vector& x, double lambda, const Piece& piece,
             const std::vector<Index>& active) {
  CurvePoint at;
  at.x = x;
  at.lambda = lambda;
  at.piece = piece;
  return rays_around(walker, at, active, active.empty() ? 1e-12 : 1e-9);
}

}  // namespace springfold::continuation
