// Spring laws of preloaded and virtual joints: paper eq. (2) and (3).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "springfold/core/types.hpp"
#include "springfold/model/spring_curve.hpp"

namespace springfold::model {

/// torque = stiffness (c - free).
struct LinearSpring {
  double stiffness = 0;  ///< [N*m/rad] or [N/m]
  double free = 0;       ///< coordinate of zero torque [rad] or [length]
  bool falling = false;  ///< may the stiffness be negative?
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
  bool falling = false;               ///< may stiffnesses be negative?
};

/// A shape-preserving cubic through points (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5, 1984):
/// it rises, falls and is flat where the points do. Beyond the ends it goes on straight.
struct TableSpring {
  std::vector<double> deformations{};  ///< u = c - free, strictly increasing, at least two
  std::vector<double> torques{};       ///< as many [N*m] or [N]
  double free = 0;                     ///< coordinate with u = 0 [rad] or [length]
  bool falling = false;                ///< may the torque fall from point to point?
};

using SpringLaw = std::variant<LinearSpring, OneSidedSpring, PiecewiseLinearSpring, TableSpring,
                               PolynomialSpring, FormulaSpring, LogarithmicSpring, PowerSpring>;

/// Every rule that the law breaks, as sentences; empty when usable.
std::vector<std::string> problems_in(const SpringLaw& law);

/// The same law in other units: coordinates are divided by `coordinate`, torques by `torque`. With
/// powers of two nothing is rounded.
SpringLaw scaled(const SpringLaw& law, double coordinate, double torque);

/// The same law with all its coordinates greater by `by`.
SpringLaw moved(const SpringLaw& law, double by);

/// The law with its breakpoint nearest to `near` at `to`, a place in a segment beside it. Where the law is free of
/// torque at the breakpoint, as that of a cable that just hangs, all of it is moved: it is to be free at `to`, too.
/// Otherwise only the breakpoint is, the torque at `to` stays what it is, and that of the other segment changes by the
/// difference of both stiffnesses times the way. The same law where another breakpoint lies in between.
SpringLaw with_breakpoint(const SpringLaw& law, double near, double to);

/// Any spring law in one form: segments, each written from its own anchor so that neighbouring
/// segments agree exactly at their common breakpoint. A segment is straight or follows a curve.
struct CompiledSpring {
  struct Segment {
    double anchor = 0;     ///< coordinate from which the segment is written
    double torque = 0;     ///< at the anchor
    double stiffness = 0;  ///< slope, of a curve that at the anchor
    double energy = 0;     ///< at the anchor; zero at the law's free (or activation) coordinate
    Index curve = -1;      ///< which one it follows; none: it is straight
  };
  std::vector<Segment> segments{Segment{}};
  std::vector<double> breakpoints{};  ///< strictly increasing; one less than segments
  std::vector<SpringCurve> curves{};

  /// Segment in which the coordinate c lies; at a breakpoint the upper one.
  std::size_t segment_at(double c) const;

  bool is_straight(std::size_t i) const { return segments[i].curve < 0; }

  /// No torque anywhere in segment i.
  bool is_free(std::size_t i) const {
    return is_straight(i) && segments[i].stiffness == 0 && segments[i].torque == 0;
  }

  /// No torque anywhere.
  bool is_free() const {
    for (std::size_t i = 0; i < segments.size(); ++i)
      if (!is_free(i)) return false;
    return true;
  }

  /// Do the segments on both sides of breakpoint i differ there?
  bool changes_at(std::size_t i) const {
    return is_straight(i) != is_straight(i + 1) ||
           stiffness(i, breakpoints[i]) != stiffness(i + 1, breakpoints[i]);
  }

  /// Torque of segment i, continued beyond its ends.
  template <class S>
  S torque(std::size_t i, const S& c) const {
    const Segment& s = segments[i];
    if (s.curve >= 0) return torque_of(curve_of(s), c).value;
    return S(s.torque) + s.stiffness * (c - s.anchor);
  }

  /// Slope of the torque of segment i at c, continued beyond its ends.
  template <class S>
  S stiffness(std::size_t i, const S& c) const {
    const Segment& s = segments[i];
    return s.curve >= 0 ? torque_of(curve_of(s), c).slope : S(s.stiffness);
  }

  /// Slope of the stiffness of segment i at c, continued beyond its ends.
  template <class S>
  S stiffness_rate(std::size_t i, const S& c) const {
    const Segment& s = segments[i];
    return s.curve >= 0 ? torque_of(curve_of(s), c).bend : S(0);
  }

  /// Energy of segment i, continued beyond its ends.
  template <class S>
  S energy(std::size_t i, const S& c) const {
    const Segment& s = segments[i];
    if (s.curve >= 0) return energy_of(curve_of(s), c);
    const S d = c - s.anchor;
    return S(s.energy) + d * (S(s.torque) + 0.5 * s.stiffness * d);
  }

 private:
  const SpringCurve& curve_of(const Segment& segment) const {
    return curves[static_cast<std::size_t>(segment.curve)];
  }
};

/// @pre problems_in(law).empty().
CompiledSpring compile(const SpringLaw& law);

/// Coordinate at which the torque vanishes, near `initial`: the nearest one of a law that rises.
double relaxed_coordinate(const CompiledSpring& spring, double initial);

/// Coordinate at which the law has the torque: of a law that rises the one nearest to `near`, of others the first one
/// met on the way on which a rising law has it. Nothing where the way ends without it.
std::optional<double> coordinate_of_torque(const CompiledSpring& spring, double torque,
                                           double near);

/// Is the torque nowhere less than at a smaller coordinate? Then it has a torque nowhere if coordinate_of_torque() does
/// not find it.
bool never_falls(const CompiledSpring& spring);

/// Does the energy grow without bound on both sides? False where that is not sure.
bool holds_both_ways(const CompiledSpring& spring);

/// How stiff the law is, roughly: for the choice of units. Of every segment that acts one number > 0,
/// that at its anchor, or where that is 0 its greatest one within `width` of the anchor.
std::vector<double> typical_stiffnesses(const CompiledSpring& spring, double width);

}  // namespace springfold::model
