#include "transitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "barriers.hpp"
#include "degenerate_state.hpp"
#include "limits.hpp"
#include "springfold/core/number_text.hpp"
#include "stretches.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

class Explorer {
 public:
  Explorer(const Tracing& t, const Scales& scales, const SnapSettings& settings,
           StudyResult& result, SnapReport& report)
      : t_{t},
        scales_{scales},
        settings_{settings},
        result_{result},
        report_{report},
        stretches_{t, scales, settings, result},
        size_{t.problem.layout().size} {}

  void explore(const CurvePoint& start) {
    TransitionReport& found = report_.transitions.emplace();
    const bool is_untold = is_index_untold(t_.evaluator, start);
    if (is_untold || !is_stable(t_, start)) {
      report_.refusals.push_back(
          is_untold ? "the start is a limit or branch point within rounding: the states are looked "
                      "for from a stable one on, try a start beside it"
                    : "the start is not stable: the states are looked for from a stable one on");
      return;
    }
    stretches_.follow({start.x, start.lambda, start.piece});
    stretches_.write_branches();
    if (limit_passed(t_.study, t_.evaluator, t_.quantities, start)) {
      report_.transitions.reset();
      report_.refusals.push_back(
          "the start lies outside of the study's range: no state is followed from there");
      return;
    }
    follow_jumps();
    for (const double lambda : searched()) search(lambda / t_.lambda_scale);
    found.limit_reached = stretches_.is_full();
    if (found.limit_reached)
      result_.doubts.push_back("as many stable states as allowed were found");
    stretches_.write_branches();
    describe(found);
    connect(found);
    judge_transitions(found);
    for (const double lambda : settings_.transitions->barriers_at)
      if (goes_on()) {
        Searched& at = searched_at(lambda / t_.lambda_scale);
        find_barriers(stretches_, t_, scales_, at.frozen, at.book, result_, found);
      }
    if (!goes_on() && t_.crawl.factor() == 1)
      result_.doubts.push_back("interrupted: states and transitions are missing");
  }

 private:
  /// Neither interrupted nor to be begun again in another unit of lambda.
  bool goes_on() const {
    return t_.crawl.factor() == 1 && (!t_.observer || t_.observer(stretches_.count(), 0));
  }

  /// Where barriers are looked for, all states between them have to be known.
  std::vector<double> searched() const {
    std::vector<double> list = settings_.transitions->search_at;
    for (const double lambda : settings_.transitions->barriers_at)
      if (std::find(list.begin(), list.end(), lambda) == list.end()) list.push_back(lambda);
    return list;
  }

  /// Until no stretch is new.
  void follow_jumps() {
    while (done_ < stretches_.count() && goes_on()) {
      const int from = done_;
      done_ = stretches_.count();
      stretches_.write_branches();
      leave(from + 1, done_);
    }
  }

  /// Until all states of this lambda to which jumps lead are among those that the search began with or found.
  void search(double lambda) {
    Searched& at = searched_at(lambda);
    const auto is_within = [&](const RestState& state) {
      return stretches_.is_within(at.frozen, state);
    };
    std::size_t known = 0;
    SearchEnd end;
    do {
      end = search_all(at.book, settings_, is_within);
      for (const RestState& state : at.book.states())
        if (is_minimum(state) && goes_on()) stretches_.follow_new(at.frozen, state);
      take_known(at);
      known = at.book.states().size();
      follow_jumps();
      take_known(at);
    } while (at.book.states().size() > known && goes_on());
    tell(end, lambda);
  }

  void tell(const SearchEnd& end, double lambda) {
    const std::string place = "at lambda = " + rounded(t_.lambda_scale * lambda) + ": ";
    if (end.is_full)
      result_.doubts.push_back(place + "the search ended at " + std::to_string(most_states) +
                               " states of rest: there are more");
    if (end.left_bounds)
      result_.doubts.push_back(place + "states of rest go on beyond " +
                               std::to_string(lengths_away) + " sizes of the mechanism or " +
                               std::to_string(turns_away) +
                               " turns, where the search ended: limits in until give it a range");
  }

  /// One lambda with all that was found there.
  struct Searched {
    Searched(const Stretches& stretches, double lambda)
        : frozen{stretches.frozen(lambda)}, book{stretches.book_at(frozen)} {}
    Frozen frozen;
    StateBook book;
  };

  Searched& searched_at(double lambda) {
    auto& at = searches_[lambda];
    if (!at) at = std::make_unique<Searched>(stretches_, lambda);
    return *at;
  }

  /// The states of all stretches.
  void take_known(Searched& at) const {
    const StateBook known = stretches_.book_at(at.frozen);
    for (const RestState& state : known.states()) at.book.add(state);
  }

  /// Jumps and handovers from the ends of the stretches from .. to.
  void leave(int from, int to) {
    const std::size_t first = report_.jumps.size();
    jump_from(from, to);
    for (std::size_t j = first; j < report_.jumps.size() && goes_on(); ++j) {
      const Frozen frozen = stretches_.frozen(lambda_of(report_.jumps[j]) / t_.lambda_scale);
      for (const SnapState* landing : landings_of(report_.jumps[j]))
        if (const auto state =
                rest_near(frozen.landscape(),
                          frozen.reduced(unknowns_in(landing->values, t_.quantities, size_))))
          stretches_.follow_new(frozen, *state);
    }
    for (int b = from; b <= to && goes_on(); ++b)
      for (const int direction : {1, -1}) {
        if (!stretches_.ends(b, direction) || has_jump(b, direction)) continue;
        const Frozen frozen =
            stretches_.frozen(stretches_.end_of(b, direction) + direction * beyond_end);
        for (const RestState& state : stretches_.taking_over(b, direction))
          stretches_.follow_new(frozen, state);
      }
  }

