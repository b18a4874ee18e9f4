#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

using model::JointKind;
using model::JointRole;

const std::vector<std::string>& joint_words() {
  static const std::vector<std::string> words{"revolute", "prismatic", "universal", "spherical"};
  return words;
}
const std::vector<std::string>& role_words() {
  static const std::vector<std::string> words{"passive", "preloaded", "virtual", "actuated"};
  return words;
}

/// Reads one `{ joint = ... }`, which becomes one, two or three joints of the model.
class JointReader {
 public:
  JointReader(const Item& item, const std::string& default_name,
              const std::set<std::string>& coupled, NumberTable& numbers, Reading& reading)
      : table_{*item.node,
               item.key,
               {"joint", "axis", "axes", "name", "role", "spring", "value", "stiffness", "initial"},
               reading},
        coupled_{coupled},
        numbers_{numbers},
        reading_{reading} {
    const std::size_t word = table_.choice("joint", joint_words(), 0);
    composed_ = word >= 2;
    kind_ = word == 1 ? JointKind::prismatic : JointKind::revolute;
    units_ = units_of(kind_, reading.units);
    static constexpr JointRole roles[] = {JointRole::passive, JointRole::preloaded,
                                          JointRole::compliant, JointRole::actuated};
    role_ = roles[table_.choice("role", role_words(), 0)];
    name_ = table_.text("name").value_or(default_name);
    if (const Node* name = table_.find("name"); name && name->kind == Node::Kind::text)
      is_plain_name(name->text, {name, table_.key_of("name")}, reading);
    read_axes(word);
  }

