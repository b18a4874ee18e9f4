// The study kind `critical_load`: the first critical load on the path from the start, over a parameter.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "critical_kinks.hpp"
#include "critical_rows.hpp"
#include "critical_runs.hpp"
#include "critical_starts.hpp"
#include "cut_curve.hpp"
#include "first_unwanted.hpp"
#include "load_pieces.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::CriticalStart;

/// Parts of the range: how far before its end a piece is looked at, how far behind it the next one is looked for,
/// and how closely ends are bracketed.
constexpr double before_end = 1e-7, next_piece = 1e-6, closest_bracket = 1e-11;
/// A cusp is seen on the path only some way behind it: ends as near as this to one are at it, parts of the range.
constexpr double at_degeneracy = 1e-5;
constexpr int most_pieces = 200;

class LoadsOverParameter {
 public:
  LoadsOverParameter(const CaseCurves& curves, const Study& study, const Observer& observer,
                     StudyResult& result)
      : curves_{curves},
        study_{base_study(study)},
        observer_{observer},
        result_{result},
        low_{study.critical.low / curves.scale()},
        high_{study.critical.high / curves.scale()},
        width_{high_ - low_} {
    const int n = study.critical.values;
    for (int i = 0; i < n; ++i) grid_.push_back(i + 1 == n ? high_ : low_ + width_ * i / (n - 1));
    for (const Mark& mark : study.marks) {
      const double at = mark.value / curves.scale();
      if (mark.quantity == curves.name() && low_ < at && at < high_) grid_.push_back(at);
    }
    std::ranges::sort(grid_);
  }

  void run() {
    double done = low_;
    for (const double mu : grid_) {
      if (!pieces_.empty() && mu <= done) continue;
      const FirstUnwanted& first = first_at(mu);
      std::optional<LoadPiece> piece;
      if (first.point && is_alone(mu))
        alone_.push_back(mu);
      else if (first.point)
        piece = piece_of(*first.point, mu, done, high_);
      else if (!first.why.empty())
        (first.has_start ? doubted_ : lacks_start_).add(mu * curves_.scale(), first.why);
      fill(done, piece ? piece->falling.end : mu);
      if (piece) {
        fill_back(pieces_.empty() ? done : std::max(done, pieces_.back().growing.end),
                  piece->falling.end);
        add(std::move(*piece));
      }
      if (!pieces_.empty()) done = std::max(done, pieces_.back().growing.end);
    }
    if (std::ssize(pieces_) >= most_pieces) doubt(done, "there are more pieces than are followed");
    finish();
  }

 private:
  const FirstUnwanted& first_at(double mu) {
    const auto [known, is_new] = known_.try_emplace(mu);
    if (is_new)
      known->second = first_unwanted(curves_, mu, study_.critical, [this](int, double s) {
        return !observer_ || observer_(0, s);
      });
    return known->second;
  }

  /// Of what comes first at the value. A piece is never begun at one: its neighbours come to it.
  bool is_alone(double mu) { return stands_alone(curves_, *curves_.at(mu), *first_at(mu).point); }

  void doubt(double mu, const std::string& why) { doubted_.add(mu * curves_.scale(), why); }
  /// A piece could not be followed; perhaps another one comes there.
  void failed(double mu, const std::string& why) { failed_.add(mu * curves_.scale(), why); }

  /// The piece of the point that comes first at `mu`, within [from, to]; nothing if it cannot be followed.
  std::optional<LoadPiece> piece_of(const SpecialPoint& point, double mu, double from, double to) {
    LoadPiece piece{.of = point.kind};
    std::string why;
    const auto start = critical_start(curves_, *curves_.at(mu), point, why);
    if (!start) return failed(mu, why), std::nullopt;
    piece.start = *start;
    piece.growing = mu < to ? side_of(piece, mu, to, why) : Side{};
    const double back = std::max(low_, from - at_degeneracy * width_);
    piece.falling = mu > low_ ? side_of(piece, mu, back, why) : Side{};
    if (!why.empty()) return failed(mu, point.label + ": " + why), std::nullopt;
    const auto edge = [&](int sense) {
      return curves_.name() + " " + end_of_range(curves_, sense);
    };
    if (mu >= to) piece.growing = side_without_way(piece.start, edge(1));
    if (mu <= low_) piece.falling = side_without_way(piece.start, edge(-1));
    return piece;
  }

