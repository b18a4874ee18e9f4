#include "report_lists.hpp"

#include <algorithm>
#include <cmath>

#include "jump_moments.hpp"
#include "quantity_sizes.hpp"
#include "report_data.hpp"
#include "result_access.hpp"
#include "springfold/io/shown_text.hpp"
#include "text.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using analysis::Sample;
using analysis::SnapState;
using analysis::StudyKind;
using analysis::StudyResult;

constexpr int page_digits = 6;  // of numbers in sentences

RowsForm form_of(const PlannedRun& planned, const analysis::Branch& branch) {
  if (branch.samples.size() == 1) return RowsForm::points;
  const auto& map = planned.plan.map;
  if (planned.plan.kind == StudyKind::map && map.axes.size() > 1) return RowsForm::nodes;
  return planned.plan.kind == StudyKind::workspace ? RowsForm::points : RowsForm::curve;
}

void add_branches(const PlannedRun& planned, const StudyResult& result,
                  const std::vector<std::string>& files, PageLists& page) {
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const analysis::Branch& branch = result.branches[b];
    PageRows list{.name = planned.plan.kind == StudyKind::map
                              ? "nodes"
                              : "branch " + std::to_string(b + 1) +
                                    (branch.origin.empty() ? "" : " from " + branch.origin),
                  .file = b < files.size() ? files[b] : "",
                  .form = form_of(planned, branch),
                  .start = branch.start_row};
    for (const Sample& row : branch.samples) list.rows.push_back(&row);
    const bool is_load = planned.plan.control == analysis::ControlMode::load;
    const std::vector<Stability> steps = stability_of_steps(result, branch);
    for (const analysis::Event& event : branch.events)
      list.points.push_back({event.label, analysis::code_of(event.kind), event.detail,
                             explanation_of(event.kind, passage_at(steps, branch, event), is_load),
                             event.row, &event});
    page.lists.push_back(std::move(list));
  }
}

void add_equilibria(const StudyResult& result, const std::string& file, PageLists& page) {
  if (!result.equilibria) return;
  PageRows list{.name = "equilibria", .file = file, .form = RowsForm::points};
  for (const analysis::Equilibrium& at : result.equilibria->list) {
    if (at.is_start) list.start = list.rows.size();
    const std::string note = at.note.empty() ? "" : "; " + at.note;
    list.points.push_back(
        {at.label, "EQ",
         (at.is_start ? "found from the study's guess" : "found by the search") + note,
         "An equilibrium at the study's load, with the potential " +
             rounded(at.potential, page_digits) + ". The first has the lowest one.",
         list.rows.size()});
    list.rows.push_back(&at.sample);
  }
  page.lists.push_back(std::move(list));
}

const Sample* keep(const SnapState& state, PageLists& page) {
  page.own.push_back({.values = state.values, .piece = state.piece});
  return &page.own.back();
}

std::string with_unit(double value, const StudyResult& result, const UnitLabels& units) {
  const std::string unit = unit_label(analysis::Unit::energy, result.lambda_unit, units);
  return rounded(value, page_digits) + (unit.empty() ? "" : " " + shown_in_line(unit));
}

std::string sentence_of(const StudyResult& result, const analysis::Jump& jump,
                        const UnitLabels& units) {
  if (jump.landing.values.empty())
    return "Stability is lost at " + jump.from + ": " + to_string(jump.verdict) + ".";
  return "Stability is lost at " + jump.from + ", and the mechanism comes to rest " +
         (jump.landing.branch > 0 ? "on branch " + std::to_string(jump.landing.branch)
                                  : "on none of the branches") +
         ". Energy released: " + with_unit(jump.released, result, units) + ". The landing is " +
         to_string(jump.verdict) + ".";
}

/// The rows of a jump: its motion where it was kept, otherwise where it begins; then where it comes to rest.
void add_jumps(const StudyResult& result, const UnitLabels& units, PageLists& page) {
  if (!result.snap) return;
  for (const analysis::Jump& jump : result.snap->jumps) {
    if (jump.critical.values.empty()) continue;
    PageRows list{.name = "jump " + jump.label + " from " + jump.from,
                  .file = jump.motion.empty() ? "jumps.csv" : "motions.csv",
                  .form = RowsForm::jump};
    if (jump.motion.empty()) list.rows.push_back(keep(jump.critical, page));
    for (const analysis::SnapMoment& moment : moments_to_landing(jump))
      list.rows.push_back(keep(moment.state, page));
    const std::string towards = jump.towards.empty() ? "" : ", towards " + jump.towards;
    list.points.push_back({jump.label, "J", "jumps from " + jump.from + towards,
                           sentence_of(result, jump, units), list.rows.size() - 1});
    page.lists.push_back(std::move(list));
  }
}

