// The traced curve of a study with its special points as the engine located them. Private to analysis.
#pragma once

#include "case_curves.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/trace.hpp"
#include "ways_on.hpp"

namespace springfold::analysis {

struct SpecialPoint {
  std::string label{};  ///< as in the study's table: "LP1"
  /// Of KS that of the branch point that it is, if one chain loses rank.
  EventKind kind = EventKind::limit_point;
  std::size_t row = 0;      ///< in BasePath::branch
  continuation::Hit hit{};  ///< walked away from the start
};

/// Kinds that lie on the surface of a switch.
inline bool is_at_switching(EventKind kind) {
  return kind == EventKind::switching || kind == EventKind::corner_limit_point ||
         kind == EventKind::branching_kink;
}

struct BasePath {
  Branch branch{};
  std::vector<SpecialPoint> points{};  ///< in the order of the branch
  continuation::Curve forward{};       ///< the engine's curve towards growing lambda
  std::string problem{};               ///< why there is no path; empty: there is one
  std::string where{}, advice{};       ///< as StartReport has them, with `problem`
  bool is_enough = false;              ///< it ends behind a point behind which nothing is asked for
  double lambda_unit =
      1;  ///< > 1: the unit of lambda should be so many times larger; the rest is not to be used
};

/// "; it stopped early: " and why, of a path that ended before the limits of the study; otherwise nothing.
std::string early_ends(const Branch& branch);

/// There is no path: the start is none.
void refuse_start(const BasePath& path, StartReport& report);

struct PathOptions {
  bool forward_only = true;  ///< the way in which lambda grows; otherwise both
  double largest_unit =
      1;  ///< by which factor the unit of lambda may grow if it is too small (LambdaCrawl)
  continuation::HitObserver enough{};  ///< true: nothing far behind this point is asked for
  const Study* within = nullptr;       ///< the study with other limits; nullptr: the member's own
  const WayOn* way =
      nullptr;  ///< the path begins there, along this one alone; nullptr: at the start
};

/// The branch through the start. Special points that end it are left out.
BasePath base_path(const Member& member, const Observer& observer, const PathOptions& options = {});

/// PathOptions::largest_unit of a path whose unit of lambda has grown by this factor before.
double growth_of_lambda_unit(const Member& base, double lambda_unit);

/// The curves of a study, and the path of the case's own one.
struct CurvesWithPath {
  std::unique_ptr<CaseCurves> curves{};
  BasePath path{};         ///< where the curves have a base
  double lambda_unit = 1;  ///< as CaseCurves has it
};

/// In a unit of lambda that serves the whole path: beside a limit point the response at the start is no measure of it.
CurvesWithPath curves_with_path(const Study& study, std::size_t parameter, bool forward_only,
                                const Observer& observer);

}  // namespace springfold::analysis
