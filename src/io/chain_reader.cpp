#include <algorithm>

#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

using model::TaskSpace;

constexpr TaskSpace spaces[] = {TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz,
                                TaskSpace::spatial};
const std::vector<std::string> space_words{"xy", "planar", "xyz", "spatial"};

std::string pose_need(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return "[x, y]";
    case TaskSpace::planar:
      return "[x, y, phi]";
    case TaskSpace::xyz:
      return "[x, y, z]";
    case TaskSpace::spatial:
      return "[x, y, z, rx, ry, rz]";
  }
  return "a list";
}

}  // namespace

bool is_taken(const std::string& name, const MechanismDraft& draft) {
  const auto has_name = [&name](const auto& thing) { return thing.name == name; };
  return name == "base" || std::any_of(draft.bodies.begin(), draft.bodies.end(), has_name) ||
         std::any_of(draft.chains.begin(), draft.chains.end(), has_name) ||
         std::any_of(draft.springs.begin(), draft.springs.end(), has_name) ||
         std::any_of(draft.shape_springs.begin(), draft.shape_springs.end(), has_name) ||
         std::any_of(draft.supports.begin(), draft.supports.end(), has_name) ||
         std::any_of(draft.bars.begin(), draft.bars.end(), has_name);
}

std::string read_own_name(const TableReader& table, const MechanismDraft& draft, Reading& reading) {
  const std::optional<std::string> name = table.required_text("name", "a name");
  if (!name) return {};
  const Item at{table.find("name"), table.key_of("name")};
  if (!is_plain_name(*name, at, reading)) return *name;
  if (is_taken(*name, draft))
    reading.problems.add(at.node->place, at.key,
                         "\"" + *name +
                             "\" is already taken: bodies, chains and springs need different "
                             "names, and \"base\" is the fixed body");
  return *name;
}

bool is_planar(const BodyDraft& body) {
  return body.pose.empty() || body.task_space == TaskSpace::xy ||
         body.task_space == TaskSpace::planar;
}

namespace {

std::vector<NumberId> read_pose(const TableReader& table, TaskSpace space, NumberTable& numbers,
                                Reading& reading) {
  const auto d = static_cast<std::size_t>(model::dimension(space));
  const auto lengths = static_cast<std::size_t>(model::translations(space));
  const std::vector<Item> items = table.list("pose", pose_need(space));
  std::vector<NumberId> ids;
  for (std::size_t i = 0; i < std::min(d, items.size()); ++i) {
    const Rule rule{Range::finite, i < lengths ? reading.units.length : "rad"};
    ids.push_back(read_number(items[i], rule, numbers, reading));
  }
  const Node* pose = table.find("pose");
  if (pose && pose->kind == Node::Kind::array && items.size() != d)
    reading.problems.add(pose->place, table.key_of("pose"),
                         "got " + described(*pose) + ", need " + pose_need(space));
  while (ids.size() < d) ids.push_back(numbers.add(0));
  return ids;
}

void read_ends(const TableReader& table, const MechanismDraft& draft, ChainDraft& chain,
               Reading& reading) {
  if (const auto name = table.text("from"))
    chain.from =
        body_number(*name, {table.find("from"), table.key_of("from")}, draft.bodies, true, reading)
            .value_or(chain.from);
  if (const auto name = table.text("to"))
    chain.to =
        body_number(*name, {table.find("to"), table.key_of("to")}, draft.bodies, false, reading)
            .value_or(chain.to);
  else if (!table.has("to") && draft.bodies.size() > 1)
    table.require("to", "the name of a body: there are several");
  if (table.has("to") && chain.from == chain.to && chain.from > 0)
    reading.problems.add(table.find("to")->place, table.key_of("to"),
                         "got the body where the chain starts, need another one");
}

}  // namespace

std::optional<Index> body_number(const std::string& name, const Item& at,
                                 const std::vector<BodyDraft>& bodies, bool base_allowed,
                                 Reading& reading) {
  if (base_allowed && name == "base") return 0;
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [&name](const BodyDraft& body) { return body.name == name; });
  if (found != bodies.end()) return static_cast<Index>(found - bodies.begin() + 1);
  constexpr std::size_t most_known = 1000;
  std::vector<std::string> known;
  if (base_allowed) known.push_back("base");
  for (std::size_t i = 0; i < std::min(bodies.size(), most_known); ++i)
    if (!bodies[i].name.empty()) known.push_back(bodies[i].name);
  reading.problems.add(at.node->place, at.key,
                       "got \"" + name + "\", need the name of a " +
                           (base_allowed ? "" : "moving ") + "body" + suggestion(name, known));
  return std::nullopt;
}

void read_bodies(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading) {
  for (const Item& item : tables) {
    const TableReader table{
        *item.node, item.key, {"name", "task_space", "pose", "mass", "com", "inertia"}, reading};
    BodyDraft body{.place = item.node->place, .key = item.key};
    body.name = read_own_name(table, draft, reading);
    table.require("task_space", choices(space_words));
    body.task_space = spaces[table.choice("task_space", space_words, 3)];
    const Node* space = table.find("task_space");
    const bool known_space = space && std::find(space_words.begin(), space_words.end(),
                                                space->text) != space_words.end();
    if (known_space) body.pose = read_pose(table, body.task_space, draft.numbers, reading);
    if (table.has("mass")) body.mass = read_mass(table, draft.numbers, reading);
    if (const Node* com = table.find("com"))
      body.centre = read_vector3({com, table.key_of("com")}, is_planar(body), reading.units.length,
                                 draft.numbers, reading);
    if (table.has("com")) table.require("mass", "the mass of the body, whose centre this is");
    const bool turns = translations(body.task_space) < dimension(body.task_space);
    if (known_space && table.has("inertia") && !turns)
      reading.problems.add(table.find("inertia")->place, table.key_of("inertia"),
                           "a body of task space \"" + space->text +
                               "\" is a point and does not turn, need \"planar\" or \"spatial\"");
    else
      body.inertia = read_inertia(table, is_planar(body), draft.numbers, reading);
    draft.bodies.push_back(std::move(body));
  }
}

void read_chains(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading) {
  for (const Item& item : tables) {
    const TableReader table{
        *item.node,
        item.key,
        {"name", "from", "from_at", "to", "to_at", "elements", "coupled_springs"},
        reading};
    ChainDraft chain{.place = item.node->place, .key = item.key};
    chain.name = read_own_name(table, draft, reading);
    read_ends(table, draft, chain, reading);
    const auto body = static_cast<std::size_t>(chain.to);
    const bool planar = body > draft.bodies.size() || is_planar(draft.bodies[body - 1]);
    for (auto& [name, frame] : {std::pair{"from_at", &chain.from_at}, {"to_at", &chain.to_at}})
      if (const Node* node = table.find(name))
        *frame = read_frame({node, table.key_of(name)}, planar, draft.numbers, reading);
    const std::string need = "a list of { joint = ... }, { rigid = ... } and { elastic = ... }";
    const Node* elements = table.require("elements", need);
    read_elements(table.list("elements", need), planar, coupled_joint_names(*item.node),
                  draft.numbers, chain, reading);
    read_coupled_springs(table, draft.numbers, chain, reading);
    if (elements && elements->kind == Node::Kind::array && elements->items.empty())
      reading.problems.add(elements->place, table.key_of("elements"),
                           "got an empty list, need at least one element");
    draft.chains.push_back(std::move(chain));
  }
}

}  // namespace springfold::io
