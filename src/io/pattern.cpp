#include "pattern.hpp"

#include <algorithm>
#include <array>

#include "text.hpp"

namespace springfold::io {
namespace {

using Formulas = std::vector<std::string>;

/// A number or formula as a formula of parameters alone; empty: it is neither.
std::string formula_of(const Node& node, const Bindings& bindings) {
  if (node.kind == Node::Kind::number) return "(" + shortest(node.number) + ")";
  if (node.kind != Node::Kind::text) return {};
  return "(" + with_bindings(node.text, node.bindings ? *node.bindings : bindings) + ")";
}

Node text_node(std::string text, const Place& place) {
  return plain_node(Node::Kind::text, place, 0, std::move(text));
}

using Parts = std::vector<WrittenPart>;

/// Adds the formula that stands in the file, and those that it is made of.
void add_part(Parts& parts, const Node& node, const Bindings& bindings, const std::string& key,
              const std::string& need) {
  if (node.kind != Node::Kind::text) return;
  const Parts inner = written_parts(node);
  parts.insert(parts.end(), inner.begin(), inner.end());
  if (node.parts) return;
  parts.push_back({with_bindings(node.text, node.bindings ? *node.bindings : bindings),
                   described(node), node.place, key, need});
}

Node made_of(Parts parts, std::string text, const Place& place) {
  Node node = text_node(std::move(text), place);
  node.parts = std::make_shared<const Parts>(std::move(parts));
  return node;
}

class Turner {
 public:
  Turner(const Node& pattern, const std::string& index, const Bindings& bindings,
         const std::string& key, Problems& problems)
      : bindings_{bindings}, key_{key}, problems_{problems} {
    read_axis(pattern);
    const Node* angle = pattern.find("angle");
    const std::string each = angle ? formula_of(*angle, bindings) : "";
    if (each.empty())
      report(angle ? angle->place : pattern.place, "pattern.angle",
             (angle ? "got " + described(*angle) : std::string{"missing"}) +
                 ", need the angle from one copy to the next [rad]");
    else
      add_part(parts_, *angle, bindings, key + ".pattern.angle", "a finite number [rad]");
    const Binding* number = bindings.find(index);
    angle_ = each + "*(" + (number ? number->text : "0") + ")";
    if (const Node* about = pattern.find("about")) read_centre(*about);
  }

  bool usable() const { return usable_; }

  /// [x, y] or [x, y, z] about the axis. @param free  a direction: the axis goes through its beginning
  void turn_vector(Node& list, const std::string& key, bool free) {
    const std::size_t size = list.items.size();
    if (list.kind != Node::Kind::array || (size != 2 && size != 3)) return;  // reported elsewhere
    if (size == 2 && axis_ != 2)
      return report(list.place, "pattern.axis", "in the plane the axis is \"z\"");
    Formulas from(3, "(0)");
    for (std::size_t i = 0; i < size; ++i) {
      from[i] = formula_of(list.items[i], bindings_);
      if (from[i].empty()) return;
      if (!free && !centre_.empty()) from[i] = "(" + from[i] + "-" + centre_[i] + ")";
    }
    const std::size_t first = (axis_ + 1) % 3, second = (axis_ + 2) % 3;
    const std::string c = "cos(" + angle_ + ")", s = "sin(" + angle_ + ")";
    Formulas to = from;
    to[first] = from[first] + "*" + c + (negative_ ? "+" : "-") + from[second] + "*" + s;
    to[second] = (negative_ ? "-" : "") + from[first] + "*" + s + "+" + from[second] + "*" + c;
    Parts parts = parts_;
    parts.insert(parts.end(), centre_parts_.begin(),
                 centre_parts_.end());  // judged even where unused
    for (std::size_t i = 0; i < size; ++i)
      add_part(parts, list.items[i], bindings_, item_key(key, i), "");
    for (std::size_t i = 0; i < size; ++i) {
      if (!free && !centre_.empty()) to[i] += "+" + centre_[i];
      list.items[i] = made_of(parts, std::move(to[i]), list.items[i].place);
    }
  }

  /// A frame of a chain: its place, and a rotation.
  void turn_frame(Node& table, const std::string& key) {
    Node* frame = table.find(key);
    if (frame == nullptr) {
      Node at;
      at.kind = Node::Kind::array;
      at.place = table.place;
      at.items.assign(3, text_node("0", table.place));
      table.entries.push_back({key, table.place, std::move(at)});
      frame = &table.entries.back().value;
    }
    if (frame->kind == Node::Kind::array) {
      Node whole;
      whole.place = frame->place;
      whole.entries.push_back({"at", frame->place, std::move(*frame)});
      *frame = std::move(whole);
    }
    if (frame->kind != Node::Kind::table) return;
    if (Node* at = frame->find("at"))
      turn_vector(*at, key + ".at", false);
    else if (!centre_.empty())
      return report(frame->place, key, "need at = [...] beside rotate: the pattern has about");
    const std::string axis = std::string(negative_ ? "-" : "") + "xyz"[axis_];
    Node* rotate = frame->find("rotate");
    if (rotate == nullptr) {
      Node turn;
      turn.place = frame->place;
      turn.entries.push_back({"axis", frame->place, text_node(axis, frame->place)});
      turn.entries.push_back({"angle", frame->place, made_of(parts_, angle_, frame->place)});
      frame->entries.push_back({"rotate", frame->place, std::move(turn)});
      return;
    }
    const Node* own = rotate->find("axis");
    Node* angle = rotate->find("angle");
    if (own == nullptr || angle == nullptr) return;  // reported elsewhere
    if (own->text != axis)
      return report(rotate->place, key + ".rotate.axis",
                    "got " + described(*own) + ", need \"" + axis +
                        "\", the axis of the pattern: other turns belong into the elements");
    Parts parts = parts_;
    add_part(parts, *angle, bindings_, "", "");
    *angle = made_of(std::move(parts), formula_of(*angle, bindings_) + "+" + angle_, angle->place);
  }

