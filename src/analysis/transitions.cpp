#include "transitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branch_rows.hpp"
#include "descent.hpp"
#include "fall.hpp"
#include "frozen.hpp"
#include "limits.hpp"
#include "number_text.hpp"
#include "snap_jumps.hpp"
#include "springfold/core/decompositions.hpp"
#include "stable_stretch.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using continuation::DiagramStart;
using Kind = QuantityDefinition::Kind;

/// A step of lambda beyond a point where stability is handed over. What takes it over has an amplitude of about its
/// root there, and a stiffness of about its size: far above those of what counts as critical, and near the point.
constexpr double beyond = 1e-4;
/// States of one lambda that are farther apart than this are different before they are polished.
constexpr double far_apart = 0.1;

class Explorer {
 public:
  Explorer(const Tracing& t, const Scales& scales, const SnapSettings& settings,
           StudyResult& result, SnapReport& report)
      : t_{t},
        scales_{scales},
        settings_{settings},
        result_{result},
        report_{report},
        lambda_{column_of(Kind::lambda, t.quantities)},
        index_{column_of(Kind::index, t.quantities)},
        size_{t.problem.layout().size} {}

  void explore(const CurvePoint& start) {
    TransitionReport& found = report_.transitions.emplace();
    if (!start.negative || *start.negative != t_.problem.closures()) {
      report_.refusals.push_back(
          "the start is not stable: the states are looked for from a stable one on");
      return;
    }
    follow({start.x, start.lambda, start.piece});
    write_branches();
    for (const double lambda : settings_.transitions->search_at) search(lambda / t_.lambda_scale);
    for (std::size_t done = 0; done < stretches_.size();) {
      const std::size_t from = done;
      done = stretches_.size();
      write_branches();
      leave(from, done);
      found.limit_reached = is_full();
    }
    if (found.limit_reached) doubt("as many stable states as allowed were found");
    write_branches();
    describe(found);
    connect(found);
    judge_transitions(found);
    for (const double lambda : settings_.transitions->barriers_at)
      find_barriers(lambda / t_.lambda_scale, found);
  }

 private:
  bool is_full() const { return std::ssize(stretches_) >= settings_.transitions->maximum; }

  void doubt(const std::string& why) { result_.doubts.push_back(why); }

  void follow(const DiagramStart& from) {
    if (is_full()) return;
    auto stretch = trace_stable(t_, from);
    if (!stretch) return doubt("a stable state was found from which no single branch leads on");
    stretches_.push_back(std::move(*stretch));
  }

  void write_branches() {
    if (result_.branches.size() == stretches_.size()) return;
    std::vector<BranchRows> rows;
    for (const StableStretch& s : stretches_) rows.push_back(s.rows);
    label_events(rows, 0, t_.quantities);
    result_.branches.clear();
    for (BranchRows& r : rows) result_.branches.push_back(std::move(r.branch));
    losses_ = losses_of(result_, t_.quantities);
  }

  /// The number (from 1) of the stretch on which a state lies; 0: on none.
  int stretch_of(const Frozen& frozen, const Vector& x) const {
    for (std::size_t b = 0; b < result_.branches.size(); ++b)
      if (const auto near = near_on(frozen, b); near && is_near(frozen, *near, x)) {
        const auto state = rest_near(frozen.landscape(), *near);
        if (state && frozen.landscape().same(state->x, x)) return static_cast<int>(b) + 1;
      }
    return 0;
  }

  /// The stretch's state at this lambda, between its rows.
  std::optional<Vector> near_on(const Frozen& frozen, std::size_t branch) const {
    const auto& samples = result_.branches[branch].samples;
    for (std::size_t r = 0; r + 1 < samples.size(); ++r) {
      if (samples[r].values[index_] > 0 && samples[r + 1].values[index_] > 0) continue;
      const double from = samples[r].values[lambda_] / t_.lambda_scale - frozen.lambda();
      const double to = samples[r + 1].values[lambda_] / t_.lambda_scale - frozen.lambda();
      if (from * to > 0 || from >= to) continue;
      const Vector p = unknowns_in(samples[r].values, t_.quantities, size_);
      const Vector q = unknowns_in(samples[r + 1].values, t_.quantities, size_);
      return frozen.reduced(p + from / (from - to) * (q - p));
    }
    return std::nullopt;
  }

