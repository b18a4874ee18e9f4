// The piece of a branch between its junction and the first point of its trace. Private to the engine.
#pragma once

#include <vector>

#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// What a trace begins with.
struct Begin {
  CurvePoint from{};
  Ray ray{};
  bool attached = true;  ///< nothing is left out between the junction and `from`
};

/// Where the trace along a way begins: a little away from its junction, unless the curve in between is known.
Begin begin_along(const Walker& walker, const CurvePoint& junction, const Way& way);

/// The piece, oriented outwards, s from 0 at the junction.
struct PieceBefore {
  bool reached =
      true;  ///< false: it could not be traced back to the junction; nothing is known of it
  std::vector<CurvePoint>
      points{};             ///< the junction first; the first point of the trace is not among them
  std::vector<Hit> hits{};  ///< what lies between, events of the caller too, in the order of s
  double length = 0;
};

/// Traces back from where the way's trace begins to its junction. Both curves see the same special points; those nearer
/// to the junction than `DiagramOptions::same_place` are the junction itself.
PieceBefore piece_before(const Walker& walker, const std::vector<Event>& events,
                         const DiagramOptions& options, const Junction& junction, const Way& way);

/// The branch goes no farther than this special point of its piece.
/// @returns all of the branch
Curve end_at(const PieceBefore& piece, std::size_t hit, StopReason stop);

/// Puts the piece before the first point of the trace.
void prepend(const CurvePoint& junction, PieceBefore piece, Curve& curve);

}  // namespace springfold::continuation
