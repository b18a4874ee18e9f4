// Sigma as a polynomial around a place of a step, and where its modes vanish there, each on its own. Private to the
// engine.
#pragma once

#include <optional>
#include <vector>

#include "continuation/locating/tested_step.hpp"
#include "continuation/points/chebyshev.hpp"

namespace springfold::continuation {

/// The curve near a place and the m x m entries of its Sigma, interpolated on one window.
struct SigmaNear {
  Interpolant curve{}, entries{};
  double error = 0;    ///< of the entries between the samples
  double nothing = 0;  ///< entries below this are zero: rounding, and the interpolant's error

  Matrix at(double t) const;
  Matrix slope(double t) const;
};

/// @returns nothing where a point of the window cannot be computed
std::optional<SigmaNear> sigma_near(const TestedStep& arc, double t, double length, Index m);

/// Where modes of Sigma vanish: one, or several at one place, for all that rounding says.
struct ZeroOfMode {
  double at = 0;
  double off = 0;  ///< estimated error of the place
  Index m = 1;     ///< how many
};

/// The determinant of modes that vanish close together is their product, lost in its rounding long before they are.
/// Sigma goes with the distance from the place as the pencil
///
///     Sigma(t) + d Sigma'(t),
///
/// and the distances d at which that is singular are the modes' own, each followed to its end.
/// @returns in order; none where the modes within `reach`, and the window, are not all real, or are not told apart, by
///          more than places are promised, though they do not vanish at one place
std::vector<ZeroOfMode> modes_near(const SigmaNear& near, double t, double reach);

}  // namespace springfold::continuation
