// A critical curve that begins at a row of another one, in a parameter of its own.
#include <algorithm>
#include <cmath>

#include "cpu_time.hpp"
#include "critical_runs.hpp"
#include "critical_starts.hpp"
#include "outside_range.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalHit;
using continuation::CriticalKind;
using continuation::CriticalPoint;
using continuation::CriticalStart;

/// As the curves' own points are located: what lies farther away is another point.
constexpr double same_point = 1e-6;
/// So well points are located, in the curves' own units.
constexpr double as_located = 1e-9;

/// Of a parameter that is in both the first ones hold.
ParameterChanges with_held(ParameterChanges changes, const ParameterChanges& held) {
  for (const auto& one : held)
    if (std::none_of(changes.begin(), changes.end(),
                     [&](const auto& change) { return change.first == one.first; }))
      changes.push_back(one);
  return changes;
}

void copy_parts(const model::MovedParts& parts, const model::Mechanism& from,
                model::Mechanism& to) {
  for (const auto& [chain, part] : parts.laws)
    std::get<model::Joint>(to.chains[chain].elements[part]).spring =
        std::get<model::Joint>(from.chains[chain].elements[part]).spring;
  for (const auto& [chain, part] : parts.commands)
    std::get<model::Joint>(to.chains[chain].elements[part]).command =
        std::get<model::Joint>(from.chains[chain].elements[part]).command;
  for (const auto& [chain, part] : parts.coupled)
    to.chains[chain].coupled_springs[part] = from.chains[chain].coupled_springs[part];
  for (const std::size_t i : parts.lines) to.line_springs[i] = from.line_springs[i];
  for (const std::size_t i : parts.shape_laws) to.shape_springs[i].law = from.shape_springs[i].law;
  for (const std::size_t i : parts.loads) to.loads[i].vector = from.loads[i].vector;
}

/// The case with these values, as a function of its parameters: what depends on them follows.
std::shared_ptr<const CaseFamily> holding(const std::shared_ptr<const CaseFamily>& cases,
                                          const ParameterChanges& held) {
  auto family = std::make_shared<CaseFamily>(*cases);
  family->values = cases->at(held).parameters;
  family->at = [cases, held](const ParameterChanges& changes) {
    return cases->at(with_held(changes, held));
  };
  family->moving.put = [cases, held](std::size_t parameter, double value,
                                     model::Mechanism& mechanism) {
    const model::MovedParts* parts = cases->moving.moved(parameter);
    if (parts == nullptr || !std::isfinite(value)) return false;
    const Variant now = cases->at(with_held({{parameter, value}}, held));
    const bool is_known =
        now.problem.empty() && std::all_of(now.parameters.begin(), now.parameters.end(),
                                           [](double v) { return std::isfinite(v); });
    if (is_known) copy_parts(*parts, now.mechanism, mechanism);
    return is_known;
  };
  return family;
}

std::string quoted(const std::string& study) { return "study \"" + study + "\""; }

/// What has a row in the table: its place, and on which piece of the curve it lies.
struct LabelledRow {
  const FollowedCurve* piece = nullptr;
  const CriticalPoint* point = nullptr;
  const CriticalHit* hit = nullptr;  ///< that the row shows; nullptr: none
  EventKind kind = EventKind::end_of_range;
  bool is_between_pieces = false;  ///< another spring is at its threshold there
};

std::string labels_of(const StudyResult& result) {
  std::string names;
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events) names += (names.empty() ? "" : ", ") + event.label;
  return names.empty() ? "none" : names;
}

/// Why the curve ended before it came to an end that was asked for, if it did.
std::string early_ends_of(const StudyResult& result) {
  std::string text;
  for (const Branch& branch : result.branches)
    for (const Stop& stop : {branch.forward, branch.backward})
      if (!stop.complete && text.find(stop.reason) == std::string::npos)
        text += (text.empty() ? "; it stopped early: " : ", and: ") + stop.reason;
  return text;
}

/// Only on the surface of its own spring a curve goes on where that switches.
bool meets_other_spring(const FollowedCurve& piece, const Branch& branch, const Event& event) {
  if (event.kind == EventKind::two_activations) return true;
  if (piece.start.kind == CriticalKind::surface) return false;
  const bool is_first_of_piece_beyond = !piece.growing.points.empty() &&
                                        piece.growing.points.front().s < 0 &&
                                        event.row == branch.start_row;
  return event.kind == EventKind::fold_meets_activation || event.kind == EventKind::switching ||
         is_first_of_piece_beyond;
}

