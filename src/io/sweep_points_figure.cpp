// Figures of special points over a parameter that a study varies.
#include <algorithm>
#include <cmath>

#include "figure.hpp"
#include "result_access.hpp"
#include "stability_parts.hpp"
#include "sweep_points.hpp"
#include "sweep_tracks.hpp"

namespace springfold::io {
namespace {

/// A run that has the point, or that stands for a gap: then `at` is not finite.
struct SweepMark {
  double parameter = 0;
  PlotPoint at{};
};

std::string parameter_of(const PlotSpec& spec) {
  return spec.x.substr(std::string_view{parameter_prefix}.size());
}

bool is_shown(const PlotCurves& curves, int run) {
  return curves.runs.empty() ||
         std::find(curves.runs.begin(), curves.runs.end(), run) != curves.runs.end();
}

/// The runs that are shown, by the parameter.
std::vector<const SweepPoints::Run*> runs_of(const SweepPoints& sweep, const PlotCurves& curves,
                                             const std::string& parameter) {
  std::vector<const SweepPoints::Run*> runs;
  for (const SweepPoints::Run& run : sweep.runs)
    if (is_shown(curves, run.planned->run)) runs.push_back(&run);
  std::stable_sort(runs.begin(), runs.end(), [&](const auto* a, const auto* b) {
    return varied_value(a->planned, parameter) < varied_value(b->planned, parameter);
  });
  return runs;
}

/// The points of a track in all runs.
std::vector<SweepMark> marks_of(const std::vector<const SweepPoints::Run*>& runs,
                                const SweepTrack& track, const PlotSpec& spec,
                                const std::string& quantity) {
  std::vector<SweepMark> marks;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double parameter = varied_value(runs[r]->planned, parameter_of(spec));
    const auto& place = track.points[r] ? runs[r]->places[*track.points[r]] : std::nullopt;
    const double up =
        place ? value_at(*runs[r]->result, *place->branch, place->row, quantity) : std::nan("");
    marks.push_back({parameter, {spec.x_factor * parameter, spec.y_factor * up}});
  }
  return marks;
}

/// Lines from run to run, broken where a run has no such point.
std::vector<CurvePart> joined(const std::vector<SweepMark>& marks) {
  std::vector<CurvePart> parts;
  bool goes_on = false;
  for (const SweepMark& mark : marks) {
    if (is_finite(mark.at)) {
      if (!goes_on) parts.push_back({Stability::stable, {}});
      parts.back().line.push_back(mark.at);
    }
    goes_on = is_finite(mark.at);
  }
  std::erase_if(parts, [](const CurvePart& part) { return part.line.size() < 2; });
  return parts;
}

/// Where several parameters vary neighbours are no neighbours: the points of one label.
std::vector<SweepTrack> labelled(const SweepPoints& sweep,
                                 const std::vector<const SweepPoints::Run*>& runs) {
  std::vector<SweepTrack> tracks;
  for (std::size_t i = 0; i < sweep.labels.size(); ++i) {
    tracks.push_back({.name = sweep.labels[i], .code = sweep.codes[i]});
    for (const SweepPoints::Run* run : runs)
      tracks.back().points.push_back(run->places[i] ? std::optional{i} : std::nullopt);
  }
  return tracks;
}

/// The points of one track: marks, joined where nothing else varies.
void add_track(const std::vector<SweepMark>& marks, const std::string& code,
               const std::string& label, bool is_joined, Figure& figure) {
  FigureCurve curve{.label = {label}, .hue = static_cast<int>(figure.curves.size()) + 1};
  if (is_joined) curve.parts = joined(marks);
  bool is_named = !curve.parts.empty();
  for (const SweepMark& mark : marks) {
    if (!is_finite(mark.at)) continue;
    figure.marks.push_back({code, is_named ? "" : label, mark.at});
    is_named = true;
  }
  if (curve.parts.empty()) return;
  const auto twin =
      std::find_if(figure.curves.begin(), figure.curves.end(),
                   [&curve](const FigureCurve& other) { return look_alike(other, curve); });
  if (twin == figure.curves.end())
    figure.curves.push_back(std::move(curve));
  else
    twin->label.text += ", " + label;
}

}  // namespace

bool is_over_parameter(const PlotSpec& spec) { return spec.x.starts_with(parameter_prefix); }

void add_sweep_points(const Case& the_case, const PlotSpec& spec,
                      const std::vector<analysis::StudyResult>& results, Figure& figure) {
  figure.tells_stability = false;
  std::vector<std::string> quantities{spec.y};
  quantities.insert(quantities.end(), spec.more_y.begin(), spec.more_y.end());
  figure.x_title = {spec.x_label, spec.markup};
  if (spec.x_label.empty())
    figure.x_title = {(spec.x_factor == 1 ? "" : factor_text(spec.x_factor)) +
                      parameter_title(parameter_of(spec), the_case.units)};
  for (const SweepPoints& sweep : sweep_points_of(the_case, results))
    for (const PlotCurves& curves : spec.curves) {
      if (curves.study != sweep.study) continue;
      const auto& names = sweep.parameters;
      if (std::find(names.begin(), names.end(), parameter_of(spec)) == names.end()) continue;
      if (figure.y_title.text.empty())
        figure.y_title = ordinate_title(spec, *sweep.runs.front().result,
                                        sweep.runs.front().planned, the_case.units);
      const std::string of_study = spec.curves.size() > 1 ? sweep.study + ": " : "";
      const auto runs = runs_of(sweep, curves, parameter_of(spec));
      const bool is_joined = sweep.parameters.size() == 1;
      const auto tracks = is_joined ? tracks_of(sweep, runs) : labelled(sweep, runs);
      for (const std::string& quantity : quantities)
        for (const SweepTrack& track : tracks)
          add_track(marks_of(runs, track, spec, quantity), track.code,
                    of_study + track.name + (quantities.size() > 1 ? ", " + quantity : ""),
                    is_joined, figure);
    }
}

}  // namespace springfold::io