  /// Pieces between the values of the range.
  void fill(double from, double to) {
    while (!pieces_.empty() && to - from > at_degeneracy * width_ &&
           std::ssize(pieces_) < most_pieces) {
      const double mu = from + next_piece * width_;
      const FirstUnwanted& first = first_at(mu);
      auto piece = first.point ? piece_of(*first.point, mu, from, to) : std::nullopt;
      if (!piece) return;
      const bool stands = piece->growing.stops && piece->growing.end - mu <= at_degeneracy * width_;
      from = std::max(mu, piece->growing.end);
      add(std::move(*piece));
      if (stands) return;
    }
  }

  /// The same from behind: what comes first just before a piece begins lies within no value of the range either.
  void fill_back(double from, double to) {
    std::vector<LoadPiece> found;
    while (to - from > at_degeneracy * width_ &&
           std::ssize(pieces_) + std::ssize(found) < most_pieces) {
      const double mu = to - next_piece * width_;
      const FirstUnwanted& first = first_at(mu);
      auto piece = first.point ? piece_of(*first.point, mu, from, to) : std::nullopt;
      if (!piece) break;
      const bool stands = piece->falling.stops && mu - piece->falling.end <= at_degeneracy * width_;
      to = std::min(mu, piece->falling.end);
      found.push_back(std::move(*piece));
      if (stands) break;
    }
    std::for_each(found.rbegin(), found.rend(),
                  [this](LoadPiece& piece) { add(std::move(piece)); });
  }

  void add(LoadPiece piece) {
    if (!pieces_.empty()) join(pieces_.back(), piece, pieces_.back().growing.end);
    pieces_.push_back(std::move(piece));
  }

  /// A new piece that begins at a degeneracy just before the end of the last one decides where that ends.
  void join(LoadPiece& last, LoadPiece& piece, double done) {
    Side& end = last.growing;
    Side& begin = piece.falling;
    if (begin.decides && end.jumps && std::abs(begin.end - done) <= at_degeneracy * width_) {
      cut(last.start, end, begin.end);
    } else if (!begin.decides && begin.end < done) {
      cut(piece.start, begin, done);
      begin.jumps = true;
    }
  }

  /// Follows the critical point from `mu` as far as it comes first on the path, at most to `limit`.
  Side side_of(const LoadPiece& piece, double mu, double limit, std::string& why) {
    const double sense = limit > mu ? 1 : -1;
    Study within = study_;
    (sense > 0 ? within.critical.high : within.critical.low) = limit * curves_.scale();
    (sense > 0 ? within.critical.low : within.critical.high) = -sense * HUGE_VAL;
    constexpr int more = 10;  // beyond its turn, where the curve runs back: they show what it is
    int back = 0;
    const auto observe = [&](const CriticalPoint& p) {
      back += sense * p.dmu < 0 ? 1 : 0;
      return back < more && (!observer_ || observer_(0, p.s));
    };
    Side side;
    side.curve = follow_over_kinks(curves_, piece.start, sense > 0,
                                   first_point_events(curves_, within, piece.start.piece),
                                   critical_options(study_), observe);
    say_why_it_stops(curves_, sense > 0, side.curve);
    say_start_or_its_load(curves_, side.curve);
    const auto turn = std::ranges::find_if(
        side.curve.hits, [](const CriticalHit& hit) { return ends_piece(hit.kind); });
    if (turn == side.curve.hits.end() && side.curve.stop != continuation::StopReason::event) {
      why = side.curve.stop_detail;
      if (side.curve.points.size() < 2 || !side.curve.kept) return {};
      return stopped(piece, std::move(side), mu, sense, std::exchange(why, {}));
    }
    if (turn != side.curve.hits.end()) {
      side.decides = turn->kind;
      end_at(side, piece.of, static_cast<std::size_t>(turn - side.curve.hits.begin()));
    } else {
      const double end = side.curve.hits.back().point.mu;
      // The end of the range itself, if that was reached: beyond what it was located to nothing is left of the range.
      side.end = std::abs(end - limit) <= closest_bracket * width_ ? limit : end;
      // Between values of the range a piece is followed to where the next one begins.
      if (side.end == limit && limit > low_ && limit < high_) {
        side.another_first = true;
        side.curve.stop_detail = another_is_first;
        side.curve.hits.back().name.clear();
      }
    }
    verify(piece, side, mu, sense);
    return side;
  }

