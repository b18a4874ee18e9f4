#include "command_reader.hpp"

#include <algorithm>
#include <array>

#include "study_reader.hpp"

namespace springfold::io {
namespace {

using analysis::StudyKind;
using model::TaskSpace;

std::vector<std::string> coordinate_words(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return {"x", "y"};
    case TaskSpace::planar:
      return {"x", "y", "phi"};
    case TaskSpace::xyz:
      return {"x", "y", "z"};
    case TaskSpace::spatial:
      return {"x", "y", "z", "rx", "ry", "rz"};
  }
  return {};
}

std::vector<std::string> wrench_words(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return {"Fx", "Fy"};
    case TaskSpace::planar:
      return {"Fx", "Fy", "Mz"};
    case TaskSpace::xyz:
      return {"Fx", "Fy", "Fz"};
    case TaskSpace::spatial:
      return {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  }
  return {};
}

const std::string axes_example = "axes = [{ pose = \"x\", from = -0.5, to = 0.5, points = 21 }]";
const std::vector<std::string> solver_words{"newton", "paper"};
const std::vector<std::string> command_words{"kinetostatic", "geometric", "given"};
const std::vector<std::string> region_shapes{"square", "disc", "cube", "ball"};

class CommandReader {
 public:
  CommandReader(const TableReader& table, const BodyDraft& body,
                const std::vector<std::string>& actuators, NumberTable& numbers, Reading& reading)
      : table_{table},
        body_{body},
        actuators_{actuators},
        numbers_{numbers},
        reading_{reading},
        words_{coordinate_words(body.task_space)} {
    lengths_ = model::translations(body.task_space);
  }

  CommandDraft read(StudyKind kind) {
    if (kind != StudyKind::workspace) read_task();
    if (kind == StudyKind::control) read_path();
    if (kind == StudyKind::map) read_map();
    if (kind == StudyKind::workspace) read_workspace();
    return std::move(draft_);
  }

 private:
  std::optional<Index> coordinate(const Item& item) {
    const std::string& text = item.node->text;
    std::string name = text;
    if (text.starts_with(body_.name + ".")) name = text.substr(body_.name.size() + 1);
    const auto found = std::find(words_.begin(), words_.end(), name);
    if (item.node->kind == Node::Kind::text && found != words_.end()) return found - words_.begin();
    reading_.problems.add(item.node->place, item.key,
                          "got " + described(*item.node) + ", need a pose coordinate of \"" +
                              body_.name + "\": " + choices(words_));
    return std::nullopt;
  }

  void read_task() {
    for (const Item& item : table_.list("prescribe", "a list of pose coordinates"))
      if (const auto k = coordinate(item)) draft_.prescribed.push_back(*k);
    for (const Item& item : table_.list("commands", "a list of actuated joints")) {
      const std::string& name = item.node->text;
      if (std::find(actuators_.begin(), actuators_.end(), name) == actuators_.end())
        reading_.problems.add(item.node->place, item.key,
                              "no actuator \"" + name + "\"" + suggestion(name, actuators_));
      else
        draft_.commands.push_back(name);
    }
    draft_.method =
        std::array{analysis::CommandMethod::newton,
                   analysis::CommandMethod::paper}[table_.choice("solver", solver_words, 0)];
  }

  std::vector<Index> prescribed() const {
    std::vector<Index> all = draft_.prescribed;
    for (Index k = 0; draft_.prescribed.empty() && k < std::ssize(words_); ++k) all.push_back(k);
    return all;
  }

  /// As many numbers as `units`, each with its unit.
  std::vector<NumberId> vector(const Item& item, const std::vector<std::string>& units,
                               const std::string& what) {
    const std::string need = "a list of " + std::to_string(units.size()) + " numbers" + what;
    const auto items = list_items(item, need, reading_);
    if (item.node->kind != Node::Kind::array) return {};
    if (items.size() != units.size()) {
      reading_.problems.add(item.node->place, item.key,
                            "got " + described(*item.node) + ", need " + need);
      return {};
    }
    std::vector<NumberId> ids;
    for (std::size_t i = 0; i < units.size(); ++i)
      ids.push_back(read_number(items[i], {Range::finite, units[i]}, numbers_, reading_));
    return ids;
  }

