// Is an answer confirmed by what is traced beside it, on both sides? Private to analysis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "springfold/core/number_text.hpp"

namespace springfold::analysis {

/// Relative distances at which an answer is traced again. What is born there is so near to another point, a limit point
/// to the corner behind it, that a path may not tell them apart: the load between them falls with the square of the
/// distance.
inline constexpr std::array<double, 3> distances_beside{1e-6, 1e-5, 1e-4};
inline constexpr double nearest_beside = distances_beside.front();

/// So far beyond a value of the parameter, relative to it. @param towards  1 or -1
inline double beyond_value(double mu, double towards, double distance) {
  constexpr double least_value =
      1e-3;  // in the parameter's own unit, below which a value counts as zero
  return mu + towards * distance * std::max(std::abs(mu), least_value);
}

/// The least of these distances at which what is wanted holds on the inner side of an answer and not on the outer one;
/// nothing where no distance confirms it.
/// @param holds  at a distance inwards, outwards where it is negative; nothing: it is not known
inline std::optional<double> confirmed_beside(
    const std::function<std::optional<bool>(double)>& holds) {
  for (const double distance : distances_beside)
    if (holds(-distance) == false && holds(distance) == true) return distance;
  return std::nullopt;
}

/// ", confirmed at a relative distance of 1e-05"; empty at the nearest one.
inline std::string words_of_distance(double distance) {
  return distance > nearest_beside ? ", confirmed at a relative distance of " + rounded(distance)
                                   : "";
}

}  // namespace springfold::analysis
