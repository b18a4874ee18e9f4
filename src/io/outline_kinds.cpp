#include "outline_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "map_figure.hpp"
#include "nothing.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/analysis/design.hpp"
#include "springfold/analysis/equilibrium_notes.hpp"
#include "springfold/analysis/snap.hpp"
#include "summary_line.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::NodeState;
using analysis::Sample;
using analysis::StudyKind;
using analysis::StudyResult;

constexpr int word_digits = 4;

std::string number_words(double value) { return rounded(value, word_digits); }

/// "0.02701"; 0 where it is rounding beside what the run has of this quantity.
std::string value_words(const StudyResult& result, std::size_t column, double value) {
  return number_words(shown_against(value, quantity_size(result, column)));
}

/// "0.02701 N"; the number alone where there is no unit.
std::string value_words(const Case& the_case, const StudyResult& result, const std::string& name,
                        double value) {
  const auto column = column_of(result, name);
  if (!column) return number_words(value);
  const std::string unit =
      unit_label(result.quantities[*column].unit, result.lambda_unit, the_case.units);
  return value_words(result, *column, value) + (unit.empty() ? "" : " " + unit);
}

/// Least and largest finite value of a column, and the rows that have them.
struct Extremes {
  const Sample *least = nullptr, *largest = nullptr;
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Extremes extremes_of(const std::vector<Sample>& samples, std::size_t column) {
  Extremes found;
  for (const Sample& sample : samples) {
    const double value = column < sample.values.size() ? sample.values[column] : NAN;
    if (!std::isfinite(value)) continue;
    if (value < found.low) found.low = value, found.least = &sample;
    if (value > found.high) found.high = value, found.largest = &sample;
  }
  return found;
}

std::string search_words(const StudyResult& result) {
  int stable = 0, untold = 0, families = 0;
  const auto column = column_of(result, "index");
  for (const auto& e : result.equilibria->list) {
    if (column && e.sample.values[*column] == 0) ++stable;
    const bool is_untold = column && std::isnan(e.sample.values[*column]);
    if (e.note.starts_with(analysis::family_note))
      ++families;
    else if (is_untold)
      ++untold;
  }
  const auto count = static_cast<int>(result.equilibria->list.size());
  return "at least " + std::to_string(count) + (count == 1 ? " equilibrium" : " equilibria") +
         ", " + std::to_string(stable) + " of them stable" +
         (untold > 0 ? ", " + std::to_string(untold) + " at a limit or branch point" : "") +
         (families > 0 ? ", " + std::to_string(families) +
                             (families == 1 ? " standing for a whole line of them"
                                            : " standing for whole lines of them")
                       : "");
}

/// Which of the rows are held, and whether they are stable there.
std::string held_words(const std::vector<const Sample*>& rows, const std::string& noun) {
  int held = 0, unstable = 0;
  for (const Sample* row : rows) {
    const bool is_held = row->state != NodeState::outside &&
                         row->state != NodeState::not_computed &&
                         row->state != NodeState::undecided;
    held += is_held ? 1 : 0;
    unstable += row->state == NodeState::unstable || row->state == NodeState::critical ? 1 : 0;
  }
  const auto all = static_cast<int>(rows.size());
  return (held == all ? "all " + counted(all, noun)
                      : std::to_string(held) + " of " + counted(all, noun)) +
         (all == 1 && held == 1 ? " is" : " are") + " held" +
         (held == 0       ? ""
          : unstable == 0 ? ", stable under dead load"
          : unstable == held
              ? ", unstable under dead load"
              : ", " + std::to_string(unstable) + " of them unstable under dead load");
}

std::string control_words(const Branch& branch) {
  std::vector<const Sample*> targets;
  for (const Sample& sample : branch.samples)
    if (sample.event.empty()) targets.push_back(&sample);
  const std::string points = counted_points(branch);
  return held_words(targets, "target") + (points.empty() ? "" : "; on the way " + points);
}

std::string map_words(const Case& the_case, const PlannedRun& planned, const StudyResult& result) {
  const std::vector<Sample>& samples = result.branches.front().samples;
  std::vector<const Sample*> nodes;
  for (const Sample& sample : samples) nodes.push_back(&sample);
  std::string text = held_words(nodes, "node");
  const std::string quantity = quantity_of(planned.plan.map);
  const auto column = column_of(result, quantity);
  const Extremes found = column ? extremes_of(samples, *column) : Extremes{};
  if (found.least == nullptr) return text;
  return text + "; " + quantity + " from " + value_words(result, *column, found.low) + " to " +
         value_words(the_case, result, quantity, found.high);
}

std::string workspace_words(const Case& the_case, const StudyResult& result) {
  const Sample& sample = result.branches.front().samples.front();
  const auto column = column_of(result, "size");
  const double size = column ? sample.values[*column] : NAN;
  if (!std::isfinite(size)) return sample.status;
  return "a region of half width or radius " + value_words(the_case, result, "size", size);
}

/// "the first critical load is least, 0.02024 N, at psi = 0.7854".
std::string critical_words(const Case& the_case, const PlannedRun& planned,
                           const StudyResult& result) {
  const std::string& parameter = planned.plan.critical.parameter;
  const auto lambda = column_of(result, "lambda"), varied = column_of(result, parameter);
  if (result.branches.empty() || !lambda || !varied) return {};
  std::vector<Sample> samples;
  for (const Branch& branch : result.branches)
    samples.insert(samples.end(), branch.samples.begin(), branch.samples.end());
  const std::string points = counted_points(std::span{result.branches});
  const Extremes found = extremes_of(samples, *lambda), range = extremes_of(samples, *varied);
  if (found.least == nullptr || range.least == nullptr) return {};
  const auto at = [&](const Sample& sample) {
    return " at " + parameter + " = " + value_words(result, *varied, sample.values[*varied]);
  };
  const bool is_first = planned.plan.kind == StudyKind::critical_load;
  return (is_first ? "first critical load from " : "lambda from ") +
         value_words(the_case, result, "lambda", found.low) + at(*found.least) + " to " +
         value_words(the_case, result, "lambda", found.high) + at(*found.largest) +
         (points.empty() ? "" : "; " + points);
}

/// Where no critical point was found at all: an answer too, unless something is in doubt.
std::string no_critical_words(const PlannedRun& planned, const StudyResult& result) {
  const auto& asked = planned.plan.critical;
  if (planned.plan.kind != StudyKind::critical_load || !complete(result)) return {};
  const bool turns = asked.unwanted == analysis::Unwanted::limit_point;
  return std::string{turns ? "no limit point" : "no loss of stability"} +
         " on the path from the start at any of " + std::to_string(asked.values) + " values of " +
         asked.parameter + " over the range";
}

/// The parameter that a per cent of which moves lambda most, of every point.
std::string sensitivity_words(const PlannedRun& planned, const StudyResult& result) {
  std::string text;
  const std::string prefix = "d(lambda)/d(";
  const std::vector<double> sizes = quantity_sizes(result);
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events) {
      if (event.kind == EventKind::end_of_range) continue;
      // 0 where it is nothing but rounding: there are no shares of that.
      const auto column = column_of(result, "lambda");
      const double lambda =
          column ? shown_in(sizes, *column, branch.samples[event.row].values[*column]) : nothing;
      std::string most;
      double largest = 0;
      for (const auto& quantity : result.quantities) {
        if (!quantity.name.starts_with(prefix)) continue;
        const std::string name =
            quantity.name.substr(prefix.size(), quantity.name.size() - prefix.size() - 1);
        const auto known = planned.parameters.find(name);
        if (known == planned.parameters.end()) continue;
        const double share =
            value_at(result, branch, event.row, quantity.name) * known->second / lambda;
        if (std::isfinite(share) && std::abs(share) > std::abs(largest))
          most = name, largest = share;
      }
      if (most.empty()) continue;
      text += (text.empty() ? "" : "; ") + event.label + " depends most on " + most + ": lambda " +
              (largest > 0 ? "+" : "-") + rounded(std::abs(largest), 3) + " % for +1 %";
    }
  if (!text.empty() || result.branches.empty()) return text;
  const std::string points = counted_points(result.branches.front());
  return points.empty() ? "no special point within the range"
                        : "rates of lambda at " + points + ", none of them relative";
}

