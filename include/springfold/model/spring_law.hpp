// Spring laws of preloaded and virtual joints: paper eq. (2) and (3).
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::model {

/// torque = stiffness (c - free).
struct LinearSpring {
  double stiffness = 0;  ///< [N*m/rad] or [N/m]
  double free = 0;       ///< coordinate of zero torque [rad] or [length]
};

/// The paper's [.]^+ (side above) and [.]^- (side below): a linear spring on one side of `from`,
/// nothing on the other.
struct OneSidedSpring {
  enum class Side { above, below };
  double stiffness = 0;  ///< [N*m/rad] or [N/m]
  double from = 0;       ///< activation coordinate [rad] or [length]
  Side side = Side::above;
};

/// Any continuous piecewise-linear law: gap, stops, backlash, progressive springs.
/// Segment i has slope stiffnesses[i] and lies between breakpoints[i-1] and breakpoints[i].
struct PiecewiseLinearSpring {
  std::vector<double> breakpoints{};  ///< strictly increasing [rad] or [length]
  std::vector<double> stiffnesses{};  ///< one more than breakpoints [N*m/rad] or [N/m]
  double free = 0;                    ///< coordinate at which the torque is `preload`
  double preload = 0;                 ///< torque at `free` [N*m] or [N]
};

using SpringLaw = std::variant<LinearSpring, OneSidedSpring, PiecewiseLinearSpring>;

/// Every rule that the law breaks, as sentences; empty when usable.
std::vector<std::string> problems_in(const SpringLaw& law);

/// Any spring law in one form: straight segments, each written from its own anchor so that
/// neighbouring segments agree exactly at their common breakpoint.
struct CompiledSpring {
  struct Segment {
    double anchor = 0;     ///< coordinate from which the segment is written
    double torque = 0;     ///< at the anchor
    double stiffness = 0;  ///< slope
    double energy = 0;     ///< at the anchor; zero at the law's free (or activation) coordinate
  };
  std::vector<Segment> segments{Segment{}};
  std::vector<double> breakpoints{};  ///< strictly increasing; one less than segments

  /// Segment in which the coordinate c lies; at a breakpoint the upper one.
  std::size_t segment_at(double c) const;

  /// Torque of segment i, continued analytically beyond its ends.
  template <class S>
  S torque(std::size_t i, const S& c) const {
    return S(segments[i].torque) + segments[i].stiffness * (c - segments[i].anchor);
  }

  /// Slope of the torque of segment i at c, continued analytically beyond its ends.
  template <class S>
  S stiffness(std::size_t i, const S& /*c*/) const {
    return S(segments[i].stiffness);
  }

  /// Energy of segment i, continued analytically beyond its ends.
  template <class S>
  S energy(std::size_t i, const S& c) const {
    const S d = c - segments[i].anchor;
    return S(segments[i].energy) + d * (S(segments[i].torque) + 0.5 * segments[i].stiffness * d);
  }
};

/// @pre problems_in(law).empty().
CompiledSpring compile(const SpringLaw& law);

}  // namespace springfold::model
