#include "spring_reader.hpp"

#include <algorithm>

namespace springfold::io {
namespace {

const char* const falling_hint = ", or falling = true for a law that may fall";

/// `origin`: are coordinates those of the joint, or counted from where it stands at the start?
SpringDraft placed(SpringDraft spring, const SpringReader& reader) {
  const Item& item = reader.item;
  const Node* origin = item.node->find("origin");
  if (!origin) return spring;
  const bool from_start = origin->kind == Node::Kind::text && origin->text == "start";
  if (!from_start && !(origin->kind == Node::Kind::text && origin->text == "joint"))
    reader.reading.problems.add(origin->place, item.key + ".origin",
                                "got " + described(*origin) + ", need \"joint\" or \"start\"");
  std::visit([from_start](auto& law) { law.from_start = from_start; }, spring);
  return spring;
}

SpringDraft read_linear(const SpringReader& reader) {
  const TableReader t = reader.table({"stiffness", "free", "falling"});
  const bool falling = t.truth("falling", false);
  return LinearDraft{.stiffness = reader.stiffness(t, "stiffness", falling),
                     .free = reader.free(t),
                     .falling = falling};
}

SpringDraft read_one_sided(const SpringReader& reader) {
  const TableReader t = reader.table({"stiffness", "from", "side"});
  OneSidedDraft spring{.stiffness = reader.stiffness(t, "stiffness"),
                       .from = reader.coordinate(t, "from")};
  if (reader.below(t)) spring.side = model::OneSidedSpring::Side::below;
  return spring;
}

SpringDraft read_piecewise_linear(const SpringReader& reader) {
  const TableReader t = reader.table({"breakpoints", "stiffnesses", "free", "preload", "falling"});
  const JointUnits& units = reader.units;
  PiecewiseLinearDraft spring{.falling = t.truth("falling", false)};
  t.require("breakpoints", "a list of increasing numbers [" + units.coordinate + "]");
  t.require("stiffnesses",
            "a list of numbers >= 0 [" + units.stiffness + "], one more than breakpoints");
  spring.breakpoints =
      read_numbers(t.list("breakpoints", "a list of increasing numbers"),
                   {Range::finite, units.coordinate}, reader.numbers, reader.reading);
  const Rule rising{Range::non_negative, units.stiffness, falling_hint};
  spring.stiffnesses = read_numbers(t.list("stiffnesses", "a list of numbers >= 0"),
                                    spring.falling ? Rule{Range::finite, units.stiffness} : rising,
                                    reader.numbers, reader.reading);
  for (std::size_t i = 1; i < spring.breakpoints.size(); ++i)
    reader.numbers.require_less(spring.breakpoints[i - 1], spring.breakpoints[i],
                                "breakpoints increase");
  const Node* stiffnesses = t.find("stiffnesses");
  const std::size_t got = spring.stiffnesses.size(), need = spring.breakpoints.size() + 1;
  if (stiffnesses && t.has("breakpoints") && got != need)
    reader.report(t, "stiffnesses",
                  "got " + described(*stiffnesses) + ", need " + std::to_string(need) +
                      ": one for every segment, one more than breakpoints");
  spring.free = reader.free(t);
  spring.preload = t.number("preload", {Range::finite, units.torque}, reader.numbers, 0);
  return spring;
}

SpringDraft read_gap(const SpringReader& reader) {
  const TableReader t = reader.table({"stiffness", "low", "high"});
  const GapDraft spring{reader.stiffness(t, "stiffness"), reader.coordinate(t, "low"),
                        reader.coordinate(t, "high")};
  if (t.has("low") && t.has("high"))
    reader.numbers.require_less(spring.low, spring.high, "low < high");
  return spring;
}

SpringDraft read_stops(const SpringReader& reader) {
  const TableReader t = reader.table({"stiffness", "free", "stop_stiffness", "low", "high"});
  const StopsDraft spring{reader.stiffness(t, "stiffness"), reader.free(t),
                          reader.stiffness(t, "stop_stiffness"), reader.coordinate(t, "low"),
                          reader.coordinate(t, "high")};
  if (t.has("low") && t.has("high"))
    reader.numbers.require_less(spring.low, spring.high, "low < high");
  return spring;
}

struct Law {
  const char* word;
  SpringDraft (*read)(const SpringReader&);
};
constexpr Law laws[] = {{"linear", read_linear},
                        {"one_sided", read_one_sided},
                        {"piecewise_linear", read_piecewise_linear},
                        {"gap", read_gap},
                        {"stops", read_stops},
                        {"polynomial", read_polynomial},
                        {"table", read_table_law},
                        {"formula", read_formula_law},
                        {"logarithmic", read_logarithmic},
                        {"power", read_power}};

}  // namespace

TableReader SpringReader::table(std::vector<std::string> keys) const {
  keys.insert(keys.begin(), "law");
  keys.insert(keys.end(), "origin");
  return {*item.node, item.key, keys, reading};
}

NumberId SpringReader::stiffness(const TableReader& t, const std::string& name,
                                 bool falling) const {
  Rule rule{falling ? Range::finite : Range::non_negative, units.stiffness};
  const Node* law = item.node->find("law");
  if (!falling && law && law->text == "linear") rule.hint = falling_hint;
  return t.required_number(name, rule, numbers);
}

NumberId SpringReader::coordinate(const TableReader& t, const std::string& name) const {
  return t.required_number(name, {Range::finite, units.coordinate}, numbers);
}

NumberId SpringReader::free(const TableReader& t) const {
  return t.number("free", {Range::finite, units.coordinate}, numbers, 0);
}

bool SpringReader::below(const TableReader& t) const {
  return t.choice("side", {"above", "below"}, 0) == 1;
}

void SpringReader::report(const TableReader& t, const std::string& name,
                          const std::string& what) const {
  const Node* node = t.find(name);
  reading.problems.add(node ? node->place : t.place(), t.key_of(name), what);
}

JointUnits units_of(model::JointKind kind, const UnitLabels& labels) {
  if (kind == model::JointKind::prismatic)
    return {labels.length, labels.force, labels.force + "/" + labels.length};
  const std::string torque = labels.force + "*" + labels.length;
  return {"rad", torque, torque + "/rad"};
}

std::optional<SpringDraft> read_spring(const Item& item, model::JointKind kind,
                                       NumberTable& numbers, Reading& reading) {
  return read_spring(item, units_of(kind, reading.units), numbers, reading);
}

std::optional<SpringDraft> read_spring(const Item& item, const JointUnits& units,
                                       NumberTable& numbers, Reading& reading) {
  std::vector<std::string> words;
  for (const Law& law : laws) words.emplace_back(law.word);
  const std::string need = "a table such as { law = \"linear\", stiffness = ... }";
  if (!is_table(item, need, reading)) return std::nullopt;
  const Node* word = item.node->find("law");
  if (!word) {
    reading.problems.add(item.node->place, item.key + ".law", "missing, need " + choices(words));
    return std::nullopt;
  }
  const SpringReader reader{item, units, numbers, reading};
  for (const Law& law : laws)
    if (word->kind == Node::Kind::text && word->text == law.word)
      return placed(law.read(reader), reader);
  std::string near = nearest(word->text, words);
  if (!near.empty()) near = ", did you mean \"" + near + "\"?";
  reading.problems.add(word->place, item.key + ".law",
                       "got " + described(*word) + ", need " + choices(words) + near);
  return std::nullopt;
}

std::vector<SpringDraft> read_series_laws(const Item& list, const JointUnits& units,
                                          NumberTable& numbers, Reading& reading) {
  constexpr std::size_t most = 100;
  const std::string need = "a list of at least two springs { law = ... }, at most 100";
  const std::vector<Item> items = list_items(list, need, reading);
  std::vector<SpringDraft> springs;
  if (list.node->kind != Node::Kind::array) return springs;
  if (items.size() < 2 || items.size() > most) {
    reading.problems.add(list.node->place, list.key,
                         "got " + described(*list.node) + ", need " + need);
    return springs;
  }
  for (const Item& item : items)
    if (auto spring = read_spring(item, units, numbers, reading))
      springs.push_back(std::move(*spring));
  return springs;
}

void refuse_origin(const Item& law, const SpringDraft& spring, const std::string& what,
                   Reading& reading) {
  if (std::visit([](const auto& s) { return s.from_start; }, spring))
    reading.problems.add(law.node->place, law.key + ".origin",
                         what + ": need \"joint\" or no origin");
}

void refuse_origins(const TableReader& table, const std::optional<SeriesDraft>& series,
                    const std::string& what, Reading& reading) {
  const Node* list = table.find("series");
  if (!series || series->laws.size() != list->items.size()) return;
  for (std::size_t i = 0; i < series->laws.size(); ++i)
    refuse_origin({&list->items[i], table.key_of("series") + "[" + std::to_string(i + 1) + "]"},
                  series->laws[i], what, reading);
}

std::optional<SeriesDraft> read_series(const TableReader& table, const JointUnits& units,
                                       NumberTable& numbers, Reading& reading) {
  const Item list{table.find("series"), table.key_of("series")};
  SeriesDraft series{.laws = read_series_laws(list, units, numbers, reading)};
  const std::size_t n = list.node->items.size();
  const Node* initial = table.find("initial");
  if (initial == nullptr || n < 2)
    return series.laws.empty() ? std::nullopt : std::optional{series};
  const Rule rule{Range::finite, units.coordinate};
  if (initial->kind != Node::Kind::array) {
    series.initial = {table.number("initial", rule, numbers, 0)};
  } else {
    series.initial =
        read_numbers(table.list("initial", "a list of numbers"), rule, numbers, reading);
    if (series.initial.size() != n - 1)
      reading.problems.add(initial->place, table.key_of("initial"),
                           "got " + described(*initial) + ", need " + std::to_string(n - 1) + " [" +
                               units.coordinate +
                               "]: guesses of all coordinates but the last, which takes the rest");
  }
  return series.laws.empty() ? std::nullopt : std::optional{series};
}

}  // namespace springfold::io
