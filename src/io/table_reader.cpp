#include "table_reader.hpp"

#include <algorithm>

namespace springfold::io {
namespace {

void flatten(const Node& table, const std::string& prefix, const std::string& key,
             std::vector<NamedItem>& out) {
  for (const NodeEntry& entry : table.entries) {
    const std::string name = prefix + entry.key, entry_key = key + "." + entry.key;
    if (entry.value.kind == Node::Kind::table)
      flatten(entry.value, name + ".", entry_key, out);
    else
      out.push_back({{name, entry.place, entry_key}, &entry.value});
  }
}

}  // namespace

TableReader::TableReader(const Node& node, std::string key, const std::vector<std::string>& known,
                         Reading& reading)
    : node_{&node}, key_{std::move(key)}, reading_{&reading} {
  constexpr std::size_t most_suggestions = 100;
  std::size_t unknown = 0;
  for (const NodeEntry& entry : node.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const bool is_one_of_many = ++unknown > most_suggestions;
    reading.problems.add(entry.place, key_of(entry.key),
                         "unknown key" + (is_one_of_many ? "" : suggestion(entry.key, known)));
    if (!is_one_of_many) misspelt_.push_back(nearest(entry.key, known));
  }
}

bool TableReader::is_misspelt(const std::string& name) const {
  return !has(name) && std::find(misspelt_.begin(), misspelt_.end(), name) != misspelt_.end();
}

std::string TableReader::key_of(const std::string& name) const {
  return key_.empty() ? name : key_ + "." + name;
}

const Node* TableReader::require(const std::string& name, const std::string& need) const {
  const Node* found = find(name);
  if (!found && !is_misspelt(name))
    reading_->problems.add(place(), key_of(name), "missing, need " + need);
  return found;
}

std::optional<std::string> TableReader::text(const std::string& name) const {
  const Node* found = find(name);
  if (!found) return std::nullopt;
  if (found->kind == Node::Kind::text) return found->text;
  reading_->problems.add(found->place, key_of(name), "got " + described(*found) + ", need a text");
  return std::nullopt;
}

std::optional<std::string> TableReader::required_text(const std::string& name,
                                                      const std::string& need) const {
  const Node* found = require(name, need);
  if (!found) return std::nullopt;
  if (found->kind == Node::Kind::text && !found->text.empty()) return found->text;
  reading_->problems.add(found->place, key_of(name), "got " + described(*found) + ", need " + need);
  return std::nullopt;
}

bool TableReader::truth(const std::string& name, bool otherwise) const {
  const Node* found = find(name);
  if (!found) return otherwise;
  if (found->kind == Node::Kind::boolean) return found->number != 0;
  reading_->problems.add(found->place, key_of(name),
                         "got " + described(*found) + ", need true or false");
  return otherwise;
}

std::size_t TableReader::choice(const std::string& name, const std::vector<std::string>& words,
                                std::size_t otherwise,
                                const std::map<std::string, std::string>& others) const {
  const Node* found = find(name);
  if (!found) return otherwise;
  const auto word = std::find(words.begin(), words.end(), found->text);
  if (found->kind == Node::Kind::text && word != words.end())
    return static_cast<std::size_t>(word - words.begin());
  const auto other = others.find(found->text);
  std::string near = other == others.end() ? nearest(found->text, words) : other->second;
  if (!near.empty()) near = ", did you mean \"" + near + "\"?";
  reading_->problems.add(found->place, key_of(name),
                         "got " + described(*found) + ", need " + choices(words) + near);
  return otherwise;
}

bool TableReader::flag(const std::string& name, bool otherwise) const {
  const Node* node = find(name);
  if (node == nullptr) return otherwise;
  if (node->kind == Node::Kind::boolean) return node->number != 0;
  reading_->problems.add(node->place, key_of(name),
                         "got " + described(*node) + ", need true or false");
  return otherwise;
}

NumberId TableReader::number(const std::string& name, const Rule& rule, NumberTable& numbers,
                             double otherwise) const {
  const Node* found = find(name);
  return found ? read_number({found, key_of(name)}, rule, numbers, *reading_)
               : numbers.add(otherwise);
}

NumberId TableReader::required_number(const std::string& name, const Rule& rule,
                                      NumberTable& numbers) const {
  const Node* found = require(name, need_of(rule));
  return found ? read_number({found, key_of(name)}, rule, numbers, *reading_) : numbers.add(0);
}

std::vector<Item> TableReader::list(const std::string& name, const std::string& need) const {
  const Node* found = find(name);
  return found ? list_items({found, key_of(name)}, need, *reading_) : std::vector<Item>{};
}

std::vector<Item> TableReader::tables(const std::string& name, const std::string& example) const {
  const Node* found = find(name);
  return found ? list_of_tables({found, key_of(name)}, *reading_, example) : std::vector<Item>{};
}

std::vector<NumberId> read_numbers(const std::vector<Item>& items, const Rule& rule,
                                   NumberTable& numbers, Reading& reading) {
  std::vector<NumberId> ids;
  for (const Item& item : items) ids.push_back(read_number(item, rule, numbers, reading));
  return ids;
}

NumberId read_number(const Item& item, const Rule& rule, NumberTable& numbers, Reading& reading) {
  return numbers.add(
      read_definition(*item.node, item.key, need_of(rule), reading.book, reading.problems), rule);
}

std::vector<std::string> read_texts(const std::vector<Item>& items, Reading& reading) {
  std::vector<std::string> texts;
  for (const Item& item : items) {
    texts.push_back(item.node->text);
    if (item.node->kind != Node::Kind::text)
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) + ", need a text");
  }
  return texts;
}

