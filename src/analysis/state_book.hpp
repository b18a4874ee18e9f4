// States of rest at one lambda, each listed once, and how the ways down from saddles join minima.
// Private to analysis.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "descent.hpp"

namespace springfold::analysis {

struct StateSearch {
  int starts = 16;         ///< random first states; every second one is led to a saddle
  std::uint64_t seed = 1;  ///< of these
  int modes = 6;           ///< softest modes along which every minimum is left uphill, both ways
  int drives = 0;  ///< coordinates of every minimum that are driven, both ways; no more than modes
  int maximum = 2000;  ///< the search ends when it has found as many states
  /// Minima as high as this are not left uphill: what is beside them lies higher still.
  double bound = std::numeric_limits<double>::infinity();
  /// Minima beyond the range that is asked for are not left uphill; empty: there is no range.
  std::function<bool(const RestState&)> is_within{};
};

/// Where the ways down from a state lead.
struct WaysDown {
  std::vector<std::size_t> minima{};  ///< numbers in the book, each once
  bool away = false;                  ///< one of them has no end
  bool lost = false;                  ///< one of them ended nowhere
};

class StateBook {
 public:
  explicit StateBook(const Landscape& landscape) : landscape_{landscape} {}

  const std::vector<RestState>& states() const { return states_; }
  const Landscape& landscape() const { return landscape_; }
  /// @returns its number, that of the same state if it is known
  std::size_t add(const RestState& state);
  /// The first state of the book that is the same but for whole turns, of the same energy or not: itself, if loads do
  /// no work in a whole turn. What is around one of them is around all.
  std::size_t first_of_turns(std::size_t state) const { return first_of_turns_[state]; }
  bool are_turns(std::size_t a, std::size_t b) const {
    return first_of_turns_[a] == first_of_turns_[b];
  }
  /// States are there whose energies differ by whole turns.
  bool has_turns() const;
  /// A minimum was left alone because it lies beyond all bounds.
  bool met_bounds() const { return met_bounds_; }
  /// The minima below a state that is not at rest; saddles that are met head on are left both ways.
  WaysDown ways_down(const Vector& x) { return ways_down_past({}, x); }
  /// The minima beside a saddle, both ways along its unstable modes.
  const WaysDown& ways_from(std::size_t saddle);
  /// Looks for saddles and the minima behind them uphill from one minimum.
  /// @returns false where that was done before
  bool climb_from(std::size_t minimum, const StateSearch& options);
  /// From all minima, those that are found on the way too.
  void climb_from_minima(const StateSearch& options);
  /// Looks for further states from random ones of a box around all known ones, and uphill from every
  /// minimum that was found. A search by samples: nothing is proved about others.
  void search(const StateSearch& options);

 private:
  struct Box {
    Vector low{}, high{};
  };

  /// A saddle that was found, with the minima beside it.
  void take(const RestState& saddle, const StateSearch& options);
  void drive_from(const RestState& from, const Ground& at, const StateSearch& options);
  /// Around all known states, twice as wide, and at least a size of the mechanism or a turn.
  Box box_of_states() const;
  void search_box(const StateSearch& options);
  /// @param met  states of rest that the way down has come past, which are no minima
  WaysDown ways_down_past(const std::vector<RestState>& met, const Vector& x);
  /// @param met  the state that is left is the last one
  void leave(const std::vector<RestState>& met, WaysDown& ways);
  bool is_turned(const std::vector<RestState>& met, const RestState& state) const;
  /// Whether uphill ways are to be taken from this minimum, and were not yet from enough of those that differ from it
  /// by whole turns, or rest on the same floor.
  bool may_climb(std::size_t minimum, const StateSearch& options);

  const Landscape& landscape_;
  std::vector<RestState> states_{};
  std::vector<std::optional<WaysDown>> ways_{};  ///< per state
  std::vector<bool> climbed_{};                  ///< minima from which uphill ways have been taken
  std::vector<std::size_t> first_of_turns_{};    ///< per state
  std::optional<bool> turns_take_work_{};        ///< found out with the first state
  bool met_bounds_ = false;
};

/// A state of rest whose motions all have positive stiffness.
inline bool is_minimum(const RestState& state) { return state.index == 0 && state.is_clear; }

}  // namespace springfold::analysis
