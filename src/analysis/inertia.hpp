// The masses of a mechanism in a landscape, and its motion with them. Private to analysis.
#pragma once

#include "flow.hpp"
#include "frozen.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {

/// All masses of bodies, links and points, and how they move with the landscape's unknowns. What has moments of inertia
/// about its centre of mass has point masses in its place that turn alike.
class Masses {
 public:
  explicit Masses(const Frozen& frozen);

  double largest() const { return largest_; }  ///< 0: there are none
  /// In units of the largest.
  std::vector<MassPoint> at(const Vector& x) const;
  /// Second derivatives of the coordinates of each of them by the moving unknowns.
  std::vector<std::array<Matrix, 3>> curvatures_at(const Vector& x) const;
  /// Of all motions that keep the closures, k x k.
  Matrix along_motions(const Ground& ground) const;

 private:
  struct Mass {
    double mass = 0;
    std::size_t point = 0;
    bool has_speed = true;
  };
  /// The coordinates of a mass's point in a state of all unknowns of the statics.
  Vector variables_of(const statics::PointSlice& slice, const Vector& z) const;
  const Frozen& frozen_;
  statics::System system_{};  ///< as the landscape's, with a point at every mass
  Matrix spread_{};           ///< derivative of the statics' unknowns by the moving ones
  std::vector<Mass> masses_{};
  double largest_ = 0;
};

/// What is asked of whoever wants a motion while it is followed.
struct InertialWatch {
  std::function<bool()> goes_on{};  ///< now and then; false: the motion is given up
  /// Of one that lasts, as FlowOptions::caught_by.
  std::function<std::optional<RestState>(const Vector& x, double energy)> caught_by{};
};

/// The motion from a push, with peaks and duration in the units of the case; `landing` has no values yet.
struct Inertial {
  InertialMotion motion{};
  std::optional<RestState> landing{};
};

/// @param from  after the push, at rest
/// @param overdamped  the landing whose softest mode sets the damping; null: none
Inertial inertial_motion(const Frozen& frozen, const Scales& scales,
                         const InertialSettings& settings, const Vector& from,
                         const RestState* overdamped, const InertialWatch& watch = {});

/// Why what was asked of the motion is not all known, and what helps; empty: it is.
std::string doubt_of(const InertialMotion& motion);

}  // namespace springfold::analysis
