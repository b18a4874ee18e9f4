#include "pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "text.hpp"

namespace springfold::io {
namespace {

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

/// The same of an angle, which may be a plain number: then it is looked at whether it is in degrees.
void add_angle(Parts& parts, const Node& node, const Bindings& bindings, const std::string& key,
               const std::string& need) {
  const bool is_number = node.kind == Node::Kind::number && std::isfinite(node.number);
  if (is_number)
    parts.push_back({formula_of(node, bindings), described(node), node.place, key, need});
  else
    add_part(parts, node, bindings, key, need);
  if (is_number || (node.kind == Node::Kind::text && !node.parts)) parts.back().is_angle = true;
}

Node made_of(Parts parts, std::string text, const Place& place) {
  Node node = text_node(std::move(text), place);
  node.parts = std::make_shared<const Parts>(std::move(parts));
  return node;
}

/// A turn in the frame in which numbers stand: about `before`, which comes to lie at `after`.
struct FrameTurn {
  std::string angle{};  ///< empty: the frame turns with the copy, and the numbers stay
  Formulas before = no_shift(), after = no_shift();
};

/// Names of what the numbers of a copy stand in: in the copy, and in that of index 0. Empty: the base.
struct FrameNames {
  std::string own{}, at_zero{};
};

class Turner {
 public:
  Turner(const PatternCopy& copy, const DrawnParts& parts, Problems& problems)
      : bindings_{copy.bindings}, key_{copy.key}, drawn_{parts}, problems_{problems} {
    const Node& pattern = copy.pattern;
    read_axis(pattern);
    const Node* angle = pattern.find("angle");
    const std::string each = angle ? formula_of(*angle, bindings_) : "";
    if (each.empty())
      report(angle ? angle->place : pattern.place, "pattern.angle",
             (angle ? "got " + described(*angle) : std::string{"missing"}) +
                 ", need the angle from one copy to the next [rad]");
    else
      add_angle(parts_, *angle, bindings_, key_ + ".pattern.angle", "a finite number [rad]");
    const Binding* number = bindings_.find(copy.index);
    turn_.angle = each + "*(" + (number ? number->text : "0") + ")";
    is_zero_copy_ = number != nullptr && number->whole == 0;
    if (const Node* about = pattern.find("about")) read_centre(*about);
  }

  bool usable() const { return usable_; }

  const CopyTurn& copy_turn() const { return turn_; }
  FrameTurn in_base() const { return {turn_.angle, turn_.axis.centre, turn_.axis.centre}; }
  FrameTurn of_direction() const { return {turn_.angle}; }

  /// @param key  of the numbers, for messages. @returns nothing where it is not known, which is reported
  std::optional<FrameTurn> in_frame(const FrameNames& names, const Place& place,
                                    const std::string& key) {
    using Kind = DrawnParts::Kind;
    const Kind kind = drawn_.kind_of(names.own);
    if (names.own.empty() || kind == Kind::base || kind == Kind::unknown) return in_base();
    const bool goes_along = is_zero_copy_ || names.own != names.at_zero;
    if (goes_along && drawn_.was_turned_so(names.own, turn_))
      return kind == Kind::point ? of_direction() : FrameTurn{};
    if (kind == Kind::chain) {
      report(place, key,
             "where \"" + names.own +
                 "\" stands is not known in a pattern that does not turn its " +
                 "chain too, need repeat, with numbers for every copy");
      return std::nullopt;
    }
    return between_drawn(names, place, key);
  }

  /// [x, y] or [x, y, z].
  void turn_vector(Node& list, const std::string& key, const FrameTurn& turn) {
    const std::size_t size = list.items.size();
    if (turn.angle.empty()) return;
    if (list.kind != Node::Kind::array || (size != 2 && size != 3)) return;  // reported elsewhere
    if (size == 2 && turn_.axis.letter != 2)
      return report(list.place, "pattern.axis", "in the plane the axis is \"z\"");
    Formulas from = no_shift();
    for (std::size_t i = 0; i < size; ++i) {
      from[i] = formula_of(list.items[i], bindings_);
      if (from[i].empty()) return;
    }
    const Formulas to =
        sum(turned(difference(from, turn.before), turn_.axis, turn.angle), turn.after);
    Parts parts = parts_;
    parts.insert(parts.end(), centre_parts_.begin(),
                 centre_parts_.end());  // judged even where unused
    for (std::size_t i = 0; i < size; ++i)
      add_part(parts, list.items[i], bindings_, item_key(key, i), "");
    for (std::size_t i = 0; i < size; ++i)
      list.items[i] = made_of(parts, to[i], list.items[i].place);
  }

