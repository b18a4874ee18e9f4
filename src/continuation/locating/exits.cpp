#include "continuation/locating/exits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "continuation/locating/reduced_equation.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {
namespace {

/// Twice the largest of the spheres on which ways of close modes are told.
constexpr double around_spheres = 8 * told_apart;
/// Of two curves that cross.
constexpr std::size_t ways_of_two = 4;

Direction direction_of(const ReducedEquation& e, const Vector& U) {
  return unit_direction(*e.walker, Vector(U.cwiseQuotient(e.root)));
}

std::vector<Vector> directions_of(const RaySet& set) {
  std::vector<Vector> directions;
  for (const RayPoint& ray : set.rays) directions.push_back(ray.c / set.rho);
  return directions;
}

/// Has each of these directions a ray of its own, nearer than `within`?
bool covers(const RaySet& set, const std::vector<Vector>& directions, double within) {
  std::vector<Vector> free = directions_of(set);
  for (const Vector& d : directions) {
    const auto off = [&d](const Vector& ray) { return (ray - d).norm(); };
    const auto nearest =
        std::min_element(free.begin(), free.end(),
                         [&](const Vector& a, const Vector& b) { return off(a) < off(b); });
    if (nearest == free.end() || !(off(*nearest) < within)) return false;
    free.erase(nearest);
  }
  return true;
}

/// Do two radii show the same branches?
bool same_rays(const RaySet& a, const RaySet& b) {
  constexpr double one_ray = 0.15;
  return a.rays.size() == b.rays.size() && covers(b, directions_of(a), one_ray);
}

bool balanced(const RaySet& set) {
  int sum = 0;
  for (const RayPoint& ray : set.rays) sum += ray.sign;
  return sum == 0;
}

/// What one radius shows, the other may have missed.
void complement(const ReducedEquation& e, const RaySet& from, RaySet& to) {
  for (const RayPoint& ray : from.rays) add_ray(e, e.U0 + to.rho / from.rho * (ray.U - e.U0), to);
}

struct Limit {
  Vector c{};  ///< empty: not found
  double accuracy = infinity;
};

/// Where the branch of a ray is expected `times` as far away: on the parabola through the singular point that touches
/// the branch at the ray's point. Where curves cross under a small angle and bend by more than that, half of the way to
/// a point of one of them is nearer to the other.
Vector expected(const ReducedEquation& e, const RayPoint& ray, double times) {
  const Vector way = ray.U - e.U0;
  if (ray.rate.size() == 0) return e.U0 + times * way;
  return e.U0 + times * ((2 - times) * way + (times - 1) * ray.rate);
}

/// Points of the ray at 4 rho, 2 rho, rho, rho / 2, ... as far as the branch can be followed.
std::vector<RayPoint> along(const ReducedEquation& e, const RayPoint& ray, double rho) {
  std::vector<RayPoint> points{ray};
  const auto follow = [&](double factor, int most) {
    double r = rho;
    for (RayPoint here = ray; most > 0; --most) {
      auto next = ray_point(e, expected(e, here, factor), factor * r);
      if (!next || (next->c / (factor * r) - here.c / r).norm() > aside_share) return;
      points.insert(factor > 1 ? points.begin() : points.end(), *next);
      here = std::move(*next);
      r *= factor;
    }
  };
  follow(2, 2);
  follow(0.5, 4);
  return points;
}

/// c / rho on the branch for rho -> 0 (Neville's scheme), where change and rounding are least.
Limit limit_of(const ReducedEquation& e, const RayPoint& ray, double rho) {
  Limit best;
  std::vector<Vector> row;
  for (const RayPoint& point : along(e, ray, rho)) {
    std::vector<Vector> fresh{point.c.normalized()};
    for (std::size_t j = 0; j < row.size(); ++j) {
      fresh.push_back(fresh[j] + (fresh[j] - row[j]) / (std::exp2(static_cast<double>(j + 1)) - 1));
      const double doubt = (fresh[j + 1] - fresh[j]).norm() + 3 * point.noise;
      if (doubt < best.accuracy) best = {fresh[j + 1].normalized(), doubt};
    }
    row = std::move(fresh);
  }
  if (best.c.size() == 0) return best;
  const auto exact = quadratic_direction(e, best.c, negligible_share);
  if (exact && (*exact - best.c).norm() < told_apart + 10 * best.accuracy)
    best = {*exact, promised_place};
  return best;
}

/// The point of a ray as a point of its branch, like find_point, but without the corrector's
/// judgement: close to other branches rounding moves the point along the sphere.
std::optional<CurvePoint> branch_point_of(const ReducedEquation& e, const RayPoint& ray) {
  const Walker& walker = *e.walker;
  const Index n = e.U0.size() - 1;
  CurvePoint point;
  const Vector way = (ray.U - e.U0).cwiseQuotient(e.root);
  point.s = length_of(walker, Direction{way.head(n), way[n]});  // multipliers have none
  point.x = ray.U.head(n).cwiseQuotient(e.root.head(n));
  point.lambda = ray.U[n];
  point.piece = e.piece;
  Vector F;
  Linearisation at;
  if (!walker.problem.residual(point.x, point.lambda, e.piece, F) ||
      !(F.lpNorm<Eigen::Infinity>() <=
        residual_bound(walker.problem, e.piece, walker.options.newton, e.scale)) ||
      !linearise(walker.problem, point.x, point.lambda, e.piece, at))
    return std::nullopt;
  const auto tangent = tangent_at(at, walker.weights, direction_of(e, ray.U - e.U0));
  if (!tangent) return std::nullopt;
  point.tangent = *tangent;
  if (walker.problem.symmetric()) point.negative = negative_eigenvalues(at);
  return point;
}

/// A point of the branch at the distance rho in the kernel, half as far as the last one: by Newton's
/// method, and where that drowns in rounding by the expansion of second order, exact to rounding there.
std::optional<RayPoint> nearer(const ReducedEquation& e, const RayPoint& last, const Vector& limit,
                               double rho) {
  if (auto ray = ray_point(e, expected(e, last, 0.5), rho)) return ray;
  const Vector c = rho * limit;
  return RayPoint{.U = e.U0 + e.N * c + bend_along(e, c), .c = c};
}

/// Brings the start of a branch in until it is near enough.
/// @returns false where that does not succeed
bool bring_in(const ReducedEquation& e, const Limit& limit, RayPoint ray, double rho,
              const Direction& tangent, const NearEnough& near_enough, CurvePoint& start) {
  const double nearest = one_place * e.scale;
  while (!near_enough(start, tangent)) {
    rho *= 0.5;
    if (rho < nearest) return false;
    const auto next = nearer(e, ray, limit.c, rho);
    const auto point = next ? branch_point_of(e, *next) : std::nullopt;
    if (!point) return false;
    ray = *next;
    start = *point;
  }
  return true;
}

/// How a branch leaves the point: as it does right there, or across the sphere on which it was found.
enum class Leaving { at_the_point, across_the_sphere };

/// Adds the branch of one ray, or a reason why not all is well.
void add_exit(const ReducedEquation& e, const RayPoint& ray, double rho, Leaving leaving,
              const NearEnough& near_enough, Exits& result) {
  const auto doubt = [&](std::string why) {
    result.complete = false;
    result.why = std::move(why);
  };
  auto start = branch_point_of(e, ray);
  if (!start) return doubt("a branch near the point could not be corrected to the tolerance");
  const Limit limit = leaving == Leaving::at_the_point ? limit_of(e, ray, rho)
                                                       : Limit{ray.c.normalized(), promised_place};
  if (limit.c.size() == 0) return doubt("a branch near the point could not be followed into it");
  if (limit.accuracy > nearly_same_line)
    doubt("the tangent of a branch is known to " + rounded(limit.accuracy) + " only");
  const double away =
      (e.N * ray.c)
          .normalized()
          .dot(Vector(
                   scaled_point({.x = start->tangent.dx, .lambda = start->tangent.dlambda}, e.root))
                   .normalized());
  if (leaving == Leaving::at_the_point && away < std::cos(std::numbers::pi / 6))
    doubt("a branch is strongly curved near the point");
  const Direction tangent = direction_of(e, e.N * limit.c);
  const CurvePoint found = *start;
  if (near_enough && !bring_in(e, limit, ray, rho, tangent, near_enough, *start))
    doubt("a branch switches too near to the point to be followed");
  Exit exit{tangent, limit.accuracy, std::move(*start)};
  if (exit.start.s < found.s) exit.beyond = found;
  result.exits.push_back(std::move(exit));
}

/// Two curves cross, and only these: the quadratic terms of one equation in two unknowns say so where they have two
/// real lines. A sphere on which there are other ways is too large: they belong to a branch that passes beside the
/// point. Signs balance then as well, but on spheres that another eigenvalue's zero lies inside of, as where two modes
/// become critical together but for little.
bool is_crossing_of_two(const ReducedEquation& e, const std::vector<Vector>& sure) {
  return e.k == 1 && sure.size() == ways_of_two;
}

struct Search {
  RaySet set{};
  std::string doubt{};   ///< set: the radii do not agree
  bool crosses = false;  ///< two curves cross, and only these
};

/// Smaller and smaller spheres until neighbouring ones, as many as are needed, show the same.
Search search_inwards(const ReducedEquation& e, double rho, int radii, int needed) {
  const double shrink = e.k == 2 ? 0.5 : 1.0 / 3;
  const std::vector<Vector> sure = quadratic_rays(e);
  const bool crosses = is_crossing_of_two(e, sure);
  RaySet last;
  std::string doubt = "different radii show different branches";
  int agreeing = 0;
  for (int i = 0; i < radii; ++i, rho *= shrink) {
    RaySet set = rays_on_sphere(e, rho, i == 0 ? 360 : 120);
    if (i > 0) {
      complement(e, last, set);
      complement(e, set, last);
    }
    const bool same = agreeing > 0 && same_rays(last, set);
    const bool good = set.doubt.empty() && covers(set, sure, near_share) &&
                      (crosses ? set.rays.size() == ways_of_two : balanced(set));
    agreeing = good ? (same ? agreeing + 1 : 1) : 0;
    if (!set.doubt.empty()) doubt = set.doubt;
    last = std::move(set);
    if (agreeing == needed) return {std::move(last), {}, crosses};
  }
  // Another branch may be so near that few spheres are small enough: one shows the ways that are known to be all.
  if (crosses && agreeing > 0) doubt.clear();
  return {std::move(last), doubt, crosses};
}

/// Has every way a tangent of its own?
bool are_parted(const Walker& walker, const std::vector<Exit>& exits) {
  for (std::size_t i = 0; i < exits.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Direction &a = exits[i].tangent, &b = exits[j].tangent;
      if (length_of(walker, {a.dx - b.dx, a.dlambda - b.dlambda}) < one_direction) return false;
    }
  return true;
}

Exits exits_of(const ReducedEquation& e, const Search& search, Leaving leaving,
               const NearEnough& near_enough) {
  Exits result;
  for (const RayPoint& ray : search.set.rays)
    add_exit(e, ray, search.set.rho, leaving, near_enough, result);
  if (result.complete && search.crosses && !are_parted(*e.walker, result.exits)) {
    result.complete = false;
    result.why = "curves cross under so small an angle that their ways are not told apart";
  }
  if (result.why.empty() && !search.doubt.empty()) {
    result.complete = false;
    result.why = search.doubt;
  }
  return result;
}

}  // namespace

