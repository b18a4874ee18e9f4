// The study kind `threshold`: from which value of a parameter on does nothing unwanted happen?
#include <algorithm>
#include <cmath>
#include <utility>

#include "beside_answer.hpp"
#include "branch_rows.hpp"
#include "critical_kinks.hpp"
#include "critical_rows.hpp"
#include "critical_runs.hpp"
#include "critical_starts.hpp"
#include "cut_curve.hpp"
#include "first_unwanted.hpp"
#include "limits.hpp"
#include "load_pieces.hpp"
#include "path_parting.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalHit;
using continuation::CriticalPoint;

/// What lies as near on the curve, in parts of the range, decides.
constexpr double at_degeneracy = 1e-5;
/// The end of the range is located as well as this, in parts of it.
constexpr double at_limit = 1e-9;
/// Pieces of the boundary that are followed one after the other.
constexpr int most_boundary_pieces = 40;

std::string at_start_of_path(EventKind kind) {
  const bool turns = kind == EventKind::limit_point || kind == EventKind::corner_limit_point;
  return std::string{"the "} + (turns ? "limit" : "unwanted") +
         " point reaches the start of the path";
}

class Threshold {
 public:
  Threshold(const CaseCurves& curves, const Study& study, const Observer& observer,
            StudyResult& result)
      : curves_{curves},
        study_{study},
        observer_{observer},
        result_{result},
        report_{result.threshold.emplace()},
        towards_{study.critical.smallest ? 1.0 : -1.0} {}

  void run() {
    const CriticalPointSettings& s = study_.critical;
    const double begin = (s.smallest ? s.low : s.high) / curves_.scale();
    const double end = (s.smallest ? s.high : s.low) / curves_.scale();
    double mu = begin;
    bool any = false;
    for (int piece = 0; piece < most_boundary_pieces; ++piece) {
      if (any && lacks_start(mu)) return found(last_, true);
      if (towards_ * (mu - end) > 0) return is_clear_ ? found(last_, true) : none("");
      const auto bad = unwanted_at(mu);
      if (!why_.empty()) return doubt(mu);
      if (!bad) return found(any ? last_ : begin, any);
      is_alone_ = stands_alone(curves_, *curves_.at(mu), *bad);
      if (is_alone_)
        stand(*bad, mu);
      else if (!follow(*bad, mu))
        return;
      any = true;
      mu = beyond(last_, nearest_beside);
      // What ends beside where it began is taken up again a little farther on.
    }
    why_ = "the boundary has more pieces than are followed";
    doubt(mu);
  }

 private:
  /// Of the range.
  double width() const {
    return std::abs(study_.critical.high - study_.critical.low) / curves_.scale();
  }

  /// The first unwanted point on the path from the start at this value.
  std::optional<SpecialPoint> unwanted_at(double mu) {
    FirstUnwanted first = first_unwanted(curves_, mu, study_.critical, observer_);
    if (first.point)
      why_.clear();
    else if (!first.why.empty())
      why_ = first.why;
    return first.point;
  }

  /// So far beyond a value, relative to it, in the direction in which the answer is looked for.
  double beyond(double mu, double distance) const { return beyond_value(mu, towards_, distance); }

  /// Where an unwanted limit point has reached the start, the start is one: beyond there may be none.
  bool lacks_start(double mu) const { return at_start_ && curves_.at(mu) == nullptr; }

  /// Does the start vanish there? Another point of the path may have the start's load, too.
  bool loses_start(double mu) const {
    const Member* before = curves_.at(beyond(mu, -nearest_beside));
    const int sheet = before != nullptr ? before->sheet : 0;
    const Member* behind = curves_.at(beyond(mu, nearest_beside));
    return before != nullptr && (behind == nullptr || behind->sheet != sheet);
  }

  /// An unwanted point that no value beside has: behind it others may come.
  void stand(const SpecialPoint& bad, double mu) {
    last_ = mu;
    decides_ = bad.label + " stands at this value alone";
    result_.branches.push_back(row_alone(curves_, *curves_.at(mu), bad));
  }