  /// A side that could not be followed to an end is known as far as it came.
  Side stopped(const LoadPiece& piece, Side side, double mu, double sense, const std::string& why) {
    const CriticalPoint last = side.curve.points.back();
    failed(last.mu, std::string{"the piece of "} + code_of(piece.of) +
                        " could not be followed beyond: " + why);
    side.end = last.mu;
    side.stops = true;
    verify(piece, side, mu, sense);
    return side;
  }

  /// At the values of the range, and just before its end, the path is traced.
  void verify(const LoadPiece& piece, Side& side, double mu, double sense) {
    double good = mu;
    std::vector<double> values = grid_;
    const double near = side.end - sense * before_end * width_;
    values.push_back(near);
    std::ranges::sort(values, [sense](double a, double b) { return sense * a < sense * b; });
    for (const double value : values) {
      if (sense * (value - mu) <= 0 || sense * (value - side.end) >= 0) continue;
      const std::optional<bool> on = is_first(piece, side.curve, value);
      const std::string why = on ? first_at(value).why : why_hidden(*first_at(value).point);
      const bool is_known = on.value_or(false) || (on && why.empty());
      if (!is_known && value != near) doubt(value, why);
      if (!on || (!is_known && value != near)) continue;
      if (!*on) return end_before(piece, side, good, value);
      good = value;
    }
    // At the end of the range itself another point may come first, which no value beside has.
    if (side.end != low_ && side.end != high_) return;
    const FirstUnwanted& first = first_at(side.end);
    if (!first.point || !is_alone(side.end) ||
        is_same_load_at_ends(first.point->hit.point.lambda, load_at_end(side)))
      return;
    alone_.push_back(side.end);
    cut(piece.start, side, side.end - sense * closest_bracket * width_);
  }

  /// Does the point of the piece come first at this value? Nothing: what comes first there is unresolved and may hide
  /// it.
  std::optional<bool> is_first(const LoadPiece& piece, const CriticalCurve& curve, double mu) {
    const FirstUnwanted& first = first_at(mu);
    if (!first.point) return false;
    const auto here = point_of_curve(curves_, piece.start, curve, mu, at_degeneracy * width_);
    const bool alone = first.point->kind != piece.of && is_alone(mu);
    return here ? is_of_piece(*first.point, piece.of, alone, here->lambda) : false;
  }

  /// Does it come first just before a degeneracy of its curve between both values, and just behind not any more? Then
  /// it ends there, and no bracket has to be halved beside it, where two points of the path are hard to tell apart.
  bool ends_at_degeneracy(const LoadPiece& piece, Side& side, double good, double bad) {
    const double sense = bad > good ? 1 : -1, room = sense * at_degeneracy * width_;
    for (std::size_t i = 0; i < side.curve.hits.size(); ++i) {
      const CriticalHit& hit = side.curve.hits[i];
      const double mu = hit.point.mu;
      if (!may_decide(hit) || sense * (mu - good) <= 0 || sense * (bad - mu) <= 0) continue;
      const double before = sense * (mu - room - good) > 0 ? mu - room : good;
      const double behind = sense * (bad - mu - room) > 0 ? mu + room : bad;
      if (!is_first(piece, side.curve, before).value_or(true) ||
          is_first(piece, side.curve, behind).value_or(false))
        continue;
      side.decides = hit.kind;
      end_at(side, piece.of, i);
      return true;
    }
    return false;
  }

  /// The critical point comes first at `good` and does not at `bad`.
  void end_before(const LoadPiece& piece, Side& side, double good, double bad) {
    if (ends_at_degeneracy(piece, side, good, bad)) return;
    while (std::abs(bad - good) > closest_bracket * width_) {
      const double middle = good + 0.5 * (bad - good);
      (is_first(piece, side.curve, middle).value_or(false) ? good : bad) = middle;
      known_.erase(middle);
    }
    const auto hit = std::ranges::find_if(side.curve.hits, [&](const CriticalHit& near) {
      return may_decide(near) && std::abs(near.point.mu - good) <= at_degeneracy * width_;
    });
    if (hit != side.curve.hits.end()) {
      side.decides = hit->kind;
      return end_at(side, piece.of, static_cast<std::size_t>(hit - side.curve.hits.begin()));
    }
    side.jumps = true;
    side.decides.reset();
    side.limit = why_path_misses(curves_, bad, good, first_at(bad), study_.critical, observer_);
    cut(piece.start, side, good);
  }

