// From where on does the path from the start no longer come to an unwanted point that is followed? Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "case_curves.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

/// A piece of a critical curve that is followed from one value of the parameter to another.
struct FollowedPiece {
  double from = 0, to = 0;
  bool at_end = false;    ///< the point is still there at `to`; otherwise it is gone there
  bool at_range = false;  ///< at_end: `to` is the end of the range
  const continuation::CriticalStart* start = nullptr;
  const continuation::CriticalCurve* curve = nullptr;  ///< of the point, from there
  double width = 1;                                    ///< of the parameter's range
};

struct Parting {
  std::optional<double> clear{};    ///< from there on nothing unwanted happens on the path
  std::optional<double> another{};  ///< from there on another point comes first
  bool at_other_start =
      false;  ///< for there the start vanishes, and the path begins at another one
  bool is_bracketed =
      true;  ///< either is known to rounding; otherwise it lies between `bad` and this value
  /// From there to the end of the range, where the point that is followed still is, nothing is known of the path.
  std::optional<double> unknown_from{};
  std::string why{};  ///< why not
  double bad = 0;     ///< last value before that is known where it happens
};

/// Traces the paths at values between: the point that is followed may leave the path from the start, as where branches
/// cross, or where the start vanishes and the path begins at another one; or another point may come first, with a curve
/// of its own. Beside the place where it is gone only paths
/// whose starts belong to that of the first value are asked.
Parting parting_on(const FollowedPiece& piece, const CaseCurves& curves,
                   const CriticalPointSettings& settings, const Observer& observer);

}  // namespace springfold::analysis
