#include "springfold/io/postures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "nothing.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/shown_text.hpp"
#include "springfold/io/start_text.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::ControlMode;
using analysis::Sample;
using analysis::StudyKind;
using analysis::StudyResult;

/// A wrench of d entries as vectors of space.
drawing::BodyWrench wrench_of(const PlannedRun& planned, const Vector& w) {
  const Index body = planned.plan.body;
  const auto space = planned.mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space;
  drawing::BodyWrench wrench{.body = body};
  wrench.force.head(translations(space)) = w.head(translations(space));
  if (space == model::TaskSpace::planar) wrench.moment.z() = w[2];
  if (space == model::TaskSpace::spatial) wrench.moment = w.tail(3);
  return wrench;
}

std::optional<int> count_of(double value) {
  if (!std::isfinite(value)) return std::nullopt;
  return static_cast<int>(std::lround(value));
}

/// The mechanism as it acts in the study, to be drawn: without the chains that hold bodies where an
/// earlier study left them, which is known only when that one is run.
model::Mechanism acting(const PlannedRun& planned, const model::Mechanism& now) {
  model::Mechanism mechanism =
      analysis::with_springs_from_start(planned.mechanism, planned.plan, now);
  const std::vector<std::string>& held = planned.history.held;
  std::erase_if(mechanism.chains, [&held](const model::Chain& chain) {
    return std::find(held.begin(), held.end(), chain.name) != held.end();
  });
  return mechanism;
}

/// Springs that the case calls bars are drawn as bars.
drawing::Scene with_members(drawing::Scene scene, const PlannedRun& planned) {
  for (drawing::SpringPart& spring : scene.springs)
    if (const auto known = planned.members.find(spring.name);
        known != planned.members.end() && spring.is_line)
      spring.member = known->second;
  return scene;
}

/// Is every row of the study such a point?
bool has_critical_rows(const PlannedRun& planned) {
  // A curve that begins at a row of another one is one of the same points.
  const analysis::Study* plan = &planned.plan;
  const analysis::History* history = &planned.history;
  while (history->earlier && history->earlier->study.kind == StudyKind::critical_curve) {
    plan = &history->earlier->study;
    history = &history->earlier->history;
  }
  const std::string& point = plan->critical.point;
  return plan->kind == StudyKind::critical_load ||
         (plan->kind == StudyKind::critical_curve &&
          (point.starts_with("LP") || point.starts_with("BP")));
}

/// Does the label name a point at which an eigenvalue under dead load is zero, at an end of a stable stretch? Its own
/// count says nothing.
bool is_critical(const StudyResult& result, const std::string& label) {
  using analysis::EventKind;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Event& event : branch.events) {
      if (label.empty() || event.label != label) continue;
      const bool is_singular =
          event.kind == EventKind::limit_point || event.kind == EventKind::branch_point ||
          event.kind == EventKind::touch || event.kind == EventKind::stability_change;
      const auto is_stable = [&](std::size_t row) {
        return value_at(result, branch, row, "index_force") == 0;
      };
      return is_singular &&
             ((event.row > 0 && is_stable(event.row - 1)) || is_stable(event.row + 1));
    }
  return false;
}

}  // namespace

RowScenes::RowScenes(const PlannedRun& planned, const StudyResult& result)
    : planned_{planned}, result_{result} {
  system_ = statics::prepare(acting(planned, planned.mechanism));
  has_columns_ = true;
  for (Index i = 0; i < system_.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    z_columns_.push_back(column_of(result, system_.coordinate_names[k]));
    has_columns_ &= z_columns_.back().has_value() || system_.is_wrench[k];
  }
  for (const std::string& name : system_.command_names) {
    rho_columns_.push_back(column_of(result, name + ".rho"));
    has_columns_ &= rho_columns_.back().has_value();
  }
  sizes_ = quantity_sizes(result);
  lambda_ = column_of(result, "lambda");
  force_ = column_of(result, "force");
  deflection_ = column_of(result, "deflection");
  dead_ = column_of(result, "index_force");
  driven_ = column_of(result, "index_driven");
  if (!driven_) driven_ = column_of(result, "index");
}

