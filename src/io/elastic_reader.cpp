// { elastic = ... }: flexible links with their 6x6 virtual springs.
#include <algorithm>
#include <array>

#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

using model::Definiteness;
using model::ElasticDirection;
using Kind = ElasticDraft::Kind;
using Shape = SectionDraft::Shape;

const std::vector<std::string> elastic_words{"beam", "stiffness", "compliance"};
const std::vector<std::string> direction_words{"Tx", "Ty", "Tz", "Rx", "Ry", "Rz"};
const std::vector<std::string> own_section{"A", "Iy", "Iz", "J"};

bool is_kind(const Node* kind) {
  return kind->kind == Node::Kind::text &&
         std::find(elastic_words.begin(), elastic_words.end(), kind->text) != elastic_words.end();
}

/// Keys of one kind; of all kinds where it is unknown.
std::vector<std::string> keys_of(const Node* kind) {
  std::vector<std::string> keys{"elastic", "name", "length", "directions", "initial", "free"};
  const bool beam = is_kind(kind) && kind->text == "beam";
  if (!beam) keys.emplace_back("matrix");
  if (beam || !is_kind(kind))
    for (const char* key : {"E", "G", "section", "A", "Iy", "Iz", "J", "Ay", "Az", "segments"})
      keys.emplace_back(key);
  return keys;
}

class ElasticReader {
 public:
  ElasticReader(const Item& item, const std::string& default_name, bool plane, NumberTable& numbers,
                Reading& reading)
      : table_{*item.node, item.key, keys_of(item.node->find("elastic")), reading},
        kind_known_{is_kind(item.node->find("elastic"))},
        plane_{plane},
        numbers_{numbers},
        reading_{reading} {
    link_.kind = std::array{Kind::beam, Kind::stiffness,
                            Kind::compliance}[table_.choice("elastic", elastic_words, 0)];
    link_.name = table_.text("name").value_or(default_name);
    if (const Node* name = table_.find("name"); name && name->kind == Node::Kind::text)
      is_plain_name(name->text, {name, table_.key_of("name")}, reading);
  }

  ElasticDraft read() {
    if (!kind_known_) {  // nothing else can be said about the others
      link_.length = numbers_.add(0);
      link_.segments = numbers_.add(1);
      return std::move(link_);
    }
    read_directions();
    const std::string length = reading_.units.length;
    link_.segments = table_.number("segments", {Range::segment_count, ""}, numbers_, 1);
    if (link_.kind == Kind::beam) {
      link_.length = table_.required_number("length", {Range::positive, length}, numbers_);
      read_beam();
    } else {
      link_.length = table_.number("length", {Range::non_negative, length}, numbers_, 0);
      read_matrix();
    }
    link_.initial = read_coordinates("initial");
    link_.free = read_coordinates("free");
    return std::move(link_);
  }

 private:
  void report(const std::string& name, const std::string& what) const {
    const Node* node = table_.find(name);
    reading_.problems.add(node ? node->place : table_.place(), table_.key_of(name), what);
  }

  /// Needs the link this direction's data? Not if the directions themselves are in doubt.
  bool has(ElasticDirection d) const {
    return directions_known_ &&
           std::find(link_.directions.begin(), link_.directions.end(), d) != link_.directions.end();
  }

  void read_directions() {
    using enum ElasticDirection;
    const std::vector<ElasticDirection> all =
        plane_ ? std::vector{Tx, Ty, Rz} : std::vector{Tx, Ty, Tz, Rx, Ry, Rz};
    link_.directions = all;
    const Node* node = table_.find("directions");
    if (!node) return;
    directions_known_ = false;
    std::vector<std::string> words;
    for (const ElasticDirection d : all)
      words.push_back(direction_words[static_cast<std::size_t>(d)]);
    const std::string need = "a list of " + choices(words) + ", each once and in this order";
    const std::vector<Item> items = table_.list("directions", need);
    if (node->kind != Node::Kind::array) return;
    std::vector<ElasticDirection> found;
    for (const Item& item : items) {
      const auto word = std::find(words.begin(), words.end(), item.node->text);
      const bool known = item.node->kind == Node::Kind::text && word != words.end();
      const ElasticDirection d = known ? all[static_cast<std::size_t>(word - words.begin())] : Tx;
      if (!known || (!found.empty() && found.back() >= d))
        return reading_.problems.add(item.node->place, item.key,
                                     "got " + described(*item.node) + ", need " + need);
      found.push_back(d);
    }
    if (found.empty())
      return report("directions",
                    "got an empty list, need at least one; a link "
                    "that nowhere gives way is { rigid = ... }");
    link_.directions = found;
    directions_known_ = true;
  }

