// Figures of the boundary in a plane of two parameters: thresholds of runs, and degeneracies of critical curves.
#include <algorithm>
#include <cmath>

#include "figure.hpp"
#include "result_access.hpp"
#include "stability_parts.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyKind;
using analysis::StudyResult;

std::string plane_name(const std::string& quantity) {
  return quantity.substr(std::string_view{parameter_prefix}.size());
}

/// One run in the plane: where its point lies, and what decides there.
struct BoundaryPoint {
  double across = 0;    ///< the parameter that the study does not look for
  PlotPoint at{};       ///< not finite: the run has no point
  std::string piece{};  ///< empty: the run is not resolved
  std::string code{};
  bool has_none = false;  ///< no value of the parameter removes what is unwanted
};

/// The boundary of one study: its runs by the parameter that it does not look for.
struct StudyBoundary {
  std::string study{};
  bool is_threshold = false, is_smallest = true, of_stability = false;
  std::string parameter{};  ///< that it looks for
  std::vector<BoundaryPoint> points{};
};

class Plane {
 public:
  explicit Plane(const PlotSpec& spec) : spec_{spec} {}

  /// A point of the plane: the value of `parameter`, and that of the other one.
  PlotPoint place(const std::string& parameter, double value, double other) const {
    const bool along_x = parameter == plane_name(spec_.x);
    return {spec_.x_factor * (along_x ? value : other), spec_.y_factor * (along_x ? other : value)};
  }

  /// The other parameter of the plane in a run, which a curve that begins at another one holds.
  double across(const PlannedRun& planned, const StudyResult& result) const {
    const std::string& own = planned.plan.critical.parameter;
    const std::string other = plane_name(own == plane_name(spec_.x) ? spec_.y : spec_.x);
    const auto& held = planned.plan.critical.parameters;
    const bool is_held = planned.plan.kind == StudyKind::critical_curve &&
                         std::find(held.begin(), held.end(), other) != held.end();
    return is_held && !result.branches.empty() ? value_at(result, result.branches.front(), 0, other)
                                               : planned.parameters.at(other);
  }

 private:
  const PlotSpec& spec_;
};

bool is_boundary_point(StudyKind kind, EventKind event) {
  if (kind == StudyKind::threshold) return event == EventKind::threshold;
  switch (event) {
    case EventKind::cusp:
    case EventKind::isola_centre:
    case EventKind::crossing:
    case EventKind::hilltop:
    case EventKind::branch_points_merge:
    case EventKind::more_modes:
    case EventKind::fold_meets_activation:
    case EventKind::corner_loses_reversal:
    case EventKind::touches_activation:
    case EventKind::two_activations:
    case EventKind::bends_other_way:
    case EventKind::parameter_turns:
      return true;
    default:
      return false;
  }
}

void add_run_points(const Plane& plane, const PlannedRun& planned, const StudyResult& result,
                    StudyBoundary& boundary) {
  const double across = plane.across(planned, result);
  const double none = std::nan("");
  const std::string& parameter = planned.plan.critical.parameter;
  bool any = false;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Event& event : branch.events) {
      if (!is_boundary_point(planned.plan.kind, event.kind)) continue;
      any = true;
      const double value = value_at(result, branch, event.row, parameter);
      boundary.points.push_back({across, plane.place(parameter, value, across), event.detail,
                                 analysis::code_of(event.kind)});
    }
  if (any) return;
  const bool has_none = result.threshold && !result.threshold->found && complete(result);
  boundary.points.push_back({across, {none, none}, "", "", has_none});
}

StudyBoundary boundary_of(const Case& the_case, const Plane& plane, const PlotCurves& curves,
                          const std::vector<StudyResult>& results) {
  StudyBoundary boundary{.study = curves.study};
  for (const PlannedRun& planned : the_case.runs) {
    const bool shown = curves.runs.empty() || std::find(curves.runs.begin(), curves.runs.end(),
                                                        planned.run) != curves.runs.end();
    if (planned.study != curves.study || !shown) continue;
    boundary.is_threshold = planned.plan.kind == StudyKind::threshold;
    boundary.is_smallest = planned.plan.critical.smallest;
    boundary.of_stability = planned.plan.critical.unwanted == analysis::Unwanted::loss_of_stability;
    boundary.parameter = planned.plan.critical.parameter;
    if (const StudyResult* result = result_of(results, planned.study, planned.run))
      add_run_points(plane, planned, *result, boundary);
  }
  std::stable_sort(boundary.points.begin(), boundary.points.end(),
                   [](const auto& a, const auto& b) { return a.across < b.across; });
  return boundary;
}

/// "fold meets activation: spring knee (...)": which spring it is, and where, is another one for every run.
std::string piece_name(const StudyBoundary& boundary, const BoundaryPoint& point) {
  return boundary.is_threshold ? point.piece : point.piece.substr(0, point.piece.find(':'));
}

/// Pieces of one name have one colour.
int hue_of(const std::string& piece, std::vector<std::string>& names) {
  const auto known = std::find(names.begin(), names.end(), piece);
  const auto hue = static_cast<int>(known - names.begin()) + 1;
  if (known == names.end()) names.push_back(piece);
  return hue;
}

