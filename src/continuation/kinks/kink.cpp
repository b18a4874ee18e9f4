#include "continuation/kinks/kink.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/exits.hpp"
#include "continuation/locating/reduced_equation.hpp"
#include "continuation/locating/singular.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

enum class Side { in, out, rests, unclear };

/// On which side of a surface that is tangential here is a value of the switch at this distance? Corrected points are
/// off by their rounding over the distance to a singular point, which this one may be.
Side side_of(double value, double distance) {
  const double zero = exact_model / distance, clear = 10 * zero;
  if (std::abs(value) > clear) return value > 0 ? Side::in : Side::out;
  return std::abs(value) <= zero ? Side::rests : Side::unclear;
}

/// The same where the equations at the point say how far rounding may have moved it.
Side side_by_error(const Walker& walker, const CurvePoint& point, Index j, double value) {
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!walker.problem.switch_gradients(point.x, point.lambda, dg_dx, dg_dlambda))
    return Side::unclear;
  const double error = error_of_value(walker, point, dg_dx, dg_dlambda, j);
  if (!(std::abs(value) > clear_of_rounding * error)) return Side::unclear;
  return value > 0 ? Side::in : Side::out;
}

/// To which side of the surfaces `grazed`, tangential here, does the curve of a piece bend?
/// rests: it stays within the surface.
std::vector<Side> sides_of(const Walker& walker, const CurvePoint& at, const PieceWay& way,
                           const std::vector<Index>& grazed) {
  std::vector<Side> sides(grazed.size(), Side::unclear);
  const auto look = [&](const CurvePoint& point) {
    Vector g;
    if (!walker.problem.switches(point.x, point.lambda, g)) return;
    const double distance = length_of(walker, between(walker, at, point));
    for (std::size_t i = 0; i < grazed.size(); ++i)
      if (sides[i] != Side::in && sides[i] != Side::out) {
        const double value = at.piece[static_cast<std::size_t>(grazed[i])] * g[grazed[i]];
        sides[i] = side_of(value, distance);
        if (sides[i] == Side::unclear) sides[i] = side_by_error(walker, point, grazed[i], value);
      }
  };
  CurvePoint start = way.start.value_or(at);
  if (way.start)
    look(start);
  else
    start.tangent = way.tangent;
  for (const double ds : decades<-4, -2>())
    if (const auto point = point_at(walker, start, ds)) look(*point);
  return sides;
}

void add_doubt(std::string why, Rays& rays) {
  rays.complete = false;
  rays.why = std::move(why);
}

/// Is this way of a piece known already from a piece beyond its resting switches? Such a ray is kept once, in the piece
/// that was asked for, if that is regular. Rounding may let a switch rest on one side and not on the other: that knows
/// where it goes.
/// @param unsure   switches whose rates along the way are none to rounding
/// @param resting  of these, those that are known to rest on it
bool is_known(const Walker& walker, const Piece& preferred, const Piece& piece, const PieceWay& way,
              const std::vector<Index>& unsure, const std::vector<Index>& resting, Rays& rays) {
  for (Ray& ray : rays.rays) {
    // Branches of a singular piece were found apart, though they may touch each other here.
    if (way.start && ray.start && ray.piece == piece) continue;
    std::vector<Index> either = ray.resting;
    either.insert(either.end(), resting.begin(), resting.end());
    if (!differ_only(ray.piece, piece, either) ||
        !(length_of(walker, difference(ray.tangent, way.tangent)) <=
          10 * std::max(way.accuracy, ray.accuracy)))
      continue;
    const auto as_preferred = [&](Index j) {
      return piece[static_cast<std::size_t>(j)] == preferred[static_cast<std::size_t>(j)];
    };
    const auto goes = std::partition(ray.resting.begin(), ray.resting.end(),
                                     [&](Index j) { return way.start || contains(unsure, j); });
    if (!way.start && (goes != ray.resting.end() ||
                       (!ray.resting.empty() && std::ranges::all_of(ray.resting, as_preferred))))
      ray.piece = piece;
    ray.resting.erase(goes, ray.resting.end());
    return true;
  }
  return false;
}

/// Does the point lie on the surface of a switch to rounding?
bool is_on_surface(const CurvePoint& at, const Surfaces& surfaces, Index j) {
  const double size = surfaces.dg_dx.row(j).cwiseAbs().dot(at.x.cwiseAbs()) +
                      std::abs(surfaces.dg_dlambda[j] * at.lambda);
  return is_exact(std::abs(surfaces.g[j]), size);
}

