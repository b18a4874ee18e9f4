// The place of a kink by equations of its own.
#include <algorithm>
#include <cmath>

#include "continuation/kinks/kink.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::continuation {
namespace {

/// The equations of a point of the surface of switch j, in equilibrated unknowns and rows:
///     | dF_dx  dF_dlambda |
///     | dg_dx  dg_dlambda |
struct OnSurface {
  Matrix M{};
  Vector value{};  ///< F and g_j
  Equilibration scale{};
  Lu factors{};
};

std::optional<OnSurface> equations_on_surface(const Walker& walker, const CurvePoint& p, Index j) {
  const Index n = p.x.size();
  Linearisation at;
  Vector F, g, dg_dlambda;
  Matrix dg_dx;
  if (!walker.problem.residual(p.x, p.lambda, p.piece, F) ||
      !linearise_densely(walker.problem, p.x, p.lambda, p.piece, at) ||
      !walker.problem.switches(p.x, p.lambda, g) ||
      !walker.problem.switch_gradients(p.x, p.lambda, dg_dx, dg_dlambda))
    return std::nullopt;
  OnSurface e{.M = Matrix(n + 1, n + 1), .value = Vector(n + 1)};
  e.M << at.dF_dx, at.dF_dlambda, dg_dx.row(j), dg_dlambda[j];
  e.value << F, g[j];
  e.scale = equilibrate(e.M.cwiseAbs());
  e.factors.compute(e.scale.rows.asDiagonal() * e.M * e.scale.columns.asDiagonal());
  return e;
}

/// One step of Newton's method.
std::optional<Direction> step_to_surface(const Walker& walker, const CurvePoint& p, Index j) {
  const auto e = equations_on_surface(walker, p, j);
  if (!e) return std::nullopt;
  const Index n = p.x.size();
  const Vector step =
      -e->scale.columns.cwiseProduct(e->factors.solve(e->scale.rows.cwiseProduct(e->value)));
  if (!step.allFinite()) return std::nullopt;
  return Direction{step.head(n), step[n]};
}

/// What rounding of the terms of each equation makes of the value of another switch, of this gradient, at a place on
/// the surface of switch j: it is held there, however far soft springs let rounding move a point along a curve.
double error_on_surface(const Walker& walker, const CurvePoint& place, Index j,
                        const Vector& gradient) {
  const auto e = equations_on_surface(walker, place, j);
  if (!e) return infinity;
  Vector u(place.x.size() + 1);
  u << place.x, place.lambda;
  const Vector answers = e->scale.rows.cwiseProduct(
      Vector(e->factors.solve_transposed(e->scale.columns.cwiseProduct(gradient))));
  const double error = refined_step * (gradient.cwiseAbs().dot(u.cwiseAbs()) +
                                       answers.cwiseAbs().dot(e->M.cwiseAbs() * u.cwiseAbs()));
  return std::isfinite(error) ? error : infinity;
}

/// The curve's own point on the surface of switch j.
std::optional<CurvePoint> point_on_surface(const Walker& walker, const CurvePoint& near, Index j) {
  CurvePoint point = near;
  double moved = 0;
  const bool settled = settles(4, [&](double) -> std::optional<IterationStep> {
    const auto step = step_to_surface(walker, point, j);
    if (!step) return std::nullopt;
    point.x += step->dx;
    point.lambda += step->dlambda;
    const double length = length_of(walker, *step), size = std::max(1.0, size_of(point));
    moved += length;
    if (!(moved <= same_point * size)) return std::nullopt;
    return IterationStep{length, rounding_unit * size, same_point * size};
  });
  return settled ? std::optional(std::move(point)) : std::nullopt;
}

void take_place(const CurvePoint& from, CurvePoint place, KinkSearch& kink) {
  kink.before = std::min(kink.before, place.s - from.s);
  kink.after = std::max(kink.after, place.s - from.s);
  kink.point = std::move(place);
}

/// Which of the surfaces does the curve surely meet behind this place on the surface of `first`, and does it meet that
/// one first?
struct Order {
  std::vector<Index> here{}, ahead{};
  bool is_first = true;
};

Order order_at(const Walker& walker, const CurvePoint& place, Index first,
               const std::vector<Index>& left, const std::vector<Index>& active) {
  Order order;
  Workspace::Switches at;
  if (!read_switches(walker, place, at)) return {.is_first = false};
  for (const Index j : active) {
    const double side = place.piece[static_cast<std::size_t>(j)];
    Vector gradient(place.x.size() + 1);
    gradient << at.dg_dx.row(j).transpose(), at.dg_dlambda[j];
    const bool sure =
        j != first && !contains(left, j) &&
        std::abs(at.g[j]) > between_samples * error_on_surface(walker, place, first, gradient);
    if (sure && side * at.g[j] < 0) order.is_first = false;
    const bool ahead = sure && side * sure_rate(walker, at, j, place) < 0;
    (ahead ? order.ahead : order.here).push_back(j);
  }
  return order;
}

/// Switches act together where it makes no difference to any row which of them is first: is the curve, on this piece
/// and on that behind the surfaces `crossed`, as good as here when it meets that of j?
bool is_as_good_as_there(const Walker& walker, const CurvePoint& place,
                         const std::vector<Index>& crossed, Index j) {
  const double most = promised_place * std::max(1.0, size_of(place));
  const auto is_here = [&](const CurvePoint& near) {
    const auto there = point_on_surface(walker, near, j);
    return there && length_of(walker, difference(*there, place)) <= most;
  };
  return is_here(place) && is_here(behind(place, crossed));
}

}  // namespace

std::optional<CurvePoint> place_on_surface(const Walker& walker, const CurvePoint& from,
                                           const CurvePoint& near, Index j) {
  auto point = point_on_surface(walker, near, j);
  LinearisedPoint* place =
      point ? linearised_at(walker.problem, *walker.memory, point->x, point->lambda, point->piece)
            : nullptr;
  if (place == nullptr ||
      !tangent_at(*walker.memory, *place, walker.weights, near.tangent, point->tangent) ||
      !(cosine(walker, point->tangent, near.tangent) > same_way))
    return std::nullopt;
  point->s = from.s + std::max(0.0, way_to(walker.weights, from, *point));
  if (walker.problem.symmetric()) point->negative = place->factors.negative();
  return point;
}

void part_surfaces(const Walker& walker, const CurvePoint& from, const std::vector<Index>& left,
                   KinkSearch& kink) {
  if (kink.active.size() < 2 || kink.singular || walker.problem.structured()) return;
  for (const Index first : kink.active) {
    if (contains(left, first)) continue;
    auto place = place_on_surface(walker, from, kink.point, first);
    if (!place) continue;
    Order order = order_at(walker, *place, first, left, kink.active);
    const auto is_here = [&](Index j) {
      return is_as_good_as_there(walker, *place, order.here, j);
    };
    if (!order.is_first || std::ranges::all_of(order.ahead, is_here)) continue;
    kink.met = first;
    kink.active = std::move(order.here);
    return take_place(from, std::move(*place), kink);
  }
}

void settle_on_surface(const Walker& walker, const CurvePoint& from, KinkSearch& kink) {
  if (kink.active.size() != 1 || kink.singular || walker.problem.structured()) return;
  if (auto place = place_on_surface(walker, from, kink.point, kink.active.front()))
    take_place(from, std::move(*place), kink);
}

}  // namespace springfold::continuation
