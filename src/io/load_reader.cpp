// `gravity` and loads.
#include "anchor_reader.hpp"
#include "shape_reader.hpp"

namespace springfold::io {
namespace {

class LoadReader {
 public:
  LoadReader(const Item& item, const MechanismDraft& mechanism, NumberTable& numbers,
             Reading& reading)
      : table_{*item.node,
               item.key,
               {"name", "on", "at", "force", "moment", "follows", "scale", "pressure", "shape",
                "of", "triangles"},
               reading},
        mechanism_{mechanism},
        numbers_{numbers},
        reading_{reading} {
    draft_.place = item.node->place;
    draft_.key = item.key;
  }

  LoadDraft read(Index body) {
    draft_.name = table_.text("name").value_or("");
    draft_.with_lambda = table_.choice("scale", {"constant", "lambda"}, 0) == 1;
    const bool has_vector = table_.has("force") || table_.has("moment");
    if (table_.has("pressure") || (table_.has("shape") && !has_vector)) {
      read_pressure();
      return std::move(draft_);
    }
    refuse({"shape", "of", "triangles"}, "only a load with `pressure` has it");
    read_place(body);
    read_vector();
    if (const Node* follows = table_.find("follows")) {
      if (follows->kind != Node::Kind::boolean)
        reading_.problems.add(follows->place, table_.key_of("follows"),
                              "got " + described(*follows) + ", need true or false");
      draft_.follows = follows->kind == Node::Kind::boolean && follows->number != 0;
    }
    return std::move(draft_);
  }

 private:
  void refuse(const std::vector<std::string>& keys, const std::string& why) {
    for (const std::string& key : keys)
      if (const Node* node = table_.find(key))
        reading_.problems.add(node->place, table_.key_of(key), why);
  }

  /// On the boundary of an area or a volume.
  void read_pressure() {
    refuse({"on", "at", "force", "moment", "follows"},
           "a pressure acts on the boundary of its shape: need `shape` and `of` instead");
    draft_.kind = model::LoadKind::pressure;
    draft_.shape = read_shape(table_, {"area", "volume"}, mechanism_, numbers_, reading_);
    const std::string area = draft_.shape.kind == model::ShapeKind::volume ? "^2" : "";
    const NumberId p = table_.required_number(
        "pressure", {Range::finite, reading_.units.force + "/" + reading_.units.length + area},
        numbers_);
    draft_.vector = {p, numbers_.add(0), numbers_.add(0)};
  }

  void read_place(Index body) {
    draft_.on.body = body;
    if (table_.text("on"))
      find_anchor({table_.find("on"), table_.key_of("on")}, mechanism_, false, draft_.on, numbers_,
                  reading_);
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

std::vector<LoadDraft> read_loads(const std::vector<Item>& tables, const MechanismDraft& draft,
                                  Index body, NumberTable& numbers, Reading& reading) {
  std::vector<LoadDraft> loads;
  for (const Item& item : tables)
    loads.push_back(LoadReader{item, draft, numbers, reading}.read(body));
  return loads;
}

}  // namespace springfold::io
