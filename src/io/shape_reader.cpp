#include "shape_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anchor_reader.hpp"

namespace springfold::io {
namespace {

using model::ShapeKind;

/// Second derivatives of a shape are one matrix of its points: 18 MB for so many.
constexpr std::size_t most_shape_points = 500;

/// What a case calls a shape, and how many points it has. most = 0: any number.
struct ShapeWord {
  const char* text;
  ShapeKind kind;
  std::size_t least, most;
};
constexpr ShapeWord shape_words[]{
    {"distance", ShapeKind::path, 2, 2}, {"path", ShapeKind::path, 2, 0},
    {"angle", ShapeKind::angle, 3, 3},   {"fold", ShapeKind::dihedral, 4, 4},
    {"area", ShapeKind::area, 3, 0},     {"volume", ShapeKind::volume, 4, 0},
    {"line", ShapeKind::line, 3, 3},     {"plane", ShapeKind::plane, 4, 4},
};

const ShapeWord& word_for(const std::string& text) {
  for (const ShapeWord& known : shape_words)
    if (text == known.text) return known;
  return shape_words[1];
}

/// As many points as the shape has?
void check_count(const TableReader& table, const ShapeWord& word, std::size_t got,
                 Reading& reading) {
  if (!table.has("of") || (got >= word.least && (word.most == 0 || got <= word.most))) return;
  std::string need = "got " + std::to_string(got) + (got == 1 ? " point" : " points") + ", need " +
                     std::to_string(word.least) + (word.most == 0 ? " or more" : "");
  if (word.most == 2) need += "; of more points the shape is \"path\"";
  reading.problems.add(table.find("of")->place, table.key_of("of"), need);
}

/// [[1, 2, 3], ...]: numbers of points, counted from 1.
std::vector<std::array<std::size_t, 3>> read_triangles(const TableReader& table, std::size_t points,
                                                       Reading& reading) {
  std::vector<std::array<std::size_t, 3>> triangles;
  const std::string need = "a list of triangles such as [1, 2, 3], numbers of points in `of`";
  for (const Item& item : table.list("triangles", need)) {
    const bool is_list = item.node->kind == Node::Kind::array && item.node->items.size() == 3;
    std::array<std::size_t, 3> corners{};
    bool usable = is_list;
    for (std::size_t k = 0; usable && k < 3; ++k) {
      const Node& node = item.node->items[k];
      usable = node.kind == Node::Kind::number && node.number >= 1 &&
               node.number <= static_cast<double>(points) && node.number == std::floor(node.number);
      if (usable) corners[k] = static_cast<std::size_t>(node.number) - 1;
    }
    if (!usable)
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) +
                               ", need three whole numbers from 1 to " + std::to_string(points) +
                               ": points of `of`");
    triangles.push_back(corners);
  }
  return triangles;
}

/// A key that only some shapes have.
void refuse(const TableReader& table, const std::string& key, const std::string& what,
            Reading& reading) {
  if (const Node* node = table.find(key))
    reading.problems.add(node->place, table.key_of(key), what);
}

/// `turns` of an angle: of three different points of the plane that are nodes or fixed.
bool read_turns(const TableReader& table, const ShapeDraft& shape, const MechanismDraft& draft,
                Reading& reading) {
  if (!table.truth("turns", false)) return false;
  const bool nodes =
      std::all_of(shape.points.begin(), shape.points.end(), [&](const AnchorDraft& point) {
        return point.chain < 0 &&
               (point.body == 0 ||
                draft.bodies[static_cast<std::size_t>(point.body - 1)].task_space ==
                    model::TaskSpace::xy);
      });
  if (!nodes)
    reading.problems.add(
        table.find("turns")->place, table.key_of("turns"),
        "need three nodes in the plane, or fixed points: turns of other bodies and "
        "of chains are counted without it");
  return nodes && shape.points.size() == 3;
}

void read_gas(const Item& item, const JointUnits& units, NumberTable& numbers,
              ShapeSpringDraft& spring, Reading& reading) {
  if (!is_table(item, "a table such as { nRT = 0.1, initial = 1 }", reading)) return;
  const TableReader table{*item.node, item.key, {"nRT", "initial", "exponent"}, reading};
  GasDraft gas;
  gas.nRT = table.required_number(
      "nRT", {Range::non_negative, reading.units.force + "*" + reading.units.length}, numbers);
  gas.initial = table.required_number("initial", {Range::finite, units.coordinate}, numbers);
  gas.exponent = table.number("exponent", {Range::positive, ""}, numbers, 1);
  if (const Node* initial = table.find("initial"))
    numbers.require({gas.initial}, initial->place, table.key_of("initial"),
                    [](const std::vector<double>& value) -> std::string {
                      return value[0] != 0 ? "" : "got 0, need a number that is not 0";
                    });
  spring.gas = gas;
}

