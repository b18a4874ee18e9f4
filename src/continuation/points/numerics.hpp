// The numbers that the engine judges by, each by name and with its reason. Private to the engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace springfold::continuation {

inline constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

/// A model of the curve is exact when its measured error is this share of max(1, |u|): some hundred units of rounding, which
/// corrected points have themselves.
inline constexpr double exact_model = 500 * rounding_unit;

/// What is measured at a few places may be this many times larger between them.
inline constexpr double between_samples = 10;

/// The change of a matrix across the curve is measured in its weakest direction: elsewhere it may be so many times larger.
inline constexpr double displaced_safety = 2;

/// A matrix that changes by less than this share of itself stays regular; one half leaves a factor of two for motion
/// that is not straight.
inline constexpr double stays_regular = 0.5;

/// Where a prediction is farther than this share of the step from the straight one, the model is not continued.
inline constexpr double most_bend = 0.1;

/// A model that is farther off than this share of the size is not continued: the step is then judged by its tangent.
inline constexpr double most_surprise = 1e-7;

/// Special points that are nearer to each other than this arc length need not be told apart. A way that begins nearer to its
/// junction leads there as the reduced equation says, which was followed into the point; a trace may be lost in rounding.
inline constexpr double told_apart = 1e-4;

/// Is this error one that rounding leaves on a curve of this size?
inline bool is_exact(double error, double size) {
  return error <= exact_model * std::max(1.0, size);
}

}  // namespace springfold::continuation
