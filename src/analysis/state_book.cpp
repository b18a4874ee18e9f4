#include "state_book.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "analysis/random_fraction.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// First distance from a saddle, along an unstable mode; halved until the energy is lower there.
constexpr double kick = 0.02;
constexpr int most_halvings = 20;

}  // namespace

std::size_t StateBook::add(const RestState& state) {
  // States of different energy are different: the costly comparison is left to the few others.
  constexpr double same_energy = 1e-8;
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (std::abs(states_[i].energy - state.energy) <=
            same_energy * std::max(1.0, std::abs(state.energy)) &&
        states_[i].index == state.index && landscape_.same(states_[i].x, state.x))
      return i;
  states_.push_back(state);
  ways_.emplace_back();
  return states_.size() - 1;
}

WaysDown StateBook::ways_down(const Vector& x, int depth) {
  WaysDown ways;
  const Descent down = descend(landscape_, x);
  if (down.end == Descent::End::runs_away)
    ways.away = true;
  else if (down.end == Descent::End::lost)
    ways.lost = true;
  else if (down.state.index == 0 && down.state.is_clear)
    ways.minima.push_back(add(down.state));
  else if (depth > 0)
    leave(down.state, ways, depth - 1);
  else
    ways.lost = true;
  return ways;
}

void StateBook::leave(const RestState& state, WaysDown& ways, int depth) {
  const auto at = landscape_.ground_on(state.x, state.piece);
  if (!at || at->hessian.size() == 0) return;
  // Where springs rest the modes of one piece may lead into another one, where the energy rises: energies decide.
  bool is_left = false;
  const SymmetricEigen modes = symmetric_eigen(at->hessian);
  for (Index i = 0; i < std::max<Index>(1, state.index); ++i)
    for (const double sign : {1.0, -1.0}) {
      std::optional<Vector> x;
      double length = kick;
      for (int h = 0; h < most_halvings; ++h, length /= 2) {
        x = landscape_.moved(*at, sign * length * modes.vectors.col(i));
        if (x && landscape_.energy(*x) < state.energy) break;
        x.reset();
      }
      if (!x) continue;
      is_left = true;
      const WaysDown further = ways_down(*x, depth);
      ways.away |= further.away;
      ways.lost |= further.lost;
      for (const std::size_t m : further.minima)
        if (std::find(ways.minima.begin(), ways.minima.end(), m) == ways.minima.end())
          ways.minima.push_back(m);
    }
  // A state that is flat to second order and nowhere left is a minimum all the same.
  if (!is_left && state.index == 0) ways.minima.push_back(add(state));
}

const WaysDown& StateBook::ways_from(std::size_t saddle) {
  if (!ways_[saddle]) {
    WaysDown ways;
    leave(RestState{states_[saddle]}, ways, 3);
    ways_[saddle] = std::move(ways);
  }
  return *ways_[saddle];
}

void StateBook::climb_from_minima(const StateSearch& options) {
  for (; climbed_ < states_.size() && std::ssize(states_) < options.maximum; ++climbed_) {
    const RestState from = states_[climbed_];
    if (from.index != 0 || !(from.energy < options.bound)) continue;
    const auto at = landscape_.ground_on(from.x, from.piece);
    if (!at || at->hessian.size() == 0) continue;
    const SymmetricEigen modes = symmetric_eigen(at->hessian);
    for (Index i = 0; i < std::min<Index>(options.modes, at->hessian.rows()); ++i)
      for (const double sign : {1.0, -1.0}) {
        const Vector along = sign * (at->motions * modes.vectors.col(i));
        const auto saddle = climb(landscape_, from.x, along);
        if (!saddle || saddle->index != 1) continue;
        const std::size_t number = add(*saddle);
        if (states_[number].energy < options.bound) ways_from(number);  // adds the minima beside it
      }
  }
}

void StateBook::search_box(const StateSearch& options) {
  if (states_.empty()) return;
  Vector low = states_.front().x, high = low;
  for (const RestState& state : states_) {
    low = low.cwiseMin(state.x);
    high = high.cwiseMax(state.x);
  }
  std::mt19937_64 random(options.seed);
  for (int s = 0; s < options.starts && std::ssize(states_) < options.maximum; ++s) {
    Vector x = states_.front().x;
    for (const Index i : landscape_.moving()) {
      const double least = landscape_.periods()[i] > 0 ? 2 * std::numbers::pi : 1;
      const double width = std::max(2 * (high[i] - low[i]), least);
      x[i] = (low[i] + high[i]) / 2 + (random_fraction(random) - 0.5) * width;
    }
    if (!landscape_.close(x) || !std::isfinite(landscape_.energy(x))) continue;
    if (s % 2 == 0) {
      ways_down(x);
    } else if (const auto saddle = climb(landscape_, x, {})) {
      add(*saddle);
    }
  }
}

void StateBook::search(const StateSearch& options) {
  climb_from_minima(options);
  search_box(options);
  climb_from_minima(options);
}

}  // namespace springfold::analysis
