// `gravity`, [[spring]] and loads.
#include "anchor_reader.hpp"
#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

class LoadReader {
 public:
  LoadReader(const Item& item, const MechanismDraft& mechanism, NumberTable& numbers,
             Reading& reading)
      : table_{*item.node,
               item.key,
               {"name", "on", "at", "force", "moment", "follows", "scale"},
               reading},
        mechanism_{mechanism},
        numbers_{numbers},
        reading_{reading} {
    draft_.place = item.node->place;
    draft_.key = item.key;
  }

  LoadDraft read(Index body) {
    draft_.name = table_.text("name").value_or("");
    read_place(body);
    read_vector();
    if (const Node* follows = table_.find("follows")) {
      if (follows->kind != Node::Kind::boolean)
        reading_.problems.add(follows->place, table_.key_of("follows"),
                              "got " + described(*follows) + ", need true or false");
      draft_.follows = follows->kind == Node::Kind::boolean && follows->number != 0;
    }
    draft_.with_lambda = table_.choice("scale", {"constant", "lambda"}, 0) == 1;
    return std::move(draft_);
  }

 private:
  void read_place(Index body) {
    draft_.on.body = body;
    if (table_.text("on"))
      find_anchor({table_.find("on"), table_.key_of("on")}, mechanism_, false, draft_.on, reading_);
    else if (body == 0 && !table_.has("on"))
      table_.require("on", "the name of a body, or \"chain.point\": there are several bodies");
    draft_.on.at = read_at(table_, "at", mechanism_, draft_.on, numbers_, reading_);
  }

  void read_vector() {
    const bool force = table_.has("force"), moment = table_.has("moment");
    if (force == moment) {
      reading_.problems.add(table_.place(), table_.key(),
                            std::string(force ? "got force and moment"
                                              : "got neither force nor "
                                                "moment") +
                                ", need exactly one of them");
      return;
    }
    const std::string name = force ? "force" : "moment";
    const std::string unit = reading_.units.force + (force ? "" : "*" + reading_.units.length);
    const Item item{table_.find(name), table_.key_of(name)};
    const bool planar = lives_in_plane(mechanism_, draft_.on);
    draft_.kind = force ? model::LoadKind::force : model::LoadKind::moment;
    const bool about_z = moment && planar && item.node->kind != Node::Kind::array;
    if (about_z)  // one number
      draft_.vector = {numbers_.add(0), numbers_.add(0),
                       read_number(item, {Range::finite, unit}, numbers_, reading_)};
    else
      draft_.vector = read_vector3(item, planar && force, unit, numbers_, reading_);
  }

  TableReader table_;
  const MechanismDraft& mechanism_;
  NumberTable& numbers_;
  Reading& reading_;
  LoadDraft draft_{};
};

}  // namespace

void read_gravity(const Item& item, MechanismDraft& draft, Reading& reading) {
  draft.gravity =
      read_vector3(item, true, reading.units.force + " per unit of mass", draft.numbers, reading);
}

void read_line_springs(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading) {
  for (const Item& item : tables) {
    const TableReader table{*item.node,
                            item.key,
                            {"name", "from", "from_at", "to", "to_at", "stiffness", "free"},
                            reading};
    LineSpringDraft spring{.place = item.node->place, .key = item.key};
    spring.name = read_own_name(table, draft, reading);
    NumberTable& numbers = draft.numbers;
    if (table.text("from"))
      find_anchor({table.find("from"), table.key_of("from")}, draft, true, spring.from, reading);
    if (table.required_text("to", "the name of a body, or \"chain.point\""))
      find_anchor({table.find("to"), table.key_of("to")}, draft, true, spring.to, reading);
    spring.from.at = read_at(table, "from_at", draft, spring.from, numbers, reading);
    spring.to.at = read_at(table, "to_at", draft, spring.to, numbers, reading);
    const std::string length = reading.units.length;
    spring.stiffness = table.required_number(
        "stiffness", {Range::non_negative, reading.units.force + "/" + length}, numbers);
    spring.free = table.number("free", {Range::non_negative, length}, numbers, 0);
    draft.springs.push_back(std::move(spring));
  }
}

std::vector<LoadDraft> read_loads(const std::vector<Item>& tables, const MechanismDraft& draft,
                                  Index body, NumberTable& numbers, Reading& reading) {
  std::vector<LoadDraft> loads;
  for (const Item& item : tables)
    loads.push_back(LoadReader{item, draft, numbers, reading}.read(body));
  return loads;
}

}  // namespace springfold::io
