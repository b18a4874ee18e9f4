#include "critical_kinks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "critical_bends.hpp"
#include "critical_pieces.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalEvent;
using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::CriticalStart;

/// Differences in the parameter reach less far where they are narrowest: so near to a kink a curve is followed.
constexpr double beside_kink = step_of_family / 8;

/// Of the event that ends a stretch just before a kink: no event of the caller has it.
constexpr int own_tag = std::numeric_limits<int>::min();

/// Of one curve; one that has more goes to and fro between two states.
constexpr int most_kinks = 20;

/// Of the path's start at this value of the parameter; empty where there is none, and where nothing switches.
Piece piece_at(const CaseCurves& curves, double mu) {
  const Member* member = curves.at(mu);
  return member == nullptr ? Piece{} : member->first.piece;
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

/// A curve up to just before a kink, or to its end.
struct Stretch {
  CriticalCurve curve{};
  std::optional<double> kink{};  ///< the parameter's value there
};

class Follower {
 public:
  using Observer = std::function<bool(const CriticalPoint&)>;

  Follower(const CaseCurves& curves, const CriticalStart& start,
           const std::vector<CriticalEvent>& events, const continuation::TraceOptions& options,
           const Observer& observer, const continuation::FurtherPoints& further)
      : curves_{curves},
        start_{start},
        events_{events},
        options_{options},
        observer_{observer},
        further_{further} {}

  /// Steps cross kinks that are weak, or crawl before them: at accepted points it is asked on which piece the start is
  /// there, and as far ahead as differences reach.
  Stretch to_kink(const CriticalStart& from, bool growing) const {
    const bool watches = curves_.start_enters_equations() && !from.piece.empty();
    if (watches)
      if (auto beside = beside_kink_at(from, growing ? 1 : -1)) return *beside;
    return from_place(from, growing, watches);
  }

  Stretch from_place(const CriticalStart& from, bool growing, bool watches) const {
    CriticalPoint last{.x = from.x, .lambda = from.lambda, .mu = from.mu};
    std::optional<double> crossed;
    const Observer watch = [&](const CriticalPoint& p) {
      const double ahead = p.mu + std::copysign(grid_step, p.dmu);
      if (watches && differ(last.mu, p.mu)) crossed = p.mu;
      if (!crossed) last = p;
      if (watches && !crossed && differ(p.mu, ahead)) crossed = ahead;
      return !crossed && (!observer_ || observer_(p));
    };
    Stretch found{
        follow_critical(curves_.family(), from, growing, events_, options_, watch, further_)};
    if (crossed)
      end_before(*crossed, last, found);
    else if (found.curve.stop == continuation::StopReason::step_too_small)
      found.kink = kink_near_end(found.curve);
    if (crossed || found.kink || found.curve.stop != continuation::StopReason::step_too_small)
      return found;
    found.kink = bend_near_end(curves_, start_, found.curve);
    return found;
  }

  /// From a start at which the curve itself has a kink, and nothing leaves along its tangent: an extremum of a law with
  /// a kink in its slope lies just there. A little farther on the curve is found again, if its points lie in one
  /// direction from there.
  std::optional<Stretch> beside(const CriticalStart& from, bool growing) const {
    constexpr double wider[] = {1, 4, 16}, twice = 2, least = 1.5, most = 2.5;
    const auto point = polish_critical(curves_.family(), from);
    if (!point) return std::nullopt;
    for (const double times : wider) {
      const double gap = (growing ? times : -times) * beside_kink;
      const auto first = point_at(*point, point->mu + gap),
                 second = point_at(*point, point->mu + twice * gap);
      if (!first || !second || !is_on_piece(curves_, from, *first)) continue;
      const double grown = distance(*second, *point) / distance(*first, *point);
      if (!(grown > least && grown < most)) continue;
      auto next = going_on(*first, growing);
      if (!next) continue;
      Stretch found{.kink = next->kink};
      found.curve.points = {*point};
      CriticalPoint behind = next->curve.points.front();
      behind.s = distance(behind, *point);
      if (!close_gap(curves_, from, events_, behind, found.curve))
        append(std::move(next->curve), found.curve);
      return found;
    }
    return std::nullopt;
  }

  /// From the kink on, with its first point; nothing if the curve cannot be followed from there.
  std::optional<Stretch> from_kink(const CriticalPoint& kink, const CriticalPoint& last) const {
    constexpr double wider[] = {1, 4, 16};
    for (const double times : wider) {
      const double gap = std::max(std::abs(kink.mu - last.mu), beside_kink) * times;
      const auto first = point_near(
          curves_, start_, on_line(kink, last, kink.mu + std::copysign(gap, last.dmu)), kink);
      if (!first) continue;
      if (auto next = going_on(*first, last.dmu > 0)) return next;
    }
    return std::nullopt;
  }

 private:
  std::optional<CriticalPoint> point_at(const CriticalPoint& guess, double mu) const {
    CriticalStart start = start_;
    start.x = guess.x;
    start.lambda = guess.lambda;
    start.mu = mu;
    return polish_critical(curves_.family(), start);
  }

  std::optional<Stretch> going_on(const CriticalPoint& first, bool growing) const {
    CriticalStart start = start_;
    start.x = first.x;
    start.lambda = first.lambda;
    start.mu = first.mu;
    Stretch next = from_place(start, growing, curves_.start_enters_equations());
    if (next.curve.points.size() < 2 && next.curve.hits.empty() && !next.kink) return std::nullopt;
    return next;
  }

  bool differ(double a, double b) const {
    const Piece here = piece_at(curves_, a), there = piece_at(curves_, b);
    return !here.empty() && here.size() == there.size() && here != there;
  }

  /// A start so near to a kink that differences reach across it, whichever way it leaves: it is the stretch up to the
  /// kink, or stands for the kink itself.
  std::optional<Stretch> beside_kink_at(const CriticalStart& from, double sense) const {
    const bool ahead = differ(from.mu, from.mu + sense * beside_kink);
    if (!ahead && !differ(from.mu, from.mu - sense * beside_kink)) return std::nullopt;
    const auto place = ahead ? switching_start(curves_, from.mu, from.mu + sense * beside_kink)
                             : std::optional(std::pair{from.mu, std::string{}});
    const auto point = polish_critical(curves_.family(), from);
    if (!place || !point) return std::nullopt;
    Stretch found{.kink = place->first};
    found.curve.points = {*point};
    found.curve.points.front().dx = Vector::Zero(point->x.size());
    found.curve.points.front().dmu = sense;
    return found;
  }

  std::optional<double> kink_near_end(const CriticalCurve& curve) const {
    if (curve.points.empty() || curve.points.back().dmu == 0) return std::nullopt;
    const CriticalPoint& last = curve.points.back();
    const auto place =
        switching_start(curves_, last.mu, last.mu + std::copysign(step_of_family, last.dmu));
    return place ? std::optional(place->first) : std::nullopt;
  }

  /// The stretch ends at `last`, the last point before the kink, or nearer to it.
  void end_before(double crossed, const CriticalPoint& last, Stretch& stretch) const {
    CriticalCurve& curve = stretch.curve;
    std::erase_if(curve.points, [&](const CriticalPoint& p) { return p.s > last.s; });
    std::erase_if(curve.hits, [&](const CriticalHit& hit) { return hit.point.s > last.s; });
    const auto place = switching_start(curves_, last.mu, crossed);
    if (!place) return;
    const double sense = crossed > last.mu ? 1 : -1, end = place->first - sense * beside_kink;
    if (sense * (end - last.mu) > 0) {
      std::vector<CriticalEvent> events = events_;
      events.push_back({.name = "kink",
                        .value = [=](const CriticalPoint& p) { return sense * (p.mu - end); },
                        .action = continuation::EventAction::stop,
                        .of_place = true,
                        .tag = own_tag});
      CriticalStart from = start_;
      from.x = last.x;
      from.lambda = last.lambda;
      from.mu = last.mu;
      CriticalCurve rest =
          follow_critical(curves_.family(), from, sense > 0, events, options_, observer_, further_);
      const bool reached = !rest.hits.empty() && rest.hits.back().tag == own_tag;
      if (reached) {
        rest.points.push_back(rest.hits.back().point);
        rest.hits.pop_back();
      }
      append(std::move(rest), curve);
      if (!reached) {
        if (curve.stop == continuation::StopReason::step_too_small)
          stretch.kink = kink_near_end(curve);
        return;
      }
    }
    stretch.kink = place->first;
  }

  const CaseCurves& curves_;
  const CriticalStart& start_;
  const std::vector<CriticalEvent>& events_;
  const continuation::TraceOptions& options_;
  const Observer& observer_;
  const continuation::FurtherPoints& further_;
};

}  // namespace

