// The stable stretches of a graph of states: which state lies on which, where they end, and what takes over there.
// Private to analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frozen.hpp"
#include "snap_jumps.hpp"
#include "stable_stretch.hpp"
#include "state_book.hpp"
#include "stretch_track.hpp"

namespace springfold::analysis {

/// A step of lambda beyond a point where stability is handed over. What takes it over has an amplitude of about its
/// root there, and a stiffness of about its size: far above those of what counts as critical, and near the point.
inline constexpr double beyond_end = 1e-4;

/// Stretches are counted from 1, as branches and states are. The references must outlive it.
class Stretches {
 public:
  Stretches(const Tracing& t, const Scales& scales, const SnapSettings& settings,
            StudyResult& result);

  int count() const { return static_cast<int>(list_.size()); }
  const StableStretch& at(int number) const { return list_[static_cast<std::size_t>(number - 1)]; }
  bool is_full() const;
  /// The problem at a dimensionless lambda, with the damping that is asked for.
  Frozen frozen(double lambda) const { return {t_.problem, scales_, lambda, settings_.damping}; }

  /// Traces the stretch from a stable state on; a doubt where none leads on.
  void follow(const continuation::DiagramStart& from);
  /// The same, if the state lies on no stretch that is known and within the study's limits.
  void follow_new(const Frozen& frozen, const RestState& state);
  /// A state of this lambda obeys the study's limits.
  bool is_within(const Frozen& frozen, const RestState& state) const;
  /// Writes all stretches as the result's branches.
  void write_branches();

  /// The stretch on which a state lies; 0: on none.
  int number_of(const Frozen& frozen, const Vector& x) const;
  /// The states of all stretches at this lambda; where there are none, those to which the ways down from the stretches'
  /// nearest states lead.
  StateBook book_at(const Frozen& frozen) const;

  /// Does stability, or the curve, end there before the study's range does?
  bool ends(int number, int direction) const;
  /// Dimensionless lambda at an end.
  double end_of(int number, int direction) const;
  /// Minima beside the end of a stretch, a little beyond it: along its softest mode, both ways.
  std::vector<RestState> taking_over(int number, int direction) const;
  const std::vector<Loss>& losses() const { return losses_; }

 private:
  continuation::CurvePoint point_of(const Frozen& frozen, const RestState& state) const;
  StretchTrack track_of(const StableStretch& stretch) const;
  /// The stretch's state at this lambda, not polished.
  std::optional<Vector> near_on(const Frozen& frozen, std::size_t stretch) const;
  /// Does the stretch come near a state of this lambda?
  bool passes(const Frozen& frozen, std::size_t stretch, const Vector& x) const;
  std::size_t end_row(std::size_t branch, int direction) const;

  const Tracing& t_;
  const Scales& scales_;
  const SnapSettings& settings_;
  StudyResult& result_;
  std::size_t arc_length_, lambda_, index_;
  Index size_;
  std::vector<StableStretch> list_{};
  std::vector<StretchTrack> tracks_{};  ///< of the same
  std::vector<Loss> losses_{};          ///< of all stretches
};

}  // namespace springfold::analysis
