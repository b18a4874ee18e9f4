#include "load_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "branch_rows.hpp"
#include "first_unwanted.hpp"
#include "grow_diagram.hpp"
#include "springfold/analysis/event_rows.hpp"
#include "springfold/continuation/numerics.hpp"
#include "ways_on.hpp"

namespace springfold::analysis {
namespace {

using continuation::Hit;
using continuation::HitKind;

/// Along the path up to a point, of which it keeps what is wanted.
void cut_behind(double s, const std::function<bool(const SpecialPoint&)>& is_kept, BasePath& path) {
  Branch& branch = path.branch;
  std::erase_if(path.points, [&](const SpecialPoint& other) {
    return other.hit.point.s > s || (other.hit.point.s == s && !is_kept(other));
  });
  std::erase_if(branch.samples, [s](const Sample& row) { return row.values.front() > s; });
  const std::size_t rows = branch.samples.size();
  std::erase_if(branch.events, [rows](const Event& event) { return event.row >= rows; });
  branch.resting.clear();
  branch.log.clear();
  branch.arcs.reset();
  continuation::Curve& curve = path.forward;
  std::erase_if(curve.points, [s](const auto& other) { return other.s >= s; });
  std::erase_if(curve.hits, [s](const Hit& hit) { return hit.point.s > s; });
  curve.arcs.clear();
  curve.log.clear();
}

/// Rows and events behind the start of the way on.
void append_rows(Branch onward, double s, Branch& branch) {
  const auto is_behind = [](const Sample& row) { return row.values.front() > 0; };
  const auto first = std::ranges::find_if(onward.samples, is_behind) - onward.samples.begin();
  const std::size_t begin = static_cast<std::size_t>(first), rows = branch.samples.size();
  for (std::size_t row = begin; row < onward.samples.size(); ++row) {
    branch.samples.push_back(std::move(onward.samples[row]));
    branch.samples.back().values.front() += s;
  }
  for (Event& event : onward.events) {
    if (event.row < begin) continue;
    event.row = event.row - begin + rows;
    branch.events.push_back(std::move(event));
  }
  branch.forward = branch.backward = onward.forward;
}

void move_on(double s, Hit& hit) {
  hit.point.s += s;
  hit.s_before += s;
  hit.s_after += s;
  for (continuation::CurvePoint& way : hit.leaving) way.s += s;
}

void append_curve(continuation::Curve onward, double s, continuation::Curve& curve) {
  for (continuation::CurvePoint& point : onward.points) {
    point.s += s;
    curve.points.push_back(std::move(point));
  }
  for (Hit& hit : onward.hits) {
    move_on(s, hit);
    curve.hits.push_back(std::move(hit));
  }
  curve.stop = onward.stop;
  curve.stop_detail = std::move(onward.stop_detail);
}

/// Labels count along the path.
void label(BasePath& path) {
  std::map<std::string, int> counts;
  std::map<std::pair<std::size_t, std::string>, std::string> labels;
  for (Event& event : path.branch.events) {
    const std::string code = code_of(event.kind), text = code + std::to_string(++counts[code]);
    labels[{event.row, event.label}] = text;
    event.label = text;
  }
  for (SpecialPoint& point : path.points) point.label = labels[{point.row, point.label}];
}

/// The path up to a point and, from there, along a way on. Its rows keep what special points are judged by.
BasePath joined(BasePath path, double s, BasePath onward,
                const std::function<bool(const SpecialPoint&)>& is_kept) {
  cut_behind(s, is_kept, path);
  for (Hit& hit : path.forward.hits)
    if (hit.point.s == s && !onward.forward.points.empty()) {
      hit.leaving = {onward.forward.points.front()};
      hit.leaving.front().s = s;
    }
  const std::vector<Sample>& rows = onward.branch.samples;
  const auto behind = static_cast<std::size_t>(
      std::ranges::count_if(rows, [](const Sample& row) { return !(row.values.front() > 0); }));
  for (SpecialPoint& next : onward.points) {
    if (!(next.hit.point.s > 0)) continue;
    next.row = next.row - behind + path.branch.samples.size();
    move_on(s, next.hit);
    path.points.push_back(std::move(next));
  }
  append_rows(std::move(onward.branch), s, path.branch);
  append_curve(std::move(onward.forward), s, path.forward);
  path.is_enough = onward.is_enough;
  label(path);
  return path;
}

/// Does the load surely change behind a point of the curve as it did before?
bool leads_on(const continuation::Curve& curve, const continuation::CurvePoint& at,
              const std::function<double(const continuation::CurvePoint&)>& load) {
  const auto is_behind = [&](const auto& p) { return p.s > at.s + continuation::told_apart; };
  const auto is_before = [&](const auto& p) { return p.s < at.s - continuation::told_apart; };
  const auto behind = std::ranges::find_if(curve.points, is_behind);
  const auto before = std::find_if(curve.points.rbegin(), curve.points.rend(), is_before);
  if (behind == curve.points.end() || before == curve.points.rend()) return false;
  const double here = load(at);
  return (here - load(*before)) * (load(*behind) - here) > 0;
}

LoadedState loaded_state(const Member& member, const QuantityDefinition& load,
                         const QuantityDefinition& index) {
  const Evaluator& evaluator = member.evaluator();
  return {.load = [&](const auto& point) { return evaluator.value(load, point); },
          .unstable = [&](const auto& point) { return evaluator.unstable_modes(index, point); }};
}

}  // namespace

BasePath load_path(const Member& member, const CriticalPointSettings& settings,
                   const Observer& observer, const continuation::HitObserver& enough,
                   const Study* within) {
  return load_path(base_path(member, observer, {.enough = enough, .within = within}), member,
                   settings, observer, enough, within);
}

BasePath load_path(BasePath path, const Member& member, const CriticalPointSettings& settings,
                   const Observer& observer, const continuation::HitObserver& enough,
                   const Study* within) {
  const bool dead = settings.stability == StabilityOf::dead_load;
  const QuantityDefinition *force = dead ? member.quantity("force") : nullptr,
                           *load = force != nullptr ? force : member.quantity("lambda"),
                           *index = member.quantity(dead ? "index_force" : "index");
  const Study& study = within != nullptr ? *within : member.study;
  const auto load_at = [&](const continuation::CurvePoint& point) {
    return member.evaluator().value(*load, point);
  };
  const auto may_hand_over = [&](const SpecialPoint& point) {
    return (point.kind == EventKind::branching_kink || point.kind == EventKind::branch_point) &&
           !leads_on(path.forward, point.hit.point, load_at);
  };
  for (int i = 0; i < most_handovers && index != nullptr && path.problem.empty(); ++i) {
    const std::size_t last = path.branch.samples.size() - 1;
    const auto first = std::ranges::find_if(path.points, [&](const SpecialPoint& point) {
      return is_unwanted(member, settings, path, point) ||
             (point.row == last && point.kind == EventKind::branching_kink);
    });
    if (first == path.points.end() || !may_hand_over(*first)) break;
    const continuation::CurvePoint at = first->hit.point;
    const auto way = taken_over_at(*member.problem, at, loaded_state(member, *load, *index),
                                   options_of(study.trace));
    if (!way) break;
    BasePath onward =
        base_path(member, observer, {.enough = enough, .within = within, .way = &*way});
    if (!onward.problem.empty() || onward.forward.points.empty()) break;
    const auto is_kept = [&, kind = first->kind, before = path](const SpecialPoint& other) {
      return other.kind != kind && !is_unwanted(member, settings, before, other);
    };
    path = joined(std::move(path), at.s, std::move(onward), is_kept);
  }
  return path;
}

}  // namespace springfold::analysis
