// What was found, for people: one block of text per run.
#include <algorithm>
#include <cmath>

#include "command_summary.hpp"
#include "counts_beside.hpp"
#include "fitted_table.hpp"
#include "jump_access.hpp"
#include "outline.hpp"
#include "point_summary.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/results.hpp"
#include "springfold/io/start_text.hpp"
#include "springfold/io/summary_detail.hpp"
#include "summary_line.hpp"
#include "summary_start.hpp"
#include "summary_words.hpp"
#include "sweep_points.hpp"
#include "sweep_tables.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {
using analysis::Branch;
using analysis::StudyResult;

/// Columns of the mechanism's bodies ("tool.x") or actuator commands ("leg.drive.rho").
std::vector<std::string> pose_names(const model::Mechanism& mechanism, const StudyResult& result) {
  std::vector<std::string> names;
  for (const auto& body : mechanism.bodies)
    for (const char* coordinate : {".x", ".y", ".z", ".phi", ".rx", ".ry", ".rz"})
      if (column_of(result, body.name + coordinate)) names.push_back(body.name + coordinate);
  return names;
}

std::vector<std::string> command_names(const StudyResult& result) {
  std::vector<std::string> names;
  for (const auto& quantity : result.quantities)
    if (quantity.name.ends_with(".rho")) names.push_back(quantity.name);
  return names;
}

std::string named_values(std::string_view label, const std::vector<std::string>& names,
                         const StudyResult& result, const std::vector<double>& sizes,
                         const UnitLabels& units) {
  std::string text;
  const Branch& first = result.branches.front();
  for (const auto& name : names) {
    const std::size_t column = *column_of(result, name);
    const auto& quantity = result.quantities[column];
    const auto unit = unit_label(quantity.unit, result.lambda_unit, units);
    const double value = shown_in(sizes, column, first.samples[first.start_row].values[column]);
    text += (text.empty() ? "" : ", ") + name + " = " + rounded(value, summary_digits);
    if (!unit.empty()) text += " " + unit;
  }
  return text.empty() ? text : summary_line(label, text);
}

/// "lambda 0, tip.x -0.7, tip.y 0.7": rates along a way out of the start.
std::string rates_text(const Case& the_case, const StudyResult& result,
                       const std::vector<double>& rates) {
  std::vector<std::string> names{"lambda"};
  if (const PlannedRun* planned = plan_of(the_case, result))
    for (const auto& name : pose_names(planned->mechanism, result)) names.push_back(name);
  std::string text;
  for (const auto& name : names) {
    const auto column = column_of(result, name);
    if (!column || *column >= rates.size() || std::isnan(rates[*column])) continue;
    const double rate = std::abs(rates[*column]) < 1e-9 ? 0 : rates[*column];
    text += (text.empty() ? "" : ", ") + name + " " + rounded(rate, 4);
  }
  return text;
}

/// A start that is no ordinary point, and all ways that leave it.
std::string way_lines(const Case& the_case, const StudyResult& result) {
  const analysis::StartReport& start = result.start;
  if (start.situation.empty()) return "";
  const auto count = static_cast<int>(start.ways.size());
  std::string text = summary_line(
      "", "the start is " + start.situation + (count > 0 ? ": " + counted(count, "way") : ""));
  for (std::size_t i = 0; i < start.ways.size(); ++i) {
    const int branch = start.ways[i].branch;
    text +=
        summary_line("", "way " + std::to_string(i + 1) + ": " +
                             (branch > 0 ? "branch " + std::to_string(branch) : "not followed") +
                             ", d/ds " + rates_text(the_case, result, start.ways[i].rates));
  }
  return text;
}

std::string stop_line(std::string_view label, const analysis::Stop& stop) {
  return summary_line(label, (stop.complete ? "" : "STOPPED EARLY: ") + stop.reason);
}

/// Where a branch begins, if it does not run through the start.
std::string origin_text(const StudyResult& result, const Branch& branch) {
  if (!branch.origin.empty()) return branch.backward.reason;
  if (branch.start == 0) return "";
  int before = 0;  // equilibria of earlier searches
  for (const auto& search : result.searches) {
    if (branch.start <= before + search.found)
      return "found by the search at lambda = " + rounded(search.lambda, summary_digits);
    before += search.found;
  }
  return "";
}

