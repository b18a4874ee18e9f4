#include "critical_kinks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "springfold/continuation/numerics.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalEvent;
using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::CriticalStart;

/// Differences in the parameter reach no farther where they are narrowest: so near to a kink a curve breaks off.
constexpr double reach_of_differences = step_of_family;

/// Of one curve; one that has more goes to and fro between two states.
constexpr int most_kinks = 20;

double distance(const CriticalPoint& a, const CriticalPoint& b) {
  return std::hypot((a.x - b.x).norm(), a.lambda - b.lambda, a.mu - b.mu);
}

/// The point of the curve at this value, near a guess; nothing where Newton's method goes elsewhere.
/// @param from  the point before, from which the guess was made
std::optional<CriticalPoint> point_near(const CaseCurves& curves, CriticalStart start,
                                        const CriticalPoint& guess, const CriticalPoint& from) {
  start.x = guess.x;
  start.lambda = guess.lambda;
  start.mu = guess.mu;
  auto point = polish_critical(curves.family(), start);
  if (!point || distance(*point, guess) > distance(guess, from)) return std::nullopt;
  point->dx = from.dx;
  point->dlambda = from.dlambda;
  point->dmu = from.dmu;
  point->s = from.s + distance(*point, from);
  return point;
}

/// As far along the straight line on which the curve arrives, or came.
CriticalPoint on_line(const CriticalPoint& from, const CriticalPoint& slope, double mu) {
  CriticalPoint guess = from;
  const double t = (mu - from.mu) / slope.dmu;
  guess.x += t * slope.dx;
  guess.lambda += t * slope.dlambda;
  guess.mu = mu;
  return guess;
}

/// Events between the last point before a kink and the first one behind it, where each is located by the curve's own points.
class ShortGap {
 public:
  ShortGap(const CaseCurves& curves, const CriticalStart& start,
           const std::vector<CriticalEvent>& events)
      : curves_{curves}, start_{start}, events_{events} {}

  /// @returns whether one of them ends the curve
  bool close(const CriticalPoint& to, CriticalCurve& curve) const {
    const CriticalPoint from = curve.points.back();
    std::vector<CriticalHit> met;
    std::vector<bool> stops;
    for (const CriticalEvent& event : events_) {
      const double before = event.value(from), behind = event.value(to);
      if (!(before * behind < 0)) continue;
      met.push_back({.name = event.name, .point = zero_of(event, from, to), .tag = event.tag});
    }
    std::stable_sort(met.begin(), met.end(), [](const CriticalHit& a, const CriticalHit& b) {
      return a.point.s < b.point.s;
    });
    for (const CriticalHit& hit : met) {
      curve.hits.push_back(hit);
      if (!ends(hit)) continue;
      curve.points.push_back(hit.point);
      curve.stop = continuation::StopReason::event;
      curve.stop_detail = hit.name;
      return true;
    }
    curve.points.push_back(to);
    return false;
  }

 private:
  bool ends(const CriticalHit& hit) const {
    return std::any_of(events_.begin(), events_.end(), [&](const CriticalEvent& event) {
      return event.action == continuation::EventAction::stop && event.name == hit.name &&
             event.tag == hit.tag;
    });
  }

  CriticalPoint zero_of(const CriticalEvent& event, CriticalPoint from, CriticalPoint to) const {
    const bool rises = event.value(from) < 0;
    const double room = rounding_unit * std::max(1.0, std::abs(to.mu));
    while (std::abs(to.mu - from.mu) > room) {
      CriticalPoint guess = from;
      guess.mu = from.mu + 0.5 * (to.mu - from.mu);
      if (guess.mu == from.mu || guess.mu == to.mu) break;
      guess.x = 0.5 * (from.x + to.x);
      guess.lambda = 0.5 * (from.lambda + to.lambda);
      const auto middle = point_near(curves_, start_, guess, from);
      if (!middle) break;
      ((event.value(*middle) < 0) == rises ? from : to) = *middle;
    }
    return to;
  }

  const CaseCurves& curves_;
  const CriticalStart& start_;
  const std::vector<CriticalEvent>& events_;
};

