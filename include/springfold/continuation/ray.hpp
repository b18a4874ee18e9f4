// Ways to leave a point of a curve, as plain data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/continuation/curve.hpp"

namespace springfold::continuation {

/// One way to leave a point: a piece and a unit tangent that leads into it.
struct Ray {
  Piece piece{};
  Direction tangent{};
  std::vector<Index> resting{};  ///< switches that stay zero along it
  /// Where the piece is singular at the point itself: the first point of the curve beyond it, before
  /// the next switching surface, with its own tangent; s is the distance. trace() goes on from there.
  std::optional<CurvePoint> start{};
  /// Where the next switching surface lies just beside such a point: a point farther out, on the smooth continuation of
  /// the piece, from which the curve in front of the surface is told. trace() then begins at the point itself.
  std::optional<CurvePoint> beyond{};
  double accuracy = 0;  ///< of the tangent: it may be off by this, in the metric
};

struct Rays {
  std::vector<Ray> rays{};
  bool complete = true;  ///< false: some piece has no derivatives or no unique tangent here, or one
                         ///< whose side of a surface could not be told; `why` says which
  std::string why{};
};

}  // namespace springfold::continuation
