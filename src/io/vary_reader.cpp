// `vary` of a study: one run for every value of a parameter, or for lists, grids and samples of several.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "study_reader.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

constexpr std::size_t most_runs = 10000;
const std::vector<std::string> ways{"values", "list", "grid", "sample"};

/// A parameter with what is given for it.
struct Axis {
  std::size_t parameter = 0;
  Item given{};
};

std::vector<std::string> read_labels(const TableReader& vary, std::size_t runs, Reading& reading) {
  std::vector<std::string> labels = read_texts(vary.list("labels", "a list of texts"), reading);
  const Node* node = vary.find("labels");
  if (node && node->kind == Node::Kind::array && labels.size() != runs)
    reading.problems.add(
        node->place, vary.key_of("labels"),
        "got " + described(*node) + ", need " + std::to_string(runs) + ": one for every value");
  return labels;
}

void refuse_too_many(double runs, const Place& place, const std::string& key,
                     const std::string& got, Reading& reading) {
  if (runs > static_cast<double>(most_runs))
    reading.problems.add(place, key,
                         "got " + got + ", need at most " + std::to_string(most_runs) + " values");
}

class VaryReader {
 public:
  VaryReader(const TableReader& vary, const Redefinitions& set, Reading& reading)
      : vary_{vary}, set_{set}, reading_{reading} {}

  /// @returns false if the runs are not known
  bool read(VaryDraft& draft) {
    const std::size_t way = way_of_it();
    refuse_what_is_not_used(way);
    if (way == 0) return read_values(draft);
    const std::vector<Axis> axes = read_axes(ways[way]);
    if (axes.empty()) return false;
    for (const Axis& axis : axes) draft.parameters.push_back(axis.parameter);
    const std::size_t before = reading_.problems.size();
    if (way == 1) lists(axes, draft);
    if (way == 2) grid(axes, draft);
    if (way == 3) sample(axes, draft);
    return reading_.problems.size() == before && !draft.values.empty();
  }

 private:
  std::size_t way_of_it() const {
    std::size_t found = 0;
    for (std::size_t way = 0; way < ways.size(); ++way) {
      if (!vary_.has(ways[way])) continue;
      if (way > 0 && (found > 0 || vary_.has("values")))
        reading_.problems.add(vary_.find(ways[way])->place, vary_.key_of(ways[way]),
                              "need one of parameter with values, list, grid and sample");
      found = way;
    }
    return found;
  }

  void refuse_what_is_not_used(std::size_t way) const {
    const auto only_with = [&](const std::string& key, std::size_t wanted) {
      if (way != wanted && vary_.has(key))
        reading_.problems.add(vary_.find(key)->place, vary_.key_of(key),
                              "has no meaning here, goes with " + ways[wanted]);
    };
    only_with("parameter", 0);
    only_with("points", 3);
    only_with("seed", 3);
  }

  /// A parameter that is not set otherwise.
  std::optional<std::size_t> parameter(const std::string& name, const Place& place,
                                       const std::string& key) const {
    const auto number = parameter_number(name, place, key, reading_.book, reading_.problems);
    if (number && set_.contains(*number))
      reading_.problems.add(place, key, "\"" + name + "\" is in set too, need one of them");
    return number;
  }

  std::vector<Definition> definitions(const Item& list) const {
    std::vector<Definition> values;
    for (const Item& value : list_items(list, "a list of numbers, one for every run", reading_))
      values.push_back(
          read_definition(*value.node, value.key, "a number", reading_.book, reading_.problems));
    if (list.node->kind != Node::Kind::array) return values;
    if (values.empty())
      reading_.problems.add(list.node->place, list.key,
                            "got an empty list, need a list of numbers, one for every run");
    refuse_too_many(static_cast<double>(values.size()), list.node->place, list.key,
                    described(*list.node), reading_);
    return values;
  }

  bool read_values(VaryDraft& draft) const {
    const auto name = vary_.required_text("parameter", "the name of a parameter");
    const Node* node = vary_.require("values", "a list of numbers, one for every run");
    if (node != nullptr)
      for (Definition& value : definitions({node, vary_.key_of("values")}))
        draft.values.push_back({std::move(value)});
    if (!name) return false;
    const auto number = parameter(*name, vary_.find("parameter")->place, vary_.key_of("parameter"));
    if (!number || draft.values.empty()) return false;
    draft.parameters = {*number};
    return true;
  }

