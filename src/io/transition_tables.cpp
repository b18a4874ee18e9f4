// Stable states and their transitions in the summary, as JSON and as tables.
#include <algorithm>
#include <cmath>
#include <limits>

#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "text.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using Json = nlohmann::ordered_json;
using analysis::Barrier;
using analysis::StableState;
using analysis::StudyResult;
using analysis::Transition;
using analysis::TransitionReport;

constexpr int digits = 10;
constexpr std::size_t label_width = 14;  // of the label column of the summary

std::string line(std::string label, const std::string& text) {
  label.resize(std::max(label.size(), label_width), ' ');
  return "    " + label + text + "\n";
}

const TransitionReport* report_of(const StudyResult& result) {
  return result.snap && result.snap->transitions ? &*result.snap->transitions : nullptr;
}

std::string name_of(int state) { return state > 0 ? "S" + std::to_string(state) : ""; }

std::string memory_word(TransitionReport::Memory memory) {
  switch (memory) {
    case TransitionReport::Memory::holds:
      return "holds";
    case TransitionReport::Memory::fails:
      return "fails";
    case TransitionReport::Memory::undecided:
      return "undecided";
  }
  return "";
}

/// "S2, S5": where a state is left to in one sense.
std::string exits(const TransitionReport& report, int state, int loading) {
  std::string text;
  for (const Transition& t : report.transitions)
    if (t.from == state && t.loading == loading && !t.is_alternative)
      text += (text.empty() ? "" : " or ") + (t.to > 0 ? name_of(t.to) : std::string{"unknown"});
  return text;
}

std::string state_line(const TransitionReport& report, std::size_t i) {
  const StableState& s = report.states[i];
  const auto number = static_cast<int>(i) + 1;
  const auto end = [&](int loading, bool is_limit) {
    return is_limit ? std::string{"the range ends"} : exits(report, number, loading);
  };
  return line(s.label, "lambda " + rounded(s.low, digits) + " to " + rounded(s.high, digits) +
                           "; down: " + end(-1, s.low_is_limit) +
                           ", up: " + end(1, s.high_is_limit) +
                           (s.is_garden_of_eden ? "; Garden of Eden: nothing leads here" : "") +
                           (s.reached ? "" : "; not reached from S1"));
}

std::string common(const StudyResult& result) {
  return csv_text(result.study) + "," + std::to_string(result.run) + "," + csv_text(result.label) +
         ",";
}

std::string with_rows(const std::string& head, const std::vector<StudyResult>& results,
                      void (*add)(const StudyResult&, const TransitionReport&, std::string&)) {
  std::string rows;
  bool is_any = false;
  for (const StudyResult& result : results)
    if (const TransitionReport* report = report_of(result)) {
      is_any = true;
      add(result, *report, rows);
    }
  return is_any ? "study,run,label," + head + "\n" + rows : "";
}

Json json_of(const StableState& s) {
  return {{"label", s.label},
          {"branch", s.branch},
          {"low", s.low},
          {"high", s.high},
          {"low_is_limit", s.low_is_limit},
          {"high_is_limit", s.high_is_limit},
          {"reached", s.reached},
          {"garden_of_eden", s.is_garden_of_eden},
          {"row", s.found.row},
          {"potential", s.found.energy}};
}

Json json_of(const StudyResult& result, const Barrier& b) {
  Json values = Json::object();
  for (std::size_t i = 0; i < std::min(b.saddle.values.size(), result.quantities.size()); ++i)
    values[result.quantities[i].name] = b.saddle.values[i];
  return {{"lambda", b.lambda},           {"first", name_of(b.first)},
          {"second", name_of(b.second)},  {"from_first", b.from_first},
          {"from_second", b.from_second}, {"saddle", values}};
}

}  // namespace

