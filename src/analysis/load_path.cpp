#include "load_path.hpp"

#include <algorithm>
#include <map>

#include "branch_rows.hpp"
#include "first_unwanted.hpp"
#include "limits.hpp"
#include "springfold/analysis/event_rows.hpp"
#include "ways_on.hpp"

namespace springfold::analysis {
namespace {

/// One path is handed over no more often: each time at a greater load.
constexpr int most_handovers = 50;

class LoadPath {
 public:
  LoadPath(const Member& member, const CriticalPointSettings& settings, const Observer& observer,
           const continuation::HitObserver& enough, const Study* within)
      : member_{member},
        settings_{settings},
        observer_{observer},
        enough_{enough},
        within_{within} {
    const bool dead = settings.stability == StabilityOf::dead_load;
    load_ = member.quantity(dead && member.quantity("force") != nullptr ? "force" : "lambda");
    index_ = member.quantity(dead ? "index_force" : "index");
  }

  BasePath follow(BasePath curve) {
    path_ = std::move(curve);
    for (int i = 0; i < most_handovers && index_ != nullptr && path_.problem.empty(); ++i) {
      const SpecialPoint* const point = first_unwanted_point();
      if (point == nullptr) break;
      std::optional<BasePath> onward = taken_over_at(*point);
      if (!onward) break;
      go_on(SpecialPoint(*point), std::move(*onward));
    }
    return std::move(path_);
  }

 private:
  double load_at(const Sample& row) const { return value_at(*load_, row); }
  double value_at(const QuantityDefinition& quantity, const Sample& row) const {
    return row.values[static_cast<std::size_t>(&quantity - member_.quantities().data())];
  }

  const SpecialPoint* first_unwanted_point() const {
    const std::size_t last = path_.branch.samples.size() - 1;
    const auto counts = [&](const SpecialPoint& point) {
      return is_unwanted(member_, settings_, path_, point) ||
             (point.row == last && point.kind == EventKind::branching_kink);
    };
    const auto found = std::ranges::find_if(path_.points, counts);
    return found != path_.points.end() ? &*found : nullptr;
  }

  /// In which sense the load changes on the way to a row, +-1, where the path comes to it stable.
  double sense_before(std::size_t row) const {
    const std::vector<Sample>& rows = path_.branch.samples;
    if (row <= path_.branch.start_row || value_at(*index_, rows[row - 1]) != 0) return 0;
    const double change = load_at(rows[row]) - load_at(rows[row - 1]);
    return change > 0 ? 1 : change < 0 ? -1 : 0;
  }

  bool goes_on_behind(std::size_t row, double sense) const {
    const std::vector<Sample>& rows = path_.branch.samples;
    const double s = rows[row].values.front();
    const auto next = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(row), rows.end(),
                                   [s](const Sample& one) { return one.values.front() > s; });
    return next != rows.end() && sense * (load_at(*next) - load_at(rows[row])) > 0;
  }

  /// The one way on along which the load still grows beyond a point where the path does not, if that is stable.
  std::optional<BasePath> taken_over_at(const SpecialPoint& point) const {
    const bool branches =
        point.kind == EventKind::branch_point || point.kind == EventKind::branching_kink;
    const double sense = branches ? sense_before(point.row) : 0;
    if (sense == 0 || goes_on_behind(point.row, sense)) return std::nullopt;
    const Study& study = within_ != nullptr ? *within_ : member_.study;
    const continuation::CurvePoint& at = point.hit.point;
    const auto ways = ways_from(*member_.problem, at, options_of(study.trace));
    if (!ways) return std::nullopt;
    const Evaluator& evaluator = member_.evaluator();
    const WayOn* on = nullptr;
    for (const WayOn& way : *ways) {
      const continuation::CurvePoint& beside = *way.ray.start;
      if (!(sense * (evaluator.value(*load_, beside) - evaluator.value(*load_, at)) > 0)) continue;
      if (on != nullptr || evaluator.value(*index_, beside) != 0) return std::nullopt;
      on = &way;
    }
    if (on == nullptr) return std::nullopt;
    BasePath onward = base_path(member_, true, observer_, 1, enough_, within_, on);
    if (!onward.problem.empty() || onward.forward.points.empty()) return std::nullopt;
    return onward;
  }

