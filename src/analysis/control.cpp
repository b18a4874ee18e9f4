// Study kind `control`: commands along a path of targets.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "analysis/undefined.hpp"
#include "branch_rows.hpp"
#include "control_leg.hpp"
#include "cpu_time.hpp"
#include "grow_diagram.hpp"
#include "not_held.hpp"
#include "run_kinds.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/statics/shapes.hpp"
#include "switch_words.hpp"

namespace springfold::analysis {
namespace {

/// How the texts of events end that stand for a target.
constexpr const char* at_target = " is exactly on its threshold at this target";

/// Directions along which stiffness is given: the study's own, if there is one.
std::vector<Vector> directions_of(const Study& study) {
  return study.direction.size() > 0 ? std::vector<Vector>{study.direction} : std::vector<Vector>{};
}

class ControlRun {
 public:
  ControlRun(const model::Mechanism& mechanism, const Study& study, const Observer& observer)
      : study_{study},
        observer_{observer},
        setup_{command_setup(mechanism, study, study.constant_load)},
        path_{setup_, study.targets},
        directions_{directions_of(study)} {
    result_.study = study.name;
    result_.quantities = columns_of(study, mechanism);
    result_.branches.emplace_back();
    near_ = at_own_pose(setup_);
  }

  StudyResult run() {
    const double began = thread_seconds();
    int next = 1;
    for (; next <= path_.count(); ++next) {
      if (observer_ && !observer_(next, path_.way(next))) break;
      go_to(next);
    }
    finish(next);
    result_.seconds = thread_seconds() - began;
    return std::move(result_);
  }

 private:
  Branch& branch() { return result_.branches.front(); }

  /// One row: the place, then the values of the point; a point without solution has none.
  void add_row(double place, const CommandedState* state, std::string status) {
    Sample sample{.values = {place, setup_.scales.length * path_.way(place)},
                  .state = NodeState::outside};
    if (state != nullptr) {
      const CommandedValues at = command_values(setup_, directions_, *state);
      sample.values.insert(sample.values.end(), at.values.begin(), at.values.end());
      sample.piece = piece_text(setup_.system, state->piece);
      sample.state = state_of(at);
      if (status.empty()) status = status_of(at);
    }
    sample.values.resize(result_.quantities.size(), undefined);
    sample.status = std::move(status);
    branch().samples.push_back(std::move(sample));
  }

  void add_event(LegEvent event) {
    const auto plain = [&](double place) {
      near_ = approach(setup_, path_.target(place), near_);
      return near_;
    };
    event.state.plain = plain(event.place);
    const std::string code = code_of(event.kind);
    Event entry{.kind = event.kind,
                .label = code + std::to_string(++labels_[code]),
                .detail = event.detail,
                .row = branch().samples.size()};
    entry.stiffness = physical_stiffness(event.state);
    add_row(event.place, &event.state, "on the way");
    branch().samples.back().event = entry.label;
    const bool two_sides = event.kind == EventKind::switching ||
                           event.kind == EventKind::corner_limit_point ||
                           event.kind == EventKind::branching_kink;
    if (two_sides) {
      CommandedState other = event.leaving ? *event.leaving : event.state;
      other.plain = near_;
      add_row(event.place, &other, "on the way");
      branch().samples.back().event = entry.label;
    }
    entry.rates_before.assign(result_.quantities.size(), undefined);
    entry.rates_after = entry.rates_before;
    branch().events.push_back(std::move(entry));
  }

  Matrix physical_stiffness(const CommandedState& state) const {
    statics::Workspace work;
    Vector r;
    Matrix A;
    if (!equilibrium_matrix(setup_.system, state.piece, state.z, state.inputs, work, r, A))
      return {};
    const Matrix K = body_stiffness(setup_, state.z, A).K;
    if (K.size() == 0) return K;
    return setup_.wrench_scale.asDiagonal() * K * setup_.pose_scale.cwiseInverse().asDiagonal();
  }