std::vector<Item> list_items(const Item& item, const std::string& need, Reading& reading) {
  if (item.node->kind != Node::Kind::array) {
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) + ", need " + need);
    return {};
  }
  std::vector<Item> items;
  for (std::size_t i = 0; i < item.node->items.size(); ++i) {
    const Node& node = item.node->items[i];
    const std::string number = node.number_text.empty() ? std::to_string(i + 1) : node.number_text;
    items.push_back({&node, item.key + "[" + number + "]"});
  }
  return items;
}

std::vector<Item> list_of_tables(const Item& list, Reading& reading, const std::string& example) {
  constexpr std::size_t most_tables = 10000;
  const std::string need = example.empty()
                               ? "a list of tables: [[" + list.key + "]] with two brackets"
                               : "a list of tables such as " + example;
  std::vector<Item> items = list_items(list, need, reading);
  if (items.size() > most_tables) {
    reading.problems.add(items[most_tables].node->place, list.key,
                         "got " + std::to_string(items.size()) + " tables, need at most " +
                             std::to_string(most_tables));
    items.resize(most_tables);
  }
  const std::string one = example.empty() ? "a table" : "a table as in " + example;
  std::erase_if(items, [&](const Item& item) { return !is_table(item, one, reading); });
  return items;
}

bool is_table(const Item& item, const std::string& need, Reading& reading) {
  if (item.node->kind == Node::Kind::table) return true;
  reading.problems.add(item.node->place, item.key,
                       "got " + described(*item.node) + ", need " + need);
  return false;
}

bool is_plain_name(const std::string& name, const Item& at, Reading& reading) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (!name.empty() && std::all_of(name.begin(), name.end(), fits)) return true;
  reading.problems.add(at.node->place, at.key,
                       "got \"" + name +
                           "\", need a name of letters, digits, '_' and '-': it becomes part of "
                           "column names");
  return false;
}

std::vector<NamedItem> named_items(const TableReader& table, const std::string& name,
                                   const std::string& need, Reading& reading) {
  std::vector<NamedItem> items;
  const Node* node = table.find(name);
  if (node && is_table({node, table.key_of(name)}, need, reading))
    flatten(*node, "", table.key_of(name), items);
  return items;
}

}  // namespace springfold::io
