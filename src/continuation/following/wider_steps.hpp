// Where special points cannot be told on a step: other steps on which they can. Private to the engine.
#pragma once

#include <optional>

#include "continuation/following/one_step.hpp"

namespace springfold::continuation {

/// A step that special points made too long, and how many points the curve had before it.
struct RefusedStep {
  Progress before{};
  std::size_t points = 0;
};

/// Where special points made a step too long first, and where the steps before it began to be: what rounding hides may
/// be wider than the last of them, so that none of about its length leads beyond.
struct Anchor {
  RefusedStep at{};
  std::size_t hits = 0;
  bool set = false, tried = false;
  bool passing = false;   ///< branches pass each other there: nothing is crossed in one step
  int refusals = 0;       ///< of steps there, because of what lies on them or where they end
  double back_from = -1;  ///< up to this arc length no step begins once more behind the anchor
  int elsewhere = 0;      ///< how often steps that end elsewhere were tried on the curve
  std::optional<RefusedStep> first{};  ///< of the steps that were refused one after the other
  double refused_to = -1;              ///< as far as any of these reached

  /// Takes note of a step that was refused.
  void note(const Refusal& refused, const Progress& progress, const Curve& curve);
  /// Lets go of a step that was refused where it lies behind, and of the first one where something was found or all
  /// that were refused lie behind.
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
