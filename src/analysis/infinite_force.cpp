#include "infinite_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

Vector wrenches_of(const PathProblem& problem, Vector x) {
  const statics::System& layout = problem.layout();
  for (Index i = 0; i < x.size(); ++i)
    if (i >= layout.first_pose || !layout.is_wrench[static_cast<std::size_t>(i)]) x[i] = 0;
  return x;
}

/// From `last` to where 1/w, linear in s, vanishes; nothing where the wrenches do not grow in one sense.
std::optional<double> way_left(const PathProblem& problem, const CurvePoint& earlier,
                               const CurvePoint& last) {
  const Vector w = wrenches_of(problem, last.x), v = wrenches_of(problem, earlier.x);
  const double force = w.norm(), before = v.dot(w) / force;
  if (!(before > 0) || !(force > before)) return std::nullopt;
  return (last.s - earlier.s) * before / (force - before);
}

/// Is no spring switched on the other side of its threshold?
bool keeps_its_piece(const PathProblem& problem, const CurvePoint& point) {
  Vector g;
  if (point.piece.empty()) return true;
  if (!problem.switches(point.x, point.lambda, g)) return false;
  for (Index j = 0; j < g.size(); ++j)
    if (g[j] * point.piece[static_cast<std::size_t>(j)] < -continuation::promised_place)
      return false;
  return true;
}

/// The solved point after this share of the way that is left: moved on along the chord, its wrenches as much larger.
std::optional<CurvePoint> after_share(const PathProblem& problem, const CurvePoint& earlier,
                                      const CurvePoint& last, double left, double share) {
  const double way = last.s - earlier.s, on = share * left / way;
  const Vector w = wrenches_of(problem, last.x), v = wrenches_of(problem, earlier.x);
  const continuation::Direction along{(last.x - earlier.x - (w - v)) / way,
                                      (last.lambda - earlier.lambda) / way};
  const Vector x = last.x + on * way * along.dx + w * (share / (1 - share));
  // The curve's own tolerance is relative to the largest unknown: here that would be to forces without bound.
  constexpr double units_of_rounding = 2;
  continuation::NewtonOptions newton;
  newton.residual_tolerance =
      std::max(newton.residual_tolerance / std::max(1.0, x.lpNorm<Eigen::Infinity>()),
               units_of_rounding * std::numeric_limits<double>::epsilon());
  const auto solved =
      continuation::correct(problem, problem.metric(), x, last.lambda + on * way * along.dlambda,
                            last.piece, along, newton);
  if (!converged(solved)) return std::nullopt;
  CurvePoint point = last;
  point.x = solved.x;
  point.lambda = solved.lambda;
  point.s = last.s + share * left;
  const Vector reached = wrenches_of(problem, point.x);
  const bool has_grown = reached.dot(w) > w.squaredNorm();
  return has_grown && keeps_its_piece(problem, point) ? std::optional(point) : std::nullopt;
}

std::optional<CurvePoint> nearer(const PathProblem& problem, const CurvePoint& earlier,
                                 const CurvePoint& last, double left) {
  for (const double share : {0.75, 0.5, 0.25})
    if (auto point = after_share(problem, earlier, last, left, share)) return point;
  return std::nullopt;
}

void complete_point(const PathProblem& problem, const CurvePoint& earlier, CurvePoint& point) {
  point.negative.reset();
  count_negative(problem, point);
  continuation::Linearisation at;
  if (!continuation::linearise(problem, point.x, point.lambda, point.piece, at)) return;
  const continuation::Direction along{point.x - earlier.x, point.lambda - earlier.lambda};
  if (auto tangent = continuation::tangent_at(at, problem.metric(), along))
    point.tangent = *std::move(tangent);
}

}  // namespace

std::optional<CurvePoint> beside_infinite_force(const PathProblem& problem,
                                                const CurvePoint& earlier, const CurvePoint& last) {
  constexpr int most_points = 100;  // of which each leaves at most three quarters of the way
  // Closures of chains that lie flat together have errors of rounding over their singular value, and with such wrenches the
  // equilibrium one over its square: nearer points than this may not be found, but that there is a pole is certain.
  constexpr double certain_growth = 1e2;
  if (earlier.piece != last.piece || !(last.s > earlier.s)) return std::nullopt;
  CurvePoint a = earlier, b = last;
  for (int i = 0; i < most_points; ++i) {
    const auto left = way_left(problem, a, b);
    if (!left || *left <= continuation::promised_place) break;
    auto next = nearer(problem, a, b, *left);
    if (!next) break;
    a = std::exchange(b, *std::move(next));
  }
  const double grown = wrenches_of(problem, b.x).norm() / wrenches_of(problem, last.x).norm();
  if (!(grown >= certain_growth)) return std::nullopt;
  complete_point(problem, a, b);
  return b;
}

bool is_solved_on_side_of(const PathProblem& problem, const CurvePoint& point,
                          const CurvePoint& before) {
  const double size = std::max({1.0, point.x.lpNorm<Eigen::Infinity>(), std::abs(point.lambda)});
  Vector F;
  return problem.residual(point.x, point.lambda, point.piece, F) &&
         F.lpNorm<Eigen::Infinity>() <=
             continuation::residual_bound(problem, point.piece, {}, size) &&
         wrenches_of(problem, point.x).dot(wrenches_of(problem, before.x)) >= 0;
}

}  // namespace springfold::analysis
