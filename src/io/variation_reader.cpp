#include <algorithm>

#include "study_reader.hpp"

namespace springfold::io {
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

}  // namespace springfold::io
