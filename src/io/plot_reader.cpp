#include "plot_reader.hpp"

#include <algorithm>

#include "figure.hpp"
#include "gnuplot_text.hpp"
#include "result_access.hpp"

namespace springfold::io {
namespace {

PlotCurves read_curves(const Item& item, const std::vector<StudyDraft>& studies, Reading& reading) {
  const TableReader table{*item.node, item.key, {"study", "runs", "labels"}, reading};
  PlotCurves curves;
  curves.study = table.required_text("study", "the name of a study").value_or("");
  curves.labels = read_texts(table.list("labels", "a list of texts"), reading);
  const std::vector<Item> runs = table.list("runs", "a list of run numbers");
  if (curves.study.empty()) return curves;
  const auto study =
      study_number(curves.study, {table.find("study"), table.key_of("study")}, studies, reading);
  if (!study) return curves;
  for (const Item& run : runs)
    if (const auto number = read_run(run, studies[*study], reading)) curves.runs.push_back(*number);
  const std::size_t count =
      runs.empty() ? static_cast<std::size_t>(studies[*study].runs()) : runs.size();
  const Node* labels = table.find("labels");
  const bool countable =
      labels && labels->kind == Node::Kind::array && (!runs.empty() || studies[*study].runs_known);
  if (countable && labels->items.size() != count)
    reading.problems.add(
        labels->place, table.key_of("labels"),
        "got " + described(*labels) + ", need " + std::to_string(count) + ": one for every run");
  return curves;
}

/// Reports all texts of a plot that are not usable as markup.
void check_markup(const Item& item, Reading& reading) {
  const Node& node = *item.node;
  if (const std::string problem = markup_problem(node.text);
      node.kind == Node::Kind::text && !problem.empty())
    reading.problems.add(node.place, item.key, problem + ", which markup does not allow");
  for (const Node& one : node.items) check_markup({&one, item.key}, reading);
  for (const NodeEntry& entry : node.entries)
    check_markup({&entry.value, item.key + "." + entry.key}, reading);
}

/// Labels of `vary` stand beside curves that have none of their own.
void check_vary_labels(const Item& markup, const PlotCurves& curves,
                       const std::vector<StudyDraft>& studies, Reading& reading) {
  if (!curves.labels.empty()) return;
  for (const StudyDraft& study : studies) {
    if (study.name != curves.study || !study.vary) continue;
    for (const std::string& label : study.vary->labels)
      if (const std::string problem = markup_problem(label); !problem.empty())
        reading.problems.add(markup.node->place, markup.key,
                             "vary.labels of study \"" + study.name + "\": " + problem +
                                 ", which markup does not allow");
  }
}

/// How `curves` is written, with what was meant if that can be seen.
std::string curves_example(const Node* curves, const std::vector<StudyDraft>& studies) {
  std::string study = "...";
  const Node* named = curves;
  if (curves && curves->kind == Node::Kind::array && !curves->items.empty())
    named = &curves->items.front();
  if (named && named->kind == Node::Kind::table && named->find("study"))
    named = named->find("study");
  const auto has_name = [named](const StudyDraft& s) { return s.name == named->text; };
  if (named && named->kind == Node::Kind::text &&
      std::any_of(studies.begin(), studies.end(), has_name))
    study = named->text;
  return "curves = [{ study = \"" + study + "\" }]";
}

NamedPlace read_quantity(const TableReader& table, const std::string& name,
                         const std::string& otherwise) {
  const Node* node = table.find(name);
  return {table.text(name).value_or(otherwise), node ? node->place : table.place(),
          table.key_of(name)};
}

/// One quantity, or a list of them.
std::vector<NamedPlace> read_ordinates(const TableReader& table, const std::string& otherwise,
                                       Reading& reading) {
  const Node* node = table.find("y");
  if (!node || node->kind != Node::Kind::array) return {read_quantity(table, "y", otherwise)};
  std::vector<NamedPlace> ordinates;
  for (const Item& item : table.list("y", "a quantity, or a list of them"))
    if (item.node->kind == Node::Kind::text)
      ordinates.push_back({item.node->text, item.node->place, item.key});
    else
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) + ", need a quantity such as \"force\"");
  if (node->items.empty())
    reading.problems.add(node->place, table.key_of("y"),
                         "got an empty list, need at least one quantity");
  return ordinates;
}

void check_polar(const TableReader& table, const PlotSpec& spec, Reading& reading) {
  for (const auto& [key, is_log] :
       {std::pair{"x_log", spec.look.x_log}, {"y_log", spec.look.y_log}})
    if (spec.polar && is_log)
      reading.problems.add(
          table.find(key)->place, table.key_of(key),
          "got true, need false beside polar = true: both axes show distances from "
          "the origin, which a logarithmic axis does not have");
}

}  // namespace

