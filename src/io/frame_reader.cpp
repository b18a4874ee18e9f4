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

}  // namespace springfold::io
