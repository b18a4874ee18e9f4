#include "springfold/analysis/study.hpp"

#include <algorithm>
#include <cmath>

#include "outside_range.hpp"
#include "quantities.hpp"
#include "run_kinds.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {
namespace {

/// Loads with lambda need one that moves in units of its own.
void check_loads(const Study& study, const model::Mechanism& mechanism,
                 std::vector<std::string>& problems) {
  const bool traces = study.kind != StudyKind::equilibrium;
  for (const model::Load& load : mechanism.loads)
    if (load.with_lambda && (!traces || study.control == ControlMode::parameter))
      problems.push_back(
          "loads: scale = \"lambda\" needs a study that drives one of load, pose, "
          "mixed, actuator");
  const auto in_chain = [](const model::Anchor& anchor) { return anchor.chain >= 0; };
  bool loaded_chains = !mechanism.line_springs.empty() || !mechanism.shape_springs.empty();
  for (const model::Load& load : mechanism.loads)
    loaded_chains |= in_chain(load.on) || load.kind == model::LoadKind::pressure;
  for (const model::Chain& chain : mechanism.chains)
    for (const model::ChainPoint& point : chain.points)
      loaded_chains |= point.mass != 0 && !mechanism.gravity.isZero(0);
  if (loaded_chains && study.start.solver == StartSolver::fixed_point)
    problems.push_back(
        "start.solver: the paper's fixed-point iteration knows wrenches at the ends "
        "of chains only, no loads, masses and springs between points within them");
}

void check_direction(const Study& study, const model::Body& body, bool some_load_grows,
                     std::vector<std::string>& problems) {
  const Index d = dimension(body.task_space), lengths = translations(body.task_space);
  const bool needed = study.control == ControlMode::load || study.control == ControlMode::pose ||
                      study.control == ControlMode::mixed;
  if (study.direction.size() == 0) {
    if (study.control == ControlMode::load && some_load_grows) return;
    if (needed && study.kind == StudyKind::force_deflection)
      problems.push_back("direction: this control mode needs one");
    return;
  }
  if (study.direction.size() != d || !study.direction.allFinite() || study.direction.isZero(0)) {
    problems.push_back("direction: need " + std::to_string(d) +
                       " finite numbers that are not all zero");
    return;
  }
  if (study.prescribed.empty() && study.control == ControlMode::mixed &&
      !study.direction.head(lengths).isZero(0) && !study.direction.tail(d - lengths).isZero(0))
    problems.push_back(
        "direction: control \"mixed\" needs a pure translation or a pure rotation; which wrench "
        "stays zero beside a screw would depend on the unit of length");
}

/// `prescribed`: names of pose coordinates, those along which the direction leads among them.
void check_prescribed(const Study& study, const model::Body& body,
                      std::vector<std::string>& problems) {
  if (study.prescribed.empty()) return;
  if (study.control != ControlMode::mixed || study.kind != StudyKind::force_deflection)
    problems.push_back("prescribed: has no meaning here, need control = \"mixed\" with it");
  const std::vector<std::string> names = statics::pose_names(body.task_space);
  for (std::size_t i = 0; i < study.prescribed.size(); ++i) {
    const std::string& name = study.prescribed[i];
    const auto here = study.prescribed.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.push_back("prescribed: the body has no pose coordinate \"" + name + "\"");
    if (std::find(study.prescribed.begin(), here, name) != here)
      problems.push_back("prescribed: \"" + name + "\" is named twice");
  }
  const auto prescribed = prescribed_coordinates(study, body.task_space);
  if (prescribed.size() == names.size())
    problems.push_back("prescribed: all coordinates, that is control = \"pose\"");
  for (Index i = 0; i < study.direction.size() && i < dimension(body.task_space); ++i)
    if (study.direction[i] != 0 &&
        std::find(prescribed.begin(), prescribed.end(), i) == prescribed.end())
      problems.push_back("direction: leads along " + names[static_cast<std::size_t>(i)] +
                         ", which is not prescribed");
}

void check_start(const Study& study, const model::Mechanism& mechanism, const model::Body& body,
                 std::vector<std::string>& problems) {
  const Index d = dimension(body.task_space);
  const StartOptions& start = study.start;
  if (start.pose.size() != 0 && (start.pose.size() != d || !start.pose.allFinite()))
    problems.push_back("start.pose: need " + std::to_string(d) + " finite numbers");
  if (start.attempts < 1) problems.push_back("start.attempts: need at least 1");
  if (!(start.maximum_move >= 0)) problems.push_back("start.maximum_move: need a number >= 0");
  if (start.solver == StartSolver::fixed_point && start.solve == StartSolve::pose)
    problems.push_back(
        "start.solver: the paper's fixed-point iteration works at a given pose; use it with "
        "start.solve = \"wrench\" or \"actuators\"");
  if (start.solve != StartSolve::actuators) return;
  const auto commands = static_cast<Index>(statics::prepare(mechanism).command_names.size());
  if (commands != d)
    problems.push_back(
        "start.solve: \"actuators\" needs as many actuated joints as the body has "
        "pose coordinates (" +
        std::to_string(d) + "), the mechanism has " + std::to_string(commands));
}

void check_quantities(const Study& study, const model::Mechanism& mechanism,
                      std::vector<std::string>& problems) {
  const auto list = quantities_of(study, statics::prepare(mechanism), {}, 1, Unit::none);
  const auto check = [&](const std::string& key, const std::string& name) {
    const QuantityDefinition* q = find_quantity(list, name);
    if (q == nullptr)
      problems.push_back(key + ": no quantity \"" + name + "\" in this study");
    else if (!is_continuous(*q))
      problems.push_back(key + ": \"" + name +
                         "\" cannot be used here, only quantities that vary "
                         "continuously along the branch");
  };
  for (const Limit& limit : study.until) {
    check("until", limit.quantity);
    if (!(limit.low < limit.high))
      problems.push_back("until." + limit.quantity + ": need low < high");
  }
  for (const std::string& name : study.extrema) {
    check("extrema", name);
    if (name == "lambda" || name == "force" || name == "s")
      problems.push_back("extrema: \"" + name +
                         (name == "s"
                              ? "\" only grows"
                              : "\" has its extrema at limit points, which are told anyway") +
                         ", need other quantities");
  }
  for (const Mark& mark : study.marks) {
    check("mark", mark.quantity);
    if (!std::isfinite(mark.value))
      problems.push_back("mark." + mark.quantity + ": need a finite number");
  }
}

void check_control(const Study& study, const model::Mechanism& mechanism,
                   std::vector<std::string>& problems) {
  if (study.kind != StudyKind::force_deflection) return;
  if (study.control == ControlMode::parameter && study.parameter.empty())
    problems.push_back("parameter: control \"parameter\" needs the name of one");
  if (study.control != ControlMode::actuator) return;
  const auto names = statics::prepare(mechanism).command_names;
  bool moves = false;
  for (const ActuatorRate& rate : study.actuators) {
    if (std::find(names.begin(), names.end(), rate.actuator) == names.end())
      problems.push_back("actuators: no actuated joint \"" + rate.actuator + "\"");
    if (!std::isfinite(rate.rate))
      problems.push_back("actuators." + rate.actuator + ": need a finite number");
    moves = moves || rate.rate != 0;
  }
  if (!moves) problems.push_back("actuators: control \"actuator\" needs one that moves");
}

void check_steps(const TraceSettings& t, std::vector<std::string>& problems) {
  if (!(t.minimum_step > 0)) problems.push_back("trace.minimum_step: need a number > 0");
  if (!(t.initial_step <= t.maximum_step))
    problems.push_back("trace.initial_step: got " + rounded(t.initial_step) +
                       ", need at most maximum_step, " + rounded(t.maximum_step));
  if (!(t.minimum_step <= t.initial_step))
    problems.push_back("trace.minimum_step: got " + rounded(t.minimum_step) +
                       ", need at most initial_step, " + rounded(t.initial_step));
}

void check_branches(const Study& study, std::vector<std::string>& problems) {
  const BranchSettings& b = study.branches;
  if (b.depth < 0) problems.push_back("branches.depth: need a whole number >= 0");
  if (b.maximum < 1) problems.push_back("branches.maximum: need at least 1");
  if (b.starts < 1) problems.push_back("branches.starts: need at least 1");
  if (study.path == Path::davidenko && (b.depth > 0 || !b.search_at.empty()))
    problems.push_back(
        "branches: path = \"davidenko\" follows the branch of the start alone: it finds no branch "
        "points");
  if (study.kind != StudyKind::force_deflection && (b.depth > 0 || !b.search_at.empty()))
    problems.push_back("branches: only kind = \"force_deflection\" has branches");
  for (const double lambda : b.search_at) {
    if (!std::isfinite(lambda)) problems.push_back("branches.search_at: need finite numbers");
    for (const Limit& limit : study.until)
      if (limit.quantity == "lambda" && !(limit.low <= lambda && lambda <= limit.high))
        problems.push_back("branches.search_at: a value" +
                           outside_range(lambda, "the limits of lambda", limit.low, limit.high));
  }
}

/// Values of lambda of load cycles and searches lie within the study's limits.
void check_levels(const Study& study, std::vector<std::string>& problems) {
  const auto check = [&](const std::string& key, const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) problems.push_back(key + ": need finite numbers");
      for (const Limit& limit : study.until)
        if (limit.quantity == "lambda" && !(limit.low <= value && value <= limit.high))
          problems.push_back(key + ": a value" +
                             outside_range(value, "the limits of lambda", limit.low, limit.high));
    }
  };
  if (study.snap->cycle) {
    if (study.snap->cycle->levels.empty()) problems.push_back("cycle.levels: need at least one");
    check("cycle.levels", study.snap->cycle->levels);
  }
  if (study.snap->transitions) {
    check("transitions.search_at", study.snap->transitions->search_at);
    check("transitions.barriers_at", study.snap->transitions->barriers_at);
  }
}

