#include "snap_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branch_rows.hpp"
#include "fall.hpp"
#include "flow.hpp"
#include "frozen.hpp"
#include "inertia.hpp"
#include "leg_angles.hpp"
#include "limits.hpp"
#include "load_error.hpp"
#include "springfold/analysis/event_rows.hpp"
#include "springfold/core/decompositions.hpp"
#include "start.hpp"
#include "stretch_track.hpp"
#include "switched_springs.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using Kind = QuantityDefinition::Kind;

/// States of rest of all traced branches at one lambda.
class Jumper {
 public:
  Jumper(const Tracing& t, const Scales& scales, const SnapSettings& settings,
         const StudyResult& result, SnapFindings& findings)
      : t_{t},
        scales_{scales},
        settings_{settings},
        result_{result},
        findings_{findings},
        arc_length_{column_of(Kind::arc_length, t.quantities)},
        lambda_{column_of(Kind::lambda, t.quantities)},
        size_{t.problem.layout().size} {}

  void jump(const Loss& loss) {
    const Branch& branch = result_.branches[loss.branch];
    const Event& event = branch.events[loss.event];
    const std::vector<double>& at = branch.samples[event.row].values;
    const double lambda = at[lambda_] / t_.lambda_scale;
    const Frozen frozen(t_.problem, scales_, lambda, settings_.damping);
    const Landscape& landscape = frozen.landscape();
    Vector critical = frozen.reduced(unknowns_in(at, t_.quantities, size_));
    if (!landscape.close(critical)) return doubt(event, "its closures do not hold");
    const Departures ways =
        departures(landscape, critical, pieces_beside(frozen, branch, event, critical),
                   error_of_load(t_, event, landscape, lambda));
    if (ways.is_flat)
      doubt(event, "the energy is flat there to rounding: whether it jumps is not decided");
    if (ways.list.empty()) return;
    const double energy = landscape.energy(critical);
    StateBook book(landscape);
    for (const Departure& way : ways.list) book.ways_down(way.x);
    if (!settings_.transitions) add_traced(frozen, critical, book);
    if (!settings_.transitions) book.search(search_below(energy));
    std::vector<Told> told;
    for (const Departure& way : ways.list) {
      Jump jump;
      jump.from = event.label;
      jump.branch = static_cast<int>(loss.branch) + 1;
      jump.loading = loss.loading;
      jump.side = way.side;
      jump.towards = moves_most(frozen, way.along);
      jump.critical = {
          at,       branch.samples[event.row].piece, scales_.moment() * energy, 0, jump.branch,
          event.row};
      Fall down = settings_.transitions ? fall_to_few(book, way, energy) : fall(book, way, energy);
      if (down.is_lost)
        doubt(event,
              "a way down ended at no state that is known to be stable: the verdict is open");
      settle(frozen, event, way, down, book, jump);
      told.push_back({way, std::move(down), std::move(jump)});
    }
    const Vector before = state_of(frozen, branch, loss.stable_row);
    for (Told& one : one_of_each(landscape, critical, std::move(told))) {
      Jump& jump = one.jump;
      jump.label = "J" + std::to_string(findings_.report.jumps.size() + 1);
      write(frozen, before, one.down, book, jump);
      if (settings_.inertia)
        move_with_masses(frozen, event, critical, one.way, one.down, book, jump);
      findings_.report.jumps.push_back(std::move(jump));
    }
  }

 private:
  /// A departure and where it leads.
  struct Told {
    Departure way{};
    Fall down{};
    Jump jump{};
  };

  /// Ways down that lead to the same and begin in one part of {Pi < Pi(critical)} are one jump, by whatever pieces and
  /// modes they were found: the first of them stays.
  static std::vector<Told> one_of_each(const Landscape& landscape, const Vector& critical,
                                       std::vector<Told> told) {
    std::vector<std::size_t> group(told.size());
    for (std::size_t i = 0; i < told.size(); ++i) {
      group[i] = i;
      for (std::size_t k = 0; k < i; ++k) {
        if (group[k] == group[i] || !lead_to_the_same(told[k].down, told[i].down) ||
            !are_one_way(landscape, critical, told[k].way, told[i].way))
          continue;
        const std::size_t from = std::max(group[k], group[i]), to = std::min(group[k], group[i]);
        std::replace(group.begin(), group.end(), from, to);
      }
    }
    std::vector<Told> first;
    for (std::size_t i = 0; i < told.size(); ++i)
      if (group[i] == i) first.push_back(std::move(told[i]));
    return first;
  }

