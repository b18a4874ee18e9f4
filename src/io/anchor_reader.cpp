#include "anchor_reader.hpp"

#include <algorithm>

#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

/// Bodies, nodes and "chain.point", for messages.
std::vector<std::string> anchor_names(const MechanismDraft& draft, bool base_allowed) {
  std::vector<std::string> names;
  if (base_allowed) names.push_back("base");
  for (const BodyDraft& body : draft.bodies)
    if (!body.name.empty()) names.push_back(body.name);
  if (base_allowed)
    for (const SupportDraft& support : draft.supports)
      if (!support.name.empty()) names.push_back(support.name);
  for (const ChainDraft& chain : draft.chains)
    for (const PointDraft& point : chain.points)
      if (!point.name.empty()) names.push_back(chain.name + "." + point.name);
  return names;
}

/// A fixed node: the base, at its place. @returns whether there is one of that name
bool find_support(const Item& item, const MechanismDraft& draft, bool base_allowed,
                  AnchorDraft& anchor, NumberTable& numbers, Reading& reading) {
  const auto support =
      std::find_if(draft.supports.begin(), draft.supports.end(),
                   [&item](const SupportDraft& node) { return node.name == item.node->text; });
  if (support == draft.supports.end()) return false;
  if (!base_allowed)
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) +
                             ", a fixed node, where a load does nothing, need one that moves");
  anchor.body = 0;
  anchor.at = support->at;
  // Its place is among the numbers of the mechanism: the same numbers in the table of whoever asks.
  if (&numbers != &draft.numbers)
    for (NumberId& id : anchor.at)
      id = numbers.add(draft.numbers.definition(id), draft.numbers.rule(id));
  return true;
}

}  // namespace

void find_anchor(const Item& item, const MechanismDraft& draft, bool base_allowed,
                 AnchorDraft& anchor, NumberTable& numbers, Reading& reading) {
  const std::string& name = item.node->text;
  if (base_allowed && name == "base") return void(anchor.body = 0);
  for (std::size_t b = 0; b < draft.bodies.size(); ++b)
    if (draft.bodies[b].name == name) return void(anchor.body = static_cast<Index>(b + 1));
  if (find_support(item, draft, base_allowed, anchor, numbers, reading)) return;
  for (std::size_t c = 0; c < draft.chains.size(); ++c)
    for (std::size_t p = 0; p < draft.chains[c].points.size(); ++p) {
      const std::string& point = draft.chains[c].points[p].name;
      if (point.empty() || draft.chains[c].name + "." + point != name) continue;
      anchor.chain = static_cast<Index>(c);
      anchor.point = p;
      return;
    }
  reading.problems.add(item.node->place, item.key,
                       "got " + described(*item.node) + ", need " +
                           (base_allowed ? "\"base\", " : "") +
                           "the name of a moving body, or \"chain.point\" for a { point = ... } "
                           "in a chain" +
                           suggestion(name, anchor_names(draft, base_allowed)));
}

bool lives_in_plane(const MechanismDraft& draft, const AnchorDraft& anchor) {
  const Index body =
      anchor.chain >= 0 ? draft.chains[static_cast<std::size_t>(anchor.chain)].to : anchor.body;
  const auto b = static_cast<std::size_t>(body);
  if (b == 0) return std::all_of(draft.bodies.begin(), draft.bodies.end(), is_planar);
  return b > draft.bodies.size() || is_planar(draft.bodies[b - 1]);
}

std::vector<NumberId> read_at(const TableReader& table, const std::string& name,
                              const MechanismDraft& draft, const AnchorDraft& anchor,
                              NumberTable& numbers, Reading& reading) {
  const Node* at = table.find(name);
  if (!at) return anchor.at;
  if (!anchor.at.empty())
    reading.problems.add(at->place, table.key_of(name),
                         "a fixed node is a point and has no other points, need none");
  return read_vector3({at, table.key_of(name)}, lives_in_plane(draft, anchor), reading.units.length,
                      numbers, reading);
}

void read_ends(const TableReader& table, MechanismDraft& draft, AnchorDraft& from, AnchorDraft& to,
               Reading& reading) {
  if (table.text("from"))
    find_anchor({table.find("from"), table.key_of("from")}, draft, true, from, draft.numbers,
                reading);
  if (table.required_text("to", "the name of a body, or \"chain.point\""))
    find_anchor({table.find("to"), table.key_of("to")}, draft, true, to, draft.numbers, reading);
  const auto from_name = table.text("from"), to_name = table.text("to");
  if (from_name && from_name == to_name && !table.has("from_at") && !table.has("to_at"))
    reading.problems.add(table.find("to")->place, table.key_of("to"),
                         "got \"" + *to_name + "\" a second time, need another point");
  from.at = read_at(table, "from_at", draft, from, draft.numbers, reading);
  to.at = read_at(table, "to_at", draft, to, draft.numbers, reading);
}

AnchorDraft read_anchor(const Item& item, const MechanismDraft& draft, NumberTable& numbers,
                        Reading& reading) {
  AnchorDraft anchor;
  if (item.node->kind == Node::Kind::text) {
    find_anchor(item, draft, true, anchor, numbers, reading);
    return anchor;
  }
  const std::string need =
      "the name of a body or \"chain.point\", or a table such as { on = \"base\", at = [0, 1] }";
  if (!is_table(item, need, reading)) return anchor;
  const TableReader table{*item.node, item.key, {"on", "at"}, reading};
  if (table.required_text("on", "\"base\", the name of a body, or \"chain.point\""))
    find_anchor({table.find("on"), table.key_of("on")}, draft, true, anchor, numbers, reading);
  anchor.at = read_at(table, "at", draft, anchor, numbers, reading);
  return anchor;
}

}  // namespace springfold::io
