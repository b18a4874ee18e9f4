#include "drawn_frames.hpp"

#include <algorithm>

#include "text.hpp"

namespace springfold::io {
namespace {

bool is_nothing(const std::string& formula) { return formula == zero_formula || formula == "(-0)"; }

std::string name_of(const Node& table) {
  const Node* name = table.find("name");
  return name != nullptr && name->kind == Node::Kind::text ? name->text : std::string{};
}

std::string chain_part(const std::string& name) { return name.substr(0, name.find('.')); }

}  // namespace

Formulas no_shift() { return {zero_formula, zero_formula, zero_formula}; }

bool is_zero(const Formulas& vector) {
  return std::all_of(vector.begin(), vector.end(), is_nothing);
}

std::string formula_of(const Node& node, const Bindings& bindings) {
  if (node.kind == Node::Kind::number) return "(" + shortest(node.number) + ")";
  if (node.kind != Node::Kind::text) return {};
  return "(" + with_bindings(node.text, node.bindings ? *node.bindings : bindings) + ")";
}

Formulas turned(const Formulas& vector, const PatternAxis& axis, const std::string& angle) {
  if (is_zero(vector)) return vector;
  const std::size_t first = (axis.letter + 1) % 3, second = (axis.letter + 2) % 3;
  const std::string c = "cos(" + angle + ")", s = "sin(" + angle + ")";
  Formulas to = vector;
  to[first] = vector[first] + "*" + c + (axis.negative ? "+" : "-") + vector[second] + "*" + s;
  to[second] =
      (axis.negative ? "-" : "") + vector[first] + "*" + s + "+" + vector[second] + "*" + c;
  return to;
}

Formulas difference(const Formulas& a, const Formulas& b) {
  Formulas result = a;
  for (std::size_t i = 0; i < 3; ++i)
    if (a[i] == b[i])
      result[i] = zero_formula;
    else if (!is_nothing(b[i]))
      result[i] = "(" + a[i] + "-(" + b[i] + "))";
  return result;
}

Formulas sum(const Formulas& a, const Formulas& b) {
  Formulas result = a;
  for (std::size_t i = 0; i < 3; ++i)
    if (!is_nothing(b[i])) result[i] = "(" + a[i] + "+" + b[i] + ")";
  return result;
}

bool go_together(const CopyTurn& a, const CopyTurn& b) {
  return a.angle == b.angle && a.axis.letter == b.axis.letter &&
         a.axis.negative == b.axis.negative && a.axis.centre == b.axis.centre;
}

void DrawnParts::add(const Node& root) {
  const auto each = [&root](const char* part, const auto& add) {
    const Node* list = root.find(part);
    if (list == nullptr || list->kind != Node::Kind::array) return;
    for (const Node& table : list->items)
      if (table.kind == Node::Kind::table) add(table);
  };
  each("body", [this](const Node& table) {
    bodies_.emplace(name_of(table), &table);
    moving_.push_back(name_of(table));
  });
  each("node", [this](const Node& table) {
    nodes_.emplace(name_of(table), &table);
    const Node* fixed = table.find("fixed");
    if (fixed == nullptr || fixed->kind != Node::Kind::boolean || fixed->number == 0)
      moving_.push_back(name_of(table));
  });
}

DrawnParts::Kind DrawnParts::kind_of(const std::string& name) const {
  if (name == "base") return Kind::base;
  if (name.find('.') != std::string::npos) return Kind::chain;
  if (nodes_.contains(name)) return Kind::point;
  const auto found = bodies_.find(name);
  if (found == bodies_.end()) return Kind::unknown;
  const Node* space = found->second->find("task_space");
  const std::string word = space ? space->text : "";
  return word == "xy" || word == "xyz" ? Kind::point : Kind::body;
}

bool DrawnParts::was_turned_so(const std::string& name, const CopyTurn& turn) const {
  const auto found = turned_.find(chain_part(name));
  return found != turned_.end() && go_together(found->second, turn);
}

const Node* DrawnParts::pose_of(const std::string& name) const {
  if (const auto node = nodes_.find(name); node != nodes_.end()) return node->second->find("at");
  const auto body = bodies_.find(name);
  return body != bodies_.end() ? body->second->find("pose") : nullptr;
}

bool DrawnParts::has_pose(const std::string& name) const { return pose_of(name) != nullptr; }

std::optional<DrawnFrame> DrawnParts::frame_of(const std::string& name,
                                               const PatternAxis& axis) const {
  const Node* pose = pose_of(name);
  if (pose == nullptr) return DrawnFrame{};
  const std::size_t size = pose->items.size();
  const bool turns = kind_of(name) == Kind::body;
  const bool planar = turns && size == 3;
  const std::size_t shifts = planar ? 2 : std::min<std::size_t>(size, 3);
  if (pose->kind != Node::Kind::array || size < 2) return std::nullopt;
  DrawnFrame frame;
  for (std::size_t i = 0; i < size; ++i) {
    const std::string formula = formula_of(pose->items[i], {});
    if (formula.empty()) return std::nullopt;
    const std::size_t about = planar ? 2 : i - shifts;  // direction of a rotation
    if (i < shifts)
      frame.at[i] = formula;
    else if (about == axis.letter)
      frame.angle = formula;
    else if (!is_nothing(formula))
      return std::nullopt;
  }
  return frame;
}

}  // namespace springfold::io