/// The rate of a switch along a way, positive on the side of the piece. Below the accuracy of the way it is known as
/// well as the equations determine it, where the point lies on the surface to rounding: a stiff member moves little,
/// and surely.
KnownRate rate_on_way(const CurvePoint& at, const PieceWay& way, const Surfaces& surfaces, Index j,
                      SwitchRates& rates) {
  const double side = at.piece[static_cast<std::size_t>(j)];
  const KnownRate seen{side * switch_rate(surfaces.dg_dx, surfaces.dg_dlambda, j, way.tangent),
                       way.accuracy};
  if (seen.has_sign() || way.start || !is_on_surface(at, surfaces, j)) return seen;
  KnownRate solved = rates.of(surfaces.dg_dx, surfaces.dg_dlambda, j, way.tangent);
  solved.value *= side;
  return solved.error < way.accuracy ? solved : seen;
}

/// Keeps one direction of one piece if it leads into the piece.
void judge(const Walker& walker, const CurvePoint& at, const PieceWay& way,
           const Surfaces& surfaces, const Piece& preferred, SwitchRates& rates, Rays& rays) {
  std::vector<Index> grazed, resting;
  const auto leads_out = [&](Index j) {
    return at.piece[static_cast<std::size_t>(j)] *
               switch_rate(surfaces.dg_dx, surfaces.dg_dlambda, j, way.tangent) <
           -way.accuracy;
  };
  if (std::ranges::any_of(surfaces.active, leads_out)) return;
  for (const Index j : surfaces.active) {
    const KnownRate rate = rate_on_way(at, way, surfaces, j, rates);
    if (!rate.has_sign())
      grazed.push_back(j);
    else if (rate.value < 0)
      return;
  }
  if (is_known(walker, preferred, at.piece, way, grazed, {}, rays)) return;
  if (!grazed.empty()) {
    const std::vector<Side> sides = sides_of(walker, at, way, grazed);
    if (std::find(sides.begin(), sides.end(), Side::out) != sides.end()) return;
    for (std::size_t i = 0; i < grazed.size(); ++i) {
      if (sides[i] == Side::rests) resting.push_back(grazed[i]);
      if (sides[i] == Side::unclear)
        return add_doubt(
            "the curve grazes a switching surface: " + walker.problem.switch_name(grazed[i]), rays);
    }
  }
  if (!resting.empty() && is_known(walker, preferred, at.piece, way, grazed, resting, rays)) return;
  rays.rays.push_back(
      {at.piece, way.tangent, std::move(resting), way.start, way.beyond, way.accuracy});
}

Piece piece_of(Piece piece, const std::vector<Index>& active, unsigned pattern) {
  for (std::size_t k = 0; k < active.size(); ++k)
    piece[static_cast<std::size_t>(active[k])] = (pattern >> k) & 1u ? 1 : -1;
  return piece;
}

/// By pieces, counted in binary with the first active switch as the lowest digit.
void sort_by_piece(const std::vector<Index>& active, std::vector<Ray>& rays) {
  const auto before = [&](const Ray& a, const Ray& b) {
    for (std::size_t k = active.size(); k-- > 0;) {
      const auto j = static_cast<std::size_t>(active[k]);
      if (a.piece[j] != b.piece[j]) return a.piece[j] < b.piece[j];
    }
    return false;
  };
  std::stable_sort(rays.begin(), rays.end(), before);
}

/// Has the piece surely one curve through the point? At less cost than its decomposition. false: not known
bool is_surely_regular(const Walker& walker, const CurvePoint& at, double full_rank) {
  constexpr double safely = 10;
  Linearisation linear;
  return at.tangent.dx.size() == at.x.size() &&
         linearise(walker.problem, at.x, at.lambda, at.piece, linear) &&
         !is_singular(extended_matrix(linear, walker.weights, at.tangent), safely * full_rank);
}

