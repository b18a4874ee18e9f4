// The boundary of what meets requirements near one of its points, and the least change there. Private to analysis.
#pragma once

#include <cmath>
#include <vector>

#include "design_jump.hpp"

namespace springfold::analysis {

/// The boundary near a place: with x - at = tangents t + along y it is y = slope t + t curvature t/2.
struct LocalBoundary {
  Vector at{};
  Matrix tangents{};
  Vector along{};
  Matrix inverse{};  ///< of [tangents along]
  Vector slope{};
  Matrix curvature{};

  double value(const Vector& x) const {
    const Vector w = inverse * (x - at);
    const Vector t = w.head(w.size() - 1);
    return slope.dot(t) + 0.5 * t.dot(curvature * t) - w[w.size() - 1];
  }
  Vector rates(const Vector& x) const {
    const Vector w = inverse * (x - at);
    Vector by(w.size());
    by << slope + curvature * w.head(w.size() - 1), -1;
    return inverse.transpose() * by;
  }
};

/// Offsets along the tangents at which the boundary is looked for: as many as slope and curvature have numbers.
std::vector<Vector> offsets(Index tangents, Index two_sided, double h);

/// Gives a boundary the slope and curvature with which it passes points.
/// @param t  along the tangents  @param y  there
void pass(LocalBoundary& boundary, const std::vector<Vector>& t, const Vector& y);

/// The least change near a place, with linear requirements and, if there is one, a local boundary.
struct SmallProblem {
  const JumpProblem& of;
  const Vector& at;
  const Assessment& here;  ///< there
  const LocalBoundary* local = nullptr;
  double radius = HUGE_VAL;

  /// Variables are counted from `from` in a unit. For the sum of changes they are what grows and what falls.
  Vector least(const Vector& from, double unit) const;
};

}  // namespace springfold::analysis
