#include "springfold/continuation/kink.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "springfold/continuation/locate.hpp"

namespace springfold::continuation {
namespace {

/// Unit kernel vector of [dF/dx dF/dlambda]; nothing if the kernel is not one-dimensional.
std::optional<Direction> kernel(const Linearisation& at, const Vector& weights) {
  const Index n = at.dF_dx.rows();
  Matrix A(n, n + 1);
  A << at.dF_dx, at.dF_dlambda;
  Eigen::FullPivLU<Matrix> lu(A);
  lu.setThreshold(1e-12);
  if (n > 0 && lu.dimensionOfKernel() != 1) return std::nullopt;
  const Vector v = n > 0 ? Vector(lu.kernel().col(0)) : Vector::Ones(1);
  Direction tangent{v.head(n), v[n]};
  const double length = std::sqrt(metric_product(weights, tangent, tangent));
  if (!(length > 1e-14 * v.norm())) return std::nullopt;
  tangent.dx /= length;
  tangent.dlambda /= length;
  return tangent;
}

std::string names_of(const Walker& walker, const std::vector<Index>& switches) {
  std::string names;
  for (const Index j : switches)
    names += (names.empty() ? "" : ", ") + walker.problem.switch_name(j);
  return names;
}

/// Does a cubic with these end values and slopes change sign inside (0, h)? Looks at its extrema.
bool cubic_dips(double f0, double d0, double f1, double d1, double h) {
  // p(t) = f0 + d0 t + a t^2 + b t^3
  const double a = (3 * (f1 - f0) / h - 2 * d0 - d1) / h;
  const double b = (d0 + d1 - 2 * (f1 - f0) / h) / (h * h);
  const auto p = [&](double t) { return f0 + t * (d0 + t * (a + t * b)); };
  const double discriminant = a * a - 3 * b * d0;
  if (discriminant < 0) return false;
  const double root = std::sqrt(discriminant);
  const double q = -(a + std::copysign(root, a));  // p'(t) = d0 + 2 a t + 3 b t^2
  for (const double t : {b != 0 ? q / (3 * b) : -1.0, q != 0 ? d0 / q : -1.0})
    if (t > 0 && t < h && (p(t) < 0) != (f0 < 0)) return true;
  return false;
}

double slope(const Matrix& dg_dx, const Vector& dg_dlambda, Index j, const Direction& tangent) {
  return dg_dx.row(j).dot(tangent.dx) + dg_dlambda[j] * tangent.dlambda;
}

}  // namespace

std::vector<Index> active_switches(const Walker& walker, const Vector& x, double lambda) {
  std::vector<Index> active;
  Vector g;
  if (!walker.problem.switches(x, lambda, g)) return active;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= walker.options.simultaneous) active.push_back(j);
  return active;
}

Rays rays_at(const Walker& walker, const Vector& x, double lambda, const Piece& piece,
             const std::vector<Index>& active) {
  assert(active.size() <= 12);
  constexpr double grazing = 1e-9;  // a tangent closer to a surface than this has no clear side
  Rays result;
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!active.empty() && !walker.problem.switch_gradients(x, lambda, dg_dx, dg_dlambda))
    return {.complete = false, .why = "switching functions are not defined here"};
  Linearisation at;
  for (unsigned pattern = 0; pattern < (1u << active.size()); ++pattern) {
    Piece side = piece;
    for (std::size_t k = 0; k < active.size(); ++k)
      side[static_cast<std::size_t>(active[k])] = (pattern >> k) & 1u ? 1 : -1;
    const bool defined = linearise(walker.problem, x, lambda, side, at);
    const auto tangent = defined ? kernel(at, walker.weights) : std::nullopt;
    if (!tangent) {
      result.complete = false;
      result.why = defined ? "more than one curve, or none, passes through this point"
                           : "derivatives are not defined here";
      continue;
    }
    for (const double sign : {1.0, -1.0}) {
      const Direction ray{sign * tangent->dx, sign * tangent->dlambda};
      double least = 1;
      for (const Index j : active)
        least =
            std::min(least, side[static_cast<std::size_t>(j)] * slope(dg_dx, dg_dlambda, j, ray));
      if (least > grazing) {
        result.rays.push_back({side, ray});
      } else if (least > -grazing) {
        result.complete = false;
        result.why = "the curve grazes a switching surface: " + names_of(walker, active);
      }
    }
  }
  return result;
}

KinkSearch first_kink(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                      const std::vector<Index>& left) {
  KinkSearch result;
  const Index m = walker.problem.switch_count();
  if (m == 0) return result;
  const double h = to.s - from.s;
  // Step lengths are measured along from.tangent: slopes by the arc at `to` are smaller by this.
  const double along = metric_product(walker.weights, to.tangent, from.tangent);
  Vector g0, g1, dl0, dl1;
  Matrix dg0, dg1;
  if (!walker.problem.switches(from.x, from.lambda, g0) ||
      !walker.problem.switches(to.x, to.lambda, g1) ||
      !walker.problem.switch_gradients(from.x, from.lambda, dg0, dl0) ||
      !walker.problem.switch_gradients(to.x, to.lambda, dg1, dl1))
    return {.status = KinkSearch::Status::suspicious};

  for (Index j = 0; j < m; ++j) {
    const double side = from.piece[static_cast<std::size_t>(j)];
    const bool leaves = std::find(left.begin(), left.end(), j) != left.end();
    const double f0 = leaves ? 0 : side * g0[j], f1 = side * g1[j];
    const double d0 = side * slope(dg0, dl0, j, from.tangent);
    const double d1 = side * slope(dg1, dl1, j, to.tangent) / along;
    if (f1 >= 0) {
      const bool dips = cubic_dips(leaves ? 1e-12 * h : f0, d0, f1, d1, h);
      if (!dips) continue;
      // A double crossing inside the step, or nearly one: look closer.
      return {.status = KinkSearch::Status::suspicious, .suspect = j};
    }
    const auto value = [&walker, j, side](const CurvePoint& p) {
      Vector g;
      return walker.problem.switches(p.x, p.lambda, g) ? side * g[j]
                                                       : std::numeric_limits<double>::quiet_NaN();
    };
    // A switch that is being left starts at zero: begin the bracket where it is clearly positive.
    const double start = leaves ? 1e-3 * h : 0;
    const double end = result.status == KinkSearch::Status::found ? result.after : h;
    if (result.status == KinkSearch::Status::found) {
      const auto early = point_at(walker, from, end);
      if (!early || value(*early) >= -walker.options.simultaneous) continue;  // later, or the same
    }
    const auto located = locate(walker, from, start, end, value);
    if (!located) return {.status = KinkSearch::Status::suspicious, .suspect = j};
    result.status = KinkSearch::Status::found;
    result.point = located->point;
    result.before = located->before;
    result.after = located->after;
  }
  if (result.status == KinkSearch::Status::found)
    result.active = active_switches(walker, result.point.x, result.point.lambda);
  return result;
}

}  // namespace springfold::continuation
