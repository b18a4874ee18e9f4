// Where special points cannot be told on a step: other steps on which they can. Private to the engine.
#pragma once

#include <optional>

#include "continuation/following/one_step.hpp"

namespace springfold::continuation {

/// Where special points made a step too long first.
struct Anchor {
  Progress before{};
  std::size_t points = 0, hits = 0;
  bool set = false, tried = false;
  bool passing = false;   ///< branches pass each other there: nothing is crossed in one step
  int refusals = 0;       ///< of steps there, because of what lies on them or where they end
  double back_from = -1;  ///< up to this arc length no step begins once more behind the anchor
  int elsewhere = 0;      ///< how often steps that end elsewhere were tried on the curve

  /// Takes note of a step that was refused.
  void note(const Refusal& refused, const Progress& progress, const Curve& curve);
  /// Lets go where something was found, or the step that was refused lies behind.
  void release(const Progress& progress, const Curve& curve);
};

/// Shorter steps end nearer to a special point and tell less of it. So the second refusal tries steps of about the
/// length of the first that end elsewhere, and the last one, on steps on which rounding decides, tries longer steps and
/// at last crosses the special points as one cluster.
/// @returns nothing where the step has to be shorter
std::optional<Outcome> step_elsewhere(const Following& following, const Refusal& refused,
                                      Anchor& anchor, Progress& progress, Curve& curve);

/// Takes back points that may lie on any branch: those among unresolved special points, reached on steps too short to
/// tell, and the last one where no step continues it.
void forget_doubtful_points(const Anchor& anchor, double astray_at, Curve& curve);

}  // namespace springfold::continuation