  std::vector<JointDraft> joints() {
    std::vector<JointDraft> joints;
    const std::vector<Springs> springs = read_springs();
    const std::vector<NumberId> initial = read_initial(springs);
    const std::optional<NumberId> command = read_command();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      JointDraft joint{.name = composed_ ? name_ + "." + std::to_string(i + 1) : name_,
                       .kind = kind_,
                       .axis = axes_[i],
                       .role = role_,
                       .initial = initial[i],
                       .command = command};
      if (springs[i].size() < 2) {
        if (!springs[i].empty()) joint.spring = springs[i].front();
        joints.push_back(std::move(joint));
      } else {
        add_series(joint, springs[i], initial, joints);
      }
    }
    return joints;
  }

  const std::string& name() const { return name_; }

 private:
  using Springs = std::vector<SpringDraft>;  ///< of one axis: none, one, or several in series

  /// Springs in series are joints one after the other along the same axis: their deflections add up, and
  /// the same torque goes through all. A drive moves the first one.
  void add_series(const JointDraft& joint, const Springs& springs,
                  const std::vector<NumberId>& initial, std::vector<JointDraft>& joints) {
    for (std::size_t k = 0; k < springs.size(); ++k) {
      JointDraft part = joint;
      part.name += "." + std::to_string(k + 1);
      part.spring = springs[k];
      const bool listed = initial.size() > axes_.size();
      if (listed) part.initial = initial[k];
      if (k > 0 && !listed) part.initial = numbers_.add(0);
      if (k > 0 && role_ == JointRole::actuated) {
        part.role = JointRole::compliant;
        part.command = std::nullopt;
      }
      joints.push_back(std::move(part));
    }
  }

  void report(const std::string& name, const std::string& what) const {
    const Node* node = table_.find(name);
    reading_.problems.add(node ? node->place : table_.place(), table_.key_of(name), what);
  }

  void read_axes(std::size_t word) {
    if (!composed_) {
      axes_.resize(1);
      if (table_.has("axes")) report("axes", "a joint with one axis has axis, not axes");
      if (const Node* axis = table_.require("axis", "an axis such as \"z\""))
        axes_[0] = read_axis({axis, table_.key_of("axis")}, numbers_, reading_);
      return;
    }
    const std::size_t count = word == 2 ? 2 : 3;
    const std::string need =
        word == 2 ? "two axes such as [\"x\", \"y\"]" : "three axes such as [\"x\", \"y\", \"z\"]";
    axes_.resize(count);
    if (table_.has("axis")) report("axis", "a joint with several axes has axes, not axis");
    if (count == 3)
      for (Index i = 0; i < 3; ++i)
        axes_[static_cast<std::size_t>(i)].fixed = model::Vec3<double>::Unit(i);
    if (count == 3 && !table_.has("axes")) return;
    if (!table_.require("axes", need)) return;
    const std::vector<Item> items = table_.list("axes", need);
    if (items.size() != count && table_.find("axes")->kind == Node::Kind::array)
      report("axes", "got " + described(*table_.find("axes")) + ", need " + need);
    for (std::size_t i = 0; i < std::min(count, items.size()); ++i)
      axes_[i] = read_axis(items[i], numbers_, reading_);
    for (std::size_t i = 1; i < std::min(count, items.size()); ++i)
      if (is_usable(axes_[i - 1], items[i - 1]) && is_usable(axes_[i], items[i]))
        refuse_parallel(i, items[i]);
  }

  static bool is_usable(const AxisDraft& axis, const Item& item) {
    return !axis.entries.empty() ||
           (item.node->kind == Node::Kind::text &&
            item.node->text.find_first_not_of("-xyz") == std::string::npos);
  }

  /// An axis along the one before it turns about the same line: two coordinates for one rotation.
  void refuse_parallel(std::size_t i, const Item& item) {
    std::vector<NumberId> ids;
    for (const AxisDraft* axis : {&axes_[i - 1], &axes_[i]})
      for (std::size_t k = 0; k < 3; ++k)
        ids.push_back(axis->entries.empty() ? numbers_.add(axis->fixed[static_cast<Index>(k)])
                                            : axis->entries[k]);
    numbers_.require(ids, item.node->place, item.key, [](const std::vector<double>& n) {
      const model::Vec3<double> a{n[0], n[1], n[2]}, b{n[3], n[4], n[5]};
      const double sizes = a.norm() * b.norm();
      const bool parallel = sizes > 0 && a.cross(b).norm() <= 1e-9 * sizes;
      return std::string{parallel ? "is parallel to the axis before it: the joint would turn twice "
                                    "about one line, need another direction"
                                  : ""};
    });
  }

  /// One for every axis.
  std::vector<Springs> read_springs() {
    std::vector<Springs> springs(axes_.size());
    const bool has_spring = table_.has("spring"), has_stiffness = table_.has("stiffness");
    if (role_ == JointRole::passive) {
      if (has_spring) report("spring", "a passive joint has no spring, need role = \"preloaded\"");
      if (has_stiffness)
        report("stiffness", "a passive joint has no spring, need role = \"virtual\"");
      return springs;
    }
    if (has_spring && has_stiffness) report("stiffness", "either stiffness or spring, not both");
    if (role_ == JointRole::preloaded && has_stiffness) {
      report("stiffness", "unknown key for a preloaded joint, need spring = { law = ... }");
    } else if (has_stiffness) {
      const bool drive = role_ == JointRole::actuated;
      const Rule rule{drive ? Range::positive : Range::non_negative, units_.stiffness};
      const NumberId k = table_.number("stiffness", rule, numbers_, 0);
      springs.assign(axes_.size(), Springs{LinearDraft{k, numbers_.add(0)}});
    }
    if (has_spring) read_spring_laws(springs);
    const bool written = has_spring || has_stiffness || table_.is_misspelt("spring") ||
                         table_.is_misspelt("stiffness");
    if (!written && role_ == JointRole::preloaded && !is_coupled())
      report("spring", "missing, need a spring: a preloaded joint has one");
    if (!written && role_ == JointRole::compliant)
      report("stiffness",
             "missing, need a number >= 0 [" + units_.stiffness + "] or spring = { law = ... }");
    return springs;
  }

  /// Does a coupled spring hold all its axes?
  bool is_coupled() const {
    for (std::size_t i = 0; i < axes_.size(); ++i)
      if (!coupled_.contains(composed_ ? name_ + "." + std::to_string(i + 1) : name_)) return false;
    return true;
  }

  /// `{ law = ... }` or `{ series = [{ law = ... }, ...] }`.
  Springs read_one_axis(const Item& item) {
    Springs springs;
    const auto add = [&](const Item& law) {
      if (auto spring = read_spring(law, kind_, numbers_, reading_))
        springs.push_back(std::move(*spring));
    };
    if (item.node->kind != Node::Kind::table || !item.node->find("series")) {
      add(item);
      return springs;
    }
    const TableReader table{*item.node, item.key, {"series"}, reading_};
    return read_series_laws({table.find("series"), table.key_of("series")}, units_, numbers_,
                            reading_);
  }

  void read_spring_laws(std::vector<Springs>& springs) {
    const Item item{table_.find("spring"), table_.key_of("spring")};
    const std::size_t n = springs.size();
    if (!composed_ || item.node->kind != Node::Kind::array) {
      springs.assign(n, read_one_axis(item));
      return;
    }
    const std::vector<Item> items = list_items(item, "a list of springs", reading_);
    if (items.size() != n)
      report("spring", "got " + described(*item.node) + ", need " + std::to_string(n) +
                           " springs, one for every axis");
    for (std::size_t i = 0; i < std::min(n, items.size()); ++i)
      springs[i] = read_one_axis(items[i]);
  }

  /// One for every axis; of a joint with one axis and springs in series also one for every spring.
  std::vector<NumberId> read_initial(const std::vector<Springs>& springs) {
    const bool series = !composed_ && springs.front().size() > 1;
    const std::size_t n = axes_.size(), listed = series ? springs.front().size() : n;
    const Rule rule{Range::finite, units_.coordinate};
    const Node* node = table_.find("initial");
    if (!(composed_ || series) || !node || node->kind != Node::Kind::array)
      return std::vector<NumberId>(n, table_.number("initial", rule, numbers_, 0));
    std::vector<NumberId> ids =
        read_numbers(table_.list("initial", "a list of numbers"), rule, numbers_, reading_);
    if (ids.size() != listed)
      report("initial", "got " + described(*node) + ", need " + std::to_string(listed) +
                            " numbers [" + units_.coordinate +
                            (series ? "], one for every spring" : "], one for every axis"));
    ids.resize(listed, 0);
    return ids;
  }

  std::optional<NumberId> read_command() {
    if (role_ != JointRole::actuated) {
      if (table_.has("value"))
        report("value", "only an actuated joint has a value, need role = \"actuated\"");
      return std::nullopt;
    }
    if (composed_)
      report("role", "a joint with several axes cannot be actuated, need single joints");
    return table_.required_number("value", {Range::finite, units_.coordinate}, numbers_);
  }

  TableReader table_;
  const std::set<std::string>& coupled_;
  NumberTable& numbers_;
  Reading& reading_;
  bool composed_ = false;  ///< universal or spherical
  JointKind kind_ = JointKind::revolute;
  JointUnits units_{};
  JointRole role_ = JointRole::passive;
  std::string name_{};
  std::vector<AxisDraft> axes_{};
};

