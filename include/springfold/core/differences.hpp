// Derivatives by differences, for parameters that enter through formulas and for tests.
#pragma once

#include <functional>
#include <optional>

#include "springfold/core/types.hpp"

namespace springfold {

/// Derivative of a vector-valued function of one number by the central six-point formula
///
///     f'(p) = ( 45 (f1 - f-1) - 9 (f2 - f-2) + (f3 - f-3) ) / (60 h),   fk = f(p + k h),
///
/// with error O(h^6) + O(eps / h): about 1e-13 relative for h = 1e-2 of the scale on which f varies.
/// @returns nothing when f has no value at one of the six points
std::optional<Vector> six_point_derivative(const std::function<std::optional<Vector>(double)>& f,
                                           double p, double h);

struct GridDerivative {
  Vector value{};
  /// Largest entry of the difference from the polynomial through the same places without the outer two.
  double doubt = 0;
  /// What is left if the next order changes it by as much less as the last one did beside the order before: of smooth
  /// functions about their error, across kinks and jumps as large as the doubt.
  double expected_error = 0;
};

/// The same by the polynomial of degree seven through the eight multiples k h around p (four on each side): for
/// functions that are dear where they have not been asked before. Neighbouring p ask for the same places. @param h a
/// power of two, so that the places are the same numbers
/// @param enough  the inner four, or six, places are taken where their doubt is less than this, of max(1, value)
/// @returns nothing when f has no value at one of them
std::optional<GridDerivative> grid_derivative(const std::function<std::optional<Vector>(double)>& f,
                                              double p, double h, double enough = 0);

/// By the cubic through the inner four of these places, with an error O(h^3); doubted as far as the inner two differ.
std::optional<GridDerivative> rough_grid_derivative(
    const std::function<std::optional<Vector>(double)>& f, double p, double h);

}  // namespace springfold