  static bool is_near(const Frozen& frozen, const Vector& a, const Vector& b) {
    const Landscape& landscape = frozen.landscape();
    for (const Index i : landscape.moving()) {
      const double d = a[i] - b[i], period = landscape.periods()[i];
      if (std::abs(period > 0 ? std::remainder(d, period) : d) > far_apart) return false;
    }
    return true;
  }

  /// Follows a stable state, if it lies on no stretch that is known and within the study's limits.
  void follow_state(const Frozen& frozen, const RestState& state) {
    if (stretch_of(frozen, state.x) > 0) return;
    CurvePoint point;
    point.x = t_.problem.reduce(frozen.unknowns(state.x));
    point.lambda = frozen.lambda();
    point.piece = state.piece;
    if (limit_passed(t_.study, t_.evaluator, t_.quantities, point)) return;
    follow({point.x, point.lambda, point.piece});
    write_branches();
  }

  StateBook book_at(const Frozen& frozen) const {
    StateBook book(frozen.landscape());
    for (std::size_t b = 0; b < result_.branches.size(); ++b)
      if (const auto near = near_on(frozen, b))
        if (const auto state = rest_near(frozen.landscape(), *near)) book.add(*state);
    return book;
  }

  StateSearch search_settings() const {
    return {.starts = settings_.transitions->starts,
            .seed = settings_.seed,
            .modes = std::numeric_limits<int>::max(),
            .maximum = std::numeric_limits<int>::max() / 2};
  }

  void search(double lambda) {
    const Frozen frozen(t_.problem, scales_, lambda, settings_.damping);
    StateBook book = book_at(frozen);
    book.search(search_settings());
    for (const RestState& state : book.states())
      if (is_minimum(state)) follow_state(frozen, state);
  }

  /// Jumps and handovers from the ends of the stretches from .. to - 1.
  void leave(std::size_t from, std::size_t to) {
    std::vector<Loss> losses;
    for (const Loss& loss : losses_)
      if (loss.branch >= from && loss.branch < to) losses.push_back(loss);
    SnapFindings findings{.report = std::move(report_), .untraced = {}, .doubts = {}};
    const std::size_t first = findings.report.jumps.size();
    const StudyResult traced = result_;
    find_jumps_from(losses, t_, scales_, settings_, traced, findings);
    report_ = std::move(findings.report);
    result_.doubts.insert(result_.doubts.end(), findings.doubts.begin(), findings.doubts.end());
    for (std::size_t j = first; j < report_.jumps.size(); ++j) {
      for (const SnapState* landing : landings_of(report_.jumps[j])) {
        const Frozen frozen(t_.problem, scales_,
                            report_.jumps[j].critical.values[lambda_] / t_.lambda_scale,
                            settings_.damping);
        if (const auto state =
                rest_near(frozen.landscape(),
                          frozen.reduced(unknowns_in(landing->values, t_.quantities, size_))))
          follow_state(frozen, *state);
      }
    }
    for (std::size_t b = from; b < to; ++b)
      for (const int direction : {1, -1})
        if (ends(b, direction) && !has_jump(b, direction))
          for (const RestState& state : taking_over(b, direction)) {
            const Frozen frozen(t_.problem, scales_, end_of(b, direction) + direction * beyond,
                                settings_.damping);
            follow_state(frozen, state);
          }
  }

  static std::vector<const SnapState*> landings_of(const Jump& jump) {
    std::vector<const SnapState*> list;
    if (!jump.landing.values.empty()) list.push_back(&jump.landing);
    for (const SnapState& other : jump.others) list.push_back(&other);
    return list;
  }

