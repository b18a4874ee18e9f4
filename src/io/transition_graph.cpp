// The transition graph as GraphML and in Graphviz' language. All texts in it are our own labels and numbers:
// nothing of the case is written.
#include <algorithm>
#include <cmath>
#include <optional>

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

/// Barriers of the first lambda at which they were looked for: a figure has room for one.
std::vector<const Barrier*> shown_barriers(const TransitionReport& report) {
  std::vector<const Barrier*> list;
  for (const Barrier& b : report.barriers)
    if (b.lambda == report.barriers.front().lambda) list.push_back(&b);
  return list;
}

/// Of a state where the barriers are; nothing where no barrier tells it.
std::optional<double> energy_of(const std::vector<const Barrier*>& barriers, int state) {
  for (const Barrier* b : barriers) {
    if (b->first == state) return b->saddle.energy - b->from_first;
    if (b->second == state) return b->saddle.energy - b->from_second;
  }
  return std::nullopt;
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
      key("energy", "node", "double") + key("escape", "node", "double") +
      key("kind", "edge", "string") + key("loading", "edge", "int") +
      key("lambda", "edge", "double") + key("released", "edge", "double") +
      key("from_source", "edge", "double") + key("from_target", "edge", "double") +
      key("lowest_from_source", "edge", "double") + key("lowest_from_target", "edge", "double") +
      "  <graph edgedefault=\"directed\">\n";
  const std::vector<const Barrier*> barriers = shown_barriers(*report);
  for (std::size_t i = 0; i < report->states.size(); ++i) {
    const StableState& s = report->states[i];
    const auto energy = energy_of(barriers, static_cast<int>(i) + 1);
    text += "    <node id=\"" + s.label + "\">" + data("low", csv_number(s.low)) +
            data("high", csv_number(s.high)) + data("reached", truth(s.reached)) +
            data("garden_of_eden", truth(s.is_garden_of_eden)) +
            (energy ? data("energy", csv_number(*energy)) : std::string{}) + escape_of(*report, s) +
            "</node>\n";
  }
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

constexpr int digits = 4;

bool is_arrow(const Transition& t) { return t.to > 0 && !t.is_alternative; }

/// What the signs of the figure mean, as far as they occur.
std::string key_of(const TransitionReport& report) {
  const auto any_arrow = [&](auto is_so) {
    return std::any_of(report.transitions.begin(), report.transitions.end(),
                       [&](const Transition& t) { return is_arrow(t) && is_so(t); });
  };
  std::string key = "a state and the range of the load (lambda) in which it is stable";
  const std::string at =
      report.barriers.empty() ? "" : rounded(report.barriers.front().lambda, digits);
  if (!at.empty()) key += ", and its energy E at lambda = " + at;
  if (std::any_of(report.states.begin(), report.states.end(),
                  [](const StableState& s) { return s.is_garden_of_eden; }))
    key += "\\ldashed: a state that no jump reaches";
  const std::string numbers = "its load, and the energy released in parentheses";
  if (any_arrow([](const Transition& t) { return t.loading > 0; }))
    key += "\\lblue: a jump where the load grows, " + numbers;
  if (any_arrow([](const Transition& t) { return t.loading < 0; }))
    key += "\\lorange: a jump where the load falls, " + numbers;
  if (any_arrow(
          [](const Transition& t) { return t.verdict != analysis::SnapVerdict::unambiguous; }))
    key += "\\ldashed arrow: other damping or masses may lead elsewhere";
  if (!at.empty())
    key +=
        "\\ldotted: a barrier at lambda = " + at + ", and its height above the state at each end";
  return key + "\\l";
}

std::string node_line(const StableState& s, std::optional<double> energy) {
  return "  \"" + s.label + "\" [label=\"" + s.label + "\\n" + rounded(s.low, digits) + " .. " +
         rounded(s.high, digits) + (energy ? "\\nE = " + rounded(*energy, digits) : std::string{}) +
         "\"" + (s.is_garden_of_eden ? ", style=dashed" : "") + "];\n";
}

std::string arrow_line(const Transition& t) {
  // Graphviz takes letters for narrower than most fonts have them: without room words touch the arrows.
  const std::string room = "  ";
  const std::string released = std::isfinite(t.released)
                                   ? "\\n" + room + "(" + rounded(t.released, digits) + ")" + room
                                   : "";
  return "  \"S" + std::to_string(t.from) + "\" -> \"S" + std::to_string(t.to) + "\" [label=\"" +
         room + rounded(t.lambda, digits) + room + released + "\", color=\"" +
         (t.loading > 0 ? "#0072B2" : "#D55E00") + "\"" +
         (t.verdict == analysis::SnapVerdict::unambiguous ? "" : ", style=dashed") + "];\n";
}

/// Without an arrow, and without a say in where the states stand.
std::string barrier_edge(const Barrier& b) {
  const std::string beyond = b.second > 0 ? "S" + std::to_string(b.second) : "outside";
  return "  \"S" + std::to_string(b.first) + "\" -> \"" + beyond +
         "\" [dir=none, style=dotted, constraint=false, color=\"#555555\", taillabel=\"" +
         rounded(b.from_first, digits) + "\"" +
         (std::isfinite(b.from_second) ? ", headlabel=\"" + rounded(b.from_second, digits) + "\""
                                       : std::string{}) +
         "];\n";
}

}  // namespace

std::string transitions_dot(const StudyResult& result) {
  const TransitionReport* report = report_of(result);
  if (report == nullptr) return "";
  const std::vector<const Barrier*> barriers = shown_barriers(*report);
  std::string text =
      "digraph transitions {\n"
      "  label=\"" +
      key_of(*report) +
      "\";\n"
      "  labeljust=l; pad=0.3;\n"
      "  fontname=\"DejaVu Sans\"; fontsize=10;\n"
      "  node [fontname=\"DejaVu Sans\", fontsize=10];\n"
      "  edge [fontname=\"DejaVu Sans\", fontsize=8];\n";
  for (std::size_t i = 0; i < report->states.size(); ++i)
    text += node_line(report->states[i], energy_of(barriers, static_cast<int>(i) + 1));
  if (std::any_of(barriers.begin(), barriers.end(),
                  [](const Barrier* b) { return b->second == 0; }))
    text += "  \"outside\" [shape=plaintext];\n";
  for (const Transition& t : report->transitions)
    if (is_arrow(t)) text += arrow_line(t);
  for (const Barrier* b : barriers) text += barrier_edge(*b);
  return text + "}\n";
}

}  // namespace springfold::io