/// "at lambda = 1.2 (rising) to S3".
std::string words_of(const analysis::TransitionReport& report, const analysis::Transition& t) {
  const auto to = static_cast<std::size_t>(t.to);
  return "at lambda = " + rounded(t.lambda, page_digits) +
         (t.loading > 0 ? " (rising) to " : " (falling) to ") +
         (t.to > 0 ? report.states[to - 1].label : "no state that is known");
}

void add_states(const StudyResult& result, PageLists& page) {
  const analysis::TransitionReport* report = report_of(result);
  if (report == nullptr) return;
  PageRows list{.name = "stable states", .file = "states.csv", .form = RowsForm::points};
  for (std::size_t i = 0; i < report->states.size(); ++i) {
    const analysis::StableState& state = report->states[i];
    std::string left;
    for (const analysis::Transition& t : report->transitions)
      if (t.from == static_cast<int>(i) + 1 && !t.is_alternative)
        left += (left.empty() ? "left " : ", ") + words_of(*report, t);
    list.points.push_back({state.label, "S", left.empty() ? "not left within the range" : left,
                           "A stable state from lambda = " + rounded(state.low, page_digits) +
                               " to " + rounded(state.high, page_digits) +
                               (state.is_garden_of_eden ? "; no transition leads there." : "."),
                           list.rows.size()});
    list.rows.push_back(keep(state.found, page));
  }
  page.lists.push_back(std::move(list));
}

/// Does the quantity change by more than rounding along any list?
bool varies(const StudyResult& result, const std::vector<double>& sizes, std::string_view name) {
  const auto column = column_of(result, name);
  if (!column) return false;
  constexpr double rounding = 1e-9;  // of its largest value
  for (const analysis::Branch& branch : result.branches) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Sample& row : branch.samples) {
      const double value = *column < row.values.size() ? row.values[*column] : NAN;
      if (!std::isfinite(value)) continue;
      if (shown_in(sizes, *column, value) == 0) {
        low = std::min(low, 0.0);
        high = std::max(high, 0.0);
        continue;
      }
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (high - low > rounding * std::max(std::abs(low), std::abs(high))) return true;
  }
  return false;
}

/// The coordinate of the study's body in which the equilibria differ most.
std::string pose_of(const PlannedRun& planned, const StudyResult& result) {
  const std::string& body =
      planned.mechanism.bodies[static_cast<std::size_t>(planned.plan.body - 1)].name;
  std::string widest;
  double most = -1;
  for (std::size_t i = 0; i < result.quantities.size(); ++i) {
    const std::string& name = result.quantities[i].name;
    if (!name.starts_with(body + ".") || name.find('.', body.size() + 1) != std::string::npos)
      continue;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const analysis::Equilibrium& at : result.equilibria->list) {
      low = std::min(low, at.sample.values[i]);
      high = std::max(high, at.sample.values[i]);
    }
    if (high - low > most) most = high - low, widest = name;
  }
  return widest;
}

}  // namespace

const char* word_of(RowsForm form) {
  switch (form) {
    case RowsForm::curve:
      return "curve";
    case RowsForm::jump:
      return "jump";
    case RowsForm::points:
      return "points";
    case RowsForm::nodes:
      return "nodes";
  }
  return "";
}

PageLists page_lists_of(const PlannedRun& planned, const StudyResult& result,
                        const std::vector<std::string>& files, const std::string& equilibria,
                        const UnitLabels& units) {
  PageLists page;
  add_branches(planned, result, files, page);
  add_equilibria(result, equilibria, page);
  add_jumps(result, units, page);
  add_states(result, page);
  std::erase_if(page.lists, [](const PageRows& list) { return list.rows.empty(); });
  return page;
}

PageAxes page_axes_of(const PlannedRun& planned, const StudyResult& result) {
  const std::vector<double> sizes = quantity_sizes(result);
  const auto first = [&](std::initializer_list<std::string> names) {
    for (const std::string& name : names)
      if (varies(result, sizes, name)) return name;
    return std::string{};
  };
  const auto& map = planned.plan.map;
  if (planned.plan.kind == StudyKind::map && map.axes.size() > 1)
    return {map.axes[0].name, map.axes[1].name};
  if (planned.plan.kind == StudyKind::map)
    return {map.axes[0].name,
            first({"critical_load", "stiffness", "K_trans_min", "K_rot_min", "energy"})};
  if (analysis::is_of_critical_points(planned.plan.kind) &&
      varies(result, sizes, planned.plan.critical.parameter))
    return {planned.plan.critical.parameter, first({"lambda", "force", "energy"})};
  if (result.equilibria) return {pose_of(planned, result), "energy"};
  const std::string x = first({"deflection", "path", "size", "lambda", "s"});
  if (x == "deflection") return {x, first({"force", "lambda", "energy"})};
  return {x,
          first({"force", x == "lambda" ? "energy" : "lambda", "energy", "K_eig1", "width", "s"})};
}

}  // namespace springfold::io
