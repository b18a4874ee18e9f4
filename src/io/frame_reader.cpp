#include "mechanism_reader.hpp"

namespace springfold::io {
std::vector<NumberId> read_vector3(const Item& item, bool planar, const std::string& unit,
                                   NumberTable& numbers, Reading& reading) {
  const std::string need = planar ? "[x, y] or [x, y, z]" : "[x, y, z]";
  const std::vector<Item> items = list_items(item, need, reading);
  const bool fits = items.size() == 3 || (planar && items.size() == 2);
  if (item.node->kind == Node::Kind::array && !fits)
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) + ", need " + need);
  std::vector<NumberId> ids = read_numbers(items, {Range::finite, unit}, numbers, reading);
  ids.resize(std::min<std::size_t>(ids.size(), 3));
  return ids;
}

AxisDraft read_axis(const Item& item, NumberTable& numbers, Reading& reading) {
  static const std::string need = "\"x\", \"y\", \"z\", \"-x\", \"-y\", \"-z\" or [x, y, z]";
  AxisDraft axis;
  if (item.node->kind == Node::Kind::text) {
    const std::string& text = item.node->text;
    const bool negative = text.starts_with('-');
    const std::string letter = text.substr(negative ? 1 : 0);
    if (letter == "x" || letter == "y" || letter == "z") {
      axis.fixed = model::Vec3<double>::Unit(letter[0] - 'x') * (negative ? -1.0 : 1.0);
      return axis;
    }
  }
  if (item.node->kind != Node::Kind::array || item.node->items.size() != 3) {
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) + ", need " + need);
    return axis;
  }
  axis.entries = read_numbers(list_items(item, need, reading), {}, numbers, reading);
  numbers.require_nonzero(axis.entries, item.node->place, item.key, "an axis is a direction");
  return axis;
}

FrameDraft read_frame(const Item& item, bool planar, NumberTable& numbers, Reading& reading) {
  FrameDraft frame;
  if (item.node->kind != Node::Kind::table) {
    if (item.node->kind == Node::Kind::array)
      frame.at = read_vector3(item, planar, reading.units.length, numbers, reading);
    else
      reading.problems.add(
          item.node->place, item.key,
          "got " + described(*item.node) + ", need [x, y, z] or { at = [...], rotate = {...} }");
    return frame;
  }
  const TableReader table{*item.node, item.key, {"at", "rotate"}, reading};
  if (const Node* at = table.find("at"))
    frame.at =
        read_vector3({at, table.key_of("at")}, planar, reading.units.length, numbers, reading);
  const Node* rotate = table.find("rotate");
  const Item rotation{rotate, table.key_of("rotate")};
  if (!rotate || !is_table(rotation, "{ axis = ..., angle = ... }", reading)) return frame;
  const TableReader turn{*rotate, rotation.key, {"axis", "angle"}, reading};
  if (const Node* axis = turn.require("axis", "an axis such as \"z\""))
    frame.axis = read_axis({axis, turn.key_of("axis")}, numbers, reading);
  frame.angle = turn.required_number("angle", {Range::finite, "rad"}, numbers);
  return frame;
}

std::vector<NumberId> read_inertia(const TableReader& table, bool planar, NumberTable& numbers,
                                   Reading& reading) {
  const Node* node = table.find("inertia");
  if (!node) return {};
  table.require("mass", "the mass whose moments of inertia these are");
  const std::string key = table.key_of("inertia");
  const std::string unit =
      reading.units.force + "*" + reading.units.length + "^2 per unit of gravity";
  if (planar) return {table.number("inertia", {Range::non_negative, unit}, numbers, 0)};
  const std::string need = "three numbers, about x, y and z, or three rows of three";
  const std::vector<Item> items = list_items({node, key}, need, reading);
  if (node->kind != Node::Kind::array) return {};
  std::vector<NumberId> ids;
  for (const Item& item : items) {
    const bool is_row = item.node->kind == Node::Kind::array;
    for (const Item& entry : is_row ? list_items(item, need, reading) : std::vector{item})
      ids.push_back(read_number(entry, {Range::finite, unit}, numbers, reading));
  }
  if (items.size() != 3 || (ids.size() != 3 && ids.size() != 9)) {
    reading.problems.add(node->place, key, "got " + described(*node) + ", need " + need);
    return {};
  }
  numbers.require(ids, node->place, key, [](const std::vector<double>& values) {
    std::vector<NumberId> own(values.size());
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = i;
    return model::problem_in_inertia(inertia_of(own, values));
  });
  return ids;
}

}  // namespace springfold::io