  std::vector<Axis> read_axes(const std::string& way) const {
    const std::string example = way == "sample" ? "a table such as { Kv = [0, 0.1] }"
                                                : "a table such as { Kv = [0, 0.05, 0.1] }";
    const Item table{vary_.find(way), vary_.key_of(way)};
    if (!is_table(table, example, reading_)) return {};
    std::vector<Axis> axes;
    bool known = true;
    for (const NodeEntry& entry : table.node->entries) {
      const std::string key = table.key + "." + entry.key;
      const auto number = parameter(entry.key, entry.place, key);
      known = known && number.has_value();
      axes.push_back({number.value_or(0), {&entry.value, key}});
    }
    if (axes.empty())
      reading_.problems.add(table.node->place, table.key, "got nothing, need " + example);
    return known ? axes : std::vector<Axis>{};
  }

  /// Its value with the parameters as the study has them without `vary`.
  double value_of(const Definition& definition) const {
    if (!definition.usable) return 0;
    double value = definition.constant;
    if (definition.formula) {
      Problems ignored;  // of parameters: reported when the runs are checked
      const Values all = evaluate(*reading_.parameters, set_, reading_.book, "", ignored);
      value = reading_.book.value(*definition.formula, all.values);
    }
    if (!std::isfinite(value))
      reading_.problems.add(definition.place, definition.key,
                            "got " + definition.shown + ", need a finite number");
    return value;
  }

  static Definition number_at(double value, const Item& at) {
    return {.constant = value, .shown = shortest(value), .place = at.node->place, .key = at.key};
  }

  /// A list of numbers, or { from, to, points }: numbers at equal distances.
  std::vector<Definition> values_of(const Item& given) const {
    if (given.node->kind != Node::Kind::table) return definitions(given);
    NumberTable numbers;
    const TableReader range{*given.node, given.key, {"from", "to", "points"}, reading_};
    const auto end = [&](const char* name) {
      const Node* node = range.require(name, "a number");
      return node == nullptr ? 0
                             : value_of(read_definition(*node, range.key_of(name), "a number",
                                                        reading_.book, reading_.problems));
    };
    const double from = end("from"), to = end("to");
    const std::size_t points = count(range, "points", 2);
    std::vector<Definition> values;
    for (std::size_t i = 0; i < points; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(points - 1);
      values.push_back(number_at(i + 1 == points ? to : from + (to - from) * part, given));
    }
    return values;
  }

  /// A whole number from `least` to the largest number of runs; 0 if it is missing or wrong.
  std::size_t count(const TableReader& table, const std::string& name, double least) const {
    const std::string need =
        "a whole number from " + shortest(least) + " to " + std::to_string(most_runs);
    const Node* node = table.require(name, need);
    if (node == nullptr) return 0;
    const double value = node->number;
    if (node->kind == Node::Kind::number && value >= least && value == std::floor(value) &&
        value <= static_cast<double>(most_runs))
      return static_cast<std::size_t>(value);
    reading_.problems.add(node->place, table.key_of(name),
                          "got " + described(*node) + ", need " + need);
    return 0;
  }

  /// All parameters side by side.
  void lists(const std::vector<Axis>& axes, VaryDraft& draft) const {
    for (const Axis& axis : axes) {
      std::vector<Definition> values = values_of(axis.given);
      if (&axis == &axes.front()) draft.values.resize(values.size());
      if (values.size() != draft.values.size()) {
        reading_.problems.add(axis.given.node->place, axis.given.key,
                              "got " + std::to_string(values.size()) + " values, need " +
                                  std::to_string(draft.values.size()) +
                                  " as for the first parameter");
        continue;
      }
      for (std::size_t i = 0; i < values.size(); ++i)
        draft.values[i].push_back(std::move(values[i]));
    }
  }

