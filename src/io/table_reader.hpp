// Typed access to the tables of a case file: every wrong, missing or unknown entry is reported.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "numbers.hpp"
#include "problems.hpp"
#include "springfold/io/case_file.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

/// A file that a case names and that is no TOML.
struct TextFile {
  std::string text{};
  std::string shown_name{};  ///< in messages
};

/// Reads a file whose name is relative to the file of `place`, where it stands. Nothing if it cannot be read,
/// which is reported.
using FileReader = std::function<std::optional<TextFile>(
    const std::string& name, const Place& place, const std::string& key)>;

/// What all readers share while a case is read.
struct Reading {
  Problems& problems;
  FormulaBook& book;
  UnitLabels units{};
  const std::vector<Parameter>* parameters = nullptr;  ///< once they are read
  FileReader files{};
};

/// A node with its key path.
struct Item {
  const Node* node = nullptr;
  std::string key{};
};

/// One table with the keys that it may have.
class TableReader {
 public:
  /// Reports every key that is not in `known`. @pre node is a table
  TableReader(const Node& node, std::string key, const std::vector<std::string>& known,
              Reading& reading);

  const Place& place() const { return node_->place; }
  const std::string& key() const { return key_; }
  std::string key_of(const std::string& name) const;
  bool has(const std::string& name) const { return node_->find(name) != nullptr; }
  const Node* find(const std::string& name) const { return node_->find(name); }

  /// As find(); reports a missing key, unless an unknown one nearby was taken for it.
  /// @param need  "a name"
  const Node* require(const std::string& name, const std::string& need) const;

  /// Is there an unknown key that was probably meant to be this one?
  bool is_misspelt(const std::string& name) const;

  /// Text; nothing if missing or wrong.
  std::optional<std::string> text(const std::string& name) const;
  std::optional<std::string> required_text(const std::string& name, const std::string& need) const;

  /// true or false; `otherwise` if missing or wrong.
  bool truth(const std::string& name, bool otherwise) const;

  /// Position of the word in `words`; `otherwise` if missing or wrong.
  /// @param others  what people call some of them elsewhere, each before the word that is meant
  std::size_t choice(const std::string& name, const std::vector<std::string>& words,
                     std::size_t otherwise,
                     const std::map<std::string, std::string>& others = {}) const;

  /// true or false; `otherwise` if missing or wrong.
  bool flag(const std::string& name, bool otherwise) const;

  /// A number; `otherwise` if missing.
  NumberId number(const std::string& name, const Rule& rule, NumberTable& numbers,
                  double otherwise) const;
  NumberId required_number(const std::string& name, const Rule& rule, NumberTable& numbers) const;

  /// Elements of a list; reports anything else. A missing key is an empty list.
  std::vector<Item> list(const std::string& name, const std::string& need) const;

  /// Tables of a list of tables, `[[name]]` or `name = [{...}]`; reports anything else.
  std::vector<Item> tables(const std::string& name, const std::string& example = "") const;

 private:
  const Node* node_;
  std::string key_;
  std::vector<std::string> misspelt_{};  ///< known keys that unknown ones were taken for
  Reading* reading_;
};

/// The elements as numbers, each with its rule.
std::vector<NumberId> read_numbers(const std::vector<Item>& items, const Rule& rule,
                                   NumberTable& numbers, Reading& reading);
NumberId read_number(const Item& item, const Rule& rule, NumberTable& numbers, Reading& reading);

/// The elements as texts; reports others.
std::vector<std::string> read_texts(const std::vector<Item>& items, Reading& reading);

/// Reports anything that is not a list; then the result is empty.
std::vector<Item> list_items(const Item& item, const std::string& need, Reading& reading);

/// Tables of `[[name]]` or `name = [{...}]`, where `list.key` is the name; reports anything else.
/// @param example  of such a list, for messages; empty: the list of a table of the file itself
std::vector<Item> list_of_tables(const Item& list, Reading& reading,
                                 const std::string& example = "");

/// An entry of a table whose keys are names of the case.
struct NamedItem {
  NamedPlace name{};
  const Node* value = nullptr;
};

/// Entries of the table `name` of `table`; `a.b = 1`, which is a table within a table in TOML, and
/// `"a.b" = 1` mean the same. Reports anything that is not a table. @param need  "a table such as"
std::vector<NamedItem> named_items(const TableReader& table, const std::string& name,
                                   const std::string& need, Reading& reading);

/// Reports anything that is not a table.
bool is_table(const Item& item, const std::string& need, Reading& reading);

/// Letters, digits, '_' and '-': names that become parts of column names. Reports others.
bool is_plain_name(const std::string& name, const Item& at, Reading& reading);

}  // namespace springfold::io