const CriticalHit* hit_of(const FollowedCurve& piece, const CriticalPoint* point) {
  for (const auto* side : {&piece.growing, &piece.falling})
    for (const CriticalHit& hit : side->hits)
      if (&hit.point == point) return &hit;
  const bool is_start = !piece.growing.points.empty() && point == &piece.growing.points.front();
  return is_start && piece.at_start ? &*piece.at_start : nullptr;
}

/// Degeneracies are those of the equilibrium at its load, whatever the parameter; only where the load is
/// stationary along the curve depends on that.
std::optional<CriticalHit> degeneracy_of(const LabelledRow& row) {
  using continuation::Degeneracy;
  if (row.hit == nullptr || row.hit->kind == Degeneracy::user ||
      row.hit->kind == Degeneracy::extremum)
    return std::nullopt;
  return *row.hit;
}

std::optional<LabelledRow> row_at(const CurveRun& run, const std::string& label) {
  for (std::size_t b = 0; b < run.result.branches.size(); ++b) {
    const Branch& branch = run.result.branches[b];
    for (const Event& event : branch.events) {
      if (event.label != label) continue;
      const FollowedCurve& piece = run.pieces[b];
      const CriticalPoint* point = point_at(piece, branch.samples[event.row].values.front());
      if (point == nullptr) return std::nullopt;
      return LabelledRow{&piece, point, hit_of(piece, point), event.kind,
                         meets_other_spring(piece, branch, event)};
    }
  }
  return std::nullopt;
}

/// Why no curve begins at the row; empty: one does.
std::string trouble_with_row(const CurveRun& before, const std::string& label,
                             const std::optional<LabelledRow>& row) {
  const std::string& name = before.result.study;
  if (!before.result.start.found)
    return quoted(name) + " has no curve: " + before.result.start.message;
  if (!row)
    return quoted(name) + " has no " + label + "; its special points: " + labels_of(before.result) +
           early_ends_of(before.result);
  if (row->kind == EventKind::unresolved)
    return quoted(name) + " is not resolved at " + label +
           ", need a point of it that is, such as one that it marks";
  if (row->is_between_pieces)
    return "another spring is at its threshold at " + label + " of " + quoted(name) +
           ", where its curve ends, need a point beside it, such as one that it marks";
  return {};
}

/// The row as a start of curves that have its values.
CriticalStart start_in(const CaseCurves& curves, const LabelledRow& row) {
  CriticalStart start = row.piece->start;
  start.x = row.point->x;
  start.lambda = row.point->lambda;
  start.mu = curves.base().mu;
  // The branch point through which the limit points of its imperfect versions lead is one still.
  if (row.kind == EventKind::branch_point) start.kind = CriticalKind::branch_point;
  return start;
}

/// Is that point a solution for these curves, as it is for those it comes from?
bool is_point_of(const CaseCurves& curves, const CriticalStart& start) {
  const auto same = polish_critical(curves.family(), start);
  return !same || ((same->x - start.x).lpNorm<Eigen::Infinity>() <= same_point &&
                   std::abs(same->lambda - start.lambda) <= same_point);
}

/// In the histories of critical curves that begin at each other's rows: that of the first one.
const History& history_of_first(const History& history) {
  const History* of = &history;
  while (begins_on_curve(*of)) of = &of->earlier->history;
  return *of;
}

/// With the states that studies before the first curve lead to, for all values.
Study in_states_of(const History& history, Study study, const Observer& observer) {
  const History& first = history_of_first(history);
  if (first.earlier)
    study.critical.cases =
        after(std::make_shared<const Arrivals>(first, observer), study.critical.cases, study);
  return study;
}

CurveRun earlier_curve(const History& history, const Observer& observer) {
  const Earlier& earlier = *history.earlier;
  CurveRun run =
      begins_on_curve(earlier.history)
          ? begin_on_curve(earlier.history, earlier.study, observer)
          : begin_critical_curve(in_states_of(earlier.history, earlier.study, observer), observer);
  if (run.result.start.found) follow_within_rules(run, observer);
  return run;
}