  /// Every value with every other; the first parameter runs fastest.
  void grid(const std::vector<Axis>& axes, VaryDraft& draft) const {
    std::vector<std::vector<Definition>> values;
    double runs = 1;
    for (const Axis& axis : axes) {
      values.push_back(values_of(axis.given));
      runs *= static_cast<double>(values.back().size());
    }
    const Node* node = vary_.find("grid");
    refuse_too_many(runs, node->place, vary_.key_of("grid"), shortest(runs) + " values", reading_);
    if (runs > static_cast<double>(most_runs)) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(runs); ++i) {
      std::size_t rest = i;
      auto& row = draft.values.emplace_back();
      for (const auto& along : values) {
        row.push_back(along[rest % along.size()]);
        rest /= along.size();
      }
    }
  }

  /// Latin hypercube (McKay, Beckman, Conover 1979): each range is cut into as many equal parts as there
  /// are runs, every part is used once, at a random place within it; parts are paired at random.
  void sample(const std::vector<Axis>& axes, VaryDraft& draft) const {
    const std::size_t points = count(vary_, "points", 1);
    double seed = 1;
    if (const Node* node = vary_.find("seed")) {
      seed = node->number;
      if (node->kind != Node::Kind::number || seed < 0 || seed > 0x1p53 || seed != std::floor(seed))
        reading_.problems.add(node->place, vary_.key_of("seed"),
                              "got " + described(*node) + ", need a whole number >= 0");
    }
    std::vector<std::pair<double, double>> ranges;
    for (const Axis& axis : axes) {
      const Node& node = *axis.given.node;
      if (node.kind != Node::Kind::array || node.items.size() != 2) {
        reading_.problems.add(node.place, axis.given.key,
                              "got " + described(node) + ", need [low, high]");
        continue;
      }
      const std::vector<Definition> ends = definitions(axis.given);
      ranges.emplace_back(value_of(ends[0]), value_of(ends[1]));
      if (!(ranges.back().first < ranges.back().second))
        reading_.problems.add(node.place, axis.given.key, "need low < high");
    }
    if (points == 0 || ranges.size() != axes.size()) return;
    draw(axes, ranges, points, static_cast<std::uint64_t>(std::max(seed, 0.0)), draft);
  }

  static void draw(const std::vector<Axis>& axes,
                   const std::vector<std::pair<double, double>>& ranges, std::size_t points,
                   std::uint64_t seed, VaryDraft& draft) {
    std::mt19937_64 random{
        seed};  // its numbers are fixed by the standard, those of distributions are not
    const auto n = static_cast<double>(points);
    draft.values.resize(points);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      std::vector<std::size_t> parts(points);
      std::iota(parts.begin(), parts.end(), std::size_t{0});
      for (std::size_t i = points; i > 1; --i) std::swap(parts[i - 1], parts[random() % i]);
      for (std::size_t i = 0; i < points; ++i) {
        const double within = static_cast<double>(random() >> 11) * 0x1p-53;
        const double part = (static_cast<double>(parts[i]) + within) / n;
        const auto [low, high] = ranges[k];
        draft.values[i].push_back(number_at(low + (high - low) * part, axes[k].given));
      }
    }
  }

  const TableReader& vary_;
  const Redefinitions& set_;
  Reading& reading_;
};

/// Columns of the table, each with a name of its own; by default that of the quantity and the point.
std::vector<ExpectedDraft> read_columns(const TableReader& vary, Reading& reading) {
  static const std::vector<std::string> keys{"name", "at",   "near",  "quantity",
                                             "per",  "side", "factor"};
  std::vector<ExpectedDraft> columns;
  std::set<std::string> names;
  for (const Item& item :
       vary.tables("table", "table = [{ name = \"F_cr\", at = \"LP1\", quantity = \"force\" }]")) {
    const TableReader table{*item.node, item.key, keys, reading};
    ExpectedDraft& column = columns.emplace_back(read_wanted(table, reading));
    ExpectedValue& value = column.value;
    value.name = table.text("name").value_or(value.at == "start" ? value.quantity
                                                                 : value.at + "." + value.quantity);
    if (!names.insert(value.name).second || value.name == "run" || value.name == "status")
      reading.problems.add(
          item.node->place, item.key,
          "two columns are called \"" + value.name + "\": give one of them a name");
  }
  return columns;
}

bool read_keeps_curves(const TableReader& vary, const VaryDraft& draft, Reading& reading) {
  const bool keeps = vary.flag("curves", true);
  if (!keeps && draft.columns.empty() && !vary.is_misspelt("table"))
    reading.problems.add(
        vary.find("curves")->place, vary.key_of("curves"),
        "got false without a table: nothing would be left of the runs, need table");
  return keeps;
}

}  // namespace

std::optional<VaryDraft> read_vary(const TableReader& study, const Redefinitions& set,
                                   Reading& reading) {
  const Node* node = study.find("vary");
  const Item item{node, study.key_of("vary")};
  if (!node ||
      !is_table(item, "a table such as { parameter = \"Kv\", values = [0, 0.1] }", reading))
    return std::nullopt;
  const TableReader vary{*node,
                         item.key,
                         {"parameter", "values", "labels", "list", "grid", "sample", "points",
                          "seed", "table", "curves"},
                         reading};
  VaryDraft draft;
  const bool known = VaryReader{vary, set, reading}.read(draft);
  draft.labels = read_labels(vary, draft.values.size(), reading);
  draft.columns = read_columns(vary, reading);
  draft.keeps_curves = read_keeps_curves(vary, draft, reading);
  return known ? std::optional{std::move(draft)} : std::nullopt;
}

}  // namespace springfold::io
