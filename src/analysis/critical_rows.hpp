// A critical curve as a branch of a result. Private to analysis.
#pragma once

#include "base_path.hpp"

namespace springfold::analysis {

/// A followed critical curve: both sides leave the same point.
struct FollowedCurve {
  continuation::CriticalStart start{};
  EventKind of = EventKind::limit_point;                ///< what is followed
  continuation::CriticalCurve falling{}, growing{};     ///< by the parameter, at first
  std::optional<continuation::CriticalHit> at_start{};  ///< a degeneracy that it begins at
  std::vector<continuation::CriticalHit> passed{};      ///< extrema and marks that it begins at
};

/// "reaches its lower limit" (sense -1) or the upper one, of the parameter; the rule of the case that sets it, too.
std::string end_of_range(const CaseCurves& curves, int sense);

/// Limits of the study and of the parameter end the curve, marks are recorded.
std::vector<continuation::CriticalEvent> critical_events(const CaseCurves& curves,
                                                         const Study& study, const Piece& piece);

/// The end at which the first point of the path is its start.
bool ends_at_start_of_path(const continuation::CriticalCurve& curve);

/// The same for the first point on paths along which lambda grows: it may come to the start, and goes no farther.
std::vector<continuation::CriticalEvent> first_point_events(const CaseCurves& curves,
                                                            const Study& study, const Piece& piece);

/// @param starts  at one place; more than one where several springs switch there
FollowedCurve follow_both_ways(const CaseCurves& curves, const Study& study,
                               const std::vector<continuation::CriticalStart>& starts, EventKind of,
                               const Observer& observer);

/// A curve that ends at the load of the start of the path, in another state, says that.
void say_start_or_its_load(const CaseCurves& curves, continuation::CriticalCurve& curve);

/// A curve that breaks off just before a spring switches at the start of the path, or where a length comes to zero,
/// says so.
/// @param growing  was the parameter growing at first?
void say_why_it_stops(const CaseCurves& curves, bool growing, continuation::CriticalCurve& curve);

/// As many as there is memory for.
double most_rows(const CaseCurves& curves);

/// Why rows that `spacing` wants are missing, with what to change; empty if none are.
std::vector<std::string> doubts_of(const CaseCurves& curves, const Study& study,
                                   const FollowedCurve& followed);

/// Columns of the study's curve, then parameters that are held, then the parameter.
std::vector<Quantity> critical_quantities(const CaseCurves& curves);

/// The curve begins at this degeneracy: where a side meets it at the start once more, that is no point of its own.
void begin_at_degeneracy(const continuation::CriticalHit& hit, FollowedCurve& followed);

/// Neither side meets what lies where both begin: an extremum of lambda, or a marked value, is told from both.
void note_passed_at_start(const std::vector<continuation::CriticalEvent>& events,
                          FollowedCurve& followed);

/// The point that became the row with this s of rows_of(); nullptr: there is none.
const continuation::CriticalPoint* point_at(const FollowedCurve& followed, double s);

/// Rows from the falling end to the growing one, special points in rows of their own, without labels.
Branch rows_of(const CaseCurves& curves, const FollowedCurve& followed);

/// Numbers the events of all branches: CP1, CP2, ...
void label_critical(std::vector<Branch>& branches);

/// What a degeneracy is called in results.
EventKind kind_of(continuation::Degeneracy kind, EventKind of);

/// The same in words.
std::string name_of_degeneracy(continuation::Degeneracy kind, EventKind of);

/// Options of the engine for critical curves: those of the study.
continuation::TraceOptions critical_options(const Study& study);

/// What ends a curve, in words; complete where it was asked for or named.
Stop critical_stop(const continuation::CriticalCurve& curve);

}  // namespace springfold::analysis