  StateSearch search_below(double energy) const {
    return {.starts = settings_.starts,
            .seed = settings_.seed,
            .drives = StateSearch{}.modes,
            .bound = energy};
  }

  /// A graph of all states asks only whether there is more than one landing: ways up are taken from what is known to be
  /// in the part that is entered, until there is.
  Fall fall_to_few(StateBook& book, const Departure& way, double energy) const {
    if (settings_.starts > 0) book.search(search_below(energy));
    Fall down = fall(book, way, energy);
    for (bool grows = true; grows && down.verdict == SnapVerdict::unambiguous;) {
      grows = false;
      for (const std::size_t minimum : std::vector<std::size_t>(down.minima))
        grows |= book.climb_from(minimum, search_below(energy));
      if (grows) down = fall(book, way, energy);
    }
    return down;
  }

  std::function<bool()> goes_on() const {
    return [this] { return !t_.observer || t_.observer(0, 0); };
  }

  void doubt(const Event& event, const std::string& why) {
    findings_.doubts.push_back("the jump from " + event.label + ": " + why);
  }

  /// Where several states may be reached, the landing is that of the overdamped motion; where one, that
  /// motion has to confirm it.
  void settle(const Frozen& frozen, const Event& event, const Departure& way, Fall& down,
              StateBook& book, Jump& jump) {
    if (!down.landing) return;
    const bool keep_way = !settings_.transitions;
    const Flow flow =
        flow_by_cvode({frozen.landscape()}, way.x, {.keep_way = keep_way, .goes_on = goes_on()});
    if (keep_way) keep_motion(frozen, flow, jump);
    if (flow.end != Flow::End::rest) {
      if (down.verdict == SnapVerdict::unambiguous)
        doubt(event, "the overdamped motion was not integrated to a state of rest");
      return;
    }
    const std::size_t reached = book.add(flow.state);
    if (reached == *down.landing || flow.state.index > 0) return;
    if (down.verdict == SnapVerdict::unambiguous)
      doubt(event, "the overdamped motion comes to rest somewhere else than the way down");
    // The same state some turns farther stands in its place.
    std::erase_if(down.minima, [&](std::size_t m) { return book.are_turns(m, reached); });
    down.minima.push_back(reached);
    down.landing = reached;
  }

  /// Moments of the motion at even lengths of way, both ends among them.
  void keep_motion(const Frozen& frozen, const Flow& flow, Jump& jump) const {
    constexpr double parts = 60;
    const auto& moving = frozen.landscape().moving();
    std::vector<double> lengths;
    for (std::size_t i = 0; i < flow.way.size(); ++i)
      lengths.push_back(i == 0 ? 0
                               : lengths.back() +
                                     (flow.way[i].second - flow.way[i - 1].second)(moving).norm());
    double next = 0;
    for (std::size_t i = 0; i < flow.way.size(); ++i) {
      if (lengths[i] < next && i + 1 < flow.way.size()) continue;
      next = lengths[i] + lengths.back() / parts;
      const auto at = frozen.landscape().ground(flow.way[i].second);
      if (!at) continue;
      const double energy = frozen.landscape().energy(at->x);
      jump.motion.push_back({flow.way[i].first, lengths[i],
                             written(frozen, {.x = at->x, .piece = at->piece, .energy = energy})});
    }
  }