/// Branch points and other junctions at which branches were not followed. A graph of states follows what takes over
/// there.
std::string left_out(const StudyResult& result) {
  std::string labels;
  if (result.snap && result.snap->transitions) return "";
  for (const auto& junction : result.junctions) {
    const auto count = std::count(junction.ways.begin(), junction.ways.end(), 0);
    const std::string label = junction.label.empty() ? "a point out of range" : junction.label;
    if (count > 0)
      labels +=
          (labels.empty() ? "" : ", ") + counted(static_cast<int>(count), "way") + " at " + label;
  }
  const bool is_interrupted =
      std::any_of(result.doubts.begin(), result.doubts.end(),
                  [](const std::string& doubt) { return doubt.starts_with("interrupted"); });
  const std::string why = is_interrupted ? "interrupted" : "beyond branches.depth or .maximum";
  if (!labels.empty()) return "not followed, " + why + ": " + labels;
  if (!result.junctions.empty()) return "";
  for (const auto& branch : result.branches)
    for (const auto& event : branch.events)
      if (event.kind == analysis::EventKind::branch_point)
        labels += (labels.empty() ? "" : ", ") + event.label;
  return labels.empty() ? "" : "not followed, branches.depth = 0: what crosses at " + labels;
}

std::string search_text(const analysis::Search& search) {
  std::string text = "search at lambda = " + rounded(search.lambda, summary_digits) + ": ";
  if (search.found == 0)
    text += "no other equilibrium found in " + counted(search.starts, "start");
  else
    text +=
        "at least " + std::to_string(search.found) +
        (search.found == 1 ? " other equilibrium found, " : " other equilibria found, ") +
        (search.traced == search.found ? "all traced" : std::to_string(search.traced) + " traced");
  if (search.out_of_range > 0)
    text += "; " + std::to_string(search.out_of_range) + " further out of range, not traced";
  if (search.limit_reached) text += "; ended because so many were found, there may be more";
  return text;
}

/// What is known of the diagram as a whole, and what is not.
std::string diagram_lines(const StudyResult& result, const PlannedRun* planned) {
  const bool is_point = planned == nullptr ? result.branches.front().samples.size() < 2
                                           : planned->plan.kind == analysis::StudyKind::equilibrium;
  if (is_point) return "";
  std::string text;
  std::string label = "branches";
  const auto add = [&](const std::string& sentence) {
    text += summary_line(label, sentence);
    label.clear();
  };
  add(std::to_string(result.branches.size()));
  if (const std::string omitted = left_out(result); !omitted.empty()) add(omitted);
  for (const auto& search : result.searches) add(search_text(search));
  // Stable states have a search, and lines, of their own.
  const bool has_graph = result.snap && result.snap->transitions;
  if (result.searches.empty() && !has_graph)
    add("nothing is claimed about branches that are not connected to the start: no search was run");
  for (const auto& doubt : result.doubts) add("UNRESOLVED: " + doubt);
  return text;
}

/// How much of it is shown to be one curve.
std::string arcs_text(const analysis::VerifiedArcs& arcs) {
  constexpr double percent = 100, hundredth = 0.01;
  const bool all = arcs.sampled.empty();
  // Rounded down: only all of it is 100 %.
  const double share = std::floor(percent * arcs.share() / hundredth) * hundredth;
  return (all ? "verified as one curve"
              : rounded(share, 4) + " % of its length verified as one curve") +
         (all ? std::string(" along its whole length")
              : ", the rest is known at points only: " +
                    counted(static_cast<int>(arcs.sampled.size()), "part"));
}

/// Mirror images end at the mirrored joint, or at the opposite limit.
std::string other_ends(const StudyResult& result, const std::vector<std::size_t>& numbers) {
  const Branch& first = result.branches[numbers.front() - 1];
  std::string text;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const Branch& other = result.branches[numbers[i] - 1];
    const std::string of_branch = "of branch " + std::to_string(numbers[i]) + ": ";
    if (first.origin.empty() && other.backward.reason != first.backward.reason)
      text += summary_line("", of_branch + "first row: " + other.backward.reason);
    if (other.forward.reason != first.forward.reason)
      text += summary_line("", of_branch + other.forward.reason);
  }
  return text;
}

