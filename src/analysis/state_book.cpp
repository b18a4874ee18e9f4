#include "state_book.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "analysis/random_fraction.hpp"
#include "drive.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// First distance from a saddle, along an unstable mode; halved until the energy is lower there.
constexpr double kick = 0.02;
constexpr int most_halvings = 20;
/// Energies of one state that was solved for twice, relative to it or to one unit of a problem without dimensions.
constexpr double same_energy = 1e-8;

bool are_same(double a, double b) {
  return std::abs(a - b) <= same_energy * std::max({1.0, std::abs(a), std::abs(b)});
}

/// Two states of rest without stiffness at one height: places of one motion that nothing resists, as far as can be
/// seen.
bool are_on_one_floor(const RestState& a, const RestState& b) {
  return !a.is_clear && !b.is_clear && are_same(a.energy, b.energy);
}

/// Loads do work in a whole turn of a coordinate, as much in every state: turned states have other energies and the
/// same surroundings. (A spring that counts turns has other forces after one: such states are different.)
bool turns_take_work(const Landscape& landscape, const Vector& x) {
  constexpr double beside = 0.01;  // a second state, anywhere
  Vector other = x;
  for (const Index i : landscape.moving()) other[i] += beside;
  const auto work = [&](const Vector& from, Index i) {
    Vector turned = from;
    turned[i] += landscape.periods()[i];
    return landscape.energy(turned) - landscape.energy(from);
  };
  bool takes_work = false;
  for (const Index i : landscape.moving()) {
    if (!(landscape.periods()[i] > 0) || are_same(work(x, i), 0)) continue;
    if (!are_same(work(x, i), work(other, i))) return false;
    takes_work = true;
  }
  return takes_work;
}

}  // namespace

std::size_t StateBook::add(const RestState& state) {
  if (!turns_take_work_) turns_take_work_ = turns_take_work(landscape_, state.x);
  std::size_t first = states_.size();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    // States of different energy are different, but for turns: the costly comparison is left to the few others.
    const bool alike = are_same(states_[i].energy, state.energy);
    if (!(alike || (*turns_take_work_ && first == states_.size())) ||
        states_[i].index != state.index || !landscape_.same(states_[i].x, state.x))
      continue;
    if (alike) return i;
    first = first_of_turns_[i];
  }
  states_.push_back(state);
  climbed_.push_back(false);
  ways_.emplace_back();
  first_of_turns_.push_back(first);
  return states_.size() - 1;
}

bool StateBook::has_turns() const {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (first_of_turns_[i] != i) return true;
  return false;
}

/// The same as one that the way down came past, but for whole turns and the energy that these release: so it goes on
/// for ever.
bool StateBook::is_turned(const std::vector<RestState>& met, const RestState& state) const {
  /// States without stiffness are known to the root of what residuals are solved to.
  constexpr double near = 1e-4;
  if (met.empty() || !turns_take_work(landscape_, state.x)) return false;
  return std::any_of(met.begin(), met.end(), [&](const RestState& before) {
    if (!(before.energy > state.energy) || are_same(before.energy, state.energy)) return false;
    return std::all_of(landscape_.moving().begin(), landscape_.moving().end(), [&](Index i) {
      const double d = before.x[i] - state.x[i], period = landscape_.periods()[i];
      return std::abs(period > 0 ? std::remainder(d, period) : d) < near;
    });
  });
}

WaysDown StateBook::ways_down_past(const std::vector<RestState>& met, const Vector& x) {
  constexpr std::size_t most_met = 4;
  WaysDown ways;
  const Descent down = descend(landscape_, x);
  if (down.end == Descent::End::runs_away)
    ways.away = true;
  else if (down.end == Descent::End::lost)
    ways.lost = true;
  else if (down.state.index == 0 && down.state.is_clear)
    ways.minima.push_back(add(down.state));
  else if (is_turned(met, down.state))
    ways.away = true;
  else if (met.size() < most_met) {
    std::vector<RestState> further = met;
    further.push_back(down.state);
    leave(further, ways);
  } else
    ways.lost = true;
  return ways;
}

void StateBook::leave(const std::vector<RestState>& met, WaysDown& ways) {
  const RestState& state = met.back();
  const auto at = landscape_.ground_on(state.x, state.piece);
  if (!at || at->hessian.size() == 0) {
    ways.lost = true;
    return;
  }
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
      const WaysDown further = ways_down_past(met, *x);
      ways.away |= further.away;
      ways.lost |= further.lost;
      for (const std::size_t m : further.minima)
        if (std::find(ways.minima.begin(), ways.minima.end(), m) == ways.minima.end())
          ways.minima.push_back(m);
    }
  // A state that is flat to second order and nowhere left is a minimum all the same.
  if (is_left) return;
  if (state.index == 0)
    ways.minima.push_back(add(state));
  else
    ways.lost = true;
}