  /// The path up to the point, and on from there.
  void go_on(const SpecialPoint& point, BasePath onward) {
    const double s = point.hit.point.s;
    cut_behind(point, onward.forward.points.front());
    const std::size_t first = append_rows(onward.branch, s);
    for (SpecialPoint& next : onward.points) {
      if (!(next.hit.point.s > 0)) continue;
      next.row = next.row - first + rows_before_;
      move_on(s, next.hit);
      path_.points.push_back(std::move(next));
    }
    append_curve(std::move(onward.forward), s);
    path_.is_enough = onward.is_enough;
    label();
  }

  static void move_on(double s, continuation::Hit& hit) {
    hit.point.s += s;
    hit.s_before += s;
    hit.s_after += s;
    for (continuation::CurvePoint& way : hit.leaving) way.s += s;
  }

  /// Of the points there those stay that are wanted.
  void cut_behind(const SpecialPoint& point, continuation::CurvePoint onward) {
    const double s = point.hit.point.s;
    std::erase_if(path_.points, [&](const SpecialPoint& other) {
      const double there = other.hit.point.s;
      return there > s || (there == s && (other.kind == point.kind ||
                                          is_unwanted(member_, settings_, path_, other)));
    });
    Branch& branch = path_.branch;
    branch.samples.resize(point.row + 1);
    std::erase_if(branch.events, [&](const Event& event) { return event.row > point.row; });
    branch.resting.clear();
    branch.log.clear();
    branch.arcs.reset();
    continuation::Curve& curve = path_.forward;
    std::erase_if(curve.points, [s](const auto& other) { return other.s >= s; });
    std::erase_if(curve.hits, [s](const auto& hit) { return hit.point.s > s; });
    curve.arcs.clear();
    curve.log.clear();
    onward.s = s;
    for (continuation::Hit& hit : curve.hits)
      if (hit.point.s == s) hit.leaving = {onward};
  }

  /// The rows behind the start of the way on, with their events. @returns the first one of them
  std::size_t append_rows(Branch& onward, double s) {
    Branch& branch = path_.branch;
    rows_before_ = branch.samples.size();
    std::size_t first = onward.start_row;
    while (first < onward.samples.size() && !(onward.samples[first].values.front() > 0)) ++first;
    for (std::size_t row = first; row < onward.samples.size(); ++row) {
      branch.samples.push_back(std::move(onward.samples[row]));
      branch.samples.back().values.front() += s;
    }
    for (Event& event : onward.events)
      if (event.row >= first) {
        event.row = event.row - first + rows_before_;
        branch.events.push_back(std::move(event));
      }
    branch.forward = branch.backward = onward.forward;
    return first;
  }

  void append_curve(continuation::Curve onward, double s) {
    continuation::Curve& curve = path_.forward;
    for (continuation::CurvePoint& point : onward.points) {
      point.s += s;
      curve.points.push_back(std::move(point));
    }
    for (continuation::Hit& hit : onward.hits) {
      move_on(s, hit);
      curve.hits.push_back(std::move(hit));
    }
    curve.stop = onward.stop;
    curve.stop_detail = std::move(onward.stop_detail);
  }

  void label() {
    std::map<std::string, int> counts;
    std::map<std::pair<std::size_t, EventKind>, std::string> labels;
    for (Event& event : path_.branch.events) {
      const std::string code = code_of(event.kind);
      event.label = code + std::to_string(++counts[code]);
      labels[{event.row, event.kind}] = event.label;
    }
    for (SpecialPoint& point : path_.points) point.label = labels.at({point.row, point.kind});
  }

  const Member& member_;
  const CriticalPointSettings& settings_;
  const Observer& observer_;
  const continuation::HitObserver& enough_;
  const Study* within_;
  const QuantityDefinition* load_ = nullptr;
  const QuantityDefinition* index_ = nullptr;
  BasePath path_{};
  std::size_t rows_before_ = 0;
};

}  // namespace

BasePath load_path(const Member& member, const CriticalPointSettings& settings,
                   const Observer& observer, const continuation::HitObserver& enough,
                   const Study* within) {
  return load_path(base_path(member, true, observer, 1, enough, within), member, settings, observer,
                   enough, within);
}

BasePath load_path(BasePath path, const Member& member, const CriticalPointSettings& settings,
                   const Observer& observer, const continuation::HitObserver& enough,
                   const Study* within) {
  return LoadPath(member, settings, observer, enough, within).follow(std::move(path));
}

}  // namespace springfold::analysis
