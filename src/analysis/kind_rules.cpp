// Columns of the study kinds control, map and workspace, and what such a study must obey.
#include <algorithm>
#include <cmath>
#include <set>

#include "commanded.hpp"
#include "run_kinds.hpp"
#include "springfold/model/point.hpp"
#include "springfold/statics/redundancy.hpp"

namespace springfold::analysis {
namespace {

using Problems = std::vector<std::string>;

Unit pose_unit(const CommandSetup& setup, Index i) {
  return setup.system.is_length[static_cast<std::size_t>(setup.t + i)] ? Unit::length : Unit::angle;
}

std::vector<Quantity> workspace_columns(const CommandSetup& setup) {
  std::vector<Quantity> columns{{"size", Unit::length}, {"width", Unit::length}};
  for (Index i = 0; i < setup.d; ++i)
    columns.push_back({setup.system.coordinate_names[static_cast<std::size_t>(setup.t + i)],
                       pose_unit(setup, i)});
  for (const char* name : {"velocity_min", "velocity_max", "force_min", "force_max"})
    columns.push_back({name, Unit::none});
  return columns;
}

std::vector<Quantity> map_columns(const Study& study, const CommandSetup& setup) {
  std::vector<Quantity> columns;
  for (const MapAxis& axis : study.map.axes)
    columns.push_back({axis.name, axis.pose ? pose_unit(setup, *axis.pose) : Unit::none});
  for (Quantity& q : command_columns(setup, study.map.directions)) columns.push_back(std::move(q));
  if (study.map.critical) {
    const model::TaskSpace space =
        setup.system.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space;
    const bool moves = !study.map.critical->direction.head(translations(space)).isZero(0);
    columns.push_back({"critical_load", moves ? Unit::force : Unit::moment});
  }
  return columns;
}

bool usable(const Vector& v, Index size) { return v.size() == size && v.allFinite(); }

std::string numbers(Index count) { return "need " + std::to_string(count) + " finite numbers"; }

/// @returns false if nothing else can be checked
bool check_command(const Study& study, const model::Mechanism& mechanism, Problems& problems) {
  const statics::System system = statics::prepare(mechanism);
  const auto& names = system.command_names;
  const auto d = dimension(mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space);
  const std::size_t before = problems.size();
  for (const std::string& name : study.command.commands)
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.push_back("commands: no actuated joint \"" + name + "\"");
  if (std::set(study.command.commands.begin(), study.command.commands.end()).size() !=
      study.command.commands.size())
    problems.push_back("commands: need different ones");
  for (const Index k : study.command.prescribed)
    if (k < 0 || k >= d) problems.push_back("prescribe: no such pose coordinate");
  if (std::set(study.command.prescribed.begin(), study.command.prescribed.end()).size() !=
      study.command.prescribed.size())
    problems.push_back("prescribe: need different coordinates");
  if (problems.size() != before) return false;
  const auto commands =
      study.command.commands.empty() ? std::ssize(names) : std::ssize(study.command.commands);
  const auto prescribed =
      study.command.prescribed.empty() ? d : std::ssize(study.command.prescribed);
  if (commands != prescribed || commands == 0)
    problems.push_back("prescribe: need as many pose coordinates as commands, got " +
                       std::to_string(prescribed) + " coordinates and " + std::to_string(commands) +
                       " actuated joints; choose with prescribe and commands");
  if (study.command.method == CommandMethod::paper &&
      (prescribed != d || commands != std::ssize(names) || mechanism.bodies.size() > 1))
    problems.push_back(
        "solver: the paper's scheme prescribes the whole pose of the only body with all commands");
  return problems.size() == before;
}

void check_control(const Study& study, Index prescribed, Index d, Problems& problems) {
  const ControlPath& path = study.targets;
  if (path.count() < 1) problems.push_back("targets: need at least one");
  for (const Vector& target : path.targets)
    if (!usable(target, prescribed))
      problems.push_back("targets: " + numbers(prescribed) + " each");
  if (path.circle) {
    const CirclePath& c = *path.circle;
    if (!usable(c.centre, prescribed)) problems.push_back("circle.centre: " + numbers(prescribed));
    if (!(c.radius > 0)) problems.push_back("circle.radius: need a number > 0");
    if (c.first == c.second || std::max(c.first, c.second) >= prescribed)
      problems.push_back("circle.axes: need two different prescribed coordinates");
    if (c.from == c.to) problems.push_back("circle.to: need another angle than from");
    if (path.circle_points < 2) problems.push_back("circle.points: need at least 2");
  }
  const auto loads = std::ssize(path.loads);
  if (loads != 0 && loads != path.count() && !(path.circle && loads == 2))
    problems.push_back("loads: need one for every target");
  for (const Vector& load : path.loads)
    if (!usable(load, d)) problems.push_back("loads: " + numbers(d) + " each");
}

void check_axis(const Study& study, std::size_t i, Index d, Problems& problems) {
  const MapAxis& axis = study.map.axes[i];
  const std::string key = "axes: axis " + std::to_string(i + 1) + ": ";
  if (!std::isfinite(axis.from) || !std::isfinite(axis.to) ||
      (axis.points > 1 && axis.from == axis.to))
    problems.push_back(key + "need two different finite ends");
  if (axis.points < 1) problems.push_back(key + "need at least one point");
  if (!axis.pose) {
    if (!study.map.situation) problems.push_back(key + "a parameter needs a case");
    return;
  }
  const auto& wanted = study.command.prescribed;
  if (*axis.pose < 0 || *axis.pose >= d)
    problems.push_back(key + "no such pose coordinate");
  else if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), *axis.pose) == wanted.end())
    problems.push_back(key + "this pose coordinate is not among those of prescribe");
  if (study.map.command == NodeCommand::given)
    problems.push_back(key + "with command = \"given\" the pose is a result, need a parameter");
}

