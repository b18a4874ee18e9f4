#include "fall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drive.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// A mode without stiffness, or of negative one, relative to the stiffest mode or to one unit of a problem
/// without dimensions.
constexpr double soft_part = 1e-6;
/// Force along a mode that is above rounding, relative to the stiffest mode.
constexpr double clear_force = 1e-12;
/// Where the energy has not changed up to here, it is flat.
constexpr double largest_push = 0.13;
/// Difference of energies that is above rounding.
constexpr double clear_energy = 1e-13;

/// Directions in which a critical state may be left, as seen from one piece.
std::vector<Vector> soft_directions(const Landscape& landscape, const Vector& critical,
                                    const Piece& piece) {
  std::vector<Vector> list;
  const auto at = landscape.ground_on(critical, piece);
  if (!at || at->hessian.size() == 0) return list;
  const SymmetricEigen modes = symmetric_eigen(at->hessian);
  const double soft = soft_part * std::max(1.0, modes.values.cwiseAbs().maxCoeff());
  // The softest mode of a critical state is the one that matters, whatever the size of the others.
  const Index count = std::max<Index>(1, (modes.values.array() < soft).count());
  const Matrix V = at->motions * modes.vectors.leftCols(count);
  if (count == 1) list.push_back(V.col(0));
  // Several modes at once: any combination may be the way out.
  constexpr int around = 6;
  for (Index i = 0; i + 1 < count; ++i)
    for (int k = 0; k < around; ++k) {
      const double angle = std::numbers::pi * k / around;
      list.push_back(std::cos(angle) * V.col(i) + std::sin(angle) * V.col(i + 1));
    }
  return list;
}

/// The largest entry is positive: eigenvectors have no sign of their own.
Vector oriented(Vector v) {
  Index largest = 0;
  double size = 0;
  for (Index i = 0; i < v.size(); ++i)
    if (std::abs(v[i]) > size * (1 + 1e-6)) size = std::abs(v[i]), largest = i;
  return v[largest] < 0 ? Vector(-v) : v;
}

double noise_of_force(const Landscape& landscape, const Vector& critical, const Piece& piece) {
  const auto at = landscape.ground_on(critical, piece);
  return clear_force * (at && at->hessian.size() > 0 ? std::max(1.0, at->hessian.norm()) : 1.0);
}

/// What a push along a direction shows.
struct Leaving {
  std::optional<Pushed> at{};  ///< the state is left: after the push
  double amplitude = 0;
  bool is_flat = false;  ///< no force above rounding
};

/// The force along a push that the load's error makes.
double force_of(const LoadError& load, const Landscape& landscape, const Vector& x,
                const Vector& along) {
  if (!(load.lambda > 0)) return 0;
  const auto piece = landscape.piece_at(x);
  if (!piece) return 0;
  const Vector rate = load.rate(x, *piece);
  return rate.size() > 0 ? load.lambda * std::abs(rate.dot(along)) : 0;
}

/// The nearest force above rounding and the load's error tells whether the state is left. Where it turns back before a
/// push of the usual size, a stable state lies nearer than that, and the push ends before it.
Leaving leave_along(const Landscape& landscape, const Vector& critical, const Vector& along,
                    double rounding, const LoadError& load) {
  constexpr double least_push = push_size / 1024;
  // The critical state is off by as much as its load: nearer than a push of the usual size only what is far clear
  // counts.
  constexpr double far_clear = 100;
  Leaving outward;
  for (double a = least_push; a < largest_push; a *= 2) {
    const auto at = pushed(landscape, critical, along, critical, {.amplitude = a});
    const bool usual = a >= push_size;
    if (!at && usual) break;
    if (!at) continue;
    const double noise = rounding + force_of(load, landscape, at->x, along);
    if (!(std::abs(at->force) > (usual ? 1 : far_clear) * noise)) continue;
    if (at->force < 0) return outward;
    if (usual)
      return landscape.energy(at->x) < landscape.energy(critical) ? Leaving{at, a} : Leaving{};
    outward = {at, a};
  }
  if (!outward.at) outward.is_flat = true;
  return outward;
}

}  // namespace

Departure shortened(const Landscape& landscape, const Vector& critical, const Departure& departure,
                    double way) {
  constexpr double part = 1e-3;
  const auto piece = landscape.piece_at(departure.x);
  if (!piece) return departure;
  const double noise = noise_of_force(landscape, critical, *piece);
  const double farthest = std::max(part * way, departure.amplitude);
  for (double a = part * way; a <= farthest; a *= 2) {
    const auto at = pushed(landscape, critical, departure.along, critical, {.amplitude = a});
    if (at && at->force > noise && landscape.energy(at->x) < landscape.energy(critical))
      return {departure.side, departure.along, at->x, a};
  }
  return departure;
}