  void cut(const CriticalStart& start, Side& side, double mu) const {
    const auto last = point_of_curve(curves_, start, side.curve, mu, at_degeneracy * width_);
    if (!last) return;
    end_curve_at(*last, another_is_first, side.curve);
    side.another_first = true;
    side.end = last->mu;
  }

  /// Just beside a value at which what comes first stands alone there may be pieces that end before the next value.
  /// @returns false where it is not known what comes first there
  bool look_beside(double mu) {
    for (const double side : {-1.0, 1.0}) {
      const double beside = mu + side * next_piece * width_;
      if (beside < low_ || beside > high_) continue;
      const FirstUnwanted& first = first_at(beside);
      if (!first.why.empty()) return false;
      if (!first.point || is_reached(curves_, pieces_, beside, first.point->hit.point.lambda,
                                     at_degeneracy * width_))
        continue;
      const auto [from, to] = room_beside(pieces_, beside, low_, high_);
      auto piece = piece_of(*first.point, beside, from, to);
      if (piece) insert_in_order(std::move(*piece), pieces_);
    }
    return true;
  }

  /// Values at which what comes first stands alone belong to the pieces that come to it with its load. Where all is
  /// known beside, and has another load, the value is a place of its own.
  void tell_apart() {
    std::vector<double> own;
    for (const double mu : std::set<double>(alone_.begin(), alone_.end())) {
      const SpecialPoint& point = *first_at(mu).point;
      const auto belongs = [&] {
        return is_reached(curves_, pieces_, mu, point.hit.point.lambda, at_degeneracy * width_);
      };
      if (belongs()) continue;
      const bool is_known = look_beside(mu);
      if (belongs()) continue;
      if (is_known)
        own.push_back(mu);
      else
        doubt(mu, point.label +
                      " stands alone at this value, and what comes first beside is not known");
    }
    alone_ = std::move(own);
  }

  /// Rows for values of their own, in the order of the parameter.
  void add_places() {
    for (const double mu : alone_) {
      Branch own = row_alone(curves_, *curves_.at(mu), *first_at(mu).point);
      const auto value = [](const Branch& b) { return b.samples.front().values.back(); };
      const auto behind = std::find_if(result_.branches.begin(), result_.branches.end(),
                                       [&](const Branch& b) { return value(b) >= value(own); });
      result_.branches.insert(behind, std::move(own));
    }
  }

  void finish() {
    tell_apart();
    lacks_start_.forget(
        [this](double value) { return ends_at_start(pieces_, value / curves_.scale()); });
    end_stops_where_next_begins(pieces_, at_degeneracy * width_);
    failed_.forget([this](double value) {
      return is_settled(pieces_, value / curves_.scale(), at_degeneracy * width_);
    });
    for (const DoubtedValues& doubted : {lacks_start_, doubted_, failed_})
      for (std::string& text : doubted.told(curves_.name()))
        result_.doubts.push_back(std::move(text));
    leave_out_points(pieces_, at_degeneracy * width_);
    say_what_goes_on(curves_, alone_, pieces_, at_degeneracy * width_);
    for (const LoadPiece& piece : pieces_) {
      FollowedCurve followed{piece.start, piece.of, piece.falling.curve, piece.growing.curve};
      note_passed_at_start(first_point_events(curves_, study_, piece.start.piece), followed);
      result_.branches.push_back(rows_of(curves_, followed));
    }
    say_jumps(pieces_, at_degeneracy * width_, result_.branches);
    add_places();
    label_critical(result_.branches);
  }

  const CaseCurves& curves_;
  const Study study_;
  const Observer& observer_;
  StudyResult& result_;
  double low_ = 0, high_ = 0, width_ = 1;
  std::vector<double> grid_{};  ///< of the parameter, dimensionless
  std::map<double, FirstUnwanted> known_{};
  std::vector<double> alone_{};  ///< values at which what comes first stands alone
  DoubtedValues doubted_{}, lacks_start_{}, failed_{};
  std::vector<LoadPiece> pieces_{};
};

}  // namespace

void run_critical_load(const CaseCurves& curves, const Study& study, const Observer& observer,
                       StudyResult& result) {
  LoadsOverParameter(curves, study, observer, result).run();
}

}  // namespace springfold::analysis
