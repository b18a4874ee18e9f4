#include "outline.hpp"

#include <algorithm>
#include <cmath>

#include "command_summary.hpp"
#include "outline_kinds.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "stability_parts.hpp"
#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::ControlMode;
using analysis::Event;
using analysis::EventKind;
using analysis::StudyKind;
using analysis::StudyResult;

constexpr int outline_digits = 4;

/// Rows from `from` to `to`, both included, of one stability.
struct Stretch {
  Stability stability = Stability::stable;
  std::size_t from = 0, to = 0;
  bool is_joined = false;  ///< stable ones and such that are stable only as they are driven
};

/// @param forward  from the start to the last row, otherwise from it back to the first one
std::vector<Stretch> stretches_of(const StudyResult& result, const Branch& branch, bool forward) {
  const std::vector<Stability> steps = stability_of_steps(result, branch);
  std::vector<Stretch> stretches;
  const auto add = [&](Stability stability, std::size_t from, std::size_t to) {
    if (!stretches.empty() && stretches.back().stability == stability)
      stretches.back().to = to;
    else
      stretches.push_back({stability, from, to, false});
  };
  if (forward)
    for (std::size_t i = branch.start_row; i < steps.size(); ++i) add(steps[i], i, i + 1);
  else
    for (std::size_t i = branch.start_row; i-- > 0;) add(steps[i], i + 1, i);
  return stretches;
}

/// The special point at a row, or at the other row of a switching there.
const Event* event_at(const Branch& branch, std::size_t row) {
  for (const Event& event : branch.events) {
    const std::size_t last = event.row + (has_two_rows(branch, event) ? 1 : 0);
    if (event.kind != EventKind::end_of_range && event.row <= row && row <= last) return &event;
  }
  return nullptr;
}

/// A run that is told in words.
struct Told {
  const Case& the_case;
  const StudyResult& result;
  bool is_load = false;         ///< controlled by its load
  std::vector<double> sizes{};  ///< of its quantities
  bool has_values = true;       ///< otherwise special points have their labels only
};

/// "0.02701 N" along the study's direction; lambda where there is no force.
std::string value_text(const Told& told, const Branch& branch, std::size_t row) {
  const StudyResult& result = told.result;
  for (const char* name : {"force", "lambda"}) {
    const auto column = column_of(result, name);
    if (!column || std::isnan(branch.samples[row].values[*column])) continue;
    const std::string unit =
        unit_label(result.quantities[*column].unit, result.lambda_unit, told.the_case.units);
    const std::string number =
        rounded(shown_in(told.sizes, *column, branch.samples[row].values[*column]), outline_digits);
    return (name == std::string{"lambda"} ? "lambda = " : "") + number +
           (unit.empty() ? "" : " " + unit);
  }
  return {};
}

std::string point_text(const Told& told, const Branch& branch, std::size_t row) {
  const Event* event = event_at(branch, row);
  const std::string value = told.has_values ? value_text(told, branch, row) : std::string{};
  if (event == nullptr || event->label.empty()) return value.empty() ? "where it changes" : value;
  return event->label + (value.empty() ? "" : " at " + value);
}

/// Which column of counts says whether the mechanism stands.
std::string state_text(Stability stability, bool is_load) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unknown:
      return "stability not known";
    case Stability::driven:
      return is_load ? "unstable, but it would stand if the way were driven"
                     : "stable only as it is driven, not under dead load";
    case Stability::unstable:
      return "unstable";
  }
  return {};
}

/// Neighbours that all stand under a driven way count as one stretch: what the study holds comes first.
std::vector<Stretch> as_driven(const std::vector<Stretch>& stretches) {
  std::vector<Stretch> joined;
  for (const Stretch& stretch : stretches)
    if (!joined.empty() && stands(joined.back().stability, false) &&
        stands(stretch.stability, false)) {
      joined.back().to = stretch.to;
      joined.back().is_joined = true;
    } else
      joined.push_back(stretch);
  return joined;
}

