#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

/// The numbers of one spring, in the units of its joint.
struct SpringReader {
  const Item& item;
  const JointUnits units;
  NumberTable& numbers;
  Reading& reading;

  TableReader table(std::vector<std::string> keys) const {
    keys.insert(keys.begin(), "law");
    keys.insert(keys.end(), "origin");
    return {*item.node, item.key, keys, reading};
  }
  NumberId stiffness(const TableReader& t, const std::string& name) const {
    return t.required_number(name, {Range::non_negative, units.stiffness}, numbers);
  }
  NumberId coordinate(const TableReader& t, const std::string& name) const {
    return t.required_number(name, {Range::finite, units.coordinate}, numbers);
  }
  NumberId free(const TableReader& t) const {
    return t.number("free", {Range::finite, units.coordinate}, numbers, 0);
  }

  /// `origin`: are coordinates those of the joint, or counted from where it stands at the start?
  SpringDraft placed(SpringDraft spring) const {
    const Node* origin = item.node->find("origin");
    if (!origin) return spring;
    const bool from_start = origin->kind == Node::Kind::text && origin->text == "start";
    if (!from_start && !(origin->kind == Node::Kind::text && origin->text == "joint"))
      reading.problems.add(origin->place, item.key + ".origin",
                           "got " + described(*origin) + ", need \"joint\" or \"start\"");
    std::visit([from_start](auto& law) { law.from_start = from_start; }, spring);
    return spring;
  }

  SpringDraft linear() const {
    const TableReader t = table({"stiffness", "free"});
    return LinearDraft{stiffness(t, "stiffness"), free(t)};
  }

  SpringDraft one_sided() const {
    const TableReader t = table({"stiffness", "from", "side"});
    OneSidedDraft spring{.stiffness = stiffness(t, "stiffness"), .from = coordinate(t, "from")};
    if (t.choice("side", {"above", "below"}, 0) == 1)
      spring.side = model::OneSidedSpring::Side::below;
    return spring;
  }

  SpringDraft piecewise_linear() const {
    const TableReader t = table({"breakpoints", "stiffnesses", "free", "preload"});
    PiecewiseLinearDraft spring;
    t.require("breakpoints", "a list of increasing numbers [" + units.coordinate + "]");
    t.require("stiffnesses",
              "a list of numbers >= 0 [" + units.stiffness + "], one more than breakpoints");
    spring.breakpoints = read_numbers(t.list("breakpoints", "a list of increasing numbers"),
                                      {Range::finite, units.coordinate}, numbers, reading);
    spring.stiffnesses = read_numbers(t.list("stiffnesses", "a list of numbers >= 0"),
                                      {Range::non_negative, units.stiffness}, numbers, reading);
    for (std::size_t i = 1; i < spring.breakpoints.size(); ++i)
      numbers.require_less(spring.breakpoints[i - 1], spring.breakpoints[i],
                           "breakpoints increase");
    const Node* stiffnesses = t.find("stiffnesses");
    const std::size_t got = spring.stiffnesses.size(), need = spring.breakpoints.size() + 1;
    if (stiffnesses && t.has("breakpoints") && got != need)
      reading.problems.add(stiffnesses->place, t.key_of("stiffnesses"),
                           "got " + described(*stiffnesses) + ", need " + std::to_string(need) +
                               ": one for every segment, one more than breakpoints");
    spring.free = free(t);
    spring.preload = t.number("preload", {Range::finite, units.torque}, numbers, 0);
    return spring;
  }

  SpringDraft gap() const {
    const TableReader t = table({"stiffness", "low", "high"});
    const GapDraft spring{stiffness(t, "stiffness"), coordinate(t, "low"), coordinate(t, "high")};
    if (t.has("low") && t.has("high")) numbers.require_less(spring.low, spring.high, "low < high");
    return spring;
  }

  SpringDraft stops() const {
    const TableReader t = table({"stiffness", "free", "stop_stiffness", "low", "high"});
    const StopsDraft spring{stiffness(t, "stiffness"), free(t), stiffness(t, "stop_stiffness"),
                            coordinate(t, "low"), coordinate(t, "high")};
    if (t.has("low") && t.has("high")) numbers.require_less(spring.low, spring.high, "low < high");
    return spring;
  }
};

}  // namespace

JointUnits units_of(model::JointKind kind, const UnitLabels& labels) {
  if (kind == model::JointKind::prismatic)
    return {labels.length, labels.force, labels.force + "/" + labels.length};
  const std::string torque = labels.force + "*" + labels.length;
  return {"rad", torque, torque + "/rad"};
}

std::optional<SpringDraft> read_spring(const Item& item, model::JointKind kind,
                                       NumberTable& numbers, Reading& reading) {
  return read_spring(item, units_of(kind, reading.units), numbers, reading);
}

std::optional<SpringDraft> read_spring(const Item& item, const JointUnits& units,
                                       NumberTable& numbers, Reading& reading) {
  static const std::vector<std::string> laws{"linear", "one_sided", "piecewise_linear", "gap",
                                             "stops"};
  const std::string need = "a table such as { law = \"linear\", stiffness = ... }";
  if (!is_table(item, need, reading)) return std::nullopt;
  const Node* law = item.node->find("law");
  if (!law) {
    reading.problems.add(item.node->place, item.key + ".law", "missing, need " + choices(laws));
    return std::nullopt;
  }
  const SpringReader reader{item, units, numbers, reading};
  if (law->kind == Node::Kind::text) {
    if (law->text == "linear") return reader.placed(reader.linear());
    if (law->text == "one_sided") return reader.placed(reader.one_sided());
    if (law->text == "piecewise_linear") return reader.placed(reader.piecewise_linear());
    if (law->text == "gap") return reader.placed(reader.gap());
    if (law->text == "stops") return reader.placed(reader.stops());
  }
  std::string near = nearest(law->text, laws);
  if (!near.empty()) near = ", did you mean \"" + near + "\"?";
  reading.problems.add(law->place, item.key + ".law",
                       "got " + described(*law) + ", need " + choices(laws) + near);
  return std::nullopt;
}

}  // namespace springfold::io