  /// Follows an unwanted point to where it is gone. @returns false where the search is over
  bool follow(const SpecialPoint& bad, double mu) {
    std::string why;
    const Member& member = *curves_.at(mu);
    const auto start = critical_start(curves_, member, bad, why);
    if (!start) {
      why_ = why;
      doubt(mu);
      return false;
    }
    // Beyond its end the piece runs back: a little of it shows what it is.
    constexpr int more = 10;
    int back = 0;
    const auto observe = [&](const CriticalPoint& p) {
      back += towards_ * p.dmu < 0 ? 1 : 0;
      return back < more && (!observer_ || observer_(0, p.s));
    };
    Study limits = base_study(study_);
    std::erase_if(limits.marks, [](const Mark&) { return true; });
    const auto events = first_point_events(curves_, limits, start->piece);
    FollowedCurve followed{.start = *start, .of = bad.kind};
    CriticalCurve& curve = followed.growing;
    curve =
        follow_over_kinks(curves_, *start, towards_ > 0, events, critical_options(study_), observe);
    say_why_it_stops(curves_, towards_ > 0, curve);
    say_start_or_its_load(curves_, curve);
    const auto end = std::find_if(curve.hits.begin(), curve.hits.end(),
                                  [](const CriticalHit& hit) { return ends_piece(hit.kind); });
    const bool left = end == curve.hits.end() && curve.stop == continuation::StopReason::event;
    if (curve.points.empty() || (end == curve.hits.end() && !left)) {
      why_ = "the piece of " + bad.label + " could not be followed: " + curve.stop_detail;
      doubt(mu);
      return false;
    }
    if (curve.stop == continuation::StopReason::observer)
      curve.stop = continuation::StopReason::event;
    const double limit =
        (towards_ > 0 ? study_.critical.high : study_.critical.low) / curves_.scale();
    const bool at_range = end == curve.hits.end() &&
                          std::abs(curve.hits.back().point.mu - limit) <= at_limit * width();
    CriticalPoint last = end == curve.hits.end() ? curve.hits.back().point : end->point;
    decides_ =
        end == curve.hits.end() ? curve.stop_detail : name_of_degeneracy(end->kind, bad.kind);
    if (end != curve.hits.end() && !end->name.empty()) decides_ += ": " + end->name;
    const bool at_its_load = end == curve.hits.end() && ends_at_start_of_path(curve);
    at_start_ = at_its_load && loses_start(last.mu);
    if (at_start_) decides_ = at_start_of_path(bad.kind);
    const Parting parting = parting_of({.from = mu,
                                        .to = last.mu,
                                        .at_end = at_range || (at_its_load && !at_start_),
                                        .at_range = at_range,
                                        .start = &followed.start,
                                        .curve = &curve,
                                        .width = width()});
    is_clear_ = parting.clear.has_value();
    at_start_ = at_start_ && !is_clear_ && !parting.another;
    if (is_clear_) end_where_clear(*parting.clear, parting.at_other_start, followed, last);
    if (parting.another) end_at(*parting.another, another_is_first, followed, last);
    followed.falling.points = {curve.points.front()};
    followed.falling.stop = continuation::StopReason::event;
    followed.falling.stop_detail = "begins at " + bad.label;
    result_.branches.push_back(rows_of(curves_, followed));
    last_ = last.mu;
    ended_on_ = bad;
    const bool goes_on = !at_range || is_clear_ || parting.another;
    if (parting.unknown_from) {
      why_ = parting.why;
      doubt(*parting.unknown_from);
    } else if (!goes_on) {
      none(bad.label);
    }
    return goes_on;
  }

  /// The path may part from the point that is followed.
  Parting parting_of(const FollowedPiece& piece) {
    const Parting parting = parting_on(piece, curves_, study_.critical, observer_);
    if (parting.clear && !parting.is_bracketed)
      result_.doubts.push_back("between " + study_.critical.parameter + " = " +
                               rounded(parting.bad * curves_.scale()) + " and " +
                               rounded(*parting.clear * curves_.scale()) +
                               " the path from the start no longer comes to it, but where is not "
                               "known: starts there do not belong to each other");
    return parting;
  }

  /// The point of a curve whose parameter comes nearest to a value before it.
  CriticalPoint nearest_before(const CriticalCurve& curve, double mu) const {
    CriticalPoint nearest = curve.points.front();
    const auto see = [&](const CriticalPoint& p) {
      if (towards_ * (mu - p.mu) >= 0 && std::abs(p.mu - mu) < std::abs(nearest.mu - mu))
        nearest = p;
    };
    for (const CriticalPoint& p : curve.points) see(p);
    for (const CriticalHit& hit : curve.hits) see(hit.point);
    return nearest;
  }

  /// @param last  becomes the curve's last point
  void end_where_clear(double clear, bool at_other_start, FollowedCurve& followed,
                       CriticalPoint& last) {
    const CriticalCurve& curve = followed.growing;
    const auto near = std::find_if(curve.hits.begin(), curve.hits.end(), [&](const auto& hit) {
      return hit.kind != continuation::Degeneracy::user &&
             hit.kind != continuation::Degeneracy::extremum &&
             std::abs(hit.point.mu - clear) <= at_degeneracy * width();
    });
    const std::string why =
        near != curve.hits.end() ? name_of_degeneracy(near->kind, followed.of)
        : at_other_start
            ? "the start vanishes there, and the path from another one does not come to it"
            : "the path from the start no longer comes to it" +
                  why_path_misses(curves_, clear, clear, {}, study_.critical, observer_);
    end_at(clear, why, followed, last);
  }