void read_rigid(const Item& item, bool planar, NumberTable& numbers, Reading& reading,
                ChainDraft& chain) {
  const TableReader table{*item.node, item.key, {"rigid", "mass", "com", "inertia"}, reading};
  const FrameDraft frame =
      read_frame({table.find("rigid"), table.key_of("rigid")}, planar, numbers, reading);
  if (table.has("mass")) {  // in the middle of the link unless said otherwise
    PointDraft point{.elements_before = chain.elements.size(), .at = frame.at, .factor = 0.5};
    point.mass = read_mass(table, numbers, reading);
    if (const Node* com = table.find("com")) {
      point.at =
          read_vector3({com, table.key_of("com")}, planar, reading.units.length, numbers, reading);
      point.factor = 1;
    }
    point.inertia = read_inertia(table, planar, numbers, reading);
    chain.points.push_back(std::move(point));
  } else {
    if (table.has("com")) table.require("mass", "the mass of the link, whose centre this is");
    read_inertia(table, planar, numbers, reading);  // which needs the mass
  }
  chain.elements.push_back({frame, item.node->place, item.key});
}

/// `{ point = "knee", at = [...], mass = ... }`.
void read_point(const Item& item, bool planar, NumberTable& numbers, Reading& reading,
                ChainDraft& chain) {
  const TableReader table{*item.node, item.key, {"point", "at", "mass"}, reading};
  PointDraft point{.elements_before = chain.elements.size()};
  point.name = table.text("point").value_or("");
  const Item name{table.find("point"), table.key_of("point")};
  const bool usable = !point.name.empty() && is_plain_name(point.name, name, reading);
  const auto has_name = [&point](const PointDraft& other) { return other.name == point.name; };
  if (usable && std::any_of(chain.points.begin(), chain.points.end(), has_name))
    reading.problems.add(name.node->place, name.key,
                         "\"" + point.name +
                             "\" is already the name of another point of this chain, need "
                             "different names");
  if (const Node* at = table.find("at"))
    point.at =
        read_vector3({at, table.key_of("at")}, planar, reading.units.length, numbers, reading);
  if (table.has("mass")) point.mass = read_mass(table, numbers, reading);
  chain.points.push_back(std::move(point));
}