void add_region_part(const std::string& name, bool is_wanted, Polyline outline, Figure& figure) {
  const auto known = std::find_if(figure.regions.begin(), figure.regions.end(),
                                  [&](const FigureRegion& region) { return region.name == name; });
  if (known != figure.regions.end()) return known->parts.push_back(std::move(outline));
  figure.regions.push_back({name, is_wanted, {std::move(outline)}});
}

/// Runs next to each other in which the same decides are joined; beyond the line nothing unwanted happens.
void add_pieces(const StudyBoundary& boundary, const Plane& plane, std::vector<std::string>& names,
                Figure& figure) {
  const auto& points = boundary.points;
  for (std::size_t first = 0, last = 0; first < points.size(); first = last + 1) {
    last = first;
    if (!is_finite(points[first].at)) continue;
    Polyline line{points[first].at};
    const std::string name = piece_name(boundary, points[first]);
    while (last + 1 < points.size() && is_finite(points[last + 1].at) &&
           piece_name(boundary, points[last + 1]) == name)
      line.push_back(points[++last].at);
    for (const PlotPoint& at : line) figure.marks.push_back({points[first].code, "", at});
    if (line.size() < 2) continue;
    figure.curves.push_back(
        {.label = {name}, .parts = {{Stability::stable, line}}, .hue = hue_of(name, names)});
    if (!boundary.is_threshold) continue;
    const double beyond = boundary.is_smallest ? HUGE_VAL : -HUGE_VAL;
    for (const std::size_t end : {last, first})
      line.push_back(plane.place(boundary.parameter, beyond, points[end].across));
    add_region_part(boundary.of_stability ? "no loss of stability" : "no limit point", true,
                    std::move(line), figure);
  }
}

/// Where between a run with and one without an answer the boundary of another study ends that of this one.
double wall_between(double from, double to, const StudyBoundary& boundary, const PlotSpec& spec,
                    const std::vector<StudyBoundary>& others) {
  const bool along_x =
      boundary.parameter != plane_name(spec.x);  // of what the study does not look for
  double wall = to;
  for (const StudyBoundary& other : others)
    for (const BoundaryPoint& point : other.points) {
      if (other.parameter == boundary.parameter || !is_finite(point.at)) continue;
      const double at = along_x ? point.at.first / spec.x_factor : point.at.second / spec.y_factor;
      if ((at - from) * (at - to) < 0 && std::abs(at - from) < std::abs(wall - from)) wall = at;
    }
  return wall;
}

/// Runs in which no value is the answer.
void add_nowhere(const StudyBoundary& boundary, const Plane& plane, const PlotSpec& spec,
                 const std::vector<StudyBoundary>& all, Figure& figure) {
  const auto& points = boundary.points;
  for (std::size_t first = 0, last = 0; first < points.size(); first = last + 1) {
    last = first;
    if (!points[first].has_none) continue;
    while (last + 1 < points.size() && points[last + 1].has_none) ++last;
    double low = points[first].across, high = points[last].across;
    if (first > 0 && is_finite(points[first - 1].at))
      low = wall_between(points[first - 1].across, low, boundary, spec, all);
    if (last + 1 < points.size() && is_finite(points[last + 1].at))
      high = wall_between(points[last + 1].across, high, boundary, spec, all);
    Polyline outline;
    for (const auto& [value, across] :
         {std::pair{-HUGE_VAL, low}, {HUGE_VAL, low}, {HUGE_VAL, high}, {-HUGE_VAL, high}})
      outline.push_back(plane.place(boundary.parameter, value, across));
    add_region_part("no value of " + boundary.parameter + " removes it", false, std::move(outline),
                    figure);
  }
}

}  // namespace

bool is_in_plane(const PlotSpec& spec) {
  return spec.x.starts_with(parameter_prefix) && spec.y.starts_with(parameter_prefix) &&
         spec.more_y.empty();
}

void add_boundary(const Case& the_case, const PlotSpec& spec,
                  const std::vector<StudyResult>& results, Figure& figure) {
  figure.tells_stability = false;
  const auto title = [&](const std::string& given, const std::string& quantity, double factor) {
    if (!given.empty()) return FigureText{given, spec.markup};
    return FigureText{(factor == 1 ? "" : factor_text(factor)) +
                      parameter_title(plane_name(quantity), the_case.units)};
  };
  figure.x_title = title(spec.x_label, spec.x, spec.x_factor);
  figure.y_title = title(spec.y_label, spec.y, spec.y_factor);
  const Plane plane{spec};
  std::vector<StudyBoundary> all;
  for (const PlotCurves& curves : spec.curves)
    all.push_back(boundary_of(the_case, plane, curves, results));
  std::vector<std::string> names;
  for (const StudyBoundary& boundary : all) add_pieces(boundary, plane, names, figure);
  for (const StudyBoundary& boundary : all)
    if (boundary.is_threshold) add_nowhere(boundary, plane, spec, all, figure);
}

}  // namespace springfold::io
