#include "continuation/locating/unexplained.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::continuation {

void add_unresolved(const CurvePoint& from, const CurvePoint& to, const StepEvents& found,
                    Curve& curve) {
  const int count = std::max(1, found.unexplained);
  if (!curve.hits.empty() && curve.hits.back().kind == HitKind::unresolved &&
      from.s - curve.hits.back().s_after < 1000 * unresolved_length) {
    curve.hits.back().s_after = to.s;
    if (!found.flat) curve.hits.back().multiplicity += count;
    return;
  }
  Hit hit{.kind = HitKind::unresolved, .name = "unresolved: " + found.doubt};
  hit.point = to;
  hit.multiplicity = count;
  hit.s_before = from.s;
  hit.s_after = to.s;
  curve.hits.push_back(std::move(hit));
}

void account_over_gap(Curve& curve) {
  const CurvePoint& here = curve.points.back();
  auto known = curve.points.rbegin() + 1;
  while (known != curve.points.rend() && !known->negative) ++known;
  if (!here.negative || known == curve.points.rend() || known == curve.points.rbegin() + 1) return;
  int most = 0;
  bool odd = false, parity = true;
  for (const Hit& hit : curve.hits) {
    if (hit.point.s < known->s || hit.kind == HitKind::user) continue;
    const bool branch_point = hit.kind == HitKind::branch_point;
    const bool limit_point = hit.kind == HitKind::limit_point;
    if (!branch_point && !limit_point && hit.kind != HitKind::touch) return;
    most += branch_point ? hit.multiplicity + 1 : limit_point ? 1 : 0;
    odd = odd != limit_point;
    parity = parity && !branch_point;  // lambda may turn there as well
  }
  const auto change = static_cast<int>(std::abs(*here.negative - *known->negative));
  if (change <= most && (!parity || (change % 2 == 1) == odd)) return;
  Hit hit{
      .kind = HitKind::unresolved,
      .name = "unresolved: number of negative eigenvalues and special points do not fit together"};
  hit.point = here;
  hit.multiplicity = std::max(1, change);
  hit.s_before = known->s;
  hit.s_after = here.s;
  curve.hits.push_back(std::move(hit));
}

}  // namespace springfold::continuation