/// Is it known that a start lies off all of these surfaces, which are too near to be told from it, in a piece in which
/// curves cross there? What leaves in that piece, as along a dead band, is not seen.
bool lies_between(const Walker& walker, const CurvePoint& start, const std::vector<Index>& active) {
  Vector g;
  if (active.empty() || !walker.problem.switches(start.x, start.lambda, g)) return false;
  const double rounding = exact_model * scale_of(start);
  const auto is_clear = [&](Index j) {
    return start.piece[static_cast<std::size_t>(j)] * g[j] > rounding;
  };
  return std::ranges::all_of(active, is_clear) && corank_of(walker, start, located_rank) > 0;
}

}  // namespace

bool differ_only(const Piece& a, const Piece& b, const std::vector<Index>& where) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j] != b[j] && !contains(where, static_cast<Index>(j))) return false;
  return true;
}

std::vector<Index> active_switches(const Walker& walker, const Vector& x, double lambda) {
  std::vector<Index> active;
  Vector g;
  if (!walker.problem.switches(x, lambda, g)) return active;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= walker.options.simultaneous) active.push_back(j);
  return active;
}

std::vector<Index> active_or_met(const Walker& walker, const KinkSearch& kink) {
  std::vector<Index> active = active_switches(walker, kink.point.x, kink.point.lambda);
  if (!contains(active, kink.met))
    active.insert(std::ranges::lower_bound(active, kink.met), kink.met);
  return active;
}

Rays rays_around(const Walker& walker, const CurvePoint& at, const std::vector<Index>& active,
                 double full_rank, const Direction* along, bool polished,
                 const std::vector<Piece>* among) {
  assert(active.size() <= most_active);
  Surfaces surfaces{.active = active};
  if (!active.empty() &&
      (!walker.problem.switch_gradients(at.x, at.lambda, surfaces.dg_dx, surfaces.dg_dlambda) ||
       !walker.problem.switches(at.x, at.lambda, surfaces.g)))
    return {.complete = false, .why = "switching functions are not defined here"};
  Rays rays;
  std::vector<unsigned> singular;
  CurvePoint ray = at;
  const auto add = [&](const PieceWays& ways) {
    if (!ways.why.empty()) add_doubt(ways.why, rays);
    SwitchRates rates(walker, ray);
    for (const PieceWay& way : ways.list) judge(walker, ray, way, surfaces, at.piece, rates, rays);
  };
  for (unsigned pattern = 0; pattern < (1u << active.size()); ++pattern) {
    ray.piece = piece_of(at.piece, active, pattern);
    const bool is_asked = !among || std::ranges::find(*among, ray.piece) != among->end();
    if (!is_asked && is_surely_regular(walker, ray, full_rank)) continue;
    const bool arrives = along && ray.piece == at.piece;
    PieceWays ways = arrives ? both_ways(*along) : regular_ways(walker, ray, full_rank, polished);
    if (along && active.size() == 1 && !ways.list.empty()) {
      // The point lies on the surface to rounding.
      const double off = known_rate(walker, ray, surfaces.dg_dx, surfaces.dg_dlambda,
                                    active.front(), ways.list.front().tangent)
                             .error;
      for (PieceWay& way : ways.list) {
        if (ways.conditioning > 0)
          way.accuracy = std::min(way.accuracy, 2 * exact_model / ways.conditioning);
        way.accuracy = std::min(way.accuracy, off);
      }
    }
    if (ways.singular) singular.push_back(pattern);
    if (ways.singular || is_asked) add(ways);
  }
  if (active.empty() && !singular.empty())
    add_doubt("more than one curve, or none, passes through this point", rays);
  if (!active.empty())
    for (const unsigned pattern : singular) {
      ray.piece = piece_of(at.piece, active, pattern);
      std::vector<Direction> known;
      for (const Ray& other : rays.rays) known.push_back(other.tangent);
      add(singular_ways(walker, ray, surfaces, known));
    }
  sort_by_piece(active, rays.rays);
  return rays;
}

Rays rays_at(const Walker& walker, const Vector& x, double lambda, const Piece& piece,
             const std::vector<Index>& active) {
  CurvePoint at;
  at.x = x;
  at.lambda = lambda;
  at.piece = piece;
  Rays rays =
      rays_around(walker, at, active, active.empty() ? residual_level : one_place, nullptr, true);
  if (rays.complete && lies_between(walker, at, active))
    add_doubt("the start lies between the thresholds of " + names_of(walker.problem, active) +
                  ", nearer than points are told apart",
              rays);
  return rays;
}

}  // namespace springfold::continuation