  /// From the solution before, without looking what lies in between.
  std::optional<CommandedState> warm_started(int k, const CommandedState& from) const {
    statics::ControlSolver solver =
        control_solver(setup_.system, setup_.task, from.z, from.inputs.rho);
    if (!solve_control(setup_.system, solver, path_.target(k), path_.load(k))) return std::nullopt;
    CommandedState state{.z = solver.z, .inputs = solver.inputs, .piece = solver.piece};
    state.iterations = solver.iterations;
    return state;
  }

  /// From plain inverse kinematics.
  statics::ControlResult afresh(int k) const {
    statics::ControlProblem problem{.task = setup_.task,
                                    .target = path_.target(k),
                                    .W = path_.load(k),
                                    .z = near_.z,
                                    .rho = near_.rho};
    if (study_.command.method == CommandMethod::paper)
      problem.method = statics::ControlMethod::paper;
    return kinetostatic_control(setup_.system, problem);
  }

  static bool same(const CommandedState& a, const CommandedState& b) {
    return (a.z - b.z).lpNorm<Eigen::Infinity>() <= 1e-7 &&
           (a.inputs.rho - b.inputs.rho).lpNorm<Eigen::Infinity>() <= 1e-7;
  }

  /// The solution at target k that is connected with the one before, if there is one.
  std::optional<CommandedState> along_the_path(int k) {
    if (!last_ || study_.command.method == CommandMethod::paper) return std::nullopt;
    Leg leg = follow_leg(setup_, path_, k - 1, *last_, options_of(study_.trace));
    const double last_event = leg.events.empty() ? k - 1 : leg.events.back().place;
    for (LegEvent& event : leg.events) add_event(std::move(event));
    if (!leg.end) {
      const double place = leg.lost_place.value_or(last_event);
      if (lost_.empty())
        lost_ = "control is lost at path = " + rounded(place, 10) + ": " + leg.lost;
      return std::nullopt;
    }
    const auto direct = warm_started(k, *last_);
    if (direct && same(*direct, *leg.end)) return direct;
    return warm_started(k, *leg.end);  // the straight jump went to another solution, or nowhere
  }

  void go_to(int k) {
    const bool had_last = last_.has_value();
    std::optional<CommandedState> state = along_the_path(k);
    near_ = approach(setup_, path_.target(k), near_);
    std::string status;
    if (!state) {
      const statics::ControlResult fresh = afresh(k);
      if (fresh.status == statics::ControlStatus::converged) {
        state = CommandedState{.z = fresh.z, .inputs = fresh.inputs, .piece = fresh.piece};
        state->iterations = fresh.iterations;
        if (had_last && study_.command.method == CommandMethod::newton)
          status = "not reached along the path";
      } else {
        status = words(why_not_held(setup_, path_.target(k), path_.load(k), fresh));
        ++missing_;
        if (first_missing_.empty()) first_missing_ = "target " + std::to_string(k) + ": " + status;
      }
      if (!result_.start.found) report_start(k, state, fresh, status);
    }
    if (state) state->plain = near_;
    if (state) add_thresholds(k, *state);
    add_row(k, state ? &*state : nullptr, status);
    const NodeState here = branch().samples.back().state;
    if (here == NodeState::unstable || here == NodeState::critical) ++unstable_;
    last_ = std::move(state);
  }

