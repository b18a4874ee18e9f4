// Curves as plain data: points, special points, why a trace ended.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "springfold/core/linearisation.hpp"
#include "springfold/core/types.hpp"

namespace springfold::continuation {

using springfold::Direction;
using springfold::Linearisation;

struct CurvePoint {
  double s = 0;  ///< pseudo arc length from the start of the trace [-], never decreasing
  Vector x{};
  double lambda = 0;
  Direction tangent{};  ///< unit length in the metric, oriented with increasing s
  Piece piece{};
  std::optional<Index> negative{};  ///< negative eigenvalues of dF/dx; symmetric problems only;
                                    ///< empty at a point where one is zero
};

/// Whether two points are the same to the last bit: place, tangent and piece, whatever was counted there. Points of
/// different sizes are not, and neither is a point without tangent like one that has it.
bool is_same(const CurvePoint& a, const CurvePoint& b);

enum class HitKind {
  limit_point,     ///< lambda turns back
  branch_point,    ///< the extended Jacobian loses rank: branches cross
  kink,            ///< one or more switching surfaces are crossed, one way out
  corner,          ///< the same, and lambda turns back there
  branching_kink,  ///< a kink with more than one way out
  touch,           ///< an eigenvalue or lambda's rate is zero but keeps its sign: degenerate
  family,          ///< lambda stands still from s_before to s_after: equilibria at one load
  user,            ///< an event of the caller
  unresolved,      ///< something happens that no located point explains
  inexact,         ///< a remark on the special point before it: rounding places it worse than 1e-10
};

/// A located special point: plain data, always with the interval that proves it.
struct Hit {
  HitKind kind = HitKind::user;
  std::string name{};  ///< the caller's event, or the switches that are crossed
  CurvePoint point{};  ///< tangent and piece of the arriving side
  /// Kinks: every way out, the one that was taken first. Branch points: none, but where a path goes on along another
  /// branch the way that it takes.
  std::vector<CurvePoint> leaving{};
  /// Half-branches: what seems to leave here within rounding, and leaves at another point next to it.
  std::vector<CurvePoint> leaving_beside{};
  std::vector<Index> switches{};     ///< kinks: which ones are crossed
  int multiplicity = 1;              ///< branch points: how many eigenvalues vanish
  double s_before = 0, s_after = 0;  ///< on the branch, the event lies between these two
  bool stops = false;                ///< the curve ends here
  int tag = 0;                       ///< of the caller's event
  /// In a diagram: the junction at this place, and which of its ways lie on the two sides of it, that by
  /// which the curve arrives and that by which it would go on. -1: none.
  int junction = -1, way_back = -1, way_on = -1;
};

enum class StopReason {
  event,           ///< a stopping event of the caller
  closed,          ///< back at its start: a loop, traced once
  joined,          ///< goes on along a branch that was traced before
  max_points,      ///< as many points as allowed
  step_too_small,  ///< the corrector refused every step down to the minimum
  no_way_out,      ///< at a kink none of the pieces continues the curve
  several_ways,    ///< at a kink more than one piece continues the curve
  bad_start,       ///< the start is no point of a curve: no unique tangent, or F is not defined
  observer,        ///< the caller asked to stop
  unbounded,       ///< as `observer`, where the caller saw lambda grow without bound
  pole,  ///< as `observer`, where the caller saw unknowns go to infinity: nothing lies ahead
  turns_upon_itself,  ///< at a kink, where a switch rests along the curve: it leads back, nothing lies ahead
};

std::string_view to_string(StopReason reason);

/// Did the curve end where it was to end, or where nothing lies ahead? `observer` and `joined` are the caller's matter.
bool ended_as_asked(StopReason reason);

/// Why a step was refused or cut, for the step log.
struct StepNote {
  double s = 0;          ///< where the step began
  double step = 0;       ///< its length
  std::string reason{};  ///< in words
};

/// What shows that an arc of a curve belongs to it as a whole (verification.hpp).
enum class ArcEvidence {
  sampled,   ///< points on it, and the test of every step: nothing more is shown
  regular,   ///< in a tube around it there is no other solution
  crossing,  ///< one simple branch point may lie on it, and the curve passes along its own branch
};

struct Arc {
  double s_begin = 0, s_end = 0;
  ArcEvidence evidence = ArcEvidence::sampled;
  double radius =
      0;  ///< of the tube, in the metric (unknowns of weight zero: in their unit); sampled: 0
};

struct Curve {
  std::vector<CurvePoint> points{};  ///< accepted points, the start first; one between hits
  std::vector<Hit> hits{};           ///< in the order of s
  StopReason stop = StopReason::bad_start;
  std::string stop_detail{};  ///< in words
  std::vector<StepNote> log{};
  std::vector<Arc>
      arcs{};  ///< what is known of the arcs between the points; TraceOptions::verify_arcs
};

enum class EventAction { record, stop };

/// Something worth knowing happens where `value` crosses zero.
struct Event {
  std::string name{};
  std::function<double(const CurvePoint&)> value{};
  EventAction action = EventAction::record;
  int tag = 0;  ///< the caller's own: its hits carry it
  /// What rounding may do to the value there: values that are no larger are not told from zero. Not given: a few units
  /// in the last place of the values on a step.
  std::function<double(const CurvePoint&)> noise{};
  bool of_place = false;  ///< the value depends on x and lambda alone: it needs no tangent
};

}  // namespace springfold::continuation