  bool ends(std::size_t b, int direction) const {
    return direction > 0 ? stretches_[b].ends_high : stretches_[b].ends_low;
  }
  bool has_jump(std::size_t b, int direction) const {
    return std::any_of(report_.jumps.begin(), report_.jumps.end(), [&](const Jump& jump) {
      return jump.branch == static_cast<int>(b) + 1 && jump.loading == direction;
    });
  }
  /// Dimensionless lambda at an end.
  double end_of(std::size_t b, int direction) const {
    return result_.branches[b].samples[end_row(b, direction)].values[lambda_] / t_.lambda_scale;
  }
  /// Where stability is lost; where it is not, the row of the largest or smallest lambda.
  std::size_t end_row(std::size_t b, int direction) const {
    for (const Loss& loss : losses_)
      if (loss.branch == b && loss.loading == direction)
        return result_.branches[b].events[loss.event].row;
    const auto& samples = result_.branches[b].samples;
    std::size_t row = 0;
    for (std::size_t r = 0; r < samples.size(); ++r)
      if ((samples[r].values[lambda_] - samples[row].values[lambda_]) * direction > 0) row = r;
    return row;
  }

  /// Minima beside the end of a stretch, a little beyond it: along its softest mode, both ways.
  std::vector<RestState> taking_over(std::size_t b, int direction) const {
    std::vector<RestState> list;
    const Frozen frozen(t_.problem, scales_, end_of(b, direction) + direction * beyond,
                        settings_.damping);
    const Landscape& landscape = frozen.landscape();
    Vector x = frozen.reduced(unknowns_in(result_.branches[b].samples[end_row(b, direction)].values,
                                          t_.quantities, size_));
    const auto at = landscape.close(x) ? landscape.ground(x) : std::nullopt;
    if (!at || at->hessian.size() == 0) return list;
    const Vector mode = symmetric_eigen(at->hessian).vectors.col(0);
    for (const double side : {1.0, -1.0}) {
      const auto pushed = landscape.moved(*at, side * push_size * mode);
      const Descent down = pushed ? descend(landscape, *pushed) : Descent{};
      if (down.end != Descent::End::rest || !is_minimum(down.state)) continue;
      const bool known = std::any_of(list.begin(), list.end(), [&](const RestState& other) {
        return landscape.same(other.x, down.state.x);
      });
      if (!known) list.push_back(down.state);
    }
    return list;
  }

  void describe(TransitionReport& found) const {
    for (std::size_t b = 0; b < result_.branches.size(); ++b) {
      const Branch& branch = result_.branches[b];
      const Sample& start = branch.samples[branch.start_row];
      StableState state{.label = "S" + std::to_string(b + 1), .branch = static_cast<int>(b) + 1};
      state.low = t_.lambda_scale * end_of(b, -1);
      state.high = t_.lambda_scale * end_of(b, 1);
      state.low_is_limit = !stretches_[b].ends_low;
      state.high_is_limit = !stretches_[b].ends_high;
      state.found = {start.values, start.piece,     std::numeric_limits<double>::quiet_NaN(), 0,
                     state.branch, branch.start_row};
      const Frozen frozen(t_.problem, scales_, start.values[lambda_] / t_.lambda_scale,
                          settings_.damping);
      state.found.energy = scales_.moment() * frozen.landscape().energy(frozen.reduced(
                                                  unknowns_in(start.values, t_.quantities, size_)));
      found.states.push_back(std::move(state));
    }
  }

  void connect(TransitionReport& found) {
    for (std::size_t b = 0; b < result_.branches.size(); ++b)
      for (const int direction : {1, -1}) {
        if (!ends(b, direction)) continue;
        const auto state = static_cast<int>(b) + 1;
        const double lambda = end_of(b, direction);
        if (!has_jump(b, direction)) {
          const Frozen frozen(t_.problem, scales_, lambda + direction * beyond, settings_.damping);
          const auto next = taking_over(b, direction);
          for (const RestState& taker : next)
            found.transitions.push_back({.from = state,
                                         .to = stretch_of(frozen, taker.x),
                                         .loading = direction,
                                         .lambda = t_.lambda_scale * lambda});
          if (next.empty())
            found.transitions.push_back(
                {.from = state, .loading = direction, .lambda = t_.lambda_scale * lambda});
          continue;
        }
        for (std::size_t j = 0; j < report_.jumps.size(); ++j)
          if (report_.jumps[j].branch == state && report_.jumps[j].loading == direction)
            connect(state, j, found);
      }
  }