/// Jumps need all special points, and names of joints that exist.
void check_snap(const Study& study, const model::Mechanism& mechanism,
                std::vector<std::string>& problems) {
  if (!study.snap) return;
  if (study.kind != StudyKind::force_deflection)
    problems.push_back("snap: only studies that trace branches have jumps");
  if (study.path == Path::davidenko)
    problems.push_back("snap: path = \"davidenko\" finds no branch points, need \"arc_length\"");
  if (study.snap->starts < 0) problems.push_back("snap.starts: need a whole number >= 0");
  const statics::System system = statics::prepare(mechanism);
  const auto check = [&](const std::string& key, const std::vector<JointDamping>& list) {
    for (const JointDamping& damping : list) {
      bool found = false;
      for (Index i = 0; i < system.first_pose; ++i)
        found |= !system.is_wrench[static_cast<std::size_t>(i)] &&
                 system.coordinate_names[static_cast<std::size_t>(i)] == damping.joint;
      if (!found) problems.push_back(key + ": no joint coordinate \"" + damping.joint + "\"");
      if (!(damping.value > 0) || !std::isfinite(damping.value))
        problems.push_back(key + "." + damping.joint + ": need a number > 0");
    }
  };
  check("snap.damping", study.snap->damping);
  if (study.snap->inertia) check("snap.inertia.damping", study.snap->inertia->damping);
  check_levels(study, problems);
}