/// What follows behind the kink, with its first point; nothing if it cannot be followed from there.
std::optional<CriticalCurve> behind_kink(
    const CriticalPoint& kink, const CriticalPoint& last, const CaseCurves& curves,
    CriticalStart start, const std::function<CriticalCurve(CriticalStart)>& follow) {
  constexpr double wider[] = {1, 4, 16};
  for (const double times : wider) {
    const double gap = std::max(std::abs(kink.mu - last.mu), reach_of_differences / 64) * times;
    const auto first = point_near(
        curves, start, on_line(kink, last, kink.mu + std::copysign(gap, last.dmu)), kink);
    if (!first) continue;
    start.x = first->x;
    start.lambda = first->lambda;
    start.mu = first->mu;
    CriticalCurve curve = follow(start);
    if (curve.points.size() < 2 && curve.hits.empty()) continue;
    return curve;
  }
  return std::nullopt;
}

/// Puts a piece behind a curve, of which it begins at the last point.
void append(CriticalCurve piece, CriticalCurve& curve) {
  const double s = curve.points.back().s;
  for (CriticalPoint& point : piece.points) point.s += s;
  for (CriticalHit& hit : piece.hits) hit.point.s += s;
  curve.points.insert(curve.points.end(), piece.points.begin() + 1, piece.points.end());
  std::move(piece.hits.begin(), piece.hits.end(), std::back_inserter(curve.hits));
  curve.stop = piece.stop;
  curve.stop_detail = std::move(piece.stop_detail);
  curve.kept = curve.kept && piece.kept;
  curve.left_out += piece.left_out;
  curve.missed += piece.missed;
}

}  // namespace

std::optional<std::pair<double, std::string>> switching_start(const CaseCurves& curves, double mu,
                                                              double beyond) {
  const auto piece_at = [&curves](double m) {
    const Member* member = curves.at(m);
    return member == nullptr ? Piece{} : member->first.piece;
  };
  const Piece here = piece_at(mu);
  Piece there = piece_at(beyond);
  if (here.empty() || there.size() != here.size() || there == here) return std::nullopt;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = mu + 0.5 * (beyond - mu);
    Piece piece = piece_at(middle);
    if (piece.size() != here.size()) return std::nullopt;
    if (piece == here) {
      mu = middle;
    } else {
      beyond = middle;
      there = std::move(piece);
    }
  }
  const auto differs = std::mismatch(here.begin(), here.end(), there.begin()).first - here.begin();
  return std::pair{beyond, curves.base().problem->switch_name(differs)};
}

CriticalCurve follow_over_kinks(const CaseCurves& curves, const CriticalStart& start, bool growing,
                                const std::vector<CriticalEvent>& events,
                                const continuation::TraceOptions& options,
                                const std::function<bool(const CriticalPoint&)>& observer,
                                const continuation::FurtherPoints& further) {
  CriticalCurve curve =
      follow_critical(curves.family(), start, growing, events, options, observer, further);
  const ShortGap gap(curves, start, events);
  std::vector<CriticalPoint> passed;
  for (int kinks = 0; kinks < most_kinks; ++kinks) {
    if (curve.stop != continuation::StopReason::step_too_small || curve.points.size() < 2)
      return curve;
    const CriticalPoint last = curve.points.back();
    if (last.dmu == 0) return curve;
    const auto place =
        switching_start(curves, last.mu, last.mu + std::copysign(reach_of_differences, last.dmu));
    const auto kink =
        place ? point_near(curves, start, on_line(last, last, place->first), last) : std::nullopt;
    if (!kink) return curve;
    const auto is_kink = [&](const CriticalPoint& other) {
      return other.dmu * last.dmu > 0 && distance(other, *kink) <= continuation::told_apart;
    };
    if (std::any_of(passed.begin(), passed.end(), is_kink)) {
      curve.stop = continuation::StopReason::closed;
      return curve;
    }
    passed.push_back(*kink);
    const auto follow = [&](const CriticalStart& from) {
      return follow_critical(curves.family(), from, last.dmu > 0, events, options, observer,
                             further);
    };
    auto piece = behind_kink(*kink, last, curves, start, follow);
    if (!piece) return curve;
    CriticalPoint first = piece->points.front();
    first.s = kink->s + distance(first, *kink);
    if (gap.close(*kink, curve) || gap.close(first, curve)) return curve;
    append(std::move(*piece), curve);
  }
  return curve;
}

}  // namespace springfold::analysis