  /// The motion with masses; where the answer is unambiguous it has to end at the landing.
  void move_with_masses(const Frozen& frozen, const Event& event, const Vector& critical,
                        const Departure& way, const Fall& down, StateBook& book, Jump& jump) {
    // The book may find further states while the motion is followed.
    const RestState known = down.landing ? book.states()[*down.landing] : RestState{};
    const RestState* landing = down.landing ? &known : nullptr;
    const auto& moving = frozen.landscape().moving();
    const double far = landing == nullptr ? 0 : Vector((landing->x - critical)(moving)).norm();
    const Departure begin =
        landing == nullptr ? way : shortened(frozen.landscape(), critical, way, far);
    const auto caught = [&](const Vector& x, double energy) {
      return caught_by(book, down, x, energy);
    };
    Inertial inertial =
        inertial_motion(frozen, scales_, *settings_.inertia, begin.x, landing, {goes_on(), caught});
    if (landing != nullptr) inertial.motion.push = begin.amplitude / far;
    if (inertial.landing) {
      inertial.motion.landing = written(frozen, *inertial.landing);
      inertial.motion.released = jump.critical.energy - inertial.motion.landing.energy;
      if (down.verdict == SnapVerdict::unambiguous && landing != nullptr &&
          !frozen.landscape().same(landing->x, inertial.landing->x))
        doubt(event, "the motion with masses comes to rest somewhere else than the way down");
    }
    const std::string why = doubt_of(inertial.motion);
    if (!why.empty()) doubt(event, why);
    jump.inertial = std::move(inertial.motion);
  }

  Vector state_of(const Frozen& frozen, const Branch& branch, std::size_t row) const {
    return frozen.reduced(unknowns_in(branch.samples[row].values, t_.quantities, size_));
  }

  /// The pieces that meet in a special point, those of the branch's rows beside it first. The rows of a switching lie
  /// on its surface: their own signs are rounding.
  std::vector<Piece> pieces_beside(const Frozen& frozen, const Branch& branch, const Event& event,
                                   const Vector& critical) const {
    std::vector<Piece> pieces;
    const std::vector<Piece> meeting = frozen.landscape().pieces_beside(critical);
    const auto add = [&](const Piece& piece) {
      if (std::find(pieces.begin(), pieces.end(), piece) == pieces.end()) pieces.push_back(piece);
    };
    const auto add_row = [&](std::size_t row) {
      if (row >= branch.samples.size()) return;
      const auto piece = frozen.landscape().piece_at(state_of(frozen, branch, row));
      // A row may lie beyond other switchings too.
      if (piece && std::find(meeting.begin(), meeting.end(), *piece) != meeting.end()) add(*piece);
    };
    if (has_two_rows(branch, event)) {
      if (event.row > 0) add_row(event.row - 1);
      add_row(event.row + 2);
    }
    for (const Piece& piece : meeting) add(piece);
    return pieces;
  }

  struct Traced {
    Vector x{};
    std::size_t branch = 0, row = 0;
  };

  /// Up to four rows.
  StretchTrack track_of(const std::vector<Sample>& samples, std::size_t first) const {
    StretchTrack track;
    for (std::size_t r = first; r < std::min(first + 4, samples.size()); ++r) {
      track.s.push_back(samples[r].values[arc_length_]);
      track.lambda.push_back(samples[r].values[lambda_] / t_.lambda_scale);
      track.x.push_back(unknowns_in(samples[r].values, t_.quantities, size_));
    }
    return track;
  }

  /// All states of the traced branches at this lambda, polished.
  void add_traced(const Frozen& frozen, const Vector& critical, StateBook& book) {
    constexpr double beside_critical = 1e-4;
    traced_.clear();
    for (std::size_t b = 0; b < result_.branches.size(); ++b) {
      const auto& samples = result_.branches[b].samples;
      for (std::size_t r = 0; r + 1 < samples.size(); ++r) {
        const double from = samples[r].values[lambda_] / t_.lambda_scale - frozen.lambda();
        const double to = samples[r + 1].values[lambda_] / t_.lambda_scale - frozen.lambda();
        if (from * to > 0 || from == to) continue;
        const std::size_t first = r - std::min<std::size_t>(r, 1);
        const Vector x =
            frozen.reduced(state_between(track_of(samples, first), r - first, frozen.lambda()));
        const auto state = rest_near(frozen.landscape(), x);
        if (!state || distance(frozen, state->x, critical) < beside_critical) continue;
        book.add(*state);
        traced_.push_back({state->x, b, r});
      }
    }
  }

  static double distance(const Frozen& frozen, const Vector& a, const Vector& b) {
    return (a - b)(frozen.landscape().moving()).lpNorm<Eigen::Infinity>();
  }

