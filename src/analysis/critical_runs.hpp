// The study kinds that look at special points in a second parameter. Private to analysis.
#pragma once

#include "arrivals.hpp"
#include "critical_rows.hpp"
#include "springfold/analysis/history.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

/// The same study as kind force_deflection, limits and marks of the parameter included.
Study base_study(const Study& study);

/// Where a critical curve begins, and what it is one of.
struct CriticalOrigin {
  SpecialPoint point{};                   ///< on the path of a study
  const Member* member = nullptr;         ///< on whose path it lies
  EventKind of = EventKind::limit_point;  ///< what is followed
  std::optional<continuation::CriticalHit>
      degeneracy{};                                   ///< of that place itself, for any parameter
  std::vector<continuation::CriticalStart> starts{};  ///< as critical_starts() gives them
};

/// At the special point that the study names. @param path  the case's own; nothing: `report` says why
std::optional<CriticalOrigin> origin_on_path(const CaseCurves& curves, const BasePath& path,
                                             const Study& study, StartReport& report);

/// @returns what was followed, one per branch of the result
std::vector<FollowedCurve> run_critical_curve(const CaseCurves& curves,
                                              const CriticalOrigin& origin, const Study& study,
                                              const Observer& observer, StudyResult& result);

/// A study of kind critical_curve with what a further curve needs that begins at one of its rows.
struct CurveRun {
  Study study{};  ///< its cases have the values of the row where the curve begins
  StudyResult result{};
  std::shared_ptr<CaseCurves> curves{},
      of_point{};  ///< of_point: those on whose path origin.point lies
  CriticalOrigin origin{};
  std::vector<FollowedCurve> pieces{};  ///< one per branch of the result
  ParameterChanges held{};  ///< parameters that have the values of the row where the curve begins
};

/// Its curves and where it begins; result.start.found: it can be followed.
CurveRun begin_critical_curve(const Study& study, const Observer& observer);
/// Follows what was begun, in its range, which may end at rules for the case's numbers.
void follow_within_rules(CurveRun& run, const Observer& observer);

/// Does the study begin at a row of the critical curve of the earlier one?
bool begins_on_curve(const History& history);
/// The earlier studies are run, and the same kind of special point begins where the row is.
/// @pre begins_on_curve(history)
CurveRun begin_on_curve(const History& history, const Study& study, const Observer& observer);

void run_threshold(const CaseCurves& curves, const Study& study, const Observer& observer,
                   StudyResult& result);
void run_critical_load(const CaseCurves& curves, const Study& study, const Observer& observer,
                       StudyResult& result);
void run_design(const Study& study, const Observer& observer, StudyResult& result);
void run_sensitivity(const Study& study, const Observer& observer, StudyResult& result);

}  // namespace springfold::analysis