  /// Position of a point; of a planar body its angle too.
  void turn_pose(Node& table) {
    Node* pose = table.find("pose");
    const Node* space = table.find("task_space");
    const std::string word = space ? space->text : "";
    if (word == "spatial")
      return report(table.place, "pattern",
                    "cannot turn bodies in space, need pose with the index of repeat");
    if (pose == nullptr || pose->kind != Node::Kind::array) return;
    if (word != "planar") return turn_vector(*pose, "pose", false);
    if (pose->items.size() != 3) return;
    Node place = *pose;
    place.items.pop_back();
    turn_vector(place, "pose", false);
    const Node& own = pose->items[2];
    Parts parts = parts_;
    add_part(parts, own, bindings_, "", "");
    place.items.push_back(made_of(std::move(parts),
                                  formula_of(own, bindings_) + (negative_ ? "-" : "+") + angle_,
                                  own.place));
    *pose = std::move(place);
  }

  void report(const Place& place, const std::string& key, const std::string& what) {
    problems_.add(place, key_ + "." + key, what);
    usable_ = false;
  }

 private:
  std::string item_key(const std::string& key, std::size_t i) const {
    return key_ + "." + key + "[" + std::to_string(i + 1) + "]";
  }

  void read_axis(const Node& pattern) {
    const Node* axis = pattern.find("axis");
    if (axis == nullptr) return;
    static const std::array<std::string, 6> words{"x", "y", "z", "-x", "-y", "-z"};
    const auto found = std::find(words.begin(), words.end(), axis->text);
    if (found == words.end())
      return report(
          axis->place, "pattern.axis",
          "got " + described(*axis) + ", need \"x\", \"y\", \"z\", \"-x\", \"-y\" or \"-z\"");
    axis_ = static_cast<std::size_t>(found - words.begin()) % 3;
    negative_ = found - words.begin() >= 3;
  }

  void read_centre(const Node& about) {
    const bool list = about.kind == Node::Kind::array && about.items.size() >= 2;
    for (std::size_t i = 0; i < about.items.size(); ++i) {
      centre_.push_back(formula_of(about.items[i], bindings_));
      add_part(centre_parts_, about.items[i], bindings_, item_key("pattern.about", i),
               "a finite number");
    }
    centre_.resize(3, "(0)");
    if (!list || about.items.size() > 3 ||
        std::any_of(centre_.begin(), centre_.end(), [](const auto& f) { return f.empty(); }))
      report(about.place, "pattern.about",
             "got " + described(about) + ", need a point of the axis, [x, y] or [x, y, z]");
  }

  const Bindings& bindings_;
  std::string key_;
  Problems& problems_;
  std::size_t axis_ = 2;
  bool negative_ = false, usable_ = true;
  std::string angle_{};
  Formulas centre_{};  ///< empty: the origin
  Parts parts_{};      ///< of the angle
  Parts centre_parts_{};
};

void turn_places(Node& table, Turner& turner) {
  for (const char* key : {"at", "from_at", "to_at"})
    if (Node* at = table.find(key)) turner.turn_vector(*at, key, false);
  Node* of = table.find("of");
  if (of == nullptr) return;
  for (std::size_t i = 0; i < of->items.size(); ++i)
    if (Node& point = of->items[i]; point.kind == Node::Kind::table)
      if (Node* at = point.find("at"))
        turner.turn_vector(*at, "of[" + std::to_string(i + 1) + "].at", false);
}

}  // namespace

bool is_pattern_key(std::string_view key) {
  return key == "angle" || key == "axis" || key == "about";
}

void turn_copy(Node& copy, const std::string& part, const Node& pattern, const std::string& index,
               const Bindings& bindings, const std::string& key, Problems& problems) {
  Turner turner{pattern, index, bindings, key, problems};
  if (!turner.usable()) return;
  if (part == "chain") {
    turner.turn_frame(copy, "from_at");
    turner.turn_frame(copy, "to_at");
    return;
  }
  if (part == "body") return turner.turn_pose(copy);
  const Node* fixed = copy.find("fixed");
  if (part == "node" && fixed && fixed->kind == Node::Kind::array)
    return turner.report(fixed->place, "fixed",
                         "directions are those of the base, which do not turn, need true or false "
                         "in a pattern");
  turn_places(copy, turner);
  for (const char* name : {"force", "moment"})
    if (Node* vector = copy.find(name)) turner.turn_vector(*vector, name, true);
}

}  // namespace springfold::io
