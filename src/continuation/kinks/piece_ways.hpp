// Tangents of the curves of one piece through a point on switching surfaces. Private to the engine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// A direction in which a curve of the piece leaves, whether it leads into the piece or not.
struct PieceWay {
  Direction tangent{};
  std::optional<CurvePoint>
      start{};          ///< set where the piece is singular: the curve a little further
  double accuracy = 0;  ///< of the tangent
  std::optional<CurvePoint> beyond{};  ///< as a Ray has it
};

struct PieceWays {
  std::vector<PieceWay> list{};
  bool singular =
      false;          ///< the extended Jacobian of the piece has no full rank here: list is empty
  std::string why{};  ///< set: not all of them could be found
  double conditioning = 0;  ///< of a regular piece: least ratio of pivots; 0: not known
};

/// A curve along its tangent, and back.
PieceWays both_ways(const Direction& tangent);

/// The two directions of the curve of a piece that is regular here.
/// @param full_rank  smallest ratio of pivots that counts as full rank
/// @param polished   the point solves the equations to rounding: then rows and columns of different sizes are brought to
///                   one size before it is called singular. Located points are too inexact for that
PieceWays regular_ways(const Walker& walker, const CurvePoint& at, double full_rank, bool polished);

/// What is known of the active surfaces at a point.
struct Surfaces {
  std::vector<Index> active{};
  Matrix dg_dx{};
  Vector dg_dlambda{};
};

/// All ways of a piece that is singular here, with starts before the next switching surface. Those of
/// which the directions `known` are tangents already are not looked for if the piece's cone
/// { piece_j dg_j . t >= 0 } holds nothing else of the kernel.
PieceWays singular_ways(const Walker& walker, const CurvePoint& at, const Surfaces& surfaces,
                        const std::vector<Direction>& known);

/// Does the curve at `start`, which leaves `at` along `tangent`, lie within its piece and clear of the surfaces
/// ahead: no switch has come more than half-way to zero, and those that were zero go away from it?
bool before_next_surface(const Walker& walker, const CurvePoint& at, const Surfaces& surfaces,
                         const CurvePoint& start, const Direction& tangent);

}  // namespace springfold::continuation
