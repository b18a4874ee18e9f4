#include "load_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "branch_rows.hpp"
#include "frozen.hpp"
#include "path_work.hpp"
#include "springfold/continuation/newton.hpp"
#include "stable_walk.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

/// A state on a branch: between the rows `row` and `row` + 1.
struct Position {
  std::size_t branch = 0, row = 0;
  PathState state{};
};

class Cycle {
 public:
  Cycle(const Tracing& t, const Scales& scales, const StudyResult& result, const SnapReport& report)
      : t_{t},
        scales_{scales},
        result_{result},
        report_{report},
        walk_{t.quantities, result},
        lambda_{column_of(Kind::lambda, t.quantities)} {}

  LoadCycle run(const std::vector<double>& levels) {
    if (result_.branches.empty() || result_.branches.front().samples.size() < 2) {
      cycle_.end = LoadCycle::End::out_of_range;
      return cycle_;
    }
    const Branch& first = result_.branches.front();
    const std::size_t last = first.samples.size() - 1;
    at_ = {0, stable_side(first, last), state_of(0, first.start_row)};
    if (index_at(first, first.start_row) != 0) {
      cycle_.end = LoadCycle::End::not_stable;
      return cycle_;
    }
    begin_energy_ = path_energy(t_.problem, at_.state);
    arrive(0);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      cycle_.level = static_cast<int>(k) + 1;
      cycle_.end = go_to(levels[k] / t_.lambda_scale);
      if (cycle_.end != LoadCycle::End::complete) break;
      arrive(cycle_.level);
    }
    finish();
    return cycle_;
  }

 private:
  double index_at(const Branch& branch, std::size_t row) const {
    return branch.samples[row].values[column_of(Kind::index, t_.quantities)];
  }

  /// The row before the start or the start's own: a start at which stability is lost belongs to the stable side.
  std::size_t stable_side(const Branch& branch, std::size_t last) const {
    const std::size_t start = branch.start_row;
    const bool is_behind = start > 0 && index_at(branch, start - 1) == 0 &&
                           (start == last || index_at(branch, start + 1) != 0);
    return is_behind ? start - 1 : std::min(start, last - 1);
  }

  double lambda_at(std::size_t branch, std::size_t row) const {
    return result_.branches[branch].samples[row].values[lambda_] / t_.lambda_scale;
  }

  PathState state_of(std::size_t branch, std::size_t row) const {
    const auto& values = result_.branches[branch].samples[row].values;
    return {t_.problem.reduce(unknowns_in(values, t_.quantities, t_.problem.layout().size)),
            lambda_at(branch, row)};
  }

  /// Follows stable branches to a level; jumps where they end.
  LoadCycle::End go_to(double target) {
    const int direction = target >= at_.state.lambda ? 1 : -1;
    constexpr int most_stretches = 1000;
    for (int k = 0; k < most_stretches; ++k) {
      const bool grows = lambda_at(at_.branch, at_.row + 1) > lambda_at(at_.branch, at_.row);
      const int step = grows == (direction > 0) ? 1 : -1;
      const Event* end = walk_.first_unstable(at_.branch, step > 0 ? at_.row : at_.row + 1, step);
      if (reaches(target, direction, step, end)) return LoadCycle::End::complete;
      if (end == nullptr) return LoadCycle::End::out_of_range;
      if (const auto next = walk_.stable_branch_from(*end, at_.branch, direction)) {
        at_.branch = next->branch;
        at_.row = next->step > 0 ? next->row - 1 : next->row;
        continue;
      }
      const auto jump = std::find_if(
          report_.jumps.begin(), report_.jumps.end(),
          [&](const Jump& j) { return j.from == end->label && j.loading == direction; });
      if (jump == report_.jumps.end()) return LoadCycle::End::undecided;
      if (!land(*jump))
        return jump->landing.values.empty() ? LoadCycle::End::no_landing
                                            : LoadCycle::End::out_of_range;
    }
    return LoadCycle::End::undecided;
  }

  /// Goes along rows until the level is passed (true), or to the end of stability or of the rows.
  bool reaches(double target, int direction, int step, const Event* end) {
    const auto rows = std::ssize(result_.branches[at_.branch].samples);
    auto row = static_cast<std::ptrdiff_t>(at_.row) + (step > 0 ? 1 : 0);
    for (; row >= 0 && row < rows; row += step) {
      const auto r = static_cast<std::size_t>(row);
      PathState next = state_of(at_.branch, r);
      const bool is_end = end != nullptr && r == end->row;
      if ((next.lambda - target) * direction >= 0) {
        pass(at_level(next, target));
        at_.row = step > 0 ? r - 1 : r;
        return true;
      }
      pass(std::move(next));
      at_.row = step > 0 ? r - std::min<std::size_t>(r, 1) : r;
      if (is_end) return false;
    }
    return false;
  }

  /// The curve's state at this lambda, between the present state and the next one.
  PathState at_level(const PathState& next, double target) {
    const auto found = state_at_level(t_.problem, at_.state, next, target);
    is_exact_ &= found.has_value();
    return found ? *found : next;
  }

  void pass(PathState next) {
    const auto work = path_work(t_.problem, at_.state, next);
    is_exact_ &= work.has_value();
    cycle_.area += scales_.moment() * work.value_or(0);
    at_.state = std::move(next);
  }

  bool land(const Jump& jump) {
    const SnapState& landing = jump.landing;
    if (landing.values.empty() || landing.branch == 0) return false;
    const auto branch = static_cast<std::size_t>(landing.branch - 1);
    if (landing.row + 1 >= result_.branches[branch].samples.size()) return false;
    const Vector z = unknowns_in(landing.values, t_.quantities, t_.problem.layout().size);
    at_ = {branch, landing.row, {t_.problem.reduce(z), landing.values[lambda_] / t_.lambda_scale}};
    cycle_.released += jump.released;
    ++cycle_.jumps;
    cycle_.steps.push_back({cycle_.level, static_cast<int>(&jump - report_.jumps.data()) + 1,
                            landing, jump.released, cycle_.area});
    return true;
  }

  void arrive(int level) {
    continuation::CurvePoint point;
    point.x = at_.state.x;
    point.lambda = at_.state.lambda;
    Vector g;
    if (t_.problem.switches(point.x, point.lambda, g))
      for (Index j = 0; j < g.size(); ++j)
        point.piece.push_back(g[j] < 0 ? std::int8_t{-1} : std::int8_t{1});
    count_negative(t_.problem, point);
    Branch single = single_point(point, t_.evaluator, t_.quantities, t_.problem);
    SnapState state{std::move(single.samples.front().values),
                    single.samples.front().piece,
                    scales_.moment() * path_energy(t_.problem, at_.state),
                    0,
                    static_cast<int>(at_.branch) + 1,
                    at_.row};
    cycle_.steps.push_back({level, 0, std::move(state), 0, cycle_.area});
  }

  void finish() {
    cycle_.energy_change = scales_.moment() * (path_energy(t_.problem, at_.state) - begin_energy_);
    cycle_.gap = is_exact_ ? cycle_.area - cycle_.energy_change - cycle_.released
                           : std::numeric_limits<double>::quiet_NaN();
    const CycleStep& last = cycle_.steps.back();
    if (last.jump > 0) return;
    for (std::size_t k = cycle_.steps.size() - 1; k-- > 0;) {
      const CycleStep& before = cycle_.steps[k];
      if (before.jump > 0 || !same(before.at, last.at)) continue;
      cycle_.closed_with = static_cast<int>(k);
      cycle_.loop = last.area - before.area;
      cycle_.loop_released = 0;
      for (std::size_t i = k + 1; i < cycle_.steps.size(); ++i)
        cycle_.loop_released += cycle_.steps[i].released;
      return;
    }
  }

  bool same(const SnapState& a, const SnapState& b) const {
    constexpr double same_lambda = 1e-12;
    const Index size = t_.problem.layout().size;
    return std::abs(a.values[lambda_] - b.values[lambda_]) <=
               same_lambda * std::max(t_.lambda_scale, std::abs(a.values[lambda_])) &&
           same_equilibrium(t_.problem.layout(), unknowns_in(a.values, t_.quantities, size),
                            unknowns_in(b.values, t_.quantities, size));
  }

  const Tracing& t_;
  const Scales& scales_;
  const StudyResult& result_;
  const SnapReport& report_;
  StableWalk walk_;
  std::size_t lambda_;
  Position at_{};
  LoadCycle cycle_{};
  double begin_energy_ = 0;
  bool is_exact_ = true;
};

}  // namespace

LoadCycle run_cycle(const Tracing& tracing, const Scales& scales, const CycleSettings& settings,
                    const StudyResult& result, const SnapReport& report) {
  std::vector<double> levels;
  for (int k = 0; k < settings.times; ++k)
    levels.insert(levels.end(), settings.levels.begin(), settings.levels.end());
  return Cycle(tracing, scales, result, report).run(levels);
}

}  // namespace springfold::analysis
