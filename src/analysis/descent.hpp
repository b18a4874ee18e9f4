// Ways down, and up to saddles, in a landscape. Private to analysis.
#pragma once

#include <limits>

#include "landscape.hpp"

namespace springfold::analysis {

/// A state of rest at one lambda.
struct RestState {
  Vector x{};  ///< residual at tolerance
  Piece piece{};
  double energy = 0;
  Index index = 0;        ///< unstable modes
  double softest = 0;     ///< the smallest eigenvalue of the energy's Hessian along the motions
  bool is_clear = false;  ///< no eigenvalue is zero to rounding
};

/// Newton's method from a state near rest. @returns nothing where it does not converge near by
std::optional<RestState> rest_near(const Landscape& landscape, const Vector& x);

struct Descent {
  enum class End {
    rest,       ///< at `state`: a minimum, or a saddle that was met head on
    runs_away,  ///< a coordinate left all bounds
    lost,       ///< neither: no state of rest was reached, or the closures broke
  };
  End end = End::lost;
  Vector x{};         ///< the last state
  RestState state{};  ///< of End::rest
};

/// Sizes of the mechanism, or turns, beyond which a state has run away.
inline constexpr int lengths_away = 1000, turns_away = 50;

/// A coordinate has left these bounds, as seen from a first state.
bool is_away(const Landscape& landscape, const Vector& x, const Vector& from);

/// Goes down from x, so that the energy falls along the whole way and nowhere between two steps lies
/// above that of x: start and end belong to one connected part of {Pi <= Pi(x)}. With the modes v_i
/// and curvatures k_i of the Hessian along the motions a step is -(v_i . slope)/|k_i| along each, of
/// bounded length.
Descent descend(const Landscape& landscape, Vector x);

/// Goes uphill along one mode and downhill along all others: to a saddle (eigenvector following).
/// @param along    direction of the moving unknowns that is followed first; empty: the softest mode
/// @param highest  energy at which it is given up
std::optional<RestState> climb(const Landscape& landscape, Vector x, Vector along,
                               double highest = std::numeric_limits<double>::infinity());

}  // namespace springfold::analysis
