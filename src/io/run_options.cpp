#include "run_options.hpp"

namespace springfold::io {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vector& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

/// Open ends of a range are null.
Json json_of(const analysis::Limit& limit) {
  return {{"quantity", limit.quantity}, {"low", limit.low}, {"high", limit.high}};
}

Json json_of(const analysis::Mark& mark) {
  return {{"quantity", mark.quantity}, {"value", mark.value}};
}

Json json_of(const analysis::ActuatorRate& rate) {
  return {{"actuator", rate.actuator}, {"rate", rate.rate}};
}

Json json_of(const analysis::JointDamping& damping) {
  return {{"joint", damping.joint}, {"value", damping.value}};
}

template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(json_of(item));
  return list;
}

/// null where no jumps are wanted.
Json json_of(const std::optional<analysis::SnapSettings>& snap) {
  if (!snap) return nullptr;
  Json json = {{"starts", snap->starts}, {"seed", snap->seed}, {"damping", list_of(snap->damping)}};
  if (snap->inertia)
    json["inertia"] = {{"damping_ratio", snap->inertia->damping_ratio},
                       {"damping", list_of(snap->inertia->damping)}};
  if (snap->cycle) json["cycle"] = {{"levels", snap->cycle->levels}, {"times", snap->cycle->times}};
  if (snap->transitions)
    json["transitions"] = {{"search_at", snap->transitions->search_at},
                           {"barriers_at", snap->transitions->barriers_at},
                           {"starts", snap->transitions->starts},
                           {"maximum", snap->transitions->maximum}};
  return json;
}

/// Name and value of every option of one study, without saying which are defaults.
std::vector<NamedOption> listed(const analysis::Study& study, const std::string& body) {
  const auto& [initial, minimum, maximum, points, spacing, verify_arcs] = study.trace;
  return {{"kind", std::string(to_string(study.kind))},
          {"control", std::string(to_string(study.control))},
          {"body", body},
          {"direction", json_of(study.direction)},
          {"constant_load", json_of(study.constant_load)},
          {"actuators", list_of(study.actuators)},
          {"parameter", study.parameter},
          {"start.solve", std::string(to_string(study.start.solve))},
          {"start.solver", std::string(to_string(study.start.solver))},
          {"start.pose", json_of(study.start.pose)},
          {"start.attempts", study.start.attempts},
          {"start.seed", study.start.seed},
          {"start.maximum_move", study.start.maximum_move},
          {"until", list_of(study.until)},
          {"marks", list_of(study.marks)},
          {"extrema", study.extrema},
          {"trace.initial_step", initial},
          {"trace.minimum_step", minimum},
          {"trace.maximum_step", maximum},
          {"trace.maximum_points", points},
          {"trace.spacing", spacing},
          {"trace.verify_arcs", verify_arcs},
          {"path", study.path == analysis::Path::davidenko ? "davidenko" : "arc_length"},
          {"branches.depth", study.branches.depth},
          {"branches.maximum", study.branches.maximum},
          {"branches.search_at", study.branches.search_at},
          {"branches.starts", study.branches.starts},
          {"branches.seed", study.branches.seed},
          {"search.starts", study.search.starts},
          {"search.seed", study.search.seed},
          {"search.maximum", study.search.maximum},
          {"search.box", list_of(study.search.box)},
          {"snap", json_of(study.snap)}};
}

std::string body_name(const model::Mechanism& mechanism, Index body) {
  const bool exists = body >= 1 && body <= std::ssize(mechanism.bodies);
  return exists ? mechanism.bodies[static_cast<std::size_t>(body - 1)].name : "";
}

/// "foot.x", ...: what the run no longer holds.
std::vector<std::string> released_names(const PlannedRun& planned) {
  std::vector<std::string> names;
  for (const analysis::Released& one : planned.history.released)
    names.push_back(body_name(planned.mechanism, one.body) + "." + "xyz"[one.coordinate]);
  return names;
}

}  // namespace

std::vector<NamedOption> options_of(const PlannedRun& planned) {
  const analysis::Study untouched;
  auto used = listed(planned.plan, body_name(planned.mechanism, planned.plan.body));
  const auto defaults = listed(untouched, body_name(planned.mechanism, untouched.body));
  for (std::size_t i = 0; i < used.size(); ++i)
    used[i].is_default = used[i].value == defaults[i].value;
  const auto& earlier = planned.history.earlier;
  if (earlier && earlier->study.kind == analysis::StudyKind::critical_curve) {
    used.push_back({"critical_curve.of", planned.plan.critical.point});
  } else if (earlier) {
    used.push_back({"start.from", earlier->study.name});
    used.push_back({"start.at", earlier->at});
    used.push_back({"start.loads", earlier->keeps_loads ? "kept" : "own"});
    used.push_back({"start.hold", planned.history.held});
    used.push_back({"start.release", released_names(planned)});
  }
  return used;
}

}  // namespace springfold::io