std::optional<std::pair<double, std::string>> switching_start(const CaseCurves& curves, double mu,
                                                              double beyond) {
  const Piece here = piece_at(curves, mu);
  Piece there = piece_at(curves, beyond);
  if (here.empty() || there.size() != here.size() || there == here) return std::nullopt;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = mu + 0.5 * (beyond - mu);
    Piece piece = piece_at(curves, middle);
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

namespace {

/// Leads the curve over the kink at its end. @returns false where it cannot be followed farther
bool pass_kink(const CaseCurves& curves, const CriticalStart& start, const Follower& follower,
               const std::vector<CriticalEvent>& events, std::vector<CriticalPoint>& passed,
               Stretch& stretch) {
  CriticalCurve& curve = stretch.curve;
  const CriticalPoint last = curve.points.back();
  // Until it goes on, the curve ends here.
  curve.stop = continuation::StopReason::step_too_small;
  curve.stop_detail = "the curve could not be followed over " + curves.name() + " = " +
                      rounded(*stretch.kink * curves.scale()) +
                      ", where a spring switches at the start or its law bends";
  if (last.dmu == 0 || std::ssize(passed) == most_kinks) return false;
  const auto kink = point_near(curves, start, on_line(last, last, *stretch.kink), last);
  if (!kink || !is_on_piece(curves, start, *kink)) return false;
  const auto is_kink = [&](const CriticalPoint& other) {
    return other.dmu * last.dmu > 0 && distance(other, *kink) <= continuation::told_apart;
  };
  if (std::any_of(passed.begin(), passed.end(), is_kink)) {
    end_at_start(passed.front().s, curve);
    return false;
  }
  passed.push_back(*kink);
  auto next = follower.from_kink(*kink, last);
  if (!next || !is_on_piece(curves, start, next->curve.points.front())) return false;
  CriticalPoint first = next->curve.points.front();
  first.s = kink->s + distance(first, *kink);
  if (close_gap(curves, start, events, *kink, curve) ||
      close_gap(curves, start, events, first, curve))
    return false;
  append(std::move(next->curve), curve);
  stretch.kink = next->kink;
  return true;
}

}  // namespace

CriticalCurve follow_over_kinks(const CaseCurves& curves, const CriticalStart& start, bool growing,
                                const std::vector<CriticalEvent>& events,
                                const continuation::TraceOptions& options,
                                const std::function<bool(const CriticalPoint&)>& observer,
                                const continuation::FurtherPoints& further) {
  const Follower follower(curves, start, events, options, observer, further);
  Stretch stretch = follower.to_kink(start, growing);
  const bool is_stuck = stretch.curve.stop == continuation::StopReason::step_too_small &&
                        stretch.curve.points.size() < 2 && !stretch.kink;
  if (is_stuck)
    if (auto beside = follower.beside(start, growing)) stretch = std::move(*beside);
  std::vector<CriticalPoint> passed;
  while (stretch.kink && !stretch.curve.points.empty())
    if (!pass_kink(curves, start, follower, events, passed, stretch)) break;
  return std::move(stretch.curve);
}

}  // namespace springfold::analysis