  void read_beam() {
    using enum ElasticDirection;
    const std::string pressure = reading_.units.force + "/" + reading_.units.length + "^2";
    const Rule modulus{Range::positive, pressure};
    const bool shear = table_.has("Ay") || table_.has("Az");
    const bool needs_E = has(Tx) || has(Ty) || has(Tz) || has(Ry) || has(Rz);
    const bool needs_G = has(Rx) || shear;
    link_.E = needs_E ? table_.required_number("E", modulus, numbers_)
                      : table_.number("E", modulus, numbers_, 1);
    link_.G = needs_G ? table_.required_number("G", modulus, numbers_)
                      : table_.number("G", modulus, numbers_, 1);
    if (table_.has("section"))
      read_section();
    else
      read_own_section();
    const Rule area{Range::positive, reading_.units.length + "^2"};
    if (table_.has("Ay")) link_.section.Ay = table_.number("Ay", area, numbers_, 1);
    if (table_.has("Az")) link_.section.Az = table_.number("Az", area, numbers_, 1);
  }

  /// A, Iy, Iz, J: those that the directions need.
  void read_own_section() {
    using enum ElasticDirection;
    const std::string length = reading_.units.length;
    const auto number = [&](const std::string& name, int power, bool needed) {
      const Rule rule{Range::positive, length + "^" + std::to_string(power)};
      if (table_.has(name) || !needed) return table_.number(name, rule, numbers_, 1);
      if (!table_.is_misspelt(name) && !table_.is_misspelt("section"))
        report(name, "missing, need " + need_of(rule) + ", or section = { shape = ... }");
      return numbers_.add(1);
    };
    link_.section.A = number("A", 2, has(Tx));
    link_.section.Iy = number("Iy", 4, has(Tz) || has(Ry));
    link_.section.Iz = number("Iz", 4, has(Ty) || has(Rz));
    link_.section.J = number("J", 4, has(Rx));
  }

  void read_section() {
    for (const std::string& name : own_section)
      if (table_.has(name)) report(name, "either section or " + name + ", not both");
    const Item item{table_.find("section"), table_.key_of("section")};
    const std::string need = "a table such as { shape = \"round\", diameter = ... }";
    if (!is_table(item, need, reading_)) return;
    static const std::vector<std::string> shapes{"round", "rectangular"};
    const Node* shape = item.node->find("shape");
    const bool rectangular = shape && shape->text == "rectangular";
    const TableReader section{*item.node, item.key,
                              rectangular ? std::vector<std::string>{"shape", "width", "height"}
                                          : std::vector<std::string>{"shape", "diameter", "inner"},
                              reading_};
    if (!section.require("shape", choices(shapes))) return;
    section.choice("shape", shapes, 0);
    if (shape->kind != Node::Kind::text || (shape->text != "round" && !rectangular)) return;
    const std::string length = reading_.units.length;
    const Rule positive{Range::positive, length};
    SectionDraft& s = link_.section;
    s.shape = rectangular ? Shape::rectangular : Shape::round;
    if (rectangular) {
      s.width = section.required_number("width", positive, numbers_);
      s.height = section.required_number("height", positive, numbers_);
      return;
    }
    s.diameter = section.required_number("diameter", positive, numbers_);
    s.inner = section.number("inner", {Range::non_negative, length}, numbers_, 0);
    const Node* inner = section.find("inner");
    if (inner && section.has("diameter"))
      numbers_.require({s.inner, s.diameter}, inner->place, section.key_of("inner"),
                       [](const std::vector<double>& n) -> std::string {
                         return n[0] >= n[1] ? "the inner diameter must be smaller than diameter"
                                             : "";
                       });
  }

  void read_matrix() {
    const std::size_t m = link_.directions.size();
    const std::string rows = std::to_string(m);
    const std::string need = "a list of " + rows + " rows of " + rows + " numbers";
    const Node* node = table_.require("matrix", need + ", rows and columns as directions");
    link_.matrix.assign(m * m, numbers_.add(0));
    if (!node || !directions_known_) return;
    const Definiteness definite =
        link_.kind == Kind::compliance ? Definiteness::definite : Definiteness::semidefinite;
    link_.matrix =
        read_symmetric_matrix({node, table_.key_of("matrix")}, m, definite, numbers_, reading_);
  }

  /// One number per direction: lengths, then angles.
  std::vector<NumberId> read_coordinates(const std::string& name) {
    const std::size_t m = link_.directions.size();
    std::vector<NumberId> ids;
    const std::string need = "a list of " + std::to_string(m) + " numbers, one per direction";
    const std::vector<Item> items = table_.list(name, need);
    if (const Node* node = table_.find(name);
        node && directions_known_ && node->kind == Node::Kind::array && items.size() != m)
      report(name, "got " + described(*node) + ", need " + need);
    for (std::size_t i = 0; i < m; ++i) {
      const bool slides = link_.directions[i] <= ElasticDirection::Tz;
      const Rule rule{Range::finite, slides ? reading_.units.length : "rad"};
      ids.push_back(i < items.size() ? read_number(items[i], rule, numbers_, reading_)
                                     : numbers_.add(0));
    }
    return ids;
  }

  TableReader table_;
  bool kind_known_;
  bool plane_;
  bool directions_known_ = true;
  NumberTable& numbers_;
  Reading& reading_;
  ElasticDraft link_{};
};

}  // namespace

ElasticDraft read_elastic(const Item& item, const std::string& default_name, bool plane,
                          NumberTable& numbers, Reading& reading) {
  return ElasticReader{item, default_name, plane, numbers, reading}.read();
}

}  // namespace springfold::io
