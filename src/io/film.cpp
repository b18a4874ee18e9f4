#include "springfold/io/film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "jump_moments.hpp"
#include "report_lists.hpp"
#include "result_access.hpp"
#include "springfold/io/postures.hpp"
#include "springfold/io/shown_text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyResult;
using drawing::Film;

std::optional<int> count_at(const StudyResult& result, const Branch& branch, std::size_t row,
                            const char* name) {
  const double value = value_at(result, branch, row, name);
  if (!std::isfinite(value)) return std::nullopt;
  return static_cast<int>(std::lround(value));
}

bool is_known_on(const StudyResult& result, const Branch& branch, const std::string& name) {
  for (std::size_t row = 0; row < branch.samples.size(); ++row)
    if (std::isfinite(value_at(result, branch, row, name))) return true;
  return false;
}

std::string name_with_unit(const PlannedRun& planned, const StudyResult& result,
                           const std::string& name, const UnitLabels& units) {
  const auto column = column_of(result, name);
  if (!column) return name;
  const std::string unit = column_unit(result, *column, &planned, units);
  return column_title(result, name, &planned) +
         (unit.empty() ? "" : " [" + shown_in_line(unit) + "]");
}

/// Is there a deflection, and is it more than what rounding leaves of none?
/// @param size  of the mechanism [length]
bool moves_on(const StudyResult& result, const Branch& branch, double size) {
  const auto column = column_of(result, "deflection");
  if (!column) return false;
  const bool is_length = result.quantities[*column].unit == analysis::Unit::length;
  constexpr double rounding = 1e-9;  // of the size, or rad
  for (std::size_t row = 0; row < branch.samples.size(); ++row)
    if (std::abs(value_at(result, branch, row, "deflection")) > rounding * (is_length ? size : 1))
      return true;
  return false;
}

/// Force over deflection; without them lambda, or over arc length. Studies that trace no branch have axes of their
/// kind, as on the page.
/// @param size  of the mechanism [length]
PageAxes axes_of(const PlannedRun& planned, const StudyResult& result, const Branch& branch,
                 double size) {
  if (planned.plan.kind == analysis::StudyKind::map ||
      planned.plan.kind == analysis::StudyKind::control ||
      analysis::is_of_critical_points(planned.plan.kind))
    return page_axes_of(planned, result);
  return {moves_on(result, branch, size) ? "deflection" : "s",
          is_known_on(result, branch, "force") ? "force" : "lambda"};
}

/// @param size  of the mechanism [length]
drawing::Diagram diagram_of(const PlannedRun& planned, const StudyResult& result,
                            const Branch& branch, double size, const UnitLabels& units) {
  const PageAxes axes = axes_of(planned, result, branch, size);
  const char* driven = column_of(result, "index_driven") ? "index_driven" : "index";
  drawing::Diagram diagram{.x_name = name_with_unit(planned, result, axes.x, units),
                           .y_name = name_with_unit(planned, result, axes.y, units)};
  for (std::size_t row = 0; row < branch.samples.size(); ++row) {
    const std::string& label = branch.samples[row].event;
    const bool is_said =
        row > 0 && branch.samples[row - 1].event == label;  // both rows of one switching
    diagram.points.push_back({.x = value_at(result, branch, row, axes.x),
                              .y = value_at(result, branch, row, axes.y),
                              .unstable_dead = count_at(result, branch, row, "index_force"),
                              .unstable_driven = count_at(result, branch, row, driven),
                              .label = is_said ? std::string{} : label});
  }
  return diagram;
}

/// Arc length of a row; its number where the study has none.
double length_at(const StudyResult& result, const Branch& branch, std::size_t row) {
  const double s = value_at(result, branch, row, "s");
  return std::isfinite(s) ? s : static_cast<double>(row);
}

