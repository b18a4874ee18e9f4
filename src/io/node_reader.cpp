// [[node]].
#include <algorithm>

#include "anchor_reader.hpp"
#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

const std::vector<std::string> axis_words{"x", "y", "z"};
const std::string place_need = "[x, y] or, in space, [x, y, z]";
const std::string fixed_need =
    "true, false or a list of directions such as [\"x\"] in which the node is held";

/// Two or three coordinates, as many as other nodes have. None if they are unusable.
std::vector<NumberId> read_place(const TableReader& table, MechanismDraft& draft,
                                 Reading& reading) {
  const Node* at = table.require("at", place_need);
  if (!at) return {};
  const std::vector<Item> items = list_items({at, table.key_of("at")}, place_need, reading);
  if (at->kind != Node::Kind::array) return {};
  const std::size_t size = items.size();
  if (size != 2 && size != 3) {
    reading.problems.add(at->place, table.key_of("at"),
                         "got " + described(*at) + ", need " + place_need);
    return {};
  }
  const auto other = std::find_if(draft.bodies.begin(), draft.bodies.end(),
                                  [](const BodyDraft& body) { return body.is_node; });
  const std::size_t known = other != draft.bodies.end() ? other->pose.size()
                            : draft.supports.empty()    ? 0
                                                        : draft.supports.front().at.size();
  if (known > 0 && known != size)
    reading.problems.add(at->place, table.key_of("at"),
                         "got " + std::to_string(size) + " numbers, need " + std::to_string(known) +
                             " as the nodes before it have: all lie in the plane or all in space");
  return read_numbers(items, {Range::finite, reading.units.length}, draft.numbers, reading);
}

/// Directions in which the node is held.
std::vector<std::string> read_fixed(const TableReader& table, std::size_t dimension,
                                    Reading& reading) {
  const Node* fixed = table.find("fixed");
  if (!fixed) return {};
  const std::vector<std::string> own(axis_words.begin(),
                                     axis_words.begin() + static_cast<std::ptrdiff_t>(dimension));
  if (fixed->kind == Node::Kind::boolean)
    return fixed->number != 0 ? own : std::vector<std::string>{};
  std::vector<std::string> held;
  for (const Item& item : list_items({fixed, table.key_of("fixed")}, fixed_need, reading)) {
    const bool known = item.node->kind == Node::Kind::text &&
                       std::find(own.begin(), own.end(), item.node->text) != own.end();
    if (!known)
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) + ", need " + choices(own));
    else if (std::find(held.begin(), held.end(), item.node->text) != held.end())
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) + " twice, need different directions");
    else
      held.push_back(item.node->text);
  }
  return held;
}

/// A chain of passive slides along the free directions, from the place of the node.
ChainDraft guide_of(const BodyDraft& node, Index body, NumberTable& numbers) {
  ChainDraft guide{.name = node.name + ".guide", .to = body, .place = node.place, .key = node.key};
  guide.from_at.at = node.pose;
  for (std::size_t i = 0; i < node.pose.size(); ++i) {
    if (std::find(node.fixed.begin(), node.fixed.end(), axis_words[i]) != node.fixed.end())
      continue;
    JointDraft slide{.name = axis_words[i], .kind = model::JointKind::prismatic};
    slide.axis.fixed = model::Vec3<double>::Unit(static_cast<Index>(i));
    slide.initial = numbers.add(0);
    guide.elements.push_back({std::move(slide), node.place, node.key});
  }
  return guide;
}

void read_node(const Item& item, MechanismDraft& draft, Reading& reading) {
  const TableReader table{*item.node, item.key, {"name", "at", "fixed", "mass"}, reading};
  BodyDraft node{.is_node = true, .place = item.node->place, .key = item.key};
  node.name = read_own_name(table, draft, reading);
  node.pose = read_place(table, draft, reading);
  if (table.has("mass")) node.mass = read_mass(table, draft.numbers, reading);
  if (node.pose.empty()) {  // already reported: a body without place, so that its name is known
    draft.bodies.push_back(std::move(node));
    return;
  }
  node.task_space = node.pose.size() == 2 ? model::TaskSpace::xy : model::TaskSpace::xyz;
  node.fixed = read_fixed(table, node.pose.size(), reading);
  if (node.fixed.size() == node.pose.size()) {
    draft.supports.push_back({node.name, node.pose, node.place, node.key});
    return;
  }
  const auto number = static_cast<Index>(draft.bodies.size() + 1);
  if (!node.fixed.empty()) draft.chains.push_back(guide_of(node, number, draft.numbers));
  draft.bodies.push_back(std::move(node));
}

}  // namespace

void read_nodes(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading) {
  for (const Item& item : tables) read_node(item, draft, reading);
  if (draft.bodies.empty() && !tables.empty())
    reading.problems.add(tables.front().node->place, tables.front().key,
                         "all nodes are fixed, need one that moves");
}

}  // namespace springfold::io