  /// Springs that rest exactly on a threshold at a target: an event there, with the values on both sides.
  void add_thresholds(int k, const CommandedState& state) {
    constexpr double same = 1e-9;
    const statics::System& system = setup_.system;
    for (std::size_t j = 0; j < system.switches.size(); ++j) {
      const statics::Switch& s = system.switches[j];
      const auto value = [&](const CommandedState& at) {
        return switch_value(system, j, at.z, at.inputs.rho);
      };
      const std::size_t low = j - first_switch_of(system, s);
      const bool rests = std::abs(value(state)) <= same * std::max(1.0, std::abs(s.breakpoint));
      if (!rests || !law_of(system, s).changes_at(low) || is_reported(k)) continue;
      const bool rises = !last_ || value(*last_) <= 0;
      LegEvent event{.kind = EventKind::switching,
                     .detail = "spring " + name_of(system, s) + " (segment " +
                               std::to_string(rises ? low : low + 1) + " to " +
                               std::to_string(rises ? low + 1 : low) + ")" + at_target,
                     .place = static_cast<double>(k),
                     .state = state,
                     .leaving = state};
      event.state.piece[j] = rises ? std::int8_t{-1} : std::int8_t{1};
      event.leaving->piece[j] = rises ? std::int8_t{1} : std::int8_t{-1};
      add_event(std::move(event));
      at_targets_.insert(result_.branches.front().events.back().row);
    }
  }

  /// Did the way to this target see a switching there?
  bool is_reported(int k) const {
    constexpr double same_place = 1e-7;
    const std::vector<Event>& events = result_.branches.front().events;
    return std::any_of(events.begin(), events.end(), [&](const Event& event) {
      const bool switches = event.kind == EventKind::switching ||
                            event.kind == EventKind::corner_limit_point ||
                            event.kind == EventKind::branching_kink;
      const double place = result_.branches.front().samples[event.row].values.front();
      return switches && std::abs(place - k) <= same_place && at_targets_.count(event.row) == 0;
    });
  }

  void report_start(int k, const std::optional<CommandedState>& state,
                    const statics::ControlResult& fresh, const std::string& status) {
    StartReport& start = result_.start;
    if (!state) {
      if (start.message.empty()) {
        start.message = "target " + std::to_string(k) + ": " + status;
        start.where = "targets";
      }
      return;
    }
    start = {};
    start.found = true;
    start.attempts = 1;
    start.iterations = fresh.iterations;
    start.residual = fresh.residual;
    start.method = study_.command.method == CommandMethod::paper
                       ? "inverse kinetostatics by the paper's scheme"
                       : "inverse kinetostatics, exact Newton from plain inverse kinematics";
    if (fresh.globalised) start.method += ", globalised (KINSOL)";
    start.stiffness = physical_stiffness(*state);
    branch().start_row = branch().samples.size();
  }

  void finish(int next) {
    Branch& b = branch();
    const int count = path_.count();
    b.backward = {"first target", true};
    if (next <= count)
      b.forward = {"stopped on request before target " + std::to_string(next), false};
    else if (missing_ > 0)
      b.forward = {std::to_string(missing_) + " of " + std::to_string(count) +
                       " targets have no commands; " + first_missing_,
                   false};
    else if (!lost_.empty())
      b.forward = {lost_, false};
    else
      b.forward = {"last target", true};
    if (next > count && missing_ > 0 && !lost_.empty())
      b.forward.reason = lost_ + "; " + b.forward.reason;
    if (unstable_ > 0)
      b.forward.reason += "; " + std::to_string(unstable_) + " targets are not stable";
    if (!result_.start.found) result_.branches.clear();
  }

  const Study& study_;
  const Observer& observer_;
  CommandSetup setup_;
  TargetPath path_;
  std::vector<Vector> directions_;
  StudyResult result_{};
  statics::KinematicInverse near_{};      ///< plain inverse kinematics of the place before
  std::optional<CommandedState> last_{};  ///< at the target before
  std::map<std::string, int> labels_{};
  std::set<std::size_t>
      at_targets_{};  ///< rows of events that stand for a target, not for a place on the way
  std::string lost_{}, first_missing_{};
  int missing_ = 0, unstable_ = 0;
};

}  // namespace

StudyResult run_control(const model::Mechanism& mechanism, const Study& study,
                        const Observer& observer) {
  return ControlRun(mechanism, study, observer).run();
}

}  // namespace springfold::analysis