/// Exactly one of `law`, `series`, `gas` and `stiffness` with `free`.
void read_energy(const TableReader& table, NumberTable& numbers, ShapeSpringDraft& spring,
                 Reading& reading) {
  const JointUnits units = units_of(spring.shape.kind, reading.units);
  const bool law = table.has("law"), gas = table.has("gas"), plain = table.has("stiffness");
  const bool series = table.has("series");
  if (law + gas + plain + series > 1 || (!plain && table.has("free")))
    return reading.problems.add(table.place(), table.key(),
                                "need one of: stiffness (with free, if it is not 0), "
                                "law = { ... }, series = [{ ... }, ...], gas = { ... }");
  if (!series) refuse(table, "initial", "only springs in series have it, need series", reading);
  const char* const own_zero = "springs between points count from their own zero";
  if (series) {
    spring.series = read_series(table, units, numbers, reading);
    return refuse_origins(table, spring.series, own_zero, reading);
  }
  if (law) {
    const Item at{table.find("law"), table.key_of("law")};
    spring.law = read_spring(at, units, numbers, reading);
    if (spring.law) refuse_origin(at, *spring.law, own_zero, reading);
    return;
  }
  if (gas)
    return read_gas({table.find("gas"), table.key_of("gas")}, units, numbers, spring, reading);
  const NumberId stiffness =
      table.required_number("stiffness", {Range::non_negative, units.stiffness}, numbers);
  spring.law =
      LinearDraft{stiffness, table.number("free", {Range::finite, units.coordinate}, numbers, 0)};
}

bool is_shape_word(const Node* shape) {
  return shape != nullptr && shape->kind == Node::Kind::text &&
         std::any_of(std::begin(shape_words), std::end(shape_words),
                     [shape](const ShapeWord& word) { return shape->text == word.text; });
}

/// What a spring needs follows from its shape: of one that is unknown nothing else is said.
void refuse_shape(const Item& item, MechanismDraft& draft, Reading& reading) {
  std::vector<std::string> words, keys;
  for (const ShapeWord& word : shape_words) words.emplace_back(word.text);
  for (const NodeEntry& entry : item.node->entries) keys.push_back(entry.key);
  const TableReader table{*item.node, item.key, keys, reading};
  table.choice("shape", words, 0);
  ShapeSpringDraft spring{.place = item.node->place, .key = item.key};
  spring.name = read_own_name(table, draft, reading);
  draft.shape_springs.push_back(std::move(spring));
}

void read_shape_spring(const Item& item, MechanismDraft& draft, Reading& reading) {
  const bool ends = item.node->find("to") != nullptr || item.node->find("from") != nullptr;
  std::vector<std::string> keys{"name", "shape",  "stiffness", "free",
                                "law",  "series", "initial",   "gas"};
  if (ends)
    keys.insert(keys.end(), {"from", "from_at", "to", "to_at"});
  else
    keys.insert(keys.end(), {"of", "closed", "near", "turns", "triangles"});
  const TableReader table{*item.node, item.key, keys, reading};
  ShapeSpringDraft spring{.place = item.node->place, .key = item.key};
  spring.name = read_own_name(table, draft, reading);
  NumberTable& numbers = draft.numbers;
  if (!ends) {
    spring.shape =
        read_shape(table, {"path", "distance", "angle", "fold", "area", "volume", "line", "plane"},
                   draft, numbers, reading);
  } else {
    table.choice("shape", {"distance"}, 0);
    spring.shape.points.resize(2);
    read_ends(table, draft, spring.shape.points[0], spring.shape.points[1], reading);
  }
  read_energy(table, numbers, spring, reading);
  draft.shape_springs.push_back(std::move(spring));
}