/// One branch, and the numbers of others of which the same is said.
std::string branch_lines(const StudyResult& result, const std::vector<std::size_t>& numbers,
                         const std::vector<double>& sizes) {
  const Branch& branch = result.branches[numbers.front() - 1];
  std::string text;
  if (result.branches.size() > 1)
    text += summary_line(numbers.size() > 1 ? "branches " + numbers_text(numbers) + " "
                                            : "branch " + std::to_string(numbers.front()),
                         (numbers.size() > 1 ? "alike; " : "") + origin_text(result, branch));
  const std::size_t refused = branch.log.size();
  if (branch.samples.size() < 2 && branch.events.empty() && branch.backward.complete &&
      branch.forward.complete)
    return text;  // an equilibrium study: all is said by the start
  text += summary_line("curve", counted(static_cast<int>(branch.samples.size()), "point") + ", " +
                                    counted(static_cast<int>(refused), "refused or cut step"));
  if (branch.arcs) text += summary_line("", arcs_text(*branch.arcs));
  text += point_lines(result, branch, sizes);
  if (branch.origin.empty()) text += stop_line("first row", branch.backward);
  text += stop_line("last row", branch.forward);
  return text + other_ends(result, numbers);
}

/// "stable" columns of all equilibria that a search found, the lowest potential first.
std::string equilibria_table(const Case& the_case, const StudyResult& result) {
  std::vector<std::string> columns{"index", "potential", "energy"};
  if (const PlannedRun* planned = plan_of(the_case, result))
    for (const auto& name : pose_names(planned->mechanism, result)) columns.push_back(name);
  std::vector<std::vector<std::string>> rows = {{"equilibria"}};
  rows.front().front().resize(summary_label_width - 2, ' ');
  rows.front().insert(rows.front().end(), columns.begin(), columns.end());
  const std::vector<double> sizes = quantity_sizes(result);
  for (const auto& e : result.equilibria->list) {
    auto& row = rows.emplace_back();
    row.push_back(e.label);
    for (const auto& name : columns) {
      const auto column = column_of(result, name);
      if (name == "index" && e.sample.rests) {
        row.push_back(count_text(e.sample.values[column.value()], true));
        continue;
      }
      row.push_back(point_number(name == "potential"
                                     ? e.potential
                                     : shown_in(sizes, *column, e.sample.values[column.value()])));
    }
    row.push_back(e.note.empty() ? (e.is_start ? "the start" : "") : e.note);
  }
  std::vector<Align> align(1 + columns.size(), Align::right);
  align.front() = Align::left;
  align.push_back(Align::left);
  return fitted(rows, align, summary_indent);
}

std::string equilibria_lines(const Case& the_case, const StudyResult& result) {
  const analysis::EquilibriaReport& report = *result.equilibria;
  const auto count = static_cast<int>(report.list.size());
  std::string text = equilibria_table(the_case, result);
  std::string found = "at least " + std::to_string(count) +
                      (count == 1 ? " equilibrium" : " equilibria") + " found, " +
                      counted(report.starts, "start") + "; nothing is proved about others";
  if (report.out_of_range > 0)
    found += "; " + std::to_string(report.out_of_range) + " further out of range";
  if (report.locked > 0)
    found += "; " + std::to_string(report.locked) + " further with locked joints";
  text += summary_line("found", found);
  if (report.limit_reached)
    text += summary_line("", "the search ended because so many were found: there may well be more");
  const analysis::MorseCount& morse = report.morse;
  if (!morse.applies) return text + summary_line("Morse count", "does not apply: " + morse.why);
  const std::string sum = "the sum of (-1)^index is " + std::to_string(morse.found);
  return text +
         summary_line("Morse count", morse.found == morse.expected
                                         ? sum + ", as it must be"
                                         : sum + ", it must be " + std::to_string(morse.expected) +
                                               ": there are others");
}