std::optional<int> read_run(const Item& item, const StudyDraft& study, Reading& reading) {
  const double value = item.node->number;
  const bool whole = item.node->kind == Node::Kind::number && value >= 1 && value <= 1e6 &&
                     value == static_cast<int>(value);
  if (whole && (value <= study.runs() || !study.runs_known)) return static_cast<int>(value);
  const std::string range =
      study.runs() == 1 ? "1: the study has one run" : "1 to " + std::to_string(study.runs());
  reading.problems.add(item.node->place, item.key,
                       "got " + described(*item.node) + ", need the number of a run of \"" +
                           study.name + "\", " + range);
  return std::nullopt;
}

void check_plot_name(const TableReader& table, const std::string& name,
                     const std::set<std::string>& taken, Reading& reading) {
  if (name.empty()) return;
  const Item at{table.find("name"), table.key_of("name")};
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  if (name.front() == '.' || !std::all_of(name.begin(), name.end(), fits))
    reading.problems.add(
        at.node->place, at.key,
        "got \"" + name + "\", need a file name without ending: letters, digits, '_', '-', '.'");
  if (taken.contains(name))
    reading.problems.add(at.node->place, at.key,
                         "\"" + name +
                             "\" is already the name of another plot, need different "
                             "names");
}

std::optional<std::size_t> study_number(const std::string& name, const Item& at,
                                        const std::vector<StudyDraft>& studies, Reading& reading) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    if (studies[i].name == name) return i;
    known.push_back(studies[i].name);
  }
  if (studies.empty()) return std::nullopt;  // already reported
  reading.problems.add(at.node->place, at.key,
                       "no study \"" + name + "\"" + suggestion(name, known));
  return std::nullopt;
}

bool read_markup(const TableReader& table, const Item& plot, Reading& reading) {
  const bool markup = table.truth("markup", false);
  if (markup) check_markup(plot, reading);
  return markup;
}

std::vector<PlotDraft> read_plots(const std::vector<Item>& tables,
                                  const std::vector<StudyDraft>& studies, Reading& reading) {
  std::vector<std::string> keys{"name",     "title",    "x",      "y",      "x_label", "y_label",
                                "x_factor", "y_factor", "markup", "curves", "polar",   "shade"};
  keys.insert(keys.end(), look_keys().begin(), look_keys().end());
  std::vector<PlotDraft> plots;
  std::set<std::string> taken;
  for (const Item& item : tables) {
    const TableReader table{*item.node, item.key, keys, reading};
    PlotDraft draft;
    PlotSpec& spec = draft.spec;
    spec.name = table.required_text("name", "a file name without ending").value_or("");
    check_plot_name(table, spec.name, taken, reading);
    taken.insert(spec.name);
    spec.title = table.text("title").value_or("");
    draft.x = read_quantity(table, "x", spec.x);
    draft.y = read_ordinates(table, spec.y, reading);
    spec.x = draft.x.name;
    if (!draft.y.empty()) spec.y = draft.y.front().name;
    for (std::size_t i = 1; i < draft.y.size(); ++i) spec.more_y.push_back(draft.y[i].name);
    spec.x_label = table.text("x_label").value_or("");
    spec.y_label = table.text("y_label").value_or("");
    spec.polar = table.flag("polar", false);
    draft.x_factor = table.number("x_factor", {}, draft.numbers, 1);
    draft.y_factor = table.number("y_factor", {}, draft.numbers, 1);
    draft.look = read_look(table, spec.look, draft.numbers, reading);
    check_polar(table, spec, reading);
    spec.markup = read_markup(table, item, reading);
    const Node* curves = table.require("curves", "a list such as [{ study = \"...\" }]");
    for (const Item& curve : table.tables("curves", curves_example(curves, studies)))
      spec.curves.push_back(read_curves(curve, studies, reading));
    if (curves && curves->kind == Node::Kind::array && curves->items.empty())
      reading.problems.add(curves->place, table.key_of("curves"),
                           "got an empty list, need at least one curve");
    spec.shade = table.flag("shade", false);
    check_parameter_plot(table, draft, studies, reading);
    if (spec.markup)
      for (const PlotCurves& of : spec.curves)
        check_vary_labels({table.find("markup"), table.key_of("markup")}, of, studies, reading);
    plots.push_back(std::move(draft));
  }
  return plots;
}

}  // namespace springfold::io
