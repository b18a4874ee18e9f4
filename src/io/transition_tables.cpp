// Stable states and their transitions in the summary, as JSON and as tables.
#include <algorithm>
#include <cmath>
#include <limits>

#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "summary_line.hpp"
#include "text.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using Json = nlohmann::ordered_json;
using analysis::Barrier;
using analysis::Escape;
using analysis::StableState;
using analysis::StudyResult;
using analysis::Transition;
using analysis::TransitionReport;
using analysis::Unjoined;

std::string name_of(int state) { return state > 0 ? "S" + std::to_string(state) : ""; }

Json name_or_null(int state) { return state > 0 ? Json(name_of(state)) : Json(nullptr); }

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

std::string target_of(const Transition& t) {
  if (t.to > 0) return name_of(t.to);
  const bool nowhere = t.verdict == analysis::SnapVerdict::runs_away ||
                       t.verdict == analysis::SnapVerdict::no_stable_state;
  return nowhere ? to_string(t.verdict) : "unknown";
}

/// "S2 or S5": where a state is left to in one sense; both sides of a symmetric one may lead to the same.
std::string exits(const TransitionReport& report, int state, int loading) {
  std::vector<std::string> targets;
  for (const Transition& t : report.transitions)
    if (t.from == state && t.loading == loading && !t.is_alternative)
      if (std::string target = target_of(t);
          std::find(targets.begin(), targets.end(), target) == targets.end())
        targets.push_back(std::move(target));
  std::string text;
  for (const std::string& target : targets) text += (text.empty() ? "" : " or ") + target;
  return text;
}

