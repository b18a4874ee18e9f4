#include <algorithm>

#include "study_reader.hpp"

namespace springfold::io {
namespace {

std::vector<std::string> read_labels(const TableReader& vary, std::size_t values,
                                     Reading& reading) {
  std::vector<std::string> labels = read_texts(vary.list("labels", "a list of texts"), reading);
  const Node* node = vary.find("labels");
  if (node && node->kind == Node::Kind::array && labels.size() != values)
    reading.problems.add(
        node->place, vary.key_of("labels"),
        "got " + described(*node) + ", need " + std::to_string(values) + ": one for every value");
  return labels;
}

}  // namespace

std::optional<std::size_t> parameter_number(const std::string& name, const Place& place,
                                            const std::string& key, const FormulaBook& book,
                                            Problems& problems) {
  const std::vector<std::string>& known = book.variables();
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  std::string hint = suggestion(name, known);
  if (hint.empty()) hint = "; the case has no [parameters]";
  problems.add(place, key, "no parameter \"" + name + "\"" + hint);
  return std::nullopt;
}

Redefinitions read_set(const TableReader& study, Reading& reading) {
  Redefinitions changes;
  const Node* node = study.find("set");
  const Item set{node, study.key_of("set")};
  if (!node || !is_table(set, "a table such as { Kv = 0.1 }", reading)) return changes;
  for (const NodeEntry& entry : node->entries) {
    const std::string key = set.key + "." + entry.key;
    const auto number =
        parameter_number(entry.key, entry.place, key, reading.book, reading.problems);
    const Definition definition =
        read_definition(entry.value, key, "a number", reading.book, reading.problems);
    if (number) changes[*number] = definition;
  }
  return changes;
}

std::optional<VaryDraft> read_vary(const TableReader& study, const Redefinitions& set,
                                   Reading& reading) {
  const std::string values_need = "a list of numbers, one for every run";
  const Node* node = study.find("vary");
  const Item item{node, study.key_of("vary")};
  if (!node ||
      !is_table(item, "a table such as { parameter = \"Kv\", values = [0, 0.1] }", reading))
    return std::nullopt;
  const TableReader vary{*node, item.key, {"parameter", "values", "labels"}, reading};
  VaryDraft draft;
  const auto name = vary.required_text("parameter", "the name of a parameter");
  const Node* values = vary.require("values", values_need);
  for (const Item& value : vary.list("values", values_need))
    draft.values.push_back(
        read_definition(*value.node, value.key, "a number", reading.book, reading.problems));
  if (values && values->kind == Node::Kind::array && draft.values.empty())
    reading.problems.add(values->place, vary.key_of("values"),
                         "got an empty list, need " + values_need);
  constexpr std::size_t most_runs = 10000;
  if (draft.values.size() > most_runs)
    reading.problems.add(
        values->place, vary.key_of("values"),
        "got " + described(*values) + ", need at most " + std::to_string(most_runs) + " values");
  draft.labels = read_labels(vary, draft.values.size(), reading);
  if (!name) return std::nullopt;
  const Place place = vary.find("parameter")->place;
  const std::string key = vary.key_of("parameter");
  const auto number = parameter_number(*name, place, key, reading.book, reading.problems);
  if (!number || draft.values.empty()) return std::nullopt;
  draft.parameter = *number;
  if (set.contains(*number))
    reading.problems.add(place, key, "\"" + *name + "\" is in set too, need one of them");
  return draft;
}

}  // namespace springfold::io