/// "stable up to LP1 at 0.027 N, snaps there; unstable up to LP2 at 0.01 N; stable again to the end".
/// @param most  stretches that are told
std::string way_text(const Told& told, const Branch& branch, bool forward, std::size_t most) {
  auto stretches = stretches_of(told.result, branch, forward);
  if (!told.is_load && stretches.size() > most) stretches = as_driven(stretches);
  std::string text;
  bool was_stable = false;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& stretch = stretches[i];
    if (i == most)
      return text + "; and so on, " + counted(static_cast<int>(stretches.size()) - 1, "change");
    const bool is_stable = stretch.stability == Stability::stable;
    text += (i == 0 ? "" : "; ") +
            (stretch.is_joined ? "stable as it is driven"
                               : state_text(stretch.stability, told.is_load)) +
            (is_stable && was_stable ? " again" : "");
    was_stable = was_stable || is_stable;
    const bool is_last = i + 1 == stretches.size();
    const bool is_whole = forward ? branch.forward.complete : branch.backward.complete;
    text += !is_last   ? " up to " + point_text(told, branch, stretch.to)
            : is_whole ? " to the end"
                       : " to where it stopped early";
    const Event* event = event_at(branch, stretch.to);
    if (!is_last && event != nullptr &&
        loses_hold(event->kind, stretch.stability, stretches[i + 1].stability, told.is_load))
      text += ", where it snaps";
  }
  return text;
}

std::string branches_text(const StudyResult& result) {
  if (result.branches.size() < 2) return {};
  std::string alike;
  int pairs = 0;
  for (const auto& group : alike_branches(result)) {
    if (group.size() == 2) ++pairs;
    if (group.size() > 1) alike += (alike.empty() ? "" : "; ") + numbers_text(group);
  }
  constexpr std::size_t readable = 60;  // longer lists stand below
  const std::string list = alike.size() <= readable ? ": " + alike : "";
  return std::to_string(result.branches.size()) + " branches" +
         (pairs > 0       ? ", with " + counted(pairs, "pair") + " that look alike" + list
          : alike.empty() ? ""
                          : "; these look alike" + list);
}

/// The way along the first branch, how many others there are, jumps.
/// @param most  stretches of one stability that are told, on each side
std::vector<std::string> curve_outline(const Told& told, std::size_t most) {
  const StudyResult& result = told.result;
  const Branch& first = result.branches.front();
  if (first.samples.size() == 1) return {equilibrium_words(result, first.samples.front())};
  std::vector<std::string> lines;
  if (!result.non_conservative.empty() || !column_of(result, "index")) {  // nothing is counted
    const std::string points = counted_points(first);
    const bool is_whole = first.forward.complete && first.backward.complete;
    lines.push_back(
        std::string{is_whole ? "followed from end to end" : "followed, but not to the end"} +
        ", stability not known" + (points.empty() ? "" : "; special points: " + points));
  } else {
    const std::string onward = way_text(told, first, true, most);
    const std::string back = way_text(told, first, false, most);
    const bool is_one_story = !told.has_values && onward == back && !onward.empty();
    if (is_one_story) lines.push_back("both ways: " + onward);
    if (!onward.empty() && !is_one_story) lines.push_back("forward: " + onward);
    if (!back.empty() && !is_one_story) lines.push_back("backward: " + back);
  }
  const std::string branches = branches_text(result);
  const std::string jumps = told.has_values ? jump_words(told.the_case, result)
                            : result.snap && !result.snap->jumps.empty()
                                ? counted(static_cast<int>(result.snap->jumps.size()), "jump")
                                : std::string{};
  const std::string others = branches + (branches.empty() || jumps.empty() ? "" : "; ") + jumps;
  if (!others.empty()) lines.push_back(others);
  return lines;
}

/// Each as it stands in lines of a terminal.
std::vector<std::string> in_lines(const std::vector<std::string>& sentences) {
  std::vector<std::string> lines;
  for (const std::string& sentence : sentences)
    for (std::string& line : wrapped(sentence, table_width - 2 * summary_indent))
      lines.push_back(std::move(line));
  return lines;
}

