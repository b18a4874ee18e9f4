// What is known of a motion with masses that lasts. Private to analysis.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "flow.hpp"

namespace springfold::analysis {

/// A motion has settled where so much of all its energy is left.
inline constexpr double settled_part = 1e-4;

inline double kinetic_energy(const std::vector<MassPoint>& masses, const Vector& speeds) {
  double twice = 0;
  for (const MassPoint& mass : masses) twice += mass.mass * (mass.jacobian * speeds).squaredNorm();
  return twice / 2;
}

/// When only a small part of all energy was left; between steps what is left fades as an exponential does.
/// @param taken  times, and what was dissipated until then
inline double settling_time(const std::vector<std::pair<double, double>>& taken, double all) {
  const double wanted = settled_part * all;
  double before = all, from = 0;
  for (const auto& [t, dissipated] : taken) {
    const double left = all - dissipated;
    if (left <= wanted) {
      const double part =
          left > 0 && before > left ? std::log(before / wanted) / std::log(before / left) : 1;
      return from + part * (t - from);
    }
    before = left;
    from = t;
  }
  return taken.empty() ? 0 : taken.back().first;
}

/// Looks at a motion that lasts. Once it cannot leave a state of rest any more, all that it still has of energy above
/// that state is going to be dissipated. Where that is little, nothing more is to be learned; where it would take more
/// steps than are allowed until it is little, neither.
class Lasting {
 public:
  explicit Lasting(const FlowOptions& options) : options_{options} {}

  /// Peaks lie in the first swings: a motion that ends within as many steps is not asked.
  bool is_asked(int steps) const {
    constexpr int lasting = 20000, now_and_then = 512;
    return options_.caught_by && steps >= lasting && (steps % now_and_then == 0 || is_last(steps));
  }

  struct Moment {
    int steps = 0;
    double time = 0, energy = 0;  ///< energy: of place and speed
    double dissipated = 0;
  };
  struct Known {
    bool has_settled = false;
    RestState state{};
    double left = 0;          ///< energy above that of the state
    double would_settle = 0;  ///< the time by which it has settled, as its energy falls now
  };
  /// @returns nothing where it has to be followed
  std::optional<Known> look(const Moment& at, const Vector& x) {
    if (!state_) state_ = options_.caught_by(x, at.energy);
    if (!state_) return std::nullopt;
    const double left = std::max(0.0, at.energy - state_->energy);
    const double wanted = settled_part * (at.dissipated + left);
    if (left <= wanted) return Known{true, *state_, left, at.time};
    fading_.push_back({at.steps, at.time, left});
    constexpr std::size_t few = 8;
    if (fading_.size() < few && !is_last(at.steps)) return std::nullopt;
    // As it fell in the last half of the time in which it was known where it lands.
    const Fading& from = fading_[(fading_.size() - 1) / 2];
    const double span = at.time - from.time, fallen = std::log(from.left / left);
    const double more = fallen > 0 ? std::log(left / wanted) / fallen * span
                                   : std::numeric_limits<double>::infinity();
    const double steps = at.steps + more / span * (at.steps - from.steps);
    constexpr double longer = 4;  // steps grow as the fast modes fade
    if (!is_last(at.steps) && steps <= longer * options_.most_steps) return std::nullopt;
    return Known{false, *state_, left, at.time + more};
  }

 private:
  struct Fading {
    int steps = 0;
    double time = 0, left = 0;
  };
  bool is_last(int steps) const { return steps == options_.most_steps; }

  const FlowOptions& options_;
  std::optional<RestState> state_{};  ///< what it cannot leave any more
  std::vector<Fading> fading_{};      ///< since that is known
};

}  // namespace springfold::analysis