std::string state_line(const TransitionReport& report, std::size_t i) {
  const StableState& s = report.states[i];
  const auto number = static_cast<int>(i) + 1;
  const auto end = [&](int loading, bool is_limit) {
    return is_limit ? std::string{"the range ends"} : exits(report, number, loading);
  };
  return summary_line(s.label,
                      "lambda " + rounded(s.low, summary_digits) + " to " +
                          rounded(s.high, summary_digits) + "; down: " + end(-1, s.low_is_limit) +
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
  return {{"lambda", b.lambda},
          {"first", name_of(b.first)},
          {"second", name_or_null(b.second)},
          {"from_first", b.from_first},
          {"from_second", b.from_second},
          {"lowest_from_first", b.lowest_from_first},
          {"lowest_from_second", b.lowest_from_second},
          {"saddle", values}};
}

/// Both heights of a barrier; the state beyond may be none.
std::string heights(double from_first, double from_second, const std::string& energy) {
  return rounded(from_first, summary_digits) + energy +
         (std::isnan(from_second) ? "" : " and " + rounded(from_second, summary_digits) + energy);
}

std::string barrier_line(const Barrier& b, const std::string& energy) {
  std::string text = "barrier at lambda = " + rounded(b.lambda, summary_digits) + ": " +
                     heights(b.from_first, b.from_second, energy) +
                     (b.second == b.first ? " to itself, a turn on and a turn back"
                      : b.second > 0      ? " over the saddle between them"
                                          : "");
  // Not by rounding alone.
  constexpr double clearly = 1e-9;
  if (b.lowest_from_first < b.from_first * (1 - clearly))
    text += "; the lowest way, over other states: " +
            heights(b.lowest_from_first, b.lowest_from_second, energy);
  return summary_line(name_of(b.first) + "-" + (b.second > 0 ? name_of(b.second) : "outside"),
                      text);
}

std::string escape_line(const Escape& e, const std::string& energy) {
  return summary_line(name_of(e.state),
                      "escapes at lambda = " + rounded(e.lambda, summary_digits) + " over " +
                          rounded(e.energy, summary_digits) + energy +
                          (e.to > 0 ? " to " + name_of(e.to) : " to no state of the list"));
}

std::string unjoined_line(const Unjoined& u) {
  return summary_line(name_of(u.first) + "-" + name_of(u.second),
                      "NO WAY was found between them at lambda = " +
                          rounded(u.lambda, summary_digits) + ", nor between those beside them");
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
  std::string text = summary_line(
      "states", "at least " + std::to_string(report->states.size()) + " stable, " +
                    count(&StableState::reached) + " reached from S1, " +
                    count(&StableState::is_garden_of_eden) + " to which nothing leads; " +
                    std::to_string(own) + " transitions");
  if (alternatives > 0)
    text += summary_line(
        "", std::to_string(alternatives) + " more may take place with other damping or masses");
  text +=
      summary_line("", report->is_closed ? "every transition within the range leads to one of them"
                                         : "NOT CLOSED: a transition leads to none of them");
  text += summary_line(
      "",
      "checked: every state is stable within its stretch, where that ends, and where the "
      "overdamped motion goes from there; searched only: further states, lower saddles");
  if (report->limit_reached) text += summary_line("", "NOT COMPLETE: as many states as allowed");
  text += summary_line(
      "memory", report->loops == 0
                    ? "nothing is said of return-point memory: there is no loop to go through"
                    : "return-point memory " + memory_word(report->memory) + ", " +
                          std::to_string(report->loops) + " loops gone through");
  for (std::size_t i = 0; i < std::min(most_lines, report->states.size()); ++i)
    text += state_line(*report, i);
  if (report->states.size() > most_lines)
    text += summary_line(
        "", "and " + std::to_string(report->states.size() - most_lines) + " more: states.csv");
  if (report->energy_counts_turns)
    text +=
        summary_line("turns",
                     "the loads do work in whole turns: states are counted once for all turns, and "
                     "ways over several saddles are not compared");
  for (std::size_t i = 0; i < std::min(most_lines, report->barriers.size()); ++i)
    text += barrier_line(report->barriers[i], energy);
  for (std::size_t i = 0; i < std::min(most_lines, report->escapes.size()); ++i)
    text += escape_line(report->escapes[i], energy);
  for (std::size_t i = 0; i < std::min(most_lines, report->unjoined.size()); ++i)
    text += unjoined_line(report->unjoined[i]);
  return text;
}

Json transitions_json(const StudyResult& result) {
  const TransitionReport* report = report_of(result);
  if (report == nullptr) return nullptr;
  Json states = Json::array(), transitions = Json::array(), barriers = Json::array(),
       escapes = Json::array(), unjoined = Json::array();
  for (const StableState& s : report->states) states.push_back(json_of(s));
  for (const Transition& t : report->transitions)
    transitions.push_back({{"from", name_of(t.from)},
                           {"to", name_or_null(t.to)},
                           {"loading", t.loading},
                           {"lambda", t.lambda},
                           {"jump", t.jump},
                           {"verdict", t.jump > 0 ? to_string(t.verdict) : "handed over"},
                           {"released", t.released},
                           {"alternative", t.is_alternative}});
  for (const Barrier& b : report->barriers) barriers.push_back(json_of(result, b));
  for (const Escape& e : report->escapes)
    escapes.push_back({{"lambda", e.lambda},
                       {"state", name_of(e.state)},
                       {"to", name_or_null(e.to)},
                       {"energy", e.energy}});
  for (const Unjoined& u : report->unjoined)
    unjoined.push_back(
        {{"lambda", u.lambda}, {"first", name_of(u.first)}, {"second", name_of(u.second)}});
  return {{"states", states},
          {"transitions", transitions},
          {"barriers", barriers},
          {"escapes", escapes},
          {"unjoined", unjoined},
          {"is_closed", report->is_closed},
          {"limit_reached", report->limit_reached},
          {"energy_counts_turns", report->energy_counts_turns},
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
  const auto has_states = [](const StudyResult& result) { return report_of(result) != nullptr; };
  const std::vector<std::string> names = columns_where(results, has_states);
  if (names.empty()) return "";
  std::string csv =
      "study,run,label,at_lambda,first,second,from_first,from_second,lowest_from_first,"
      "lowest_from_second,potential";
  for (const auto& name : names) csv += "," + csv_text(name);
  csv += "\n";
  for (const StudyResult& result : results) {
    if (!has_states(result)) continue;
    for (const Barrier& b : report_of(result)->barriers) {
      csv += common(result) + csv_number(b.lambda) + "," + name_of(b.first) + "," +
             name_of(b.second) + "," + csv_number(b.from_first) + "," + csv_number(b.from_second) +
             "," + csv_number(b.lowest_from_first) + "," + csv_number(b.lowest_from_second) + "," +
             csv_number(b.saddle.energy);
      for (const auto& name : names) csv += "," + csv_number(column_value(result, b.saddle, name));
      csv += "\n";
    }
  }
  return csv;
}

std::string escapes_csv(const std::vector<StudyResult>& results) {
  return with_rows(
      "at_lambda,state,to,energy", results,
      [](const StudyResult& result, const TransitionReport& report, std::string& rows) {
        for (const Escape& e : report.escapes)
          rows += common(result) + csv_number(e.lambda) + "," + name_of(e.state) + "," +
                  name_of(e.to) + "," + csv_number(e.energy) + "\n";
      });
}

}  // namespace springfold::io