Departures departures(const Landscape& landscape, const Vector& critical,
                      const std::vector<Piece>& pieces, const LoadError& load) {
  Departures result;
  for (const Piece& piece : pieces) {
    const double noise = noise_of_force(landscape, critical, piece);
    for (const Vector& direction : soft_directions(landscape, critical, piece))
      for (const int side : {1, -1}) {
        const Vector along = side * oriented(direction);
        const bool known =
            std::any_of(result.list.begin(), result.list.end(),
                        [&](const Departure& other) { return other.along.dot(along) > 0.999; });
        if (known) continue;
        const Leaving leaving = leave_along(landscape, critical, along, noise, load);
        if (leaving.at) result.list.push_back({side, along, leaving.at->x, leaving.amplitude});
        result.is_flat |= leaving.is_flat;
      }
  }
  return result;
}

bool are_one_way(const Landscape& landscape, const Vector& critical, const Departure& a,
                 const Departure& b) {
  constexpr double opposite = -0.999;
  if (a.along.dot(b.along) < opposite) return false;
  const double energy = landscape.energy(critical);
  for (const double part : {0.25, 0.5, 0.75}) {
    const Vector along = ((1 - part) * a.along + part * b.along).normalized();
    const auto at = pushed(landscape, critical, along, critical,
                           {.amplitude = std::max(a.amplitude, b.amplitude)});
    if (!at || !(landscape.energy(at->x) < energy)) return false;
  }
  return true;
}

bool lead_to_the_same(const Fall& a, const Fall& b) {
  return a.verdict == b.verdict && a.landing == b.landing && a.may_run_away == b.may_run_away &&
         std::is_permutation(a.minima.begin(), a.minima.end(), b.minima.begin(), b.minima.end());
}

double lowest_barrier(std::size_t minimum, const Fall& fall, StateBook& book) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::size_t s : fall.saddles) {
    const std::vector<std::size_t>& beside = book.ways_from(s).minima;
    if (std::find(beside.begin(), beside.end(), minimum) != beside.end())
      lowest = std::min(lowest, book.states()[s].energy - book.states()[minimum].energy);
  }
  return lowest;
}

std::optional<RestState> caught_by(StateBook& book, const Fall& fall, const Vector& x,
                                   double energy) {
  if (fall.is_lost) return std::nullopt;
  const Descent way = descend(book.landscape(), x);
  if (way.end != Descent::End::rest || !is_minimum(way.state)) return std::nullopt;
  for (const std::size_t m : fall.minima) {
    const RestState minimum = book.states()[m];
    if (!book.landscape().same(minimum.x, way.state.x)) continue;
    const double barrier = lowest_barrier(m, fall, book);
    // Several minima that no known saddle parts: what is between them is not known.
    const bool is_parted = std::isfinite(barrier) || fall.verdict == SnapVerdict::unambiguous;
    if (is_parted && energy - minimum.energy < barrier) return minimum;
  }
  return std::nullopt;
}

Fall fall(StateBook& book, const Departure& departure, double energy) {
  Fall result;
  const WaysDown first = book.ways_down(departure.x);
  const double bound = energy - clear_energy * std::max(1.0, std::abs(energy));
  result.minima = first.minima;
  result.may_run_away = first.away;
  result.is_lost = first.lost;
  // The connected part grows by every saddle below the critical energy that one of its minima is
  // beside.
  std::vector<bool> used(book.states().size(), false);
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t s = 0; s < book.states().size(); ++s) {
      used.resize(book.states().size(), false);
      if (used[s] || book.states()[s].index == 0 || !(book.states()[s].energy < bound)) continue;
      const WaysDown ways = book.ways_from(s);
      const bool touches = std::any_of(ways.minima.begin(), ways.minima.end(), [&](std::size_t m) {
        return std::find(result.minima.begin(), result.minima.end(), m) != result.minima.end();
      });
      if (!touches && !(ways.away && result.may_run_away)) continue;
      used[s] = grows = true;
      result.saddles.push_back(s);
      result.may_run_away |= ways.away;
      for (const std::size_t m : ways.minima)
        if (std::find(result.minima.begin(), result.minima.end(), m) == result.minima.end())
          result.minima.push_back(m);
    }
  }
  if (!first.minima.empty()) result.landing = first.minima.front();
  // A state and the same one turned, of other energy: from each to the next it goes on so without end.
  std::vector<std::size_t> kept;
  for (const std::size_t m : result.minima) {
    const bool known = std::any_of(kept.begin(), kept.end(),
                                   [&](std::size_t other) { return book.are_turns(m, other); });
    result.may_run_away |= known;
    if (!known) kept.push_back(m);
  }
  result.minima = std::move(kept);
  if (result.minima.size() == 1 && !result.may_run_away && !result.is_lost)
    result.verdict = SnapVerdict::unambiguous;
  else if (!result.minima.empty())
    result.verdict = SnapVerdict::depends;
  else
    result.verdict = result.may_run_away ? SnapVerdict::runs_away : SnapVerdict::no_stable_state;
  return result;
}

}  // namespace springfold::analysis