  std::vector<std::string> target_units() const {
    std::vector<std::string> units;
    for (const Index k : prescribed())
      units.push_back(k < lengths_ ? reading_.units.length : "rad");
    return units;
  }
  std::vector<std::string> pose_units() const {
    std::vector<std::string> units;
    for (Index k = 0; k < std::ssize(words_); ++k)
      units.push_back(k < lengths_ ? reading_.units.length : "rad");
    return units;
  }
  std::vector<std::string> wrench_units() const {
    const std::string force = reading_.units.force;
    std::vector<std::string> units;
    for (Index k = 0; k < std::ssize(words_); ++k)
      units.push_back(k < lengths_ ? force : force + "*" + reading_.units.length);
    return units;
  }
  std::vector<std::string> plain_units() const { return std::vector<std::string>(words_.size()); }

  std::vector<NumberId> required_vector(const TableReader& table, const std::string& name,
                                        const std::vector<std::string>& units,
                                        const std::string& what) {
    const Node* node =
        table.require(name, "a list of " + std::to_string(units.size()) + " numbers");
    if (node == nullptr) return {};
    return vector({node, table.key_of(name)}, units, what);
  }

  std::vector<NumberId> optional_vector(const std::string& name,
                                        const std::vector<std::string>& units,
                                        const std::string& what) {
    const Node* node = table_.find(name);
    if (node == nullptr) return {};
    return vector({node, table_.key_of(name)}, units, what);
  }

  NumberId count(const TableReader& table, const std::string& name) {
    return table.required_number(name, {Range::small_count, ""}, numbers_);
  }

  void read_path() {
    int given = 0;
    for (const char* name : {"targets", "line", "circle", "file"})
      given += table_.has(name) ? 1 : 0;
    if (given != 1)
      reading_.problems.add(table_.place(), table_.key(),
                            "need one of targets, line, circle and file, got " +
                                (given == 0 ? std::string("none") : std::to_string(given)) +
                                ": they say where the path leads");
    const std::string each = ": one for every prescribed coordinate";
    for (const Item& item : table_.list("targets", "a list of targets such as [[0, 0], [0.1, 0]]"))
      if (auto target = vector(item, target_units(), each); !target.empty())
        draft_.targets.push_back(std::move(target));
    if (const Node* list = table_.find("targets");
        list && list->kind == Node::Kind::array && list->items.empty())
      reading_.problems.add(list->place, table_.key_of("targets"),
                            "got an empty list, need at least one target");
    read_line(each);
    read_circle(each);
    if (const auto name = table_.text("file")) {
      TargetFile file{*name, table_.find("file")->place, table_.key_of("file"), {}, {}};
      for (const Index k : prescribed())
        file.coordinates.push_back(words_[static_cast<std::size_t>(k)]);
      file.wrench = wrench_words(body_.task_space);
      draft_.file = std::move(file);
    }
    read_loads();
  }

  void read_line(const std::string& each) {
    const Node* node = table_.find("line");
    const Item item{node, table_.key_of("line")};
    if (!node ||
        !is_table(item, "a table such as { from = [0, 0], to = [1, 0], points = 11 }", reading_))
      return;
    const TableReader line{*node, item.key, {"from", "to", "points"}, reading_};
    LineDraft draft;
    draft.from = required_vector(line, "from", target_units(), each);
    draft.to = required_vector(line, "to", target_units(), each);
    draft.points = line.required_number("points", {Range::at_least_two, ""}, numbers_);
    if (draft.from.size() == draft.to.size() && !draft.from.empty()) draft_.line = draft;
  }