double RowScenes::value(const Sample& row, std::optional<std::size_t> column) const {
  return column && *column < row.values.size() ? row.values[*column] : nothing;
}

double RowScenes::shown_value(const Sample& row, std::optional<std::size_t> column) const {
  return column ? shown_in(sizes_, *column, value(row, column)) : nothing;
}

/// Rows of designs and of curves over a further parameter belong to other values of it, and of the parameter along the
/// path where that is lambda.
std::optional<analysis::Variant> RowScenes::variant_of(const Sample& row) const {
  const auto& cases = planned_.plan.critical.cases;
  if (!cases) return std::nullopt;
  std::vector<std::string> names{planned_.plan.critical.parameter};
  if (planned_.plan.kind == StudyKind::critical_curve)
    names.insert(names.end(), planned_.plan.critical.parameters.begin(),
                 planned_.plan.critical.parameters.end());
  if (planned_.plan.kind == StudyKind::design) names.clear();
  for (const auto& parameter : planned_.plan.design.parameters) names.push_back(parameter.name);
  const bool along = planned_.plan.control == ControlMode::parameter &&
                     analysis::is_of_critical_points(planned_.plan.kind);
  std::vector<std::pair<std::size_t, double>> changes;
  for (std::size_t i = 0; i < cases->names.size(); ++i)
    if (std::find(names.begin(), names.end(), cases->names[i]) != names.end())
      changes.emplace_back(i, value(row, column_of(result_, cases->names[i])));
    else if (along && cases->names[i] == planned_.plan.parameter)
      changes.emplace_back(i, value(row, lambda_));
  const bool known = std::all_of(changes.begin(), changes.end(),
                                 [](const auto& change) { return std::isfinite(change.second); });
  if (changes.empty() || !known) return std::nullopt;
  return cases->at(changes);
}

statics::System RowScenes::system_of(const Sample& row, double lambda,
                                     const std::optional<analysis::Variant>& variant) const {
  if (const auto& map = planned_.plan.map; planned_.plan.kind == StudyKind::map && map.situation) {
    std::vector<double> parameters;
    for (std::size_t i = 0; i < map.axes.size(); ++i)
      if (!map.axes[i].pose) parameters.push_back(value(row, i));
    if (!parameters.empty())
      return statics::prepare(acting(planned_, map.situation(parameters).mechanism));
  }
  if (variant) return statics::prepare(acting(planned_, variant->mechanism));
  if (planned_.plan.control != ControlMode::parameter || !planned_.family ||
      planned_.plan.kind != StudyKind::force_deflection)
    return system_;
  return statics::prepare(acting(planned_, planned_.family->at(lambda).mechanism));
}

void RowScenes::add_wrenches(const Sample& row, double lambda,
                             const std::optional<analysis::Variant>& variant,
                             drawing::Posture& posture) const {
  const analysis::Study& plan = variant ? variant->study : planned_.plan;
  const StudyKind kind = planned_.plan.kind;
  const bool traces = kind == StudyKind::force_deflection || analysis::is_of_critical_points(kind);
  Vector w = plan.constant_load;
  if (traces && !variant && plan.control == ControlMode::parameter && planned_.family)
    w = planned_.family->at(lambda).constant_load;
  if (traces && plan.control == ControlMode::load && plan.direction.size() > 0)
    w = (w.size() > 0 ? w : Vector::Zero(plan.direction.size())) + lambda * plan.direction;
  if (w.size() > 0) posture.wrenches.push_back(wrench_of(planned_, w));
  const bool drives =
      traces && (plan.control == ControlMode::pose || plan.control == ControlMode::mixed);
  const bool pushes = traces && plan.control == ControlMode::load;
  if (plan.direction.size() == 0 || (!drives && !pushes)) return;
  posture.wrenches.push_back(wrench_of(planned_, plan.direction));
  posture.wrenches.back().is_direction = true;
  if (!drives) return;
  // What holds the body where it is driven to, along the direction.
  const double force = shown_value(row, force_);
  drawing::BodyWrench reaction = wrench_of(planned_, plan.direction);
  // Along the translation, or about the axis where there is none.
  if (reaction.force.norm() > 0) reaction.moment.setZero();
  const double size = std::hypot(reaction.force.norm(), reaction.moment.norm());
  const double factor = size > 0 && std::isfinite(force) ? force / size : 0;
  reaction.force *= factor;
  reaction.moment *= factor;
  posture.wrenches.push_back(reaction);
}