  void end_at(double mu, const std::string& why, FollowedCurve& followed, CriticalPoint& last) {
    decides_ = why;
    // Where branches cross the point is singular: the nearest one that is known stands for it.
    last = point_of_curve(curves_, followed.start, followed.growing, mu, 0)
               .value_or(nearest_before(followed.growing, mu));
    last.mu = mu;
    end_curve_at(last, decides_, followed.growing);
  }

  void none(const std::string& piece) {
    report_.found = false;
    report_.decides = piece.empty() ? decides_ : "the piece of " + piece;
    report_.message = "no value of " + study_.critical.parameter +
                      " within the range removes it: " + report_.decides +
                      " is still there at the end";
    label_critical(result_.branches);
  }

  void doubt(double mu) {
    const std::string what =
        "at " + study_.critical.parameter + " = " + rounded(mu * curves_.scale()) + ": " + why_;
    report_.message = "unresolved " + what;
    result_.doubts.push_back(what);
    label_critical(result_.branches);
  }

  /// Pieces of a boundary differ by which springs act at the start, too: segments as in the column `piece`.
  std::string springs_at_start(double mu) const {
    const Member* member = curves_.at(mu);
    if (member == nullptr || member->first.piece.empty()) return "";
    return ", springs at the start " + piece_text(member->setup.system, member->first.piece);
  }

  /// Does nothing unwanted happen at this relative distance on the good side of an answer? Nothing: it is not known.
  std::optional<bool> is_clear_at(double mu, double inwards) {
    why_.clear();
    const double value = beyond(mu, inwards);
    if (inwards > 0 && lacks_start(value)) return true;
    if (unwanted_at(value)) return false;
    return why_.empty() ? std::optional{true} : std::nullopt;
  }

  void found(double mu, bool any) {
    report_.found = true;
    report_.value = std::clamp(mu * curves_.scale(), study_.critical.low, study_.critical.high);
    report_.decides = any ? decides_ : "the range begins beyond it";
    report_.message = study_.critical.parameter + " = " + rounded(report_.value) +
                      ", decided by: " + report_.decides;
    if (any) {
      if (lacks_start(beyond(mu, nearest_beside)))
        report_.message += ", beyond which there is no start";
      const auto is_clear = [&](double inwards) {
        // Before a value that stands alone nothing unwanted happens either.
        return is_alone_ && inwards < 0 ? std::optional{false} : is_clear_at(mu, inwards);
      };
      const auto distance = confirmed_beside(is_clear);
      report_.verified = distance.has_value();
      if (distance) report_.message += words_of_distance(*distance);
      if (!report_.verified)
        result_.doubts.push_back("traced again beside " + study_.critical.parameter + " = " +
                                 rounded(report_.value) + ", the path does not confirm it");
      mark();
    }
    label_critical(result_.branches);
  }

  /// The deciding row of the last piece carries the answer.
  void mark() {
    Branch& branch = result_.branches.back();
    for (std::size_t i = 0; i < branch.events.size(); ++i) {
      const Event& event = branch.events[i];
      if (std::abs(branch.samples[event.row].values.back() - report_.value) >
          1e-12 * std::max(1.0, std::abs(report_.value)))
        continue;
      if (event.kind == EventKind::extremum) continue;
      Event answer = event;
      answer.kind = EventKind::threshold;
      answer.detail = report_.decides + springs_at_start(report_.value / curves_.scale());
      branch.events.insert(branch.events.begin() + static_cast<std::ptrdiff_t>(i + 1), answer);
      return;
    }
  }

  const CaseCurves& curves_;
  const Study& study_;
  const Observer& observer_;
  StudyResult& result_;
  ThresholdReport& report_;
  double towards_ = 1;
  double last_ = 0;        ///< where the last piece ended
  bool is_alone_ = false;  ///< it is a value, not a piece
  bool is_clear_ = false;  ///< there the path no longer came to its point
  bool at_start_ = false;  ///< its point is the start there
  std::string decides_{}, why_{};
  std::optional<SpecialPoint> ended_on_{};
};

}  // namespace

void run_threshold(const CaseCurves& curves, const Study& study, const Observer& observer,
                   StudyResult& result) {
  Threshold(curves, study, observer, result).run();
}

}  // namespace springfold::analysis
