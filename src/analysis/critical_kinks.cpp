#include "critical_kinks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continued_laws.hpp"
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

/// Of one curve: those of tables with many points, to and fro.
constexpr int most_bends = 1000;

/// Of the path's start at one value of the parameter.
struct StartSides {
  Piece piece{};              ///< empty where there is no start, and where nothing switches
  std::vector<bool> rests{};  ///< switches that are zero there: rounding has their side
};

StartSides sides_at(const CaseCurves& curves, double mu) {
  constexpr double zero = continuation::TraceOptions{}.simultaneous;
  const Member* member = curves.at(mu);
  if (member == nullptr) return {};
  StartSides sides{member->first.piece, std::vector<bool>(member->first.piece.size(), false)};
  const PathProblem& problem = *member->problem;
  Vector g;
  if (!problem.switches(problem.reduce(member->first.z), member->setup.lambda_start, g))
    return sides;
  for (std::size_t j = 0; j < sides.rests.size(); ++j)
    sides.rests[j] = std::abs(g[static_cast<Index>(j)]) <= zero;
  return sides;
}

/// The first switch on different sides of the two starts, unless it is zero at both; nothing if there is none, or no
/// start.
std::optional<Index> switched_between(const StartSides& a, const StartSides& b) {
  if (a.piece.size() != b.piece.size()) return std::nullopt;
  for (std::size_t j = 0; j < a.piece.size(); ++j)
    if (a.piece[j] != b.piece[j] && !(a.rests[j] && b.rests[j])) return static_cast<Index>(j);
  return std::nullopt;
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

/// A curve up to just before a kink, to a bend of a law, or to its end.
struct Stretch {
  CriticalCurve curve{};
  std::optional<double> kink{};  ///< the parameter's value there
  bool bends = false;            ///< a law does, at the last point

  bool goes_on() const { return kink || bends; }
};

/// Did it leave its start?
bool has_left(const Stretch& stretch) {
  return stretch.curve.points.size() > 1 || !stretch.curve.hits.empty() || stretch.goes_on();
}

class Follower {
 public:
  using Observer = std::function<bool(const CriticalPoint&)>;

  Follower(const CaseCurves& curves, const CriticalStart& start,
           const std::vector<CriticalEvent>& events, const continuation::TraceOptions& options,
           const Observer& observer, const continuation::FurtherPoints& further)
      : curves_{curves},
        laws_{curves},
        start_{start},
        events_{events},
        options_{options},
        observer_{observer},
        further_{further} {}

  /// The whole curve, to one side.
  CriticalCurve follow(bool growing) {
    laws_.hold_at({.x = start_.x, .lambda = start_.lambda, .mu = start_.mu});
    stretch_ = to_kink(start_, growing);
    const bool is_stuck = stretch_.curve.stop == continuation::StopReason::step_too_small &&
                          stretch_.curve.points.size() < 2 && !stretch_.goes_on();
    if (is_stuck)
      if (auto found = beside(start_, growing)) stretch_ = std::move(*found);
    while (stretch_.goes_on() && !stretch_.curve.points.empty())
      if (!(stretch_.bends ? pass_bend(growing) : pass_kink())) break;
    return std::move(stretch_.curve);
  }

 private:
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
        follow_critical(laws_.family(), from, growing, all_events(), options_, watch, further_)};
    if (crossed)
      end_before(*crossed, last, found);
    else if (found.curve.stop != continuation::StopReason::step_too_small)
      take_bend(found);
    else if (found.kink = kink_near_end(found.curve); !found.kink)
      found.kink = bend_near_end(curves_, start_, found.curve);
    return found;
  }

  std::vector<CriticalEvent> all_events() const {
    std::vector<CriticalEvent> events = laws_.ends();
    events.insert(events.begin(), events_.begin(), events_.end());
    return events;
  }

  /// A curve that has ended on a bend of a law has its last point there.
  static void take_bend(Stretch& stretch) {
    CriticalCurve& curve = stretch.curve;
    if (curve.hits.empty() || !ContinuedLaws::is_end(curve.hits.back())) return;
    CriticalPoint end = std::move(curve.hits.back().point);
    curve.hits.pop_back();
    // Laws that are alike meet theirs together.
    while (!curve.hits.empty() && ContinuedLaws::is_end(curve.hits.back())) curve.hits.pop_back();
    if (curve.points.empty() || curve.points.back().s < end.s)
      curve.points.push_back(std::move(end));
    stretch.bends = true;
  }

  /// From a start at which the curve itself has a kink, and nothing leaves along its tangent: an extremum of a law with
  /// a kink in its slope lies just there. A little farther on the curve is found again, if its points lie in one
  /// direction from there.
  std::optional<Stretch> beside(const CriticalStart& from, bool growing) {
    constexpr double wider[] = {1, 4, 16}, twice = 2, least = 1.5, most = 2.5;
    const auto point = polish_critical(curves_.family(), from);
    if (!point) return std::nullopt;
    for (const double times : wider) {
      const double gap = (growing ? times : -times) * beside_kink;
      const auto first = point_at(curves_, start_, *point, point->mu + gap),
                 second = point_at(curves_, start_, *point, point->mu + twice * gap);
      if (!first || !second || !is_on_piece(curves_, from, *first)) continue;
      const double grown = distance(*second, *point) / distance(*first, *point);
      if (!(grown > least && grown < most)) continue;
      laws_.hold_at(*first);
      auto next = going_on(*first, growing);
      if (!next) continue;
      Stretch found{.kink = next->kink, .bends = next->bends};
      found.curve.points = {*point};
      CriticalPoint behind = next->curve.points.front();
      behind.s = distance(behind, *point);
      if (!close_gap(curves_, from, events_, behind, found.curve))
        append(std::move(next->curve), found.curve);
      return found;
    }
    return std::nullopt;
  }

  /// Says why the curve ends here, which it does until it goes on.
  void end_here(const std::string& what) {
    stretch_.curve.stop = continuation::StopReason::step_too_small;
    stretch_.curve.stop_detail = "the curve could not be followed over " + what;
  }

  /// Leads the curve over the kink at its end. @returns false where it cannot be followed farther
  bool pass_kink() {
    CriticalCurve& curve = stretch_.curve;
    const CriticalPoint last = curve.points.back();
    end_here(curves_.name() + " = " + rounded(*stretch_.kink * curves_.scale()) +
             ", where a spring switches at the start or the case has a kink");
    if (last.dmu == 0 || ++kinks_ > most_kinks) return false;
    const auto kink = point_near(curves_, start_, on_line(last, last, *stretch_.kink), last);
    if (!kink || !is_on_piece(curves_, start_, *kink) || comes_round(*kink)) return false;
    auto next = from_kink(*kink, last);
    if (!next || !is_on_piece(curves_, start_, next->curve.points.front())) return false;
    CriticalPoint first = next->curve.points.front();
    first.s = kink->s + distance(first, *kink);
    if (close_gap(curves_, start_, events_, *kink, curve) ||
        close_gap(curves_, start_, events_, first, curve))
      return false;
    go_on(std::move(*next));
    return true;
  }

  /// Leads the curve over the bend of a law at its end, where the law's next part has the same point: on, or back where
  /// the curves of both parts lie on one side of the parameter. @returns false where it cannot be followed farther
  bool pass_bend(bool growing) {
    CriticalCurve& curve = stretch_.curve;
    const CriticalPoint bend = curve.points.back();
    end_here("the bend of a spring's law at " + curves_.name() + " = " +
             rounded(bend.mu * curves_.scale()));
    const bool grows = bend.dmu != 0 ? bend.dmu > 0 : growing;
    if (++bends_ > most_bends || comes_round(bend)) return false;
    const auto bent_before = laws_.bend_of_branch(moved_to(start_, bend));
    if (!laws_.cross_at(bend)) return false;
    const auto bent_behind =
        bent_before ? laws_.bend_of_branch(moved_to(start_, bend)) : std::nullopt;
    for (const bool way : {grows, !grows}) {
      auto next = going_on(bend, way);
      const bool stays = !next || (next->bends && next->curve.points.size() < 2);
      if (stays) continue;
      const double rise = next->curve.points.front().dlambda;
      if (way != grows)
        curve.hits.push_back({.kind = continuation::turn_of(start_.kind), .point = bend});
      else if (rise * bend.dlambda < 0)
        curve.hits.push_back({.kind = continuation::Degeneracy::extremum, .point = bend});
      if (bent_behind && *bent_before * *bent_behind < 0)
        curve.hits.push_back({.kind = continuation::Degeneracy::bends_other_way, .point = bend});
      go_on(std::move(*next));
      return true;
    }
    return false;
  }

  void go_on(Stretch next) {
    append(std::move(next.curve), stretch_.curve);
    stretch_.kink = next.kink;
    stretch_.bends = next.bends;
  }

  /// Has the curve passed this point before, in the same sense? It ends at its start then.
  bool comes_round(const CriticalPoint& point) {
    // The curve has to have been elsewhere, farther than the widest gap that a kink is passed by, to both sides.
    constexpr double elsewhere = 32 * beside_kink;
    const auto is_here = [&](const CriticalPoint& other) {
      return other.dmu * point.dmu > 0 && distance(other, point) <= continuation::told_apart &&
             point.s - other.s > elsewhere;
    };
    if (std::any_of(passed_.begin(), passed_.end(), is_here)) {
      end_at_start(std::max(passed_.front().s, elsewhere), stretch_.curve);
      return true;
    }
    passed_.push_back(point);
    return false;
  }

  /// From the kink on, with its first point; nothing if the curve cannot be followed from there.
  std::optional<Stretch> from_kink(const CriticalPoint& kink, const CriticalPoint& last) {
    constexpr double wider[] = {1, 4, 16};
    for (const double times : wider) {
      const double gap = std::max(std::abs(kink.mu - last.mu), beside_kink) * times;
      const auto first = point_near(
          curves_, start_, on_line(kink, last, kink.mu + std::copysign(gap, last.dmu)), kink);
      if (!first) continue;
      laws_.hold_at(*first);
      if (auto next = going_on(*first, last.dmu > 0)) return next;
    }
    return std::nullopt;
  }

  std::optional<Stretch> going_on(const CriticalPoint& first, bool growing) const {
    Stretch next = from_place(moved_to(start_, first), growing, curves_.start_enters_equations());
    return has_left(next) ? std::optional(std::move(next)) : std::nullopt;
  }

  bool differ(double a, double b) const {
    return switched_between(sides_at(curves_, a), sides_at(curves_, b)).has_value();
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
      std::vector<CriticalEvent> events = all_events();
      events.push_back({.name = "kink",
                        .value = [=](const CriticalPoint& p) { return sense * (p.mu - end); },
                        .action = continuation::EventAction::stop,
                        .of_place = true,
                        .tag = own_tag});
      CriticalCurve rest = follow_critical(laws_.family(), moved_to(start_, last), sense > 0,
                                           events, options_, observer_, further_);
      const bool reached = !rest.hits.empty() && rest.hits.back().tag == own_tag;
      if (reached) {
        rest.points.push_back(rest.hits.back().point);
        rest.hits.pop_back();
      }
      append(std::move(rest), curve);
      if (!reached) {
        if (curve.stop == continuation::StopReason::step_too_small)
          stretch.kink = kink_near_end(curve);
        else
          take_bend(stretch);
        return;
      }
    }
    stretch.kink = place->first;
  }

  const CaseCurves& curves_;
  ContinuedLaws laws_;
  const CriticalStart& start_;
  const std::vector<CriticalEvent>& events_;
  const continuation::TraceOptions& options_;
  const Observer& observer_;
  const continuation::FurtherPoints& further_;
  Stretch stretch_{};                    ///< what has been followed
  std::vector<CriticalPoint> passed_{};  ///< kinks and bends
  int kinks_ = 0, bends_ = 0;
};

}  // namespace

std::optional<std::pair<double, std::string>> switching_start(const CaseCurves& curves, double mu,
                                                              double beyond) {
  const StartSides here = sides_at(curves, mu);
  auto differs = switched_between(here, sides_at(curves, beyond));
  if (!differs) return std::nullopt;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = mu + 0.5 * (beyond - mu);
    const StartSides sides = sides_at(curves, middle);
    if (sides.piece.size() != here.piece.size()) return std::nullopt;
    if (const auto one = switched_between(here, sides)) {
      beyond = middle;
      differs = one;
    } else {
      mu = middle;
    }
  }
  return std::pair{beyond, curves.base().problem->switch_name(*differs)};
}

CriticalCurve follow_over_kinks(const CaseCurves& curves, const CriticalStart& start, bool growing,
                                const std::vector<CriticalEvent>& events,
                                const continuation::TraceOptions& options,
                                const std::function<bool(const CriticalPoint&)>& observer,
                                const continuation::FurtherPoints& further) {
  return Follower(curves, start, events, options, observer, further).follow(growing);
}

}  // namespace springfold::analysis