void check_map(const Study& study, Index d, Problems& problems) {
  const MapSettings& map = study.map;
  if (map.axes.empty() || map.axes.size() > 3) problems.push_back("axes: need 1 to 3");
  double nodes = 1;
  for (std::size_t i = 0; i < map.axes.size(); ++i) {
    check_axis(study, i, d, problems);
    nodes *= map.axes[i].points;
    for (std::size_t j = 0; j < i; ++j)
      if (map.axes[i].name == map.axes[j].name)
        problems.push_back("axes: \"" + map.axes[i].name + "\" twice");
  }
  if (nodes > 1e7) problems.push_back("axes: more than 10 million nodes");
  if (map.pose.size() != 0 && !usable(map.pose, d)) problems.push_back("pose: " + numbers(d));
  for (const Vector& direction : map.directions)
    if (!usable(direction, d) || direction.isZero(0))
      problems.push_back("directions: " + numbers(d) + " that are not all zero, each");
  if (!map.critical) return;
  if (!usable(map.critical->direction, d) || map.critical->direction.isZero(0))
    problems.push_back("critical.direction: " + numbers(d) + " that are not all zero");
  if (!(map.critical->up_to > 0) || !std::isfinite(map.critical->up_to))
    problems.push_back("critical.up_to: need a number > 0");
}

void check_bounds(const std::string& key, const FactorBounds& bounds, Problems& problems) {
  if (!(bounds.low >= 0) || !(bounds.low < bounds.high))
    problems.push_back(key + ": need 0 <= low < high");
}

void check_workspace(const Study& study, const model::Body& body, Problems& problems) {
  const WorkspaceSettings& w = study.workspace;
  const Index d = dimension(body.task_space), lengths = translations(body.task_space);
  const bool solid = w.shape == RegionShape::cube || w.shape == RegionShape::ball;
  if (solid && lengths < 3) problems.push_back("shape: a body in the plane has a square or a disc");
  if (w.centre.size() != 0 && !usable(w.centre, d)) problems.push_back("centre: " + numbers(d));
  check_bounds("velocity_factors", w.velocity, problems);
  check_bounds("force_factors", w.force, problems);
  const auto bounded = [](const FactorBounds& b) { return b.low > 0 || std::isfinite(b.high); };
  if (!bounded(w.velocity) && !bounded(w.force))
    problems.push_back("velocity_factors: need bounds here or in force_factors");
  if (!(w.up_to > 0) || !std::isfinite(w.up_to)) problems.push_back("up_to: need a number > 0");
}