/// @param fallback  row for no label
std::optional<std::size_t> row_of(const Branch& branch, const std::string& label,
                                  std::size_t fallback) {
  if (label.empty()) return fallback;
  for (const analysis::Event& event : branch.events)
    if (event.label == label) return event.row;
  if (label == "start") return branch.start_row;
  if (label == "end") return branch.samples.size() - 1;
  return std::nullopt;
}

std::string labels_on(const Branch& branch) {
  std::string list = "start";
  for (const analysis::Event& event : branch.events) list += ", " + event.label;
  return list + ", end";
}

/// Rows in time slots of even arc length; a special point lasts longer, so that it can be seen.
std::vector<std::size_t> slots_between(const StudyResult& result, const Branch& branch,
                                       std::size_t from, std::size_t to, int count) {
  const auto [first, last] = std::minmax(from, to);
  const double begin = length_at(result, branch, first), end = length_at(result, branch, last);
  std::vector<std::size_t> slots;
  std::size_t row = first;
  for (int i = 0; i < count; ++i) {
    const double s = begin + (end - begin) * i / (count - 1);
    const auto distance = [&](std::size_t r) { return std::abs(length_at(result, branch, r) - s); };
    while (row < last && distance(row + 1) <= distance(row)) ++row;
    slots.push_back(row);
  }
  // The slot nearest to a special point has that point.
  for (const analysis::Event& event : branch.events) {
    if (event.row < first || event.row > last || end <= begin) continue;
    const double part = (length_at(result, branch, event.row) - begin) / (end - begin);
    slots[static_cast<std::size_t>(std::lround(part * (count - 1)))] = event.row;
  }
  constexpr std::size_t held = 7;
  std::vector<std::size_t> order;
  for (const std::size_t slot : slots)
    order.insert(order.end(), branch.samples[slot].event.empty() ? 1 : held, slot);
  if (from > to) std::reverse(order.begin(), order.end());
  return order;
}

/// A way in which the mechanism buckles: rates of the columns.
struct Mode {
  std::string name{};  ///< "LP1", "BP1"; of several at one point "BP1.2" is the second
  std::size_t row = 0;
  const std::vector<double>* rates = nullptr;
};

/// At a limit point the branch itself moves along the mode; branch points have modes across it.
std::vector<Mode> modes_on(const Branch& branch) {
  std::vector<Mode> modes;
  for (const analysis::Event& event : branch.events) {
    const auto& along = event.rates_after.empty() ? event.rates_before : event.rates_after;
    if (event.kind == analysis::EventKind::limit_point)
      modes.push_back({event.label, event.row, &along});
    for (std::size_t k = 0; k < event.modes.size(); ++k)
      modes.push_back(
          {event.label + (k == 0 ? "" : "." + std::to_string(k + 1)), event.row, &event.modes[k]});
  }
  return modes;
}

/// Has it the points that are asked for?
bool has_wish(const Branch& branch, const FilmWish& wish) {
  if (branch.samples.empty()) return false;
  if (wish.mode.empty()) return row_of(branch, wish.from, 0) && row_of(branch, wish.to, 0);
  const std::vector<Mode> modes = modes_on(branch);
  return std::any_of(modes.begin(), modes.end(),
                     [&wish](const Mode& mode) { return mode.name == wish.mode; });
}

/// The branch of the film; nullptr if there is none of this number. Without a number the first that has the points, or
/// branch 1 where none has.
const Branch* branch_of(const StudyResult& result, const FilmWish& wish) {
  const auto& branches = result.branches;
  if (wish.branch > 0)
    return static_cast<std::size_t>(wish.branch) <= branches.size()
               ? &branches[static_cast<std::size_t>(wish.branch) - 1]
               : nullptr;
  const auto found = std::find_if(branches.begin(), branches.end(),
                                  [&wish](const Branch& b) { return has_wish(b, wish); });
  return found == branches.end() ? &branches.front() : &*found;
}

std::string number_of(const StudyResult& result, const Branch& branch) {
  return "branch " + std::to_string(&branch - result.branches.data() + 1);
}