Exits exits_at(const Walker& walker, const CurvePoint& at, int corank,
               const NearEnough& near_enough) {
  if (corank < 0 || corank > 2 || corank > at.x.size())
    return {.complete = false,
            .why = "branches are not searched for at points of corank " + std::to_string(corank)};
  if (walker.problem.structured() && at.x.size() > most_entries)
    return {.complete = false,
            .why = "branches are not searched for among more than " + std::to_string(most_entries) +
                   " unknowns"};
  const auto e = reduce(walker, at, corank);
  if (!e) return {.complete = false, .why = "the equations cannot be expanded at this point"};
  const double rho = std::min(2 * negligible_share * e->scale,
                              small_share / std::max(e->curvature, promised_place));
  Search search = search_inwards(*e, rho, 8, corank == 2 ? 2 : 3);
  // Branches that only terms of fifth order and higher tell apart drown in rounding further in.
  if (!search.doubt.empty() && corank == 2) {
    Search further_out = search_inwards(*e, 6 * rho, 5, 2);
    if (further_out.doubt.empty()) search = std::move(further_out);
  }
  return exits_of(*e, search, Leaving::at_the_point, near_enough);
}

// With E = [J; tau^T] some way back, which is regular, and here, (1 - s) E_back + s E_here is singular at the places s
// of the modes, 1 is here.
Index modes_within(const Walker& walker, const CurvePoint& at, double within) {
  constexpr double back = around_spheres / (2 * aside_share);
  const Vector root = metric_roots(walker.weights), U = scaled_point(at, root);
  const Vector tau =
      scaled_point({.x = at.tangent.dx, .lambda = at.tangent.dlambda}, root).normalized();
  const auto E = [&](double distance) -> std::optional<Matrix> {
    const auto J = jacobian_at(walker, U - distance * tau, root, at.piece, true);
    if (!J) return std::nullopt;
    Matrix extended(U.size(), U.size());
    extended << J->dense, tau.transpose();
    return extended;
  };
  const auto here = E(0), behind = E(back);
  if (!here || !behind) return 0;
  const Matrix change = Lu(*behind).solve(Matrix(*behind - *here));
  if (!change.allFinite()) return 0;
  Index count = 0;
  for (const auto& rate : eigenvalues(change))
    if (std::abs(1.0 - rate) * back <= within * std::abs(rate)) ++count;
  return count;
}

Exits exits_of_close_modes(const Walker& walker, const CurvePoint& at,
                           const NearEnough& near_enough) {
  if (at.x.size() < 2 || walker.problem.structured() ||
      modes_within(walker, at, around_spheres) != 2)
    return {.complete = false, .why = "not two modes alone vanish beside this point"};
  const auto e = reduce(walker, at, 2);
  if (!e) return {.complete = false, .why = "the equations cannot be expanded at this point"};
  constexpr int spheres = 3;
  Exits exits = exits_of(*e, search_inwards(*e, 4 * told_apart, spheres, spheres),
                         Leaving::across_the_sphere, near_enough);
  for (const Matrix& Q : e->quadratic)
    if (Q.topLeftCorner(2, 2).norm() > negligible_share * Q.norm()) exits.of_quadratic = true;
  return exits;
}

int corank_of(const Walker& walker, const CurvePoint& at, double share) {
  const auto own = equilibrated_jacobian(walker, at);
  if (!own) return -1;
  if (own->J.rows() == 0) return 0;
  return static_cast<int>(vanishing_values(divided_svd(own->J).values, share));
}

}  // namespace springfold::continuation
