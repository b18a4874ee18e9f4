// What happens where a curve meets a switching surface, runs within one, or stands upright. Private
// to the engine.
#pragma once

#include <vector>

#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/locating/events.hpp"
#include "continuation/points/arc.hpp"

namespace springfold::continuation {

/// Where the tracer is between two steps; all else that it goes by stands in the curve. (What a walker remembers of
/// places changes no number.)
struct Progress {
  CurvePoint here{};
  CurvePoint before{}, middle{};  ///< of the step that ended here: its begin, and half-way
  std::vector<Index> left{};      ///< switches that are zero at `here` and being left
  double ds = 0;
  int sense = 0;  ///< sign of lambda's rate after the last kink, or before a family; 0: not known
  bool flat = false;           ///< lambda stands still as far as could be seen from the last kink
  double clear_of = -1;        ///< special points before this s belong to the last kink
  bool from_singular = false;  ///< the curve began at a junction at which its piece is singular
  bool blurred = false;        ///< and rounding hides eigenvalues beside it
};

enum class Outcome { go_on, shorten, stop };

/// The point `at` as the begin of a ray: its tangent, piece and number of negative eigenvalues.
CurvePoint point_on_ray(const Walker& walker, const CurvePoint& at, const Ray& ray);

/// At a switching surface: finds the ways out, records the kink, and goes on if there is one way.
///
/// It is a corner if lambda's rate has opposite signs before and after. Where the rate is zero at
/// the kink itself (a fold of one of the pieces lies on the surface) its sign is taken 1e-6 away,
/// further if need be up to 1e-2, and passage_events() looks for smooth special points only beyond
/// that distance: the fold belongs to the kink and is reported once. A rate that stays zero
/// belongs to a family; at its end the sign before the family counts.
/// @param arriving  the curve just before the kink, where that is known already
Outcome pass_kink(const Walker& walker, const KinkSearch& kink, Progress& progress, Curve& curve,
                  const Beside* arriving = nullptr);

/// A short family that does not begin at a kink may as well be a flat stretch on which lambda turns
/// several times within its rounding: it becomes unresolved.
void settle_families(Curve& curve);

/// The family that reaches as far as this point; nullptr where there is none.
Hit* open_family(const CurvePoint& from, Curve& curve);

/// Smooth special points on the step progress.here -> end, with what events_on_step() does not know:
///  - none within a fold that belongs to a kink at either end;
///  - where lambda stands still along the whole step, a family instead of limit and branch points;
///  - where switches rest on their surfaces, zeros of the eigenvalues in all pieces beside them, and
///    the branches that leave there to one side (half-branches).
/// @param kink  what first_kink() said of this step
/// @param middle  the curve's point half-way, or nullptr
/// @param end   its number of negative eigenvalues is taken away within a family
StepEvents passage_events(const Walker& walker, const Progress& progress, const KinkSearch& kink,
                          CurvePoint& end, const CurvePoint* middle,
                          const std::vector<Event>& events, Curve& curve);

/// On a step along which the switches `resting` stay zero, the equations of 2^r pieces have the same
/// curve but different dF/dx. Where an eigenvalue of one of them passes zero, a branch of that piece
/// crosses; the half of it that lies in the piece is an equilibrium path. Such points become
/// branching kinks in `found`; branch points of the step's own piece are judged in the same way. A
/// zero whose branch has no part in its piece is noted in the log, and is a kink with one way out if
/// the number of negative eigenvalues of the step's own piece changes there.
/// @param samples  the step's ends and points between them, in order
void add_half_branches(const Walker& walker, Samples samples, const std::vector<Index>& resting,
                       StepEvents& found, Curve& curve);

}  // namespace springfold::continuation