/// Which of the keys that say what an element is stands there; reports none and several.
std::optional<std::string> kind_of(const Item& item, Reading& reading) {
  static const std::vector<std::string> kinds{"joint", "rigid", "elastic"};
  std::vector<std::string> found;
  std::string hint;
  for (const std::string& kind : kinds)
    if (item.node->find(kind)) found.push_back(kind);
  if (found.size() == 1) return found.front();
  for (const NodeEntry& entry : item.node->entries)
    if (const std::string near = nearest(entry.key, kinds); found.empty() && !near.empty())
      hint = "; did you mean \"" + near + "\" where \"" + entry.key + "\" stands?";
  std::string got = "got neither joint, rigid nor elastic";
  for (std::size_t i = 0; i < found.size(); ++i) got = (i == 0 ? "got " : got + " and ") + found[i];
  reading.problems.add(item.node->place, item.key, got + ", need exactly one of them" + hint);
  return std::nullopt;
}

}  // namespace

NumberId read_mass(const TableReader& table, NumberTable& numbers, Reading& reading) {
  const std::string unit = reading.units.force + " per unit of gravity";
  return table.number("mass", {Range::non_negative, unit}, numbers, 0);
}

void read_elements(const std::vector<Item>& items, bool planar,
                   const std::set<std::string>& coupled, NumberTable& numbers, ChainDraft& chain,
                   Reading& reading) {
  std::vector<ElementDraft>& elements = chain.elements;
  std::set<std::string> names;
  int joints = 0, links = 0;
  const auto claim = [&](const Item& item, const std::string& own) {
    if (names.insert(own).second) return;
    const Node* name = item.node->find("name");
    reading.problems.add(name ? name->place : item.node->place, item.key + ".name",
                         "\"" + own +
                             "\" is already the name of another joint of "
                             "this chain, need different names");
  };
  constexpr std::size_t most_elements = 20000;
  if (items.size() > most_elements)
    return reading.problems.add(items[most_elements].node->place, items[most_elements].key,
                                "got " + std::to_string(items.size()) + " elements, need at most " +
                                    std::to_string(most_elements));
  for (const Item& item : items) {
    if (!is_table(item, "{ joint = ... }, { rigid = ... } or { elastic = ... }", reading)) continue;
    if (item.node->find("point")) {
      read_point(item, planar, numbers, reading, chain);
      continue;
    }
    const std::optional<std::string> kind = kind_of(item, reading);
    if (!kind) continue;
    if (*kind == "rigid") {
      read_rigid(item, planar, numbers, reading, chain);
    } else if (*kind == "elastic") {
      const std::string name = "e" + std::to_string(++links);
      ElasticDraft link = read_elastic(item, name, planar, numbers, reading);
      claim(item, link.name);
      elements.push_back({std::move(link), item.node->place, item.key});
    } else {
      JointReader reader{item, "j" + std::to_string(++joints), coupled, numbers, reading};
      claim(item, reader.name());
      for (JointDraft& draft : reader.joints())
        elements.push_back({std::move(draft), item.node->place, item.key});
    }
  }
}

}  // namespace springfold::io