std::string state_words(const analysis::TransitionReport& report) {
  int transitions = 0;
  for (const analysis::Transition& t : report.transitions) transitions += t.is_alternative ? 0 : 1;
  return counted(static_cast<int>(report.states.size()), "stable state") + ", joined by " +
         counted(transitions, "transition");
}

}  // namespace

std::string counted_points(std::span<const Branch> branches) {
  std::vector<std::pair<std::string, int>> counts;
  std::set<std::string> seen;  // a point where branches meet stands on all of them
  for (const Branch& branch : branches)
    for (const auto& event : branch.events) {
      if (event.kind == EventKind::end_of_range || event.kind == EventKind::user_value) continue;
      if (!event.label.empty() && !seen.insert(event.label).second) continue;
      const std::string code = analysis::code_of(event.kind);
      const auto known = std::find_if(counts.begin(), counts.end(),
                                      [&](const auto& count) { return count.first == code; });
      if (known == counts.end())
        counts.emplace_back(code, 1);
      else
        ++known->second;
    }
  std::string text;
  for (const auto& [code, count] : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + code;
  return text;
}

std::string counted_points(const Branch& branch) { return counted_points(std::span{&branch, 1}); }

std::string equilibrium_words(const StudyResult& result, const Sample& sample) {
  const auto value = [&](const char* name) {
    const auto column = column_of(result, name);
    return column && *column < sample.values.size() ? sample.values[*column] : NAN;
  };
  const double held = value("index"), dead = value("index_force");
  if (std::isnan(held) && std::isnan(dead)) return "an equilibrium; stability not known";
  if (dead == 0) return "an equilibrium, stable under dead load";
  if (held == 0) return "an equilibrium, held as it is driven, unstable under dead load";
  const double modes = std::isnan(dead) ? held : dead;
  // Where springs rest no more is known of it.
  if (sample.rests) return "an unstable equilibrium: at least 1 mode lets it go";
  const auto count = static_cast<int>(std::lround(modes));
  return "an unstable equilibrium: " + counted(count, "mode") +
         (count == 1 ? " lets it go" : " let it go");
}

std::string jump_words(const Case& the_case, const StudyResult& result) {
  if (!result.snap || result.snap->transitions) return {};
  int landed = 0;
  double released = 0;
  for (const analysis::Jump& jump : result.snap->jumps) {
    if (jump.landing.values.empty()) continue;
    ++landed;
    released = std::max(released, std::isfinite(jump.released) ? jump.released : 0);
  }
  const auto all = static_cast<int>(result.snap->jumps.size());
  if (all == 0) return {};
  const std::string unit = unit_label(analysis::Unit::energy, result.lambda_unit, the_case.units);
  const auto energy = [&](double value) {
    return number_words(value) + (unit.empty() ? "" : " " + unit);
  };
  std::string text = counted(all, "jump") +
                     (landed == all ? "" : ", " + std::to_string(landed) + " with a landing");
  if (landed > 0)
    text += (all == 1 ? ", which releases " : ", releasing up to ") + energy(released);
  if (const auto& cycle = result.snap->cycle; cycle && std::isfinite(cycle->loop))
    text += "; the cycle closes, " + energy(cycle->loop_released) + " lost in it";
  return text;
}

std::vector<std::string> outline_of_kind(const Case& the_case, const PlannedRun& planned,
                                         const StudyResult& result) {
  const auto some = [](std::string text) {
    return text.empty() ? std::vector<std::string>{} : std::vector<std::string>{std::move(text)};
  };
  if (result.threshold) return some(result.threshold->message);
  if (result.equilibria) return some(search_words(result));
  if (const auto* report = report_of(result)) return some(state_words(*report));
  if (result.design) return some(result.design->message);
  const bool has_rows = !result.branches.empty() && !result.branches.front().samples.empty();
  if (!has_rows) return some(no_critical_words(planned, result));
  switch (planned.plan.kind) {
    case StudyKind::control:
      return some(control_words(result.branches.front()));
    case StudyKind::map:
      return some(map_words(the_case, planned, result));
    case StudyKind::workspace:
      return some(workspace_words(the_case, result));
    case StudyKind::critical_curve:
    case StudyKind::critical_load:
      return some(critical_words(the_case, planned, result));
    case StudyKind::sensitivity:
      return some(sensitivity_words(planned, result));
    default:
      return {};
  }
}

}  // namespace springfold::io