std::string name_of(const StudyResult& result, const Branch& branch) {
  return number_of(result, branch) + " of " + result.study;
}

/// With the number of the branch where there are several.
std::string heading_with(const StudyResult& result, const Branch& branch) {
  return heading_of(result) + (result.branches.size() > 1 ? ", " + number_of(result, branch) : "");
}

FilmOutcome way(const PlannedRun& planned, const RowScenes& scenes, const StudyResult& result,
                const Branch& branch, const UnitLabels& units, const FilmWish& wish) {
  const auto from = row_of(branch, wish.from, 0);
  const auto to = row_of(branch, wish.to, branch.samples.size() - 1);
  if (!from || !to)
    return {.problem = "there is no point \"" + (from ? wish.to : wish.from) + "\" on " +
                       name_of(result, branch) + "; there are: " + labels_on(branch)};
  if (*from == *to) return {.problem = result.study + ": the way is a single posture"};
  Film film{.heading = heading_with(result, branch)};
  std::vector<std::optional<std::size_t>> frame_of(branch.samples.size());
  for (const std::size_t row : slots_between(result, branch, *from, *to, wish.frames)) {
    if (!frame_of[row]) {
      auto panel = scenes.panel_of(branch.samples[row], branch.samples[row].event, units);
      if (!panel) continue;
      frame_of[row] = film.frames.size();
      film.frames.push_back({std::move(*panel), row});
    }
    film.order.push_back(*frame_of[row]);
  }
  if (film.frames.empty()) return {.problem = result.study + ": no posture is known on the way"};
  const double size = drawing::size_of(film.frames.front().panel.scene);
  film.diagram = diagram_of(planned, result, branch, size, units);
  return {.film = std::move(film)};
}

FilmOutcome mode(const PlannedRun& planned, const RowScenes& scenes, const StudyResult& result,
                 const Branch& branch, const UnitLabels& units, const FilmWish& wish) {
  const std::vector<Mode> modes = modes_on(branch);
  const auto found =
      std::find_if(modes.begin(), modes.end(), [&](const Mode& m) { return m.name == wish.mode; });
  if (found == modes.end()) {
    std::string list;
    for (const Mode& m : modes) list += (list.empty() ? "" : ", ") + m.name;
    return {.problem = "there is no limit point or branch point \"" + wish.mode +
                       "\" with a mode on " + name_of(result, branch) +
                       "; there are: " + (list.empty() ? "none" : list)};
  }
  const analysis::Sample& row = branch.samples[found->row];
  const auto panel = scenes.panel_of(row, wish.mode + ": mode, enlarged", units);
  const auto motion = scenes.motion_at(row, *found->rates);
  double largest = 0;
  for (const auto& velocity : motion) largest = std::max(largest, velocity.norm());
  if (!panel || !(largest > 0)) return {.problem = "the mode at " + wish.mode + " is not known"};
  constexpr double part = 0.07;  // of the mechanism's size: large enough to be seen
  const double size = drawing::size_of(panel->scene), amplitude = part * size / largest;
  const int count = std::min(wish.frames, 24);  // of half a period
  Film film{.heading = heading_with(result, branch),
            .diagram = diagram_of(planned, result, branch, size, units)};
  for (int i = 0; i < count; ++i) {
    const double phase = std::numbers::pi * (static_cast<double>(i) / (count - 1) - 0.5);
    drawing::Frame frame{*panel, found->row};
    for (std::size_t p = 0; p < motion.size(); ++p)
      frame.panel.scene.points[p] += amplitude * std::sin(phase) * motion[p];
    frame.panel.scene.gaps.clear();  // chains close in the first order, which is what is shown
    film.order.push_back(film.frames.size());
    film.frames.push_back(std::move(frame));
  }
  return {.film = std::move(film)};
}