/// The parameter's value there: the mark, or the end of the range, where it was located at one.
double value_there(const CurveRun& before, const CriticalPoint& point) {
  const CriticalPointSettings& settings = before.study.critical;
  const double scale = before.curves->scale(), value = point.mu * scale;
  std::vector<double> asked{settings.low, settings.high};
  for (const Mark& mark : before.study.marks)
    if (mark.quantity == settings.parameter) asked.push_back(mark.value);
  for (const double one : asked)
    if (std::abs(one - value) <= as_located * scale) return one;
  return value;
}

/// The values of the row, of all parameters that critical curves moved on the way to it.
ParameterChanges held_at(const CurveRun& before, const CriticalPoint& point) {
  const auto& names = before.study.critical.cases->names;
  const auto own = static_cast<std::size_t>(
      std::find(names.begin(), names.end(), before.curves->name()) - names.begin());
  return with_held({{own, value_there(before, point)}}, before.held);
}

/// The curves of the further study, which have the values of the row. @returns false where they cannot begin there
bool make_curves(const CurveRun& before, const LabelledRow& row, CurveRun& run) {
  ParameterChanges held = held_at(before, *row.point);
  CriticalPointSettings& settings = run.study.critical;
  settings.cases = holding(settings.cases, held);
  const auto& names = settings.cases->names;
  const auto own = static_cast<std::size_t>(
      std::find(names.begin(), names.end(), settings.parameter) - names.begin());
  std::erase_if(held, [own](const auto& one) { return one.first == own; });
  std::vector<std::pair<std::string, double>> columns;
  for (const auto& [number, value] : held) columns.emplace_back(names[number], value);
  run.held = std::move(held);
  const Member* from = before.curves->at(row.point->mu);  // with its start, where it has one
  if (from == nullptr) from = before.curves->equations_at(row.point->mu);
  if (from == nullptr) return false;
  run.curves = std::make_shared<CaseCurves>(run.study, own, *from, std::move(columns));
  return run.curves->has_base();
}

/// The same kind of special point at the row. @returns false where it is none of these curves
bool make_origin(const CurveRun& before, const LabelledRow& row, const std::string& place,
                 CurveRun& run) {
  run.of_point = before.of_point;
  run.origin = before.origin;
  run.origin.of = row.kind == EventKind::branch_point ? row.kind : row.piece->of;
  run.origin.point.label = place;
  run.origin.degeneracy = degeneracy_of(row);
  run.origin.starts = critical_starts_again(*run.curves, *before.origin.member, before.origin.point,
                                            start_in(*run.curves, row));
  return !run.origin.starts.empty() && is_point_of(*run.curves, run.origin.starts.front());
}

}  // namespace

bool begins_on_curve(const History& history) {
  return history.earlier && history.earlier->study.kind == StudyKind::critical_curve;
}

CurveRun begin_on_curve(const History& history, const Study& study, const Observer& observer) {
  CurveRun run{.study = in_states_of(history, study, observer)};
  StudyResult& result = run.result;
  result.study = study.name;
  const CurveRun before = earlier_curve(history, observer);
  const std::string& label = history.earlier->at;
  const auto row = before.result.start.found ? row_at(before, label) : std::nullopt;
  const auto refused = [&](const std::string& message, const std::string& where) {
    result.start.found = false;
    result.start.message = message;
    result.start.where = where;
    return std::move(run);
  };
  if (const std::string why = trouble_with_row(before, label, row); !why.empty())
    return refused(why, "critical_curve.of");
  const CriticalPointSettings& settings = run.study.critical;
  const std::string place = label + " of " + quoted(before.result.study);
  if (!make_curves(before, *row, run)) {
    const auto value = run.curves ? run.curves->value() / run.curves->scale() : std::nan("");
    return refused(
        "at " + place + ": " + (run.curves ? run.curves->why_none(value) : "there is no start"),
        "critical_curve.of");
  }
  const double value = run.curves->value();
  if (!(settings.low <= value && value <= settings.high))
    return refused("the value of \"" + settings.parameter + "\" at " + place +
                       outside_range(value, "the range", settings.low, settings.high) +
                       ": the curve begins there",
                   "critical_curve.range");
  if (!make_origin(before, *row, place, run))
    return refused("the equations do not hold at " + place + " with " + settings.parameter + " = " +
                       rounded(value),
                   "critical_curve.of");
  const Member& base = run.curves->base();
  result.start = base.report;
  result.start.found = true;
  result.start.method = "at " + place;
  result.quantities = critical_quantities(*run.curves);
  result.lambda_unit = lambda_unit_of(base.study, base.setup.system);
  return run;
}

}  // namespace springfold::analysis