  /// A frame of a chain: its place, and a rotation.
  void turn_frame(Node& table, const std::string& key, const FrameTurn& turn) {
    if (turn.angle.empty()) return;
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
      turn_vector(*at, key + ".at", turn);
    else if (!is_zero(turn.before) || !is_zero(turn.after))
      return report(frame->place, key,
                    "need at = [...] beside rotate: the axis of the pattern is not at its origin");
    const std::string axis = std::string(turn_.axis.negative ? "-" : "") + "xyz"[turn_.axis.letter];
    Node* rotate = frame->find("rotate");
    if (rotate == nullptr) {
      Node own_turn;
      own_turn.place = frame->place;
      own_turn.entries.push_back({"axis", frame->place, text_node(axis, frame->place)});
      own_turn.entries.push_back(
          {"angle", frame->place, made_of(parts_, turn.angle, frame->place)});
      frame->entries.push_back({"rotate", frame->place, std::move(own_turn)});
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
    add_angle(parts, *angle, bindings_, "", "");
    *angle =
        made_of(std::move(parts), formula_of(*angle, bindings_) + "+" + turn.angle, angle->place);
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
    if (word != "planar") return turn_vector(*pose, "pose", in_base());
    if (pose->items.size() != 3) return;
    Node place = *pose;
    place.items.pop_back();
    turn_vector(place, "pose", in_base());
    const Node& own = pose->items[2];
    Parts parts = parts_;
    add_angle(parts, own, bindings_, "", "");
    place.items.push_back(made_of(
        std::move(parts),
        formula_of(own, bindings_) + (turn_.axis.negative ? "-" : "+") + turn_.angle, own.place));
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
    turn_.axis.letter = static_cast<std::size_t>(found - words.begin()) % 3;
    turn_.axis.negative = found - words.begin() >= 3;
  }

  void read_centre(const Node& about) {
    const std::size_t size = about.items.size();
    bool usable = about.kind == Node::Kind::array && (size == 2 || size == 3);
    for (std::size_t i = 0; usable && i < size; ++i) {
      turn_.axis.centre[i] = formula_of(about.items[i], bindings_);
      usable = !turn_.axis.centre[i].empty();
      add_part(centre_parts_, about.items[i], bindings_, item_key("pattern.about", i),
               "a finite number");
    }
    if (!usable)
      report(about.place, "pattern.about",
             "got " + described(about) + ", need a point of the axis, [x, y] or [x, y, z]");
  }

  /// The turn between the frames of two bodies, which may be one: from that of index 0 into this copy's.
  std::optional<FrameTurn> between_drawn(const FrameNames& names, const Place& place,
                                         const std::string& key) {
    const bool same = names.own == names.at_zero;
    if (drawn_.kind_of(names.at_zero) == DrawnParts::Kind::unknown) {
      report(place, key,
             "\"" + names.own + "\" goes with the index, but there is no \"" + names.at_zero +
                 "\" of index 0, need one, or its own pattern with the same axis and angle");
      return std::nullopt;
    }
    const bool has_pose = drawn_.has_pose(names.own), at_zero = drawn_.has_pose(names.at_zero);
    if (!has_pose && !at_zero && is_zero(turn_.axis.centre)) return of_direction();
    if (!has_pose || !at_zero) {
      report(place, key,
             "the pattern turns it about a point of the base, and where \"" +
                 (has_pose ? names.at_zero : names.own) +
                 "\" stands is not given, need its pose, or a pattern about the origin");
      return std::nullopt;
    }
    const auto from = drawn_.frame_of(names.at_zero, turn_.axis);
    const auto to = drawn_.frame_of(names.own, turn_.axis);
    if (!from || !to) {
      report(place, key,
             "\"" + names.own +
                 "\" is not drawn turned about the axis of the pattern alone, need "
                 "repeat, with numbers for every copy");
      return std::nullopt;
    }
    return same ? within(*to) : between(*from, *to);
  }

  /// A vector of the base, in a frame that is turned about the axis' letter.
  Formulas seen_from(const DrawnFrame& frame, const Formulas& vector) const {
    if (frame.angle == zero_formula) return vector;
    return turned(vector, {turn_.axis.letter}, "-" + frame.angle);
  }

  FrameTurn within(const DrawnFrame& frame) const {
    Formulas way = difference(turn_.axis.centre, frame.at);
    way[turn_.axis.letter] = zero_formula;
    const Formulas centre = seen_from(frame, way);
    return {turn_.angle, centre, centre};
  }

  FrameTurn between(const DrawnFrame& from, const DrawnFrame& to) const {
    const Formulas& c = turn_.axis.centre;
    const Formulas there = sum(turned(difference(from.at, c), turn_.axis, turn_.angle), c);
    Formulas way = difference(there, to.at);
    way[turn_.axis.letter] = difference(from.at, to.at)[turn_.axis.letter];
    FrameTurn turn{.angle = turn_.angle, .after = seen_from(to, way)};
    if (from.angle != to.angle)
      turn.angle += (turn_.axis.negative ? "-(" : "+(") + from.angle + "-" + to.angle + ")";
    return turn;
  }

  const Bindings& bindings_;
  std::string key_;
  const DrawnParts& drawn_;
  Problems& problems_;
  CopyTurn turn_{};
  bool usable_ = true, is_zero_copy_ = false;
  Parts parts_{};  ///< of the angle
  Parts centre_parts_{};
};

std::string text_at(const Node& table, const std::string& key) {
  const Node* node = table.find(key);
  return node != nullptr && node->kind == Node::Kind::text ? node->text : std::string{};
}

/// What a place of a copy stands in: by the key of the name beside it.
FrameNames names_in(const Node& table, const Node& at_zero, const std::string& key,
                    const std::string& otherwise = {}) {
  if (!table.find(key)) return {otherwise, otherwise};
  return {text_at(table, key), text_at(at_zero, key)};
}

void turn_at(Node& table, const char* name, const FrameNames& names, const std::string& key,
             Turner& turner) {
  Node* at = table.find(name);
  if (at == nullptr) return;
  if (const auto turn = turner.in_frame(names, at->place, key)) turner.turn_vector(*at, key, *turn);
}

void turn_points(Node& table, const Node& at_zero, Turner& turner) {
  Node* of = table.find("of");
  const Node* other = at_zero.find("of");
  if (of == nullptr || other == nullptr) return;
  for (std::size_t i = 0; i < std::min(of->items.size(), other->items.size()); ++i)
    if (Node& point = of->items[i]; point.kind == Node::Kind::table)
      turn_at(point, "at", names_in(point, other->items[i], "on"),
              "of[" + std::to_string(i + 1) + "].at", turner);
}

void turn_end(Node& chain, const std::string& key, const FrameNames& names, Turner& turner) {
  if (const auto turn = turner.in_frame(names, chain.place, key))
    turner.turn_frame(chain, key, *turn);
}

void turn_load(Node& table, const FrameNames& on, Turner& turner) {
  turn_at(table, "at", on, "at", turner);
  const Node* follows = table.find("follows");
  const bool in_body = follows && follows->kind == Node::Kind::boolean && follows->number != 0;
  for (const char* name : {"force", "moment"})
    if (Node* vector = table.find(name)) {
      const auto turn = in_body ? turner.in_frame(on, vector->place, name) : turner.of_direction();
      if (turn) turner.turn_vector(*vector, name, FrameTurn{turn->angle});
    }
}

}  // namespace

bool is_pattern_key(std::string_view key) {
  return key == "angle" || key == "axis" || key == "about";
}

void turn_copy(const PatternCopy& copy, DrawnParts& parts, Problems& problems) {
  Turner turner{copy, parts, problems};
  if (!turner.usable()) return;
  Node& table = copy.table;
  const Node& at_zero = copy.at_zero;
  if (copy.part == "body" || copy.part == "node" || copy.part == "chain")
    parts.add_turned(text_at(table, "name"), turner.copy_turn());
  if (copy.part == "body") return turner.turn_pose(table);
  if (copy.part == "node") {
    const Node* fixed = table.find("fixed");
    if (fixed && fixed->kind == Node::Kind::array)
      return turner.report(fixed->place, "fixed",
                           "directions are those of the base, which do not turn, need true or "
                           "false in a pattern");
    if (Node* at = table.find("at")) turner.turn_vector(*at, "at", turner.in_base());
    return;
  }
  const auto names = [&](const char* key, const std::string& otherwise) {
    return names_in(table, at_zero, key, otherwise);
  };
  if (copy.part == "chain") {
    turn_end(table, "from_at", names("from", ""), turner);
    return turn_end(table, "to_at", names("to", parts.only_one()), turner);
  }
  turn_at(table, "from_at", names("from", ""), "from_at", turner);
  turn_at(table, "to_at", names("to", ""), "to_at", turner);
  turn_points(table, at_zero, turner);
  turn_load(table, names("on", parts.only_one()), turner);
}

}  // namespace springfold::io