void read_line_spring(const Item& item, MechanismDraft& draft, Reading& reading) {
  const TableReader table{*item.node,
                          item.key,
                          {"name", "from", "from_at", "to", "to_at", "stiffness", "free", "shape",
                           "of", "law", "series", "gas"},
                          reading};
  LineSpringDraft spring{.place = item.node->place, .key = item.key};
  spring.name = read_own_name(table, draft, reading);
  read_ends(table, draft, spring.from, spring.to, reading);
  const std::string length = reading.units.length;
  const Rule rule{Range::non_negative, reading.units.force + "/" + length};
  if (table.has("stiffness"))
    spring.stiffness = table.required_number("stiffness", rule, draft.numbers);
  else
    reading.problems.add(table.place(), table.key_of("stiffness"),
                         "missing, need " + need_of(rule) + ", or law = { ... }, series = [...]");
  spring.free = table.number("free", {Range::non_negative, length}, draft.numbers, 0);
  draft.springs.push_back(std::move(spring));
}

/// A point twice makes a shape without a direction somewhere; a path may come back, but not at once.
void refuse_twice(const std::vector<Item>& items, bool is_path, Reading& reading) {
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t k = is_path && i > 0 ? i - 1 : 0; k < i; ++k)
      if (items[i].node->kind == Node::Kind::text && items[k].node->kind == Node::Kind::text &&
          items[i].node->text == items[k].node->text) {
        reading.problems.add(
            items[i].node->place, items[i].key,
            "got " + described(*items[i].node) + " a second time, need another point");
        break;
      }
}

}  // namespace

JointUnits units_of(model::ShapeKind kind, const UnitLabels& labels) {
  const std::string L = labels.length, F = labels.force;
  switch (kind) {
    case ShapeKind::path:
    case ShapeKind::line:
    case ShapeKind::plane:
      return units_of(model::JointKind::prismatic, labels);
    case ShapeKind::angle:
    case ShapeKind::dihedral:
      return units_of(model::JointKind::revolute, labels);
    case ShapeKind::area:
      return {L + "^2", F + "/" + L, F + "/" + L + "^3"};
    case ShapeKind::volume:
      return {L + "^3", F + "/" + L + "^2", F + "/" + L + "^5"};
  }
  return {};
}

ShapeDraft read_shape(const TableReader& table, const std::vector<std::string>& words,
                      const MechanismDraft& draft, NumberTable& numbers, Reading& reading) {
  ShapeDraft shape;
  table.require("shape", choices(words));
  const std::string word = words[table.choice("shape", words, 0)];
  shape.kind = word_for(word).kind;
  table.require("of", "a list of points");
  const std::vector<Item> items = table.list("of", "a list of points");
  for (const Item& item : items) shape.points.push_back(read_anchor(item, draft, numbers, reading));
  refuse_twice(items, shape.kind == ShapeKind::path, reading);
  check_count(table, word_for(word), shape.points.size(), reading);
  if (shape.points.size() > most_shape_points)
    reading.problems.add(table.find("of")->place, table.key_of("of"),
                         "got " + std::to_string(shape.points.size()) + " points, need at most " +
                             std::to_string(most_shape_points));
  if (shape.kind == ShapeKind::volume) {
    table.require("triangles", "a list of triangles such as [1, 2, 3]");
    shape.triangles = read_triangles(table, shape.points.size(), reading);
  } else {
    refuse(table, "triangles", "only the shape \"volume\" has triangles", reading);
  }
  if (word == "path")
    shape.closed = table.truth("closed", false);
  else
    refuse(table, "closed", "only the shape \"path\" can be closed", reading);
  const bool turns = shape.kind == ShapeKind::angle || shape.kind == ShapeKind::dihedral;
  if (turns)
    shape.near = table.number("near", {Range::finite, "rad"}, numbers, std::numbers::pi);
  else
    refuse(table, "near", "only the shapes \"angle\" and \"fold\" have it", reading);
  if (shape.kind == ShapeKind::angle)
    shape.turns = read_turns(table, shape, draft, reading);
  else
    refuse(table, "turns", "only the shape \"angle\" has it", reading);
  return shape;
}

void read_springs(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading) {
  for (const Item& item : tables) {
    const auto has = [&](const char* key) { return item.node->find(key) != nullptr; };
    if (has("shape") && !is_shape_word(item.node->find("shape")))
      refuse_shape(item, draft, reading);
    else if (has("shape") || has("of") || has("law") || has("series") || has("gas"))
      read_shape_spring(item, draft, reading);
    else
      read_line_spring(item, draft, reading);
  }
}

}  // namespace springfold::io
