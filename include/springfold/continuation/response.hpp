// How a curve answers at a point: in which units of lambda and of the multipliers it has a size of order one.
#pragma once

#include <optional>

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// Of |dlambda| for |dx| = 1 in a unit of lambda.
inline constexpr double slopes_in_a_unit = 16;

/// In the problem's units; other units of x, with the metric changed accordingly, of F and of lambda change nothing
/// else.
struct Response {
  /// A unit of lambda for the arc length. Where x moves, |dlambda| for |dx| = 1 in the metric, and sixteen times that:
  /// lengths are then measured by x, and a curve may become much steeper before lambda counts. Where x moves by less
  /// than 1/64 up to the first critical load that dF/dx and its rate along the curve promise (trivial branches above
  /// all), eight times that load; but where that load is a limit point of the curve just beside, |dlambda| is taken
  /// along its bend, from corrected points at a finite distance. Empty where neither is known: x and dF/dx stay as they
  /// are.
  std::optional<double> lambda{};
  /// Largest change of an unknown of weight 0 (a multiplier) while x moves by 1, or where x hardly moves, lambda by
  /// its unit. 0: they stay.
  double multiplier = 0;
  /// |F| over |dx| for some F without symmetry on the equations of the unknowns with weight, lambda held: roughly the
  /// least stiffness against loads. Infinite where such loads move nothing.
  double stiffness = 0;
};

/// @param x, lambda, piece  a point of the curve at which dF/dx is regular
/// @returns nothing where dF/dx is singular to what limit and branch points are located to, or outside the domain
/// @throws std::invalid_argument where sizes do not fit together
std::optional<Response> response_at(ProblemView problem, const Vector& x, double lambda,
                                    const Piece& piece);

}  // namespace springfold::continuation
