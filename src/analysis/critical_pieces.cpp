#include "critical_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "springfold/continuation/numerics.hpp"

namespace springfold::analysis {

using continuation::CriticalCurve;
using continuation::CriticalEvent;
using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::CriticalStart;

namespace {

/// Where on the curve between two of its points, near to each other, an event is zero.
CriticalPoint zero_of(const CaseCurves& curves, const CriticalStart& start,
                      const CriticalEvent& event, CriticalPoint from, CriticalPoint to) {
  const bool rises = event.value(from) < 0;
  const double room = rounding_unit * std::max(1.0, std::abs(to.mu));
  while (std::abs(to.mu - from.mu) > room) {
    CriticalPoint guess = from;
    guess.mu = from.mu + 0.5 * (to.mu - from.mu);
    if (guess.mu == from.mu || guess.mu == to.mu) break;
    guess.x = 0.5 * (from.x + to.x);
    guess.lambda = 0.5 * (from.lambda + to.lambda);
    const auto middle = point_near(curves, start, guess, from);
    if (!middle) break;
    ((event.value(*middle) < 0) == rises ? from : to) = *middle;
  }
  return to;
}

struct Met {
  CriticalHit hit{};
  bool ends = false;
};

/// Events between two points near to each other, in order.
std::vector<Met> met_between(const CaseCurves& curves, const CriticalStart& start,
                             const std::vector<CriticalEvent>& events, const CriticalPoint& from,
                             const CriticalPoint& to) {
  std::vector<Met> met;
  for (const CriticalEvent& event : events) {
    const double before = event.value(from), behind = event.value(to);
    if (!(before * behind < 0) && (before == 0 || behind != 0)) continue;
    met.push_back(
        {{.name = event.name, .point = zero_of(curves, start, event, from, to), .tag = event.tag},
         event.action == continuation::EventAction::stop});
  }
  std::stable_sort(met.begin(), met.end(),
                   [](const Met& a, const Met& b) { return a.hit.point.s < b.hit.point.s; });
  return met;
}

}  // namespace

double distance(const CriticalPoint& a, const CriticalPoint& b) {
  return std::hypot((a.x - b.x).norm(), a.lambda - b.lambda, a.mu - b.mu);
}

CriticalStart moved_to(CriticalStart start, const CriticalPoint& point) {
  start.x = point.x;
  start.lambda = point.lambda;
  start.mu = point.mu;
  return start;
}

std::optional<CriticalPoint> point_at(const CaseCurves& curves, const CriticalStart& start,
                                      CriticalPoint guess, double mu) {
  guess.mu = mu;
  return polish_critical(curves.family(), moved_to(start, guess));
}

bool is_on_piece(const CaseCurves& curves, const CriticalStart& start, const CriticalPoint& point) {
  constexpr double zero = continuation::promised_place;
  const Member* member = curves.equations_at(point.mu);
  Vector g;
  if (member == nullptr || !member->problem->switches(point.x, point.lambda, g)) return false;
  for (Index j = 0; j < g.size(); ++j)
    if (g[j] * start.piece[static_cast<std::size_t>(j)] < -zero) return false;
  return true;
}

std::optional<CriticalPoint> point_near(const CaseCurves& curves, const CriticalStart& start,
                                        const CriticalPoint& guess, const CriticalPoint& from) {
  auto point = point_at(curves, start, guess, guess.mu);
  const double room = std::max(distance(guess, from), continuation::told_apart);
  if (!point || distance(*point, guess) > room) return std::nullopt;
  point->dx = from.dx;
  point->dlambda = from.dlambda;
  point->dmu = from.dmu;
  point->s = from.s + distance(*point, from);
  return point;
}

void append(CriticalCurve piece, CriticalCurve& curve) {
  const double s = curve.points.back().s;
  for (CriticalPoint& point : piece.points) point.s += s;
  for (CriticalHit& hit : piece.hits) hit.point.s += s;
  if (!piece.points.empty())
    curve.points.insert(curve.points.end(), piece.points.begin() + 1, piece.points.end());
  std::move(piece.hits.begin(), piece.hits.end(), std::back_inserter(curve.hits));
  curve.stop = piece.stop;
  curve.stop_detail = std::move(piece.stop_detail);
  curve.kept = curve.kept && piece.kept;
  curve.left_out += piece.left_out;
  curve.missed += piece.missed;
}

bool close_gap(const CaseCurves& curves, const CriticalStart& start,
               const std::vector<CriticalEvent>& events, const CriticalPoint& to,
               CriticalCurve& curve) {
  for (Met& met : met_between(curves, start, events, curve.points.back(), to)) {
    curve.hits.push_back(std::move(met.hit));
    if (!met.ends) continue;
    curve.points.push_back(curve.hits.back().point);
    curve.stop = continuation::StopReason::event;
    curve.stop_detail = curve.hits.back().name;
    return true;
  }
  curve.points.push_back(to);
  return false;
}

namespace {

/// Do two chords of a curve lead the same way?
bool lead_alike(const CriticalPoint& a, const CriticalPoint& b, const CriticalPoint& c,
                const CriticalPoint& d) {
  return (b.x - a.x).dot(d.x - c.x) + (b.lambda - a.lambda) * (d.lambda - c.lambda) +
             (b.mu - a.mu) * (d.mu - c.mu) >
         0;
}

}  // namespace

void end_at_start(double s, CriticalCurve& curve) {
  const CriticalPoint start = curve.points.front();
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const CriticalPoint &a = curve.points[i - 1], &b = curve.points[i];
    const double length = distance(a, b);
    if (a.s < s || distance(a, start) > length || distance(b, start) > length ||
        !lead_alike(start, curve.points[1], a, b))
      continue;
    const double end = a.s + distance(a, start);
    std::erase_if(curve.hits, [&](const CriticalHit& hit) { return hit.point.s > end; });
    curve.points.resize(i);
    curve.points.push_back(start);
    curve.points.back().s = end;
    curve.stop = continuation::StopReason::closed;
    curve.stop_detail.clear();
    return;
  }
}

}  // namespace springfold::analysis