const WaysDown& StateBook::ways_from(std::size_t saddle) {
  if (!ways_[saddle]) {
    WaysDown ways;
    leave({states_[saddle]}, ways);
    ways_[saddle] = std::move(ways);
  }
  return *ways_[saddle];
}

void StateBook::climb_from_minima(const StateSearch& options) {
  for (std::size_t i = 0; i < states_.size() && std::ssize(states_) < options.maximum; ++i)
    if (states_[i].index == 0) climb_from(i, options);
}

bool StateBook::may_climb(std::size_t minimum, const StateSearch& options) {
  /// Departures to two sides may end a turn apart, or at two places of a floor; each wants its own neighbours.
  constexpr int most_alike = 4;
  const RestState& state = states_[minimum];
  if (climbed_[minimum] || !(state.energy < options.bound)) return false;
  int alike = 0;
  for (std::size_t i = 0; i < states_.size(); ++i)
    alike += climbed_[i] && (are_turns(i, minimum) || are_on_one_floor(states_[i], state));
  if (alike >= most_alike || (options.is_within && !options.is_within(state))) return false;
  const bool away = is_away(landscape_, state.x, states_.front().x);
  met_bounds_ |= away;
  return !away;
}

bool StateBook::climb_from(std::size_t minimum, const StateSearch& options) {
  if (!may_climb(minimum, options)) return false;
  climbed_[minimum] = true;
  const RestState from = states_[minimum];
  const auto at = landscape_.ground_on(from.x, from.piece);
  if (!at || at->hessian.size() == 0) return true;
  const SymmetricEigen modes = symmetric_eigen(at->hessian);
  // On its way to a saddle a climb may lie above the valley, but not by as much as the valley rises.
  const double highest = options.bound + (options.bound - from.energy);
  for (Index i = 0; i < std::min<Index>(options.modes, at->hessian.rows()); ++i)
    for (const double sign : {1.0, -1.0}) {
      const Vector along = sign * (at->motions * modes.vectors.col(i));
      if (const auto saddle = climb(landscape_, from.x, along, highest)) take(*saddle, options);
    }
  if (options.drives > 0) drive_from(from, *at, options);
  return true;
}

void StateBook::take(const RestState& saddle, const StateSearch& options) {
  if (saddle.index != 1) return;
  const std::size_t number = add(saddle);
  if (states_[number].energy < options.bound) ways_from(number);  // adds the minima beside it
}

/// Every coordinate is driven both ways, as far as the box of what is known reaches.
void StateBook::drive_from(const RestState& from, const Ground& at, const StateSearch& options) {
  const Box box = box_of_states();
  const auto& moving = landscape_.moving();
  // In closed chains many coordinates move as few others do: the first ones, those of joints, are enough.
  const Index most = std::min<Index>(options.drives, at.motions.cols());
  std::vector<Vector> taken;  // along the motions
  for (std::size_t i = 0; i < moving.size() && std::ssize(taken) < most; ++i) {
    Vector along = at.motions.row(static_cast<Index>(i)).transpose();
    constexpr double still = 1e-6, alike = 0.999;
    const double part = along.norm();
    if (part < still) continue;
    along /= part;
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const Vector& v) { return std::abs(v.dot(along)) > alike; }))
      continue;
    taken.push_back(along);
    for (const double sign : {1.0, -1.0}) {
      const double end = sign > 0 ? box.high[moving[i]] : box.low[moving[i]];
      const double farthest = std::abs(end - from.x[moving[i]]) / part;
      const Driven driven =
          drive(landscape_, from, sign * (at.motions * along), {farthest, options.bound});
      if (driven.saddle)
        take(*driven.saddle, options);
      else if (driven.beyond)
        ways_down(*driven.beyond);
    }
  }
}

StateBook::Box StateBook::box_of_states() const {
  Box box{states_.front().x, states_.front().x};
  for (const RestState& state : states_) {
    box.low = box.low.cwiseMin(state.x);
    box.high = box.high.cwiseMax(state.x);
  }
  for (const Index i : landscape_.moving()) {
    const double least = landscape_.periods()[i] > 0 ? 2 * std::numbers::pi : 1;
    const double width = std::max(2 * (box.high[i] - box.low[i]), least);
    const double middle = (box.low[i] + box.high[i]) / 2;
    box.low[i] = middle - width / 2;
    box.high[i] = middle + width / 2;
  }
  return box;
}

void StateBook::search_box(const StateSearch& options) {
  if (states_.empty()) return;
  const Box box = box_of_states();
  std::mt19937_64 random(options.seed);
  for (int s = 0; s < options.starts && std::ssize(states_) < options.maximum; ++s) {
    Vector x = states_.front().x;
    for (const Index i : landscape_.moving())
      x[i] = box.low[i] + random_fraction(random) * (box.high[i] - box.low[i]);
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
