// [[plot]] tables with parameters as axes: special points of runs, boundaries, shaded loads.
#include <algorithm>

#include "figure.hpp"
#include "plot_reader.hpp"
#include "result_access.hpp"

namespace springfold::io {
namespace {

std::string parameter_named(const std::string& quantity) {
  return quantity.substr(std::string_view{parameter_prefix}.size());
}

/// Reports what has no meaning where runs are points.
void check_points(const TableReader& table, const PlotSpec& spec, Reading& reading) {
  if (spec.polar)
    reading.problems.add(table.find("polar")->place, table.key_of("polar"),
                         "got true, need false: a parameter is no angle");
  for (const PlotCurves& curves : spec.curves)
    if (!curves.labels.empty()) {
      reading.problems.add(table.find("curves")->place, table.key_of("curves"),
                           "labels name runs, need none: lines over a parameter have the names "
                           "of their points");
      return;
    }
}

/// A figure of special points over a parameter: what its studies vary.
void check_over(const PlotDraft& draft, const std::vector<StudyDraft>& studies, Reading& reading) {
  const PlotSpec& spec = draft.spec;
  const std::string name = parameter_named(spec.x);
  for (const PlotCurves& curves : spec.curves)
    for (const StudyDraft& study : studies) {
      if (study.name != curves.study || !study.runs_known) continue;
      std::vector<std::string> varied;
      if (study.vary)
        for (const std::size_t p : study.vary->parameters)
          varied.push_back(parameter_prefix + (*reading.parameters)[p].name);
      if (std::find(varied.begin(), varied.end(), spec.x) == varied.end())
        reading.problems.add(draft.x.place, draft.x.key,
                             "got \"" + spec.x + "\", need a parameter that study \"" + study.name +
                                 "\" varies" + suggestion(spec.x, varied));
    }
}

/// A plane of two parameters: each study looks for one of them, and the other one is a parameter of the case.
void check_plane(const PlotDraft& draft, const std::vector<StudyDraft>& studies, Reading& reading) {
  std::vector<std::string> known;
  for (const Parameter& parameter : *reading.parameters)
    known.push_back(parameter_prefix + parameter.name);
  for (const NamedPlace* axis : {&draft.x, &draft.y.front()})
    if (std::find(known.begin(), known.end(), axis->name) == known.end())
      reading.problems.add(axis->place, axis->key,
                           "got \"" + axis->name + "\", need a parameter of the case" +
                               suggestion(axis->name, known));
  if (draft.spec.x == draft.spec.y)
    reading.problems.add(draft.y.front().place, draft.y.front().key,
                         "got \"" + draft.spec.y + "\", need another parameter than x");
  for (const PlotCurves& curves : draft.spec.curves)
    for (const StudyDraft& study : studies) {
      if (study.name != curves.study) continue;
      const std::string looked_for = parameter_prefix + study.critical.parameter;
      const bool fits = (study.kind == analysis::StudyKind::threshold ||
                         study.kind == analysis::StudyKind::critical_curve) &&
                        (looked_for == draft.spec.x || looked_for == draft.spec.y);
      if (!fits)
        reading.problems.add(draft.y.front().place, draft.y.front().key,
                             "study \"" + study.name +
                                 "\" does not fit, need one of kind "
                                 "threshold or critical_curve whose parameter is x or y");
    }
}

/// Shaded loads: somebody must know which critical load comes first.
void check_shade(const TableReader& table, const PlotSpec& spec,
                 const std::vector<StudyDraft>& studies, Reading& reading) {
  const bool any = std::any_of(spec.curves.begin(), spec.curves.end(), [&](const auto& curves) {
    return std::any_of(studies.begin(), studies.end(), [&](const StudyDraft& study) {
      return study.name == curves.study && study.kind == analysis::StudyKind::critical_load &&
             study.control != analysis::ControlMode::parameter &&
             study.critical.parameter == spec.x && spec.y == "lambda" && spec.more_y.empty();
    });
  });
  if (any && !spec.polar) return;
  reading.problems.add(table.find("shade")->place, table.key_of("shade"),
                       "got true, need y = \"lambda\" over the parameter of a study of kind "
                       "critical_load, not polar: only such a study says which load comes first");
}

}  // namespace

void check_parameter_plot(const TableReader& table, const PlotDraft& draft,
                          const std::vector<StudyDraft>& studies, Reading& reading) {
  const PlotSpec& spec = draft.spec;
  if (spec.shade) check_shade(table, spec, studies, reading);
  if (is_in_plane(spec))
    check_plane(draft, studies, reading);
  else if (is_over_parameter(spec))
    check_over(draft, studies, reading);
  if (is_over_parameter(spec)) check_points(table, spec, reading);
}

}  // namespace springfold::io
