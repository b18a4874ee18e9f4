// Where a piecewise-smooth curve meets its switching surfaces.
#pragma once

#include <string>
#include <vector>

#include "springfold/continuation/step.hpp"

namespace springfold::continuation {

/// One way to leave a point: a piece and a unit tangent that leads into it.
struct Ray {
  Piece piece{};
  Direction tangent{};
};

struct Rays {
  std::vector<Ray> rays{};
  bool complete = true;  ///< false: some piece has no unique tangent here, or one that grazes a
                         ///< switching surface; `why` says which
  std::string why{};
};

/// All ways to leave a point of the curve on which the switches `active` are zero. Every one of
/// the 2^k pieces around it is linearised; of its two tangents those are kept that lead into it:
///
///     | dF/dx  dF/dlambda | tau = 0,      piece_j (dg_j . tau) > 0  for all active j.
///
/// Without active switches these are the two directions of the curve.
/// @pre active.size() <= 12
Rays rays_at(const Walker& walker, const Vector& x, double lambda, const Piece& piece,
             const std::vector<Index>& active);

/// Switches that are zero at a point, within options.simultaneous.
std::vector<Index> active_switches(const Walker& walker, const Vector& x, double lambda);

/// The first switching surface that the curve meets on the step from -> to.
struct KinkSearch {
  enum class Status {
    none,        ///< the step stays in its piece
    found,       ///< `point` is on the first surface
    suspicious,  ///< a surface is nearly touched, or could not be located: take a shorter step
  };
  Status status = Status::none;
  CurvePoint point{};
  double before = 0, after = 0;  ///< step lengths that bracket it
  std::vector<Index> active{};   ///< switches that are zero there
  Index suspect = -1;            ///< the switch that asks for a shorter step
};

/// @param left  switches that are zero at `from` because the curve leaves them there
KinkSearch first_kink(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                      const std::vector<Index>& left);

}  // namespace springfold::continuation