void check_search(const Study& study, const model::Mechanism& mechanism,
                  std::vector<std::string>& problems) {
  const SearchSettings& s = study.search;
  if (s.starts < 1) problems.push_back("search.starts: need at least 1");
  if (s.maximum < 1) problems.push_back("search.maximum: need at least 1");
  if (study.kind == StudyKind::equilibria && study.start.solve == StartSolve::wrench)
    problems.push_back(
        "start.solve: \"wrench\" holds the body, so that there is one equilibrium; use \"pose\"");
  const auto list = quantities_of(study, statics::prepare(mechanism), {}, 1, Unit::none);
  for (const Limit& limit : s.box) {
    const QuantityDefinition* q = find_quantity(list, limit.quantity);
    const std::string key = "search.box." + limit.quantity;
    if (q == nullptr)
      problems.push_back(key + ": no quantity \"" + limit.quantity + "\" in this study");
    else if (q->kind != QuantityDefinition::Kind::unknown || q->unit == Unit::force ||
             q->unit == Unit::moment)
      problems.push_back(key + ": need a coordinate of a body or of a joint");
    if (!(limit.low < limit.high) || !std::isfinite(limit.low) || !std::isfinite(limit.high))
      problems.push_back(key + ": need finite numbers low < high");
  }
}

}  // namespace

std::vector<std::string> problems_in(const Study& study, const model::Mechanism& mechanism) {
  std::vector<std::string> problems;
  if (study.body < 1 || study.body > static_cast<Index>(mechanism.bodies.size()))
    return {"body: no such moving body"};
  if (is_of_commands(study.kind)) return problems_of_kind(study, mechanism);
  if (is_of_critical_points(study.kind)) return problems_of_critical(study, mechanism);
  const model::Body& body = mechanism.bodies[static_cast<std::size_t>(study.body - 1)];
  const Index d = dimension(body.task_space);
  if (study.constant_load.size() != 0 &&
      (study.constant_load.size() != d || !study.constant_load.allFinite()))
    problems.push_back("load: need " + std::to_string(d) + " finite numbers");
  const bool some_load_grows = std::any_of(
      mechanism.loads.begin(), mechanism.loads.end(),
      [](const model::Load& load) { return load.with_lambda && !load.vector.isZero(0); });
  check_direction(study, body, some_load_grows, problems);
  check_prescribed(study, body, problems);
  check_loads(study, mechanism, problems);
  check_start(study, mechanism, body, problems);
  check_control(study, mechanism, problems);
  const TraceSettings& t = study.trace;
  check_steps(study.trace, problems);
  check_branches(study, problems);
  if (!(t.spacing >= 0)) problems.push_back("trace.spacing: must not be negative");
  if (t.maximum_points < 2) problems.push_back("trace.maximum_points: need at least 2");
  if (problems.empty()) check_quantities(study, mechanism, problems);
  if (problems.empty()) check_search(study, mechanism, problems);
  check_snap(study, mechanism, problems);
  return problems;
}

std::vector<std::string> quantity_names(const Study& study, const model::Mechanism& mechanism) {
  if (is_of_critical_points(study.kind)) return critical_columns(study, mechanism);
  std::vector<std::string> names;
  if (is_of_commands(study.kind)) {
    for (const Quantity& q : columns_of(study, mechanism)) names.push_back(q.name);
    return names;
  }
  for (const auto& q : quantities_of(study, statics::prepare(mechanism), {}, 1, Unit::none))
    names.push_back(q.name);
  return names;
}

}  // namespace springfold::analysis
