// The transition graph as GraphML and in Graphviz' language. All texts in it are our own labels and numbers:
// nothing of the case is written.
#include <algorithm>

#include "springfold/analysis/snap.hpp"
#include "text.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using analysis::Barrier;
using analysis::Escape;
using analysis::StableState;
using analysis::StudyResult;
using analysis::Transition;
using analysis::TransitionReport;

std::string key(const std::string& id, const std::string& of, const std::string& type) {
  return "  <key id=\"" + id + "\" for=\"" + of + "\" attr.name=\"" + id + "\" attr.type=\"" +
         type + "\"/>\n";
}

std::string data(const std::string& id, const std::string& value) {
  return "<data key=\"" + id + "\">" + value + "</data>";
}

/// At the first lambda at which barriers were looked for; nothing where none was found.
std::string escape_of(const TransitionReport& report, const StableState& state) {
  for (const Escape& e : report.escapes)
    if (report.states[static_cast<std::size_t>(e.state - 1)].label == state.label)
      return data("escape", csv_number(e.energy));
  return "";
}

std::string truth(bool value) { return value ? "true" : "false"; }

}  // namespace

std::vector<std::string> graph_names(const std::vector<StudyResult>& results) {
  std::vector<std::string> list;
  UniqueNames names;
  for (const StudyResult& result : results)
    list.push_back(report_of(result) == nullptr ? ""
                                                : names.make(safe_file_name(result.study) + "-" +
                                                             std::to_string(result.run)));
  return list;
}

std::string transitions_graphml(const StudyResult& result) {
  const TransitionReport* report = report_of(result);
  if (report == nullptr) return "";
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n" +
      key("low", "node", "double") + key("high", "node", "double") +
      key("reached", "node", "boolean") + key("garden_of_eden", "node", "boolean") +
      key("escape", "node", "double") + key("kind", "edge", "string") +
      key("loading", "edge", "int") + key("lambda", "edge", "double") +
      key("released", "edge", "double") + key("from_source", "edge", "double") +
      key("from_target", "edge", "double") + key("lowest_from_source", "edge", "double") +
      key("lowest_from_target", "edge", "double") + "  <graph edgedefault=\"directed\">\n";
  for (const StableState& s : report->states)
    text += "    <node id=\"" + s.label + "\">" + data("low", csv_number(s.low)) +
            data("high", csv_number(s.high)) + data("reached", truth(s.reached)) +
            data("garden_of_eden", truth(s.is_garden_of_eden)) + escape_of(*report, s) +
            "</node>\n";
  for (const Transition& t : report->transitions)
    if (t.to > 0 && !t.is_alternative)
      text += "    <edge source=\"S" + std::to_string(t.from) + "\" target=\"S" +
              std::to_string(t.to) + "\">" + data("kind", t.jump > 0 ? "jump" : "handover") +
              data("loading", std::to_string(t.loading)) + data("lambda", csv_number(t.lambda)) +
              data("released", csv_number(t.released)) + "</edge>\n";
  for (const Barrier& b : report->barriers)
    if (b.second > 0)
      text += "    <edge directed=\"false\" source=\"S" + std::to_string(b.first) +
              "\" target=\"S" + std::to_string(b.second) + "\">" + data("kind", "barrier") +
              data("lambda", csv_number(b.lambda)) + data("from_source", csv_number(b.from_first)) +
              data("from_target", csv_number(b.from_second)) +
              data("lowest_from_source", csv_number(b.lowest_from_first)) +
              data("lowest_from_target", csv_number(b.lowest_from_second)) + "</edge>\n";
  return text + "  </graph>\n</graphml>\n";
}

namespace {

bool is_arrow(const Transition& t) { return t.to > 0 && !t.is_alternative; }

/// What the signs of the figure mean, as far as they occur.
std::string key_of(const TransitionReport& report) {
  const auto any_arrow = [&](auto is_so) {
    return std::any_of(report.transitions.begin(), report.transitions.end(),
                       [&](const Transition& t) { return is_arrow(t) && is_so(t); });
  };
  std::string key = "a state and the range of the load (lambda) in which it is stable";
  if (std::any_of(report.states.begin(), report.states.end(),
                  [](const StableState& s) { return s.is_garden_of_eden; }))
    key += "\\ldashed: a state that no jump reaches";
  if (any_arrow([](const Transition& t) { return t.loading > 0; }))
    key += "\\lblue: a jump where the load grows, and its load";
  if (any_arrow([](const Transition& t) { return t.loading < 0; }))
    key += "\\lorange: a jump where the load falls";
  if (any_arrow(
          [](const Transition& t) { return t.verdict != analysis::SnapVerdict::unambiguous; }))
    key += "\\ldashed arrow: other damping or masses may lead elsewhere";
  return key + "\\l";
}

}  // namespace

std::string transitions_dot(const StudyResult& result) {
  const TransitionReport* report = report_of(result);
  if (report == nullptr) return "";
  constexpr int digits = 4;
  std::string text =
      "digraph transitions {\n"
      "  label=\"" +
      key_of(*report) +
      "\";\n"
      "  labeljust=l;\n"
      "  fontname=\"DejaVu Sans\"; fontsize=10;\n"
      "  node [fontname=\"DejaVu Sans\", fontsize=10];\n"
      "  edge [fontname=\"DejaVu Sans\", fontsize=8];\n";
  for (const StableState& s : report->states)
    text += "  \"" + s.label + "\" [label=\"" + s.label + "\\n" + rounded(s.low, digits) + " .. " +
            rounded(s.high, digits) + "\"" + (s.is_garden_of_eden ? ", style=dashed" : "") + "];\n";
  for (const Transition& t : report->transitions)
    if (is_arrow(t))
      text += "  \"S" + std::to_string(t.from) + "\" -> \"S" + std::to_string(t.to) +
              "\" [label=\"" + rounded(t.lambda, digits) + "\", color=\"" +
              (t.loading > 0 ? "#0072B2" : "#D55E00") + "\"" +
              (t.verdict == analysis::SnapVerdict::unambiguous ? "" : ", style=dashed") + "];\n";
  return text + "}\n";
}

}  // namespace springfold::io