std::optional<drawing::Scene> RowScenes::scene_of(const Sample& row) const {
  if (!has_columns_) return std::nullopt;
  const double lambda = value(row, lambda_);
  const auto variant = variant_of(row);
  const statics::System system = system_of(row, lambda, variant);
  drawing::Posture posture{.z = Vector(system.size),
                           .rho = Vector(system.commands.size()),
                           .lambda = std::isfinite(lambda) ? lambda : 0};
  for (Index i = 0; i < system.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    posture.z[i] = value(row, z_columns_[k]);
    if (!system.is_wrench[k] && !std::isfinite(posture.z[i])) return std::nullopt;
  }
  for (Index i = 0; i < posture.rho.size(); ++i)
    posture.rho[i] = value(row, rho_columns_[static_cast<std::size_t>(i)]);
  if (!posture.rho.allFinite()) return std::nullopt;
  add_wrenches(row, posture.lambda, variant, posture);
  return with_members(drawing::scene_of(system, posture), planned_);
}

std::vector<model::Vec3<double>> RowScenes::motion_at(const Sample& row,
                                                      const std::vector<double>& rates) const {
  if (rates.size() != result_.quantities.size()) return {};
  double fastest = 0;
  Sample ahead = row, behind = row;
  for (const double rate : rates)
    if (std::isfinite(rate)) fastest = std::max(fastest, std::abs(rate));
  if (!(fastest > 0)) return {};
  constexpr double relative = 1e-5;  // of the values' sizes: error of the order of its square
  const double h = relative / fastest;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double by = std::isfinite(rates[i]) ? h * rates[i] : 0;
    ahead.values[i] += by;
    behind.values[i] -= by;
  }
  const auto a = scene_of(ahead), b = scene_of(behind);
  if (!a || !b || a->points.size() != b->points.size()) return {};
  std::vector<model::Vec3<double>> motion;
  for (std::size_t i = 0; i < a->points.size(); ++i)
    motion.emplace_back((a->points[i] - b->points[i]) / (2 * h));
  return motion;
}

std::optional<drawing::Panel> RowScenes::panel_of(const Sample& row, const std::string& title,
                                                  const UnitLabels& units) const {
  auto scene = scene_of(row);
  if (!scene) return std::nullopt;
  drawing::Panel panel{.scene = std::move(*scene),
                       .title = title,
                       .unstable_dead = count_of(value(row, dead_)),
                       .unstable_driven = count_of(value(row, driven_))};
  panel.is_critical = is_critical(result_, row.event) || has_critical_rows(planned_);
  for (const auto column : {lambda_, force_, deflection_}) {
    const double v = shown_value(row, column);
    if (!column || !std::isfinite(v)) continue;
    const analysis::Quantity& q = result_.quantities[*column];
    const std::string unit = unit_label(q.unit, result_.lambda_unit, units);
    panel.notes.push_back(shown_name(result_, q.name) + " = " + rounded(v, 5) +
                          (unit.empty() ? "" : " " + shown_in_line(unit)));
  }
  return panel;
}

std::string posture_title(const PlannedRun& planned, const std::string& what) {
  return shown_in_line(planned.study + (planned.label.empty() ? "" : ", " + planned.label) + ": " +
                       what);
}

