#include "cut_curve.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "springfold/core/hermite.hpp"

namespace springfold::analysis {

using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::CriticalStart;

namespace {

/// Of a place on a cubic: a bisection would need as many for all digits.
constexpr std::uintmax_t most_refinements = 60;

/// Between two points of a critical curve the curve is smooth by its length, also where lambda runs like a root of the
/// parameter: the cubics by their values and slopes; chords where a slope is not known.
class BetweenPoints {
 public:
  BetweenPoints(const CriticalPoint& a, const CriticalPoint& b, bool bends)
      : a_{a}, b_{b}, bends_{bends} {}

  static bool may_bend(const CriticalPoint& a, const CriticalPoint& b) {
    return has_slope(a) && has_slope(b);
  }

  /// The part of the way at which the parameter has this value, on the chord where the cubic has none.
  double part_at(double mu) const {
    if (a_.mu == b_.mu) return 0;
    const auto off = [&](double t) { return value(t, a_.mu, a_.dmu, b_.mu, b_.dmu) - mu; };
    if (!bends_ || off(0) * off(1) > 0) return (mu - a_.mu) / (b_.mu - a_.mu);
    std::uintmax_t most = most_refinements;
    const auto [low, high] = boost::math::tools::toms748_solve(
        off, 0.0, 1.0, boost::math::tools::eps_tolerance<double>(), most);
    return 0.5 * (low + high);
  }

  double s_at(double t) const { return a_.s + t * (b_.s - a_.s); }
  CriticalStart start_at(double t, const CriticalStart& of) const {
    CriticalStart start = of;
    start.x = value(t, a_.x, a_.dx, b_.x, b_.dx);
    start.lambda = value(t, a_.lambda, a_.dlambda, b_.lambda, b_.dlambda);
    return start;
  }

 private:
  static bool has_slope(const CriticalPoint& p) {
    return p.dx.size() == p.x.size() && (p.dlambda != 0 || !p.dx.isZero(0));
  }
  template <class Value>
  Value value(double t, const Value& a, const Value& da, const Value& b, const Value& db) const {
    if (!bends_) return (1 - t) * a + t * b;
    return HermiteCubic<Value>{a, da, b, db, b_.s - a_.s}.at(t);
  }

  const CriticalPoint &a_, &b_;
  bool bends_;
};

std::optional<CriticalPoint> point_between(const CaseCurves& curves, const CriticalStart& of,
                                           const BetweenPoints& between, double mu) {
  const double part = between.part_at(mu);
  CriticalStart start = between.start_at(part, of);
  start.mu = mu;
  auto found = polish_critical(curves.family(), start);
  if (found) found->s = between.s_at(part);
  return found;
}

}  // namespace

std::optional<CriticalPoint> point_of_curve(const CaseCurves& curves, const CriticalStart& of,
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
    // Where the parameter stands still at the very place, as at that of a symmetric structure, the chord may meet it.
    auto found =
        BetweenPoints::may_bend(a, b) ? point_between(curves, of, {a, b, true}, mu) : std::nullopt;
    return found ? found : point_between(curves, of, {a, b, false}, mu);
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