  /// One transition to every state that a jump may lead to.
  void connect(int from, std::size_t number, TransitionReport& found) {
    Jump& jump = report_.jumps[number];
    const double lambda = jump.critical.values[lambda_];
    const Frozen frozen(t_.problem, scales_, lambda / t_.lambda_scale, settings_.damping);
    const auto add = [&](SnapState* landing, bool is_alternative) {
      Transition t{.from = from,
                   .loading = jump.loading,
                   .lambda = lambda,
                   .jump = static_cast<int>(number) + 1,
                   .verdict = jump.verdict,
                   .is_alternative = is_alternative};
      if (landing != nullptr) {
        t.to =
            stretch_of(frozen, frozen.reduced(unknowns_in(landing->values, t_.quantities, size_)));
        t.released = jump.critical.energy - landing->energy;
        landing->branch = t.to;
      }
      found.transitions.push_back(t);
    };
    add(jump.landing.values.empty() ? nullptr : &jump.landing, false);
    for (SnapState& other : jump.others) add(&other, true);
  }

  void find_barriers(double lambda, TransitionReport& found) {
    const Frozen frozen(t_.problem, scales_, lambda, settings_.damping);
    StateBook book = book_at(frozen);
    book.search(search_settings());
    std::vector<int> number(book.states().size(), -1);
    const auto number_of = [&](std::size_t m) {
      number.resize(book.states().size(), -1);
      if (number[m] < 0) number[m] = stretch_of(frozen, book.states()[m].x);
      return number[m];
    };
    for (std::size_t s = 0; s < book.states().size(); ++s) {
      if (!book.states()[s].is_clear)
        doubt("a state of rest at lambda = " + rounded(t_.lambda_scale * frozen.lambda()) +
              " has next to no stiffness: barriers there are not decided");
      if (book.states()[s].index != 1 || !book.states()[s].is_clear) continue;
      const WaysDown ways = book.ways_from(s);
      if (ways.minima.size() != 2) continue;
      const int a = number_of(ways.minima[0]), b = number_of(ways.minima[1]);
      if (a == 0 || b == 0) continue;
      add_barrier(frozen, book, s, ways.minima[a < b ? 0 : 1], ways.minima[a < b ? 1 : 0],
                  std::min(a, b), std::max(a, b), found);
    }
  }

  void add_barrier(const Frozen& frozen, const StateBook& book, std::size_t saddle,
                   std::size_t first, std::size_t second, int a, int b, TransitionReport& found) {
    const auto& states = book.states();
    const double unit = scales_.moment();
    Barrier barrier{.lambda = t_.lambda_scale * frozen.lambda(),
                    .first = a,
                    .second = b,
                    .from_first = unit * (states[saddle].energy - states[first].energy),
                    .from_second = unit * (states[saddle].energy - states[second].energy)};
    const auto same =
        std::find_if(found.barriers.begin(), found.barriers.end(), [&](const Barrier& other) {
          return other.lambda == barrier.lambda && other.first == a && other.second == b;
        });
    if (same != found.barriers.end() && same->from_first <= barrier.from_first) return;
    CurvePoint point;
    point.x = t_.problem.reduce(frozen.unknowns(states[saddle].x));
    point.lambda = frozen.lambda();
    point.piece = states[saddle].piece;
    count_negative(t_.problem, point);
    Branch single = single_point(point, t_.evaluator, t_.quantities, t_.problem);
    barrier.saddle = {std::move(single.samples.front().values),
                      single.samples.front().piece,
                      unit * states[saddle].energy,
                      1,
                      0,
                      0};
    if (same != found.barriers.end())
      *same = std::move(barrier);
    else
      found.barriers.push_back(std::move(barrier));
  }

  const Tracing& t_;
  const Scales& scales_;
  const SnapSettings& settings_;
  StudyResult& result_;
  SnapReport& report_;
  std::size_t lambda_, index_;
  Index size_;
  std::vector<StableStretch> stretches_{};
  std::vector<Loss> losses_{};  ///< of all stretches
};

}  // namespace

void find_transitions(const Tracing& tracing, const Scales& scales, const CurvePoint& start,
                      const SnapSettings& settings, StudyResult& result, SnapReport& report) {
  Explorer(tracing, scales, settings, result, report).explore(start);
}

}  // namespace springfold::analysis
