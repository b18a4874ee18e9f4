#include "cut_curve.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::analysis {

using continuation::CriticalHit;
using continuation::CriticalPoint;

std::optional<CriticalPoint> point_of_curve(const CaseCurves& curves,
                                            const continuation::CriticalStart& of,
                                            const continuation::CriticalCurve& curve, double mu,
                                            double room) {
  std::vector<CriticalPoint> points = curve.points;
  for (const CriticalHit& hit : curve.hits) points.push_back(hit.point);
  std::stable_sort(points.begin(), points.end(),
                   [](const CriticalPoint& a, const CriticalPoint& b) { return a.s < b.s; });
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const CriticalPoint &a = points[i], &b = points[i + 1];
    const bool behind_all = i + 2 == points.size() && std::abs(b.mu - mu) <= room;
    if ((a.mu - mu) * (b.mu - mu) > 0 && !behind_all) continue;
    const double part = b.mu == a.mu ? 0 : (mu - a.mu) / (b.mu - a.mu);
    continuation::CriticalStart start = of;
    start.x = a.x + part * (b.x - a.x);
    start.lambda = a.lambda + part * (b.lambda - a.lambda);
    start.mu = mu;
    auto found = polish_critical(curves.family(), start);
    if (found) found->s = a.s + part * (b.s - a.s);
    return found;
  }
  return std::nullopt;
}

void end_curve_at(const CriticalPoint& last, const std::string& why,
                  continuation::CriticalCurve& curve) {
  std::erase_if(curve.hits, [](const CriticalHit& hit) {  // where it was cut before
    return hit.kind == continuation::Degeneracy::user && hit.name.empty();
  });
  std::erase_if(curve.points, [&](const CriticalPoint& p) { return p.s > last.s; });
  std::erase_if(curve.hits, [&](const CriticalHit& hit) { return hit.point.s > last.s; });
  curve.hits.push_back({continuation::Degeneracy::user, "", last});
  curve.stop = continuation::StopReason::event;
  curve.stop_detail = why;
}

void mark_jump(Branch& branch, bool last, const std::string& text) {
  const std::size_t row = last ? branch.samples.size() - 1 : 0;
  auto at = std::find_if(branch.events.begin(), branch.events.end(),
                         [&](const Event& event) { return event.row == row; });
  if (at == branch.events.end()) return;
  if (at->kind != EventKind::end_of_range)
    at = branch.events.insert(last ? branch.events.end() : at + 1, *at);
  at->kind = EventKind::jump;
  at->detail = text;
}

}  // namespace springfold::analysis