  void read_circle(const std::string& each) {
    const Node* node = table_.find("circle");
    const Item item{node, table_.key_of("circle")};
    if (!node ||
        !is_table(item, "a table such as { centre = [0, 0], radius = 0.3, points = 73 }", reading_))
      return;
    const TableReader circle{
        *node, item.key, {"centre", "radius", "points", "from", "to", "axes"}, reading_};
    CircleDraft draft;
    draft.centre = required_vector(circle, "centre", target_units(), each);
    draft.radius =
        circle.required_number("radius", {Range::positive, reading_.units.length}, numbers_);
    draft.points = circle.required_number("points", {Range::at_least_two, ""}, numbers_);
    draft.from = circle.number("from", {Range::finite, "rad"}, numbers_, 0);
    draft.to = circle.number("to", {Range::finite, "rad"}, numbers_, 6.283185307179586);
    const std::vector<Item> axes = circle.list("axes", "a list of two pose coordinates");
    if (circle.has("axes") && axes.size() != 2)
      reading_.problems.add(circle.find("axes")->place, circle.key_of("axes"),
                            "need a list of two pose coordinates such as [\"x\", \"y\"]");
    const std::vector<Index> all = prescribed();
    for (std::size_t i = 0; i < axes.size() && axes.size() == 2; ++i) {
      const auto k = coordinate(axes[i]);
      if (!k) continue;
      const auto place = std::find(all.begin(), all.end(), *k);
      if (place == all.end() || *k >= lengths_)
        reading_.problems.add(axes[i].node->place, axes[i].key,
                              "need a prescribed coordinate that is a length");
      else
        (i == 0 ? draft.first : draft.second) = place - all.begin();
    }
    if (!draft.centre.empty()) draft_.circle = draft;
  }

  void read_loads() {
    const std::vector<Item> items = table_.list("loads", "a list of wrenches");
    for (const Item& item : items)
      if (auto load = vector(item, wrench_units(), " [force, moment]"); !load.empty())
        draft_.loads.push_back(std::move(load));
    const Node* node = table_.find("loads");
    if (!node || node->kind != Node::Kind::array) return;
    if (draft_.file) {
      reading_.problems.add(
          node->place, table_.key_of("loads"),
          "has no meaning here: columns Fx, Fy, ... of the file are the wrenches");
      return;
    }
    const bool two_ends = table_.has("line") || table_.has("circle");
    const std::size_t wanted = two_ends ? 2 : draft_.targets.size();
    if (items.size() != wanted && (two_ends || !draft_.targets.empty()))
      reading_.problems.add(
          node->place, table_.key_of("loads"),
          "got " + described(*node) + ", need " + std::to_string(wanted) +
              (two_ends ? ": at the first and at the last target" : ": one for every target"));
  }

  void read_map() {
    const Node* list = table_.require(
        "axes", "a list such as [{ pose = \"x\", from = -0.5, to = 0.5, points = 21 }]");
    for (const Item& item : table_.tables("axes", axes_example)) read_axis(item);
    if (list && list->kind == Node::Kind::array && (list->items.empty() || list->items.size() > 3))
      reading_.problems.add(list->place, table_.key_of("axes"),
                            "got " + described(*list) + ", need one to three axes");
    draft_.command =
        std::array{analysis::NodeCommand::kinetostatic, analysis::NodeCommand::geometric,
                   analysis::NodeCommand::given}[table_.choice("command", command_words, 0)];
    draft_.pose = optional_vector("pose", pose_units(), ": the body's pose");
    for (const Item& item : table_.list("directions", "a list of directions such as [[1, 1]]"))
      if (auto direction = vector(item, plain_units(), ""); !direction.empty()) {
        numbers_.require_nonzero(direction, item.node->place, item.key,
                                 "stiffness is measured along it");
        draft_.directions.push_back(std::move(direction));
      }
    read_critical();
  }