drawing::IllustrationOptions illustration_options(const Case& the_case, const std::string& view,
                                                  const std::string& colour) {
  using Vec = model::Vec3<double>;
  drawing::IllustrationOptions options;
  options.title = shown_in_line(the_case.title);
  options.force_unit = shown_in_line(the_case.units.force);
  options.energy_unit = shown_in_line(the_case.units.force + "·" + the_case.units.length);
  options.colouring = colour == "force"    ? drawing::Colouring::force
                      : colour == "energy" ? drawing::Colouring::energy
                      : colour == "none"   ? drawing::Colouring::none
                                           : drawing::Colouring::stability;
  if (view == "xy") options.view = drawing::View{};
  if (view == "xz") options.view = drawing::View{Vec::UnitX(), Vec::UnitZ()};
  options.is_perspective = view == "perspective";
  if (view == "yz") options.view = drawing::View{Vec::UnitY(), Vec::UnitZ()};
  return options;
}

drawing::Panel guess_panel(const PlannedRun& planned, const std::string& title) {
  model::Mechanism mechanism = planned.mechanism;
  const auto body = static_cast<std::size_t>(planned.plan.body - 1);
  if (planned.plan.start.pose.size() > 0) mechanism.bodies[body].pose = planned.plan.start.pose;
  const statics::System system = statics::prepare(
      analysis::with_springs_from_start(planned.mechanism, planned.plan, mechanism));
  drawing::Posture posture = drawing::guess_posture(system);
  if (planned.plan.constant_load.size() > 0)
    posture.wrenches.push_back(wrench_of(planned, planned.plan.constant_load));
  if (planned.plan.direction.size() > 0) {
    posture.wrenches.push_back(wrench_of(planned, planned.plan.direction));
    posture.wrenches.back().is_direction = true;
  }
  return {.scene = with_members(drawing::scene_of(system, posture), planned), .title = title};
}

FoundRow row_at(const StudyResult& result, const std::string& label) {
  for (const FoundRow& found : special_rows(result))
    if (found.title == label) return found;
  if (label != "end" || result.branches.empty() || result.branches.front().samples.empty())
    return {};
  return {&result.branches.front().samples.back(), label};
}

std::string why_no_posture(const PlannedRun& planned, const StudyResult& result,
                           const std::string& label) {
  if (!result.start.found && !result.start.message.empty())
    return planned.study + ": " + start_problem(result.start, &planned);
  if (!RowScenes{planned, result}.has_postures())
    return planned.study + ": results of this kind do not say where everything is";
  std::string list;
  for (const FoundRow& row : special_rows(result)) list += (list.empty() ? "" : ", ") + row.title;
  return "there is no posture" + (label.empty() ? "" : " \"" + label + "\"") + " in " +
         planned.study + "; there are: " + list + (list.empty() ? "none" : ", end");
}

std::vector<FoundRow> special_rows(const StudyResult& result) {
  std::vector<FoundRow> rows;
  if (result.equilibria)
    for (const analysis::Equilibrium& at : result.equilibria->list)
      rows.push_back({&at.sample, at.label});
  std::set<std::string> seen;
  for (const analysis::Branch& branch : result.branches) {
    const bool is_first = &branch == &result.branches.front();
    if (is_first && branch.start_row < branch.samples.size())
      rows.push_back({&branch.samples[branch.start_row], "start"});
    for (const analysis::Event& event : branch.events)
      if (event.row < branch.samples.size() && seen.insert(event.label).second)
        rows.push_back({&branch.samples[event.row], event.label});
  }
  return rows;
}

std::vector<FoundRow> special_postures(const StudyResult& result) {
  std::vector<FoundRow> postures;
  for (FoundRow& found : special_rows(result)) {
    const auto same =
        std::find_if(postures.begin(), postures.end(),
                     [&found](const FoundRow& other) { return other.row == found.row; });
    if (same == postures.end())
      postures.push_back(std::move(found));
    else
      same->title += ", " + found.title;
  }
  return postures;
}

}  // namespace springfold::io