  void jump_from(int from, int to) {
    SnapFindings findings{.report = std::move(report_), .untraced = {}, .doubts = {}};
    const StudyResult traced = result_;
    const std::vector<Loss> losses = stretches_.losses();
    for (const Loss& loss : losses) {
      const int number = static_cast<int>(loss.branch) + 1;
      if (number >= from && number <= to && stretches_.ends(number, loss.loading) && goes_on())
        find_jumps_from({loss}, t_, scales_, settings_, traced, findings);
    }
    report_ = std::move(findings.report);
    result_.doubts.insert(result_.doubts.end(), findings.doubts.begin(), findings.doubts.end());
  }

  static std::vector<const SnapState*> landings_of(const Jump& jump) {
    std::vector<const SnapState*> list;
    if (!jump.landing.values.empty()) list.push_back(&jump.landing);
    for (const SnapState& other : jump.others) list.push_back(&other);
    return list;
  }

  double lambda_of(const Jump& jump) const {
    return jump.critical.values[column_of(QuantityDefinition::Kind::lambda, t_.quantities)];
  }

  bool has_jump(int stretch, int direction) const {
    return std::any_of(report_.jumps.begin(), report_.jumps.end(), [&](const Jump& jump) {
      return jump.branch == stretch && jump.loading == direction;
    });
  }

  /// Where a stretch reaches the study's limit of lambda, that number itself: states that end there end at one place.
  double end_of(int stretch, int direction) const {
    constexpr double located = 1e-10;
    const double end = t_.lambda_scale * stretches_.end_of(stretch, direction);
    if (stretches_.ends(stretch, direction)) return end;
    for (const Limit& limit : t_.study.until) {
      const double bound = direction > 0 ? limit.high : limit.low;
      if (limit.quantity == "lambda" &&
          std::abs(end - bound) <= located * std::max(t_.lambda_scale, std::abs(bound)))
        return bound;
    }
    return end;
  }

  void describe(TransitionReport& found) const {
    for (int b = 1; b <= stretches_.count(); ++b) {
      const Branch& branch = result_.branches[static_cast<std::size_t>(b - 1)];
      const Sample& start = branch.samples[branch.start_row];
      StableState state{.label = "S" + std::to_string(b), .branch = b};
      state.low_is_limit = !stretches_.ends(b, -1);
      state.high_is_limit = !stretches_.ends(b, 1);
      state.low = end_of(b, -1);
      state.high = end_of(b, 1);
      state.found = {start.values, start.piece,     std::numeric_limits<double>::quiet_NaN(), 0,
                     state.branch, branch.start_row};
      const double lambda =
          start.values[column_of(QuantityDefinition::Kind::lambda, t_.quantities)];
      const Frozen frozen = stretches_.frozen(lambda / t_.lambda_scale);
      state.found.energy = scales_.moment() * frozen.landscape().energy(frozen.reduced(
                                                  unknowns_in(start.values, t_.quantities, size_)));
      found.states.push_back(std::move(state));
    }
  }

  void connect(TransitionReport& found) {
    for (int b = 1; b <= stretches_.count() && goes_on(); ++b)
      for (const int direction : {1, -1}) {
        if (!stretches_.ends(b, direction)) continue;
        if (!has_jump(b, direction)) {
          hand_over(b, direction, found);
          continue;
        }
        for (std::size_t j = 0; j < report_.jumps.size(); ++j)
          if (report_.jumps[j].branch == b && report_.jumps[j].loading == direction)
            connect(b, j, found);
      }
  }

  void hand_over(int from, int direction, TransitionReport& found) const {
    const double end = stretches_.end_of(from, direction);
    const Frozen frozen = stretches_.frozen(end + direction * beyond_end);
    Transition t{.from = from, .loading = direction, .lambda = t_.lambda_scale * end};
    const auto next = stretches_.taking_over(from, direction);
    for (const RestState& taker : next) {
      t.to = stretches_.number_of(frozen, taker.x);
      found.transitions.push_back(t);
    }
    if (next.empty()) found.transitions.push_back(t);
  }

  /// One transition to every state that a jump may lead to.
  void connect(int from, std::size_t number, TransitionReport& found) {
    Jump& jump = report_.jumps[number];
    const double lambda = lambda_of(jump);
    const Frozen frozen = stretches_.frozen(lambda / t_.lambda_scale);
    const auto add = [&](SnapState* landing, bool is_alternative) {
      Transition t{.from = from,
                   .loading = jump.loading,
                   .lambda = lambda,
                   .jump = static_cast<int>(number) + 1,
                   .verdict = jump.verdict,
                   .is_alternative = is_alternative};
      if (landing != nullptr) {
        t.to = stretches_.number_of(
            frozen, frozen.reduced(unknowns_in(landing->values, t_.quantities, size_)));
        t.released = jump.critical.energy - landing->energy;
        landing->branch = t.to;
      }
      found.transitions.push_back(t);
    };
    add(jump.landing.values.empty() ? nullptr : &jump.landing, false);
    for (SnapState& other : jump.others) add(&other, true);
  }

  const Tracing& t_;
  const Scales& scales_;
  const SnapSettings& settings_;
  StudyResult& result_;
  SnapReport& report_;
  Stretches stretches_;
  Index size_;
  int done_ = 0;                                            ///< stretches whose ends were left
  std::map<double, std::unique_ptr<Searched>> searches_{};  ///< by dimensionless lambda
};

}  // namespace

void find_transitions(const Tracing& tracing, const Scales& scales, const CurvePoint& start,
                      const SnapSettings& settings, StudyResult& result, SnapReport& report) {
  Explorer(tracing, scales, settings, result, report).explore(start);
}

}  // namespace springfold::analysis
