#include "merged_hits.hpp"

#include <algorithm>
#include <vector>

#include "force_events.hpp"
#include "quantities.hpp"
#include "switch_words.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::Hit;
using continuation::HitKind;

/// "Rounding lets the branch point be placed to 3e-9 only": nothing that is missing.
bool is_remark(const Hit& hit) { return hit.kind == HitKind::inexact; }

/// A switching at which no spring changes its law.
bool changes_nothing(const Hit& hit, const PathProblem& problem) {
  if (hit.kind != HitKind::kink || hit.leaving.size() != 1) return false;
  const Piece &before = hit.point.piece, &after = hit.leaving.front().piece;
  return before == after ||
         is_between_equal_segments(problem.system(hit.point.lambda), hit, before, after);
}

Curve with_remarks_joined(Curve curve, const PathProblem& problem) {
  for (std::size_t i = 1; i < curve.hits.size(); ++i)
    if (is_remark(curve.hits[i])) curve.hits[i - 1].name += ", " + curve.hits[i].name;
  std::erase_if(curve.hits,
                [&](const Hit& hit) { return is_remark(hit) || changes_nothing(hit, problem); });
  return curve;
}

}  // namespace

Curve with_hits_merged(Curve curve, const Evaluator& evaluator) {
  return with_remarks_joined(with_merged_force_events(std::move(curve), evaluator),
                             evaluator.problem());
}

}  // namespace springfold::analysis