/// @param has_words  what happened comes first
std::string run_block(const Case& the_case, const StudyResult& result, bool has_words) {
  std::string text =
      heading_of(result) + "\n" + (has_words ? outline_lines(the_case, result) : std::string{});
  if (const PlannedRun* planned = plan_of(the_case, result);
      planned != nullptr && has_summary_of_its_own(planned->plan.kind))
    return text + command_lines(the_case, *planned, result);
  text += start_lines(result.start, plan_of(the_case, result));
  if (!result.start.outside.empty())
    text += summary_line("", "OUTSIDE: " + start_problem(result.start, plan_of(the_case, result)));
  if (result.start.found && result.equilibria) return text + equilibria_lines(the_case, result);
  if (!result.start.found) return text;
  if (result.branches.empty()) {
    for (const auto& doubt : result.doubts) text += summary_line("", "UNRESOLVED: " + doubt);
    return text;
  }
  const std::vector<double> sizes = quantity_sizes(result);
  const auto values = [&](std::string_view label, const std::vector<std::string>& names) {
    return named_values(label, names, result, sizes, the_case.units);
  };
  if (const PlannedRun* planned = plan_of(the_case, result))
    text += values("pose", pose_names(planned->mechanism, result));
  text += values("commands", command_names(result));
  const Branch& first = result.branches.front();
  const double index = value_at(result, first, first.start_row, "index");
  const bool rests = first.samples[first.start_row].rests;
  text += summary_line("index",
                       std::isnan(index) ? "not defined at this point" : count_text(index, rests));
  text += way_lines(the_case, result);
  text += caution_lines(result);
  text += stiffness_lines(result);
  for (const auto& numbers : alike_branches(result)) text += branch_lines(result, numbers, sizes);
  return text + jump_lines(result, the_case.units) +
         diagram_lines(result, plan_of(the_case, result));
}

/// One block for every table of many runs.
std::string sweep_blocks(const Case& the_case, const std::vector<StudyResult>& results,
                         bool is_first) {
  std::string text;
  const auto files = sweep_files(the_case);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const SweepTable& sweep = the_case.sweeps[i];
    const SweepCounts counts = counts_of(the_case, sweep, results);
    if (counts.planned == 0) continue;  // not among the chosen studies
    text += (is_first && text.empty() ? "" : "\n") +
            sweep_lines(the_case, sweep, counts.planned, results);
    text +=
        summary_line("complete", std::to_string(counts.complete) + " of " +
                                     std::to_string(counts.planned) + ", table " + shown(files[i]));
    if (counts.done < counts.planned)
      text += summary_line(
          "NOT RUN", std::to_string(counts.planned - counts.done) + " of them, interrupted before");
  }
  return text;
}

/// One block for every study whose special points change with what it varies.
std::string point_blocks(const Case& the_case, const std::vector<StudyResult>& results) {
  const auto sweeps = sweep_points_of(the_case, results);
  const auto files = sweep_points_files(the_case, sweeps);
  std::string text;
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    text += "\n" + sweep_points_lines(sweeps[i], files[i]);
  return text;
}

}  // namespace

std::string steps_table(const std::vector<StudyResult>& results) {
  std::vector<std::vector<std::string>> rows{{"step", "s", "length", "reason"}};
  for (const auto& result : results)
    for (std::size_t b = 0; b < result.branches.size(); ++b)
      for (const auto& note : result.branches[b].log)
        rows.push_back({heading_of(result) + ", branch " + std::to_string(b + 1),
                        rounded(note.s, summary_digits), rounded(note.step, summary_digits),
                        note.reason});
  if (rows.size() == 1) return "\nno step was refused or cut\n";
  return "\nRefused and cut steps\n" +
         fitted(rows, {Align::left, Align::right, Align::right, Align::left}, summary_indent);
}

namespace {

/// @param is_detailed  every run has its own words
std::string table_of(const Case& the_case, const std::vector<StudyResult>& results,
                     bool is_detailed) {
  std::string text;
  if (!the_case.title.empty()) text += shown(the_case.title) + "\n";
  for (const auto& runs : studies_of(results)) {
    const bool has_words = is_detailed || runs.size() == 1;
    if (!has_words) text += (text.empty() ? "" : "\n") + study_lines(the_case, runs);
    for (const StudyResult* result : runs)
      text += (text.empty() ? "" : "\n") + run_block(the_case, *result, has_words);
  }
  text += point_blocks(the_case, results);
  text += sweep_blocks(the_case, results, text.empty());
  for (const auto& planned : the_case.runs)
    if (planned.keeps_curves && result_of(results, planned.study, planned.run) == nullptr)
      text += "\n" + shown(planned.study) + ", run " + std::to_string(planned.run) + "\n" +
              summary_line("NOT RUN", "interrupted before");
  return text;
}

}  // namespace

std::string summary_table(const Case& the_case, const std::vector<StudyResult>& results) {
  return table_of(the_case, results, false);
}

std::string detailed_summary_table(const Case& the_case, const std::vector<StudyResult>& results) {
  return table_of(the_case, results, true);
}

}  // namespace springfold::io