  SnapState written(const Frozen& frozen, const RestState& state) const {
    CurvePoint point;
    point.x = t_.problem.reduce(frozen.unknowns(state.x));
    point.lambda = frozen.lambda();
    point.piece = state.piece;
    count_negative(t_.problem, point);
    Branch single = single_point(point, t_.evaluator, t_.quantities, t_.problem);
    SnapState result{std::move(single.samples.front().values),
                     single.samples.front().piece,
                     scales_.moment() * state.energy,
                     static_cast<int>(state.index),
                     0,
                     0};
    for (const Traced& on : traced_)
      if (frozen.landscape().same(on.x, state.x)) {
        result.branch = static_cast<int>(on.branch) + 1;
        result.row = on.row;
        break;
      }
    return result;
  }

  /// @param before  a state on the stable side of the point that is left
  void write(const Frozen& frozen, const Vector& before, const Fall& fall, StateBook& book,
             Jump& jump) {
    jump.verdict = fall.verdict;
    jump.may_run_away = fall.may_run_away;
    for (const std::size_t m : fall.minima)
      if (m != fall.landing) jump.others.push_back(written(frozen, book.states()[m]));
    for (const std::size_t s : fall.saddles)
      jump.saddles.push_back(written(frozen, book.states()[s]));
    if (!fall.landing) return;
    const auto barrier_around = [&](std::size_t minimum) {
      return scales_.moment() * lowest_barrier(minimum, fall, book);
    };
    jump.barriers = {barrier_around(*fall.landing)};
    for (const std::size_t m : fall.minima)
      if (m != fall.landing) jump.barriers.push_back(barrier_around(m));
    const RestState& landing = book.states()[*fall.landing];
    jump.landing = written(frozen, landing);
    jump.released = jump.critical.energy - jump.landing.energy;
    jump.time_scale = time_scale(frozen, landing);
    jump.switches = switched_springs(t_.problem, frozen, before, landing);
    const Vector start =
        unknowns_in(result_.branches.front().samples[result_.branches.front().start_row].values,
                    t_.quantities, size_);
    jump.warnings = leg_warnings(frozen.problem().layout(), frozen.problem().inputs(0).rho, start,
                                 frozen.unknowns(landing.x));
    if (jump.landing.branch == 0) offer_to_trace(frozen, landing);
  }

  /// Reciprocal of the slowest rate of the overdamped motion.
  double time_scale(const Frozen& frozen, const RestState& state) const {
    const auto at = frozen.landscape().ground_on(state.x, state.piece);
    if (!at || at->hessian.size() == 0) return std::numeric_limits<double>::quiet_NaN();
    return 1 / eigenvalues_of_pair(at->hessian, frozen.landscape().damping(*at))[0];
  }

  void offer_to_trace(const Frozen& frozen, const RestState& landing) {
    CurvePoint point;
    point.x = t_.problem.reduce(frozen.unknowns(landing.x));
    point.lambda = frozen.lambda();
    point.piece = landing.piece;
    if (limit_passed(t_.study, t_.evaluator, t_.quantities, point)) return;
    findings_.untraced.push_back({point.x, point.lambda, point.piece});
  }

  const Tracing& t_;
  const Scales& scales_;
  const SnapSettings& settings_;
  const StudyResult& result_;
  SnapFindings& findings_;
  std::size_t arc_length_, lambda_;
  Index size_;
  std::vector<Traced> traced_{};
};

}  // namespace

void find_jumps_from(const std::vector<Loss>& losses, const Tracing& tracing, const Scales& scales,
                     const SnapSettings& settings, const StudyResult& result,
                     SnapFindings& findings) {
  Jumper jumper(tracing, scales, settings, result, findings);
  for (const Loss& loss : losses) jumper.jump(loss);
}

SnapFindings find_jumps(const Tracing& tracing, const Scales& scales, const SnapSettings& settings,
                        const StudyResult& result) {
  SnapFindings findings;
  Jumper jumper(tracing, scales, settings, result, findings);
  for (const Loss& loss : losses_of(result, tracing.quantities)) jumper.jump(loss);
  close_loops(tracing.quantities, result, findings.report);
  return findings;
}

}  // namespace springfold::analysis
