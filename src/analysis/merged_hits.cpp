#include "merged_hits.hpp"

#include <algorithm>
#include <vector>

#include "force_events.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::Hit;
using continuation::HitKind;

/// "Rounding lets the branch point be placed to 3e-9 only": nothing that is missing.
bool is_remark(const Hit& hit) { return hit.kind == HitKind::inexact; }

Curve with_remarks_joined(Curve curve) {
  for (std::size_t i = 1; i < curve.hits.size(); ++i)
    if (is_remark(curve.hits[i])) curve.hits[i - 1].name += ", " + curve.hits[i].name;
  std::erase_if(curve.hits, [](const Hit& hit) {
    const bool same_piece = hit.kind == HitKind::kink && hit.leaving.size() == 1 &&
                            hit.leaving.front().piece == hit.point.piece;
    return is_remark(hit) || same_piece;
  });
  return curve;
}

}  // namespace

Curve with_hits_merged(Curve curve, const Evaluator& evaluator) {
  return with_remarks_joined(with_merged_force_events(std::move(curve), evaluator));
}

}  // namespace springfold::analysis