/// Do special points and ends have the same values? Those at which a mirror image ends are named otherwise: by the
/// mirrored joint, or by the opposite limit.
bool agree(const StudyResult& result, const std::vector<double>& sizes, const Branch& a,
           const Branch& b) {
  // What is said of one is said of the other: they begin alike.
  if (a.origin != b.origin || a.origin_branch != b.origin_branch || a.start != b.start)
    return false;
  if (a.backward.complete != b.backward.complete || a.forward.complete != b.forward.complete)
    return false;
  if (a.events.size() != b.events.size()) return false;
  // Both were computed, each with errors of its own: far above those, far below what is printed. Sizes are those of the
  // run: the same in all units.
  constexpr double near = 1e-6;
  const auto same = [&](std::size_t i, std::size_t k) {
    for (const char* name : {"lambda", "deflection", "force", "energy", "index"}) {
      const double u = value_at(result, a, i, name), v = value_at(result, b, k, name);
      if (std::isnan(u) != std::isnan(v)) return false;
      const auto column = column_of(result, name);
      const double size = column ? sizes[*column] : 0;
      if (std::abs(u - v) > near * std::max({size, std::abs(u), std::abs(v)})) return false;
    }
    return true;
  };
  for (std::size_t e = 0; e < a.events.size(); ++e)
    if (a.events[e].kind != b.events[e].kind || !same(a.events[e].row, b.events[e].row))
      return false;
  return !a.samples.empty() && !b.samples.empty() && same(0, 0) &&
         same(a.samples.size() - 1, b.samples.size() - 1);
}

}  // namespace

std::vector<std::vector<std::size_t>> alike_branches(const StudyResult& result) {
  std::vector<std::vector<std::size_t>> groups;
  const std::vector<double> sizes =
      result.branches.size() > 1 ? quantity_sizes(result) : std::vector<double>{};
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& known) {
      return agree(result, sizes, result.branches[known.front() - 1], result.branches[b]);
    });
    if (group == groups.end())
      groups.push_back({b + 1});
    else
      group->push_back(b + 1);
  }
  return groups;
}

std::string numbers_text(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += (i == 0 ? "" : i + 1 == numbers.size() ? " and " : ", ") + std::to_string(numbers[i]);
  return text;
}

std::vector<std::string> story_of(const Case& the_case, const StudyResult& result,
                                  std::size_t most) {
  const PlannedRun* planned = plan_of(the_case, result);
  if (planned == nullptr) return {};
  if (!result.start.found) return {"no start point was found"};
  const std::vector<std::string> of_kind = outline_of_kind(the_case, *planned, result);
  const bool is_traced = !result.branches.empty() && !result.branches.front().samples.empty() &&
                         !has_summary_of_its_own(planned->plan.kind);
  if (!of_kind.empty() || !is_traced) return of_kind;
  return curve_outline({the_case, result, planned->plan.control == ControlMode::load, {}, false},
                       most);
}

std::vector<std::string> outline_of(const Case& the_case, const StudyResult& result) {
  const PlannedRun* planned = plan_of(the_case, result);
  if (planned == nullptr || !result.start.found) return {};
  constexpr std::size_t most_lines = 3;
  std::vector<std::string> lines = in_lines(outline_of_kind(the_case, *planned, result));
  const bool is_curve = lines.empty() && !result.branches.empty() &&
                        !result.branches.front().samples.empty() &&
                        !has_summary_of_its_own(planned->plan.kind);
  // What has no room is told in fewer stretches: the table below has all points.
  const Told told{the_case, result, planned->plan.control == ControlMode::load,
                  is_curve ? quantity_sizes(result) : std::vector<double>{}};
  for (std::size_t most = 4; is_curve && most > 0; --most) {
    lines = in_lines(curve_outline(told, most));
    if (lines.size() <= most_lines) break;
  }
  if (lines.size() <= most_lines) return lines;
  lines.resize(most_lines);
  lines.back() += " ...";
  return lines;
}

}  // namespace springfold::io