std::string jumps_of(const StudyResult& result) {
  std::string list;
  for (const analysis::Jump& jump : result.snap->jumps)
    if (!jump.motion.empty()) list += (list.empty() ? "" : ", ") + jump.label;
  return list.empty() ? "none" : list;
}

/// The motion after a loss of stability, with its energy over the length of its way.
FilmOutcome jump(const RowScenes& scenes, const StudyResult& result, const UnitLabels& units,
                 const FilmWish& wish) {
  if (!result.snap)
    return {.problem =
                result.study + " has no jumps: it needs kind = \"snap_through\" or snap = true"};
  const auto& jumps = result.snap->jumps;
  const auto found = std::find_if(jumps.begin(), jumps.end(), [&](const analysis::Jump& j) {
    return j.label == wish.jump && !j.motion.empty();
  });
  if (found == jumps.end())
    return {.problem = "there is no jump \"" + wish.jump + "\" with a motion to its landing in " +
                       result.study + "; there are: " + jumps_of(result)};
  const std::string energy = unit_label(analysis::Unit::energy, result.lambda_unit, units);
  Film film{
      .heading = heading_of(result),
      .diagram = {.x_name = "length of way",
                  .y_name = "energy" + (energy.empty() ? "" : " [" + shown_in_line(energy) + "]")}};
  constexpr std::size_t held = 7;
  for (const analysis::SnapMoment& moment : moments_to_landing(*found)) {
    film.diagram.points.push_back({.x = moment.way, .y = moment.state.energy});
    const analysis::Sample row{.values = moment.state.values, .piece = moment.state.piece};
    auto panel = scenes.panel_of(row, wish.jump + " from " + found->from, units);
    if (!panel) continue;
    film.order.push_back(film.frames.size());
    film.frames.push_back({std::move(*panel), film.diagram.points.size() - 1});
  }
  if (film.frames.empty()) return {.problem = result.study + ": no posture is known on the way"};
  film.order.insert(film.order.begin(), held, 0);
  film.order.insert(film.order.end(), held, film.frames.size() - 1);
  return {.film = std::move(film)};
}

}  // namespace

FilmOutcome film_of(const PlannedRun& planned, const StudyResult& result, const UnitLabels& units,
                    const FilmWish& wish) {
  const RowScenes scenes{planned, result};
  if (result.branches.empty() || result.branches.front().samples.empty() || !scenes.has_postures())
    return {.problem = result.study +
                       ": a study of this kind has no branch of postures; "
                       "try springfold draw"};
  if (planned.plan.kind == analysis::StudyKind::map && planned.plan.map.axes.size() > 1)
    return {.problem = result.study +
                       ": the nodes of a map lie on no way; the page shows the posture of each"};
  if (!wish.jump.empty()) return jump(scenes, result, units, wish);
  const Branch* branch = branch_of(result, wish);
  if (branch == nullptr || branch->samples.empty())
    return {.problem = "there is no branch " + std::to_string(wish.branch) + " of " + result.study +
                       "; there are " + std::to_string(result.branches.size())};
  return wish.mode.empty() ? way(planned, scenes, result, *branch, units, wish)
                           : mode(planned, scenes, result, *branch, units, wish);
}

PlannedRun with_rows_for(const FilmWish& wish, PlannedRun planned, const StudyResult& result) {
  const Branch* branch =
      wish.jump.empty() && !result.branches.empty() ? branch_of(result, wish) : nullptr;
  if (branch == nullptr || branch->samples.size() < 2) return planned;
  const auto from = row_of(*branch, wish.from, 0);
  const auto to = row_of(*branch, wish.to, branch->samples.size() - 1);
  if (!from || !to || *from == *to) return planned;
  const double way = std::abs(length_at(result, *branch, *to) - length_at(result, *branch, *from));
  double& spacing = planned.plan.trace.spacing;
  const double wanted = way / wish.frames;
  spacing = spacing > 0 ? std::min(spacing, wanted) : wanted;
  return planned;
}

}  // namespace springfold::io