/// What these kinds do not reckon with yet: they would give wrong numbers without a word.
void check_mechanism(const Study& study, const model::Mechanism& mechanism, Problems& problems) {
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    model::Load load = mechanism.loads[i];
    // A map's parameter may make a load of what is zero here.
    if (study.kind == StudyKind::map && load.vector.isZero(0)) load.vector.setOnes();
    const std::string which =
        "load " + (load.name.empty() ? std::to_string(i + 1) : "\"" + load.name + "\"");
    if (load.with_lambda)
      problems.push_back("kind: " + which + " grows with lambda, which this kind does not have: " +
                         "need constant loads");
    else if (!is_conservative(mechanism, load))
      problems.push_back("kind: " + which + " has no potential: this kind needs loads that have " +
                         "one, such as forces of fixed direction");
  }
  for (const model::Chain& chain : mechanism.chains)
    for (const model::Element& element : chain.elements)
      if (const auto* joint = std::get_if<model::Joint>(&element);
          joint && joint->spring_from_start)
        problems.push_back("kind: spring of " + chain.name + "." + joint->name +
                           " with origin = \"start\": this kind has no start pose, need the " +
                           "spring's own origin");
  const statics::System system =
      statics::prepare(dimensionless(mechanism, scales_for(mechanism, {})));
  const statics::Redundancy found =
      redundant_closures(system, statics::guess(system), system.commands);
  if (found.count == 0) return;
  std::string chains;
  for (const std::size_t chain : found.chains)
    chains += (chains.empty() ? "" : ", ") + mechanism.chains[chain].name;
  problems.push_back("kind: " + std::to_string(found.count) + " of " +
                     std::to_string(system.closure_count()) +
                     " closure equations are redundant, among chains " + chains +
                     ": this kind needs independent ones; give one of the chains an elasticity");
}

}  // namespace

std::vector<Quantity> columns_of(const Study& study, const model::Mechanism& mechanism) {
  const CommandSetup setup = command_setup(mechanism, study, study.constant_load);
  if (study.kind == StudyKind::workspace) return workspace_columns(setup);
  if (study.kind == StudyKind::map) return map_columns(study, setup);
  std::vector<Quantity> columns{{"path", Unit::none}, {"way", Unit::length}};
  const auto directions =
      study.direction.size() > 0 ? std::vector<Vector>{study.direction} : std::vector<Vector>{};
  for (Quantity& q : command_columns(setup, directions)) columns.push_back(std::move(q));
  return columns;
}

Problems problems_of_kind(const Study& study, const model::Mechanism& mechanism) {
  Problems problems;
  const model::Body& body = mechanism.bodies[static_cast<std::size_t>(study.body - 1)];
  const Index d = dimension(body.task_space);
  if (study.constant_load.size() != 0 && !usable(study.constant_load, d))
    problems.push_back("load: " + numbers(d));
  if (study.direction.size() != 0 && (!usable(study.direction, d) || study.direction.isZero(0)))
    problems.push_back("direction: " + numbers(d) + " that are not all zero");
  const bool commands = study.kind != StudyKind::map || study.map.command != NodeCommand::given;
  if (commands && !check_command(study, mechanism, problems)) return problems;
  const Index prescribed =
      study.command.prescribed.empty() ? d : std::ssize(study.command.prescribed);
  if (study.kind == StudyKind::control) check_control(study, prescribed, d, problems);
  if (study.kind == StudyKind::map) check_map(study, d, problems);
  if (study.kind == StudyKind::workspace) check_workspace(study, body, problems);
  check_mechanism(study, mechanism, problems);
  return problems;
}

}  // namespace springfold::analysis