  void read_axis(const Item& item) {
    const TableReader table{
        *item.node, item.key, {"pose", "parameter", "from", "to", "points"}, reading_};
    MapAxisDraft axis;
    std::string unit;
    if (table.has("pose") == table.has("parameter")) {
      reading_.problems.add(item.node->place, item.key,
                            "need pose = \"x\" or parameter = \"name\", one of them");
    } else if (const Node* pose = table.find("pose")) {
      axis.pose = coordinate({pose, table.key_of("pose")});
      if (axis.pose) {
        axis.name = "node." + words_[static_cast<std::size_t>(*axis.pose)];
        unit = *axis.pose < lengths_ ? reading_.units.length : "rad";
      }
    } else if (const auto name = table.text("parameter")) {
      axis.name = *name;
      axis.parameter =
          parameter_number(*name, table.find("parameter")->place, table.key_of("parameter"),
                           reading_.book, reading_.problems);
    }
    axis.from = table.required_number("from", {Range::finite, unit}, numbers_);
    axis.to = table.required_number("to", {Range::finite, unit}, numbers_);
    axis.points = count(table, "points");
    if (axis.pose || axis.parameter) draft_.axes.push_back(std::move(axis));
  }

  void read_critical() {
    const Node* node = table_.find("critical");
    const Item item{node, table_.key_of("critical")};
    if (!node || !is_table(item, "a table such as { direction = [1, 1], up_to = 0.5 }", reading_))
      return;
    const TableReader table{*node, item.key, {"direction", "up_to"}, reading_};
    CriticalDraft critical;
    critical.direction = required_vector(table, "direction", plain_units(), "");
    critical.up_to =
        table.required_number("up_to", {Range::positive, reading_.units.force}, numbers_);
    if (critical.direction.empty()) return;
    numbers_.require_nonzero(critical.direction, node->place, table.key_of("direction"),
                             "the load grows along it");
    draft_.critical = std::move(critical);
  }

  void read_workspace() {
    draft_.shape = std::array{
        analysis::RegionShape::square, analysis::RegionShape::disc, analysis::RegionShape::cube,
        analysis::RegionShape::ball}[table_.choice("shape", region_shapes, 0)];
    draft_.centre = optional_vector("centre", pose_units(), ": the body's pose");
    draft_.velocity = read_bounds("velocity_factors");
    draft_.force = read_bounds("force_factors");
    if (!table_.has("velocity_factors") && !table_.has("force_factors"))
      table_.require("velocity_factors", "[low, high], here or in force_factors");
    draft_.up_to =
        table_.required_number("up_to", {Range::positive, reading_.units.length}, numbers_);
  }

  std::vector<NumberId> read_bounds(const std::string& name) {
    const Node* node = table_.find(name);
    if (node == nullptr) return {};
    const std::string need = "[low, high]; 0 and inf stand for no bound";
    const auto items = table_.list(name, need);
    if (node->kind != Node::Kind::array) return {};
    if (items.size() != 2) {
      reading_.problems.add(node->place, table_.key_of(name),
                            "got " + described(*node) + ", need " + need);
      return {};
    }
    const std::vector<NumberId> ids{
        read_number(items[0], {Range::non_negative, ""}, numbers_, reading_),
        read_number(items[1], {Range::maybe_infinite, ""}, numbers_, reading_)};
    numbers_.require_less(ids[0], ids[1], "low < high");
    return ids;
  }

  const TableReader& table_;
  const BodyDraft& body_;
  const std::vector<std::string>& actuators_;
  NumberTable& numbers_;
  Reading& reading_;
  std::vector<std::string> words_{};
  Index lengths_ = 2;
  CommandDraft draft_{};
};

}  // namespace

std::vector<std::string> command_keys(StudyKind kind) {
  std::vector<std::string> keys{"name", "kind", "body", "load", "start", "set", "vary"};
  const auto add = [&keys](const std::vector<std::string>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
  };
  if (kind == StudyKind::control)
    add({"prescribe", "commands", "solver", "trace", "direction", "targets", "loads", "line",
         "circle", "file"});
  if (kind == StudyKind::map)
    add({"prescribe", "commands", "solver", "trace", "axes", "command", "pose", "directions",
         "critical"});
  if (kind == StudyKind::workspace)
    add({"shape", "centre", "velocity_factors", "force_factors", "up_to"});
  return keys;
}

CommandDraft read_commands(StudyKind kind, const TableReader& table, const BodyDraft& body,
                           const std::vector<std::string>& actuators, NumberTable& numbers,
                           Reading& reading) {
  return CommandReader{table, body, actuators, numbers, reading}.read(kind);
}

}  // namespace springfold::io
