// All zeros of a smooth function on an interval, close ones and touching ones included. Private to
// the engine.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace springfold::continuation {

struct ZeroOf {
  double at = 0;
  double before = 0, after = 0;  ///< bracket
  double off = 0;                ///< estimated error of `at`
  bool touches = false;          ///< zero without change of sign
  bool several = false;          ///< flat crossing: three or more zeros that rounding merges
};

struct ZeroSearch {
  std::vector<ZeroOf> zeros{};  ///< ascending
  bool resolved = true;         ///< false: too close together or too rough to tell
};

/// Could a function with these samples be zero between them? Far from zero, compared with how much it
/// changes, it could not.
bool within_reach(std::span<const double> values);

/// f may fail (nothing) where its point cannot be computed.
using SampledFunction = std::function<std::optional<double>(double)>;

/// What is said of noise. Threshold: values below it are zero. Bound: of what rounding may make; touches and pairs of
/// zeros are told apart by the noise that is seen. Doubt: an extremum below it may be zero, since close to zeros there
/// is more noise than can be seen; but only what is seen to be lost in noise is one feature.
enum class NoiseIs { threshold, bound, doubt };

/// Samples f at ten points, interpolates, and looks where the interpolant is zero or stationary
/// close to zero. Features that lie closer together than a tenth of the interval, and intervals on
/// which the interpolant is not accurate, are examined again on smaller intervals, down to
/// `resolution`. A single feature is interpolated once more on a window of its own and located there:
/// f is never asked for its value exactly at its zero, where it may be ill-conditioned.
/// @param noise  values below this are not told from zero
/// @param smooth_error  of f, the same at neighbouring places, so that no samples show it
ZeroSearch find_zeros(const SampledFunction& f, double a, double b, double noise, double resolution,
                      NoiseIs noise_is = NoiseIs::threshold, double smooth_error = 0);

}  // namespace springfold::continuation