std::string transition_lines(const StudyResult& result, const UnitLabels& units) {
  const TransitionReport* report = report_of(result);
  if (report == nullptr) return "";
  constexpr std::size_t most_lines = 40;
  const std::string energy = " " + unit_label(analysis::Unit::energy, result.lambda_unit, units);
  const auto count = [&](bool StableState::*flag) {
    return std::to_string(std::count_if(report->states.begin(), report->states.end(),
                                        [flag](const StableState& s) { return s.*flag; }));
  };
  const auto alternatives = std::count_if(report->transitions.begin(), report->transitions.end(),
                                          [](const Transition& t) { return t.is_alternative; });
  const auto own = std::ssize(report->transitions) - alternatives;
  std::string text =
      line("states", "at least " + std::to_string(report->states.size()) + " stable, " +
                         count(&StableState::reached) + " reached from S1, " +
                         count(&StableState::is_garden_of_eden) + " to which nothing leads; " +
                         std::to_string(own) + " transitions");
  if (alternatives > 0)
    text += line(
        "", std::to_string(alternatives) + " more may take place with other damping or masses");
  text += line("", report->is_closed ? "every transition within the range leads to one of them"
                                     : "NOT CLOSED: a transition leads nowhere that is known");
  if (report->limit_reached) text += line("", "NOT COMPLETE: as many states as allowed");
  text += line("memory", "return-point memory " + memory_word(report->memory) + ", " +
                             std::to_string(report->loops) + " loops gone through");
  for (std::size_t i = 0; i < std::min(most_lines, report->states.size()); ++i)
    text += state_line(*report, i);
  if (report->states.size() > most_lines)
    text +=
        line("", "and " + std::to_string(report->states.size() - most_lines) + " more: states.csv");
  for (std::size_t i = 0; i < std::min(most_lines, report->barriers.size()); ++i) {
    const Barrier& b = report->barriers[i];
    text += line(name_of(b.first) + "-" + name_of(b.second),
                 "barrier at lambda = " + rounded(b.lambda, digits) + ": " +
                     rounded(b.from_first, digits) + energy + " and " +
                     rounded(b.from_second, digits) + energy);
  }
  return text;
}

Json transitions_json(const StudyResult& result) {
  const TransitionReport* report = report_of(result);
  if (report == nullptr) return nullptr;
  Json states = Json::array(), transitions = Json::array(), barriers = Json::array();
  for (const StableState& s : report->states) states.push_back(json_of(s));
  for (const Transition& t : report->transitions)
    transitions.push_back({{"from", name_of(t.from)},
                           {"to", t.to > 0 ? Json(name_of(t.to)) : Json(nullptr)},
                           {"loading", t.loading},
                           {"lambda", t.lambda},
                           {"jump", t.jump},
                           {"verdict", t.jump > 0 ? to_string(t.verdict) : "handed over"},
                           {"released", t.released},
                           {"alternative", t.is_alternative}});
  for (const Barrier& b : report->barriers) barriers.push_back(json_of(result, b));
  return {{"states", states},
          {"transitions", transitions},
          {"barriers", barriers},
          {"is_closed", report->is_closed},
          {"limit_reached", report->limit_reached},
          {"memory", memory_word(report->memory)},
          {"loops", report->loops}};
}

std::string states_csv(const std::vector<StudyResult>& results) {
  return with_rows(
      "state,branch,low,high,low_is_limit,high_is_limit,reached,garden_of_eden", results,
      [](const StudyResult& result, const TransitionReport& report, std::string& rows) {
        for (const StableState& s : report.states)
          rows += common(result) + s.label + "," + std::to_string(s.branch) + "," +
                  csv_number(s.low) + "," + csv_number(s.high) + "," +
                  (s.low_is_limit ? "1," : "0,") + (s.high_is_limit ? "1," : "0,") +
                  (s.reached ? "1," : "0,") + (s.is_garden_of_eden ? "1\n" : "0\n");
      });
}

std::string transitions_csv(const std::vector<StudyResult>& results) {
  return with_rows(
      "from,to,loading,lambda,jump,verdict,released,alternative", results,
      [](const StudyResult& result, const TransitionReport& report, std::string& rows) {
        for (const Transition& t : report.transitions)
          rows += common(result) + name_of(t.from) + "," + name_of(t.to) + "," +
                  std::to_string(t.loading) + "," + csv_number(t.lambda) + "," +
                  (t.jump > 0 ? "J" + std::to_string(t.jump) : "") + "," +
                  csv_text(t.jump > 0 ? to_string(t.verdict) : "handed over") + "," +
                  csv_number(t.released) + (t.is_alternative ? ",1\n" : ",0\n");
      });
}

std::string barriers_csv(const std::vector<StudyResult>& results) {
  return with_rows(
      "lambda,first,second,from_first,from_second", results,
      [](const StudyResult& result, const TransitionReport& report, std::string& rows) {
        for (const Barrier& b : report.barriers)
          rows += common(result) + csv_number(b.lambda) + "," + name_of(b.first) + "," +
                  name_of(b.second) + "," + csv_number(b.from_first) + "," +
                  csv_number(b.from_second) + "\n";
      });
}

}  // namespace springfold::io
