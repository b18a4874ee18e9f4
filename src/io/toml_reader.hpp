// TOML text as plain data with source positions. Keeps toml++ out of everything else.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "problems.hpp"

namespace springfold::io {

struct NodeEntry;
struct Bindings;     // bindings.hpp
struct WrittenPart;  // bindings.hpp

/// A value of a TOML file.
struct Node {
  enum class Kind { boolean, number, text, date, array, table };
  Kind kind = Kind::table;
  Place place{};
  double number = 0;               ///< number (integers too), boolean as 0 or 1
  std::string text{};              ///< text
  std::vector<Node> items;         ///< array
  std::vector<NodeEntry> entries;  ///< table, in the order of the file
  /// Names that formulas here may use beside parameters: indices of repetitions, parameters of
  /// templates. Null: none.
  std::shared_ptr<const Bindings> bindings{};
  /// Of a formula that was made of others: these. Null: it stands in the file.
  std::shared_ptr<const std::vector<WrittenPart>> parts{};
  /// Of an element of a list in which some are repeated: its number in the file and the indices,
  /// "2, i = 3". Otherwise empty.
  std::string number_text{};

  /// The value under `key`, nullptr if the table has none. @pre kind is table
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
};

struct NodeEntry {
  std::string key{};
  Place place{};  ///< of the key
  Node value{};
};

/// A value without items and entries.
inline Node plain_node(Node::Kind kind, Place place, double number = 0, std::string text = {}) {
  Node node;
  node.kind = kind;
  node.place = std::move(place);
  node.number = number;
  node.text = std::move(text);
  return node;
}

/// What stands there, for messages: `"abc"`, `2.5`, `an array of 3`, `a table`.
std::string described(const Node& node);

/// Reads TOML 1.0. A syntax error becomes one problem with its position; then there is no result.
/// Values nested more than 32 deep and keys of more than 16 parts are refused.
std::optional<Node> read_toml(std::string_view bytes, const std::string& file, Problems& problems);

}  // namespace springfold::io
