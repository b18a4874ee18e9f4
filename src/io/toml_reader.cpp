#include "toml_reader.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

#include "text.hpp"

namespace springfold::io {
namespace {

constexpr int deepest_nesting = 32;
constexpr int longest_key = 16;  ///< parts of a dotted key

Place place_of(const toml::source_position& at, const std::string& file) {
  return {file, static_cast<int>(at.line), static_cast<int>(at.column)};
}

/// Walks over the characters of a TOML text that are neither in strings nor in comments.
/// toml++ recurses without a bound in dotted keys, so depth is measured before it reads.
class DepthMeter {
 public:
  explicit DepthMeter(std::string_view bytes) : bytes_{bytes} {}

  /// Line of the first place that is too deep; 0 if there is none.
  int line_too_deep() {
    for (; at_ < bytes_.size(); ++at_) {
      const char c = bytes_[at_];
      if (c == '\n') ++line_;
      if (c == '#')
        skip_comment();
      else if (c == '"' || c == '\'')
        skip_string(c);
      else
        count(c);
      if (brackets_ > deepest_nesting || dots_ >= longest_key) return line_;
    }
    return 0;
  }

 private:
  void count(char c) {
    if (c == '[' || c == '{') ++brackets_;
    if (c == ']' || c == '}') --brackets_;
    if (c == '.') ++dots_;
    if (c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}' || c == '\n')
      dots_ = 0;
  }
  void skip_comment() {
    while (at_ + 1 < bytes_.size() && bytes_[at_ + 1] != '\n') ++at_;
  }
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool long_string = bytes_.substr(at_, 3) == three;
    at_ += long_string ? 3 : 1;
    for (; at_ < bytes_.size(); ++at_) {
      if (quote == '"' && bytes_[at_] == '\\') {
        ++at_;
        continue;
      }
      if (bytes_[at_] == '\n') {
        ++line_;
        if (!long_string) return;  // a syntax error: toml++ will say so
      }
      if (long_string && bytes_.substr(at_, 3) == three) {
        at_ += 2;
        return;
      }
      if (!long_string && bytes_[at_] == quote) return;
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  int line_ = 1, brackets_ = 0, dots_ = 0;
};

Node converted(const toml::node& from, const std::string& file);

std::vector<NodeEntry> entries_of(const toml::table& table, const std::string& file) {
  std::vector<NodeEntry> entries;
  for (const auto& [key, value] : table) {
    Place place = place_of(key.source().begin, file);
    entries.push_back({std::string{key.str()}, place, converted(value, file)});
  }
  // toml++ sorts by name; the file's own order is the one that users expect in output.
  std::stable_sort(entries.begin(), entries.end(), [](const NodeEntry& a, const NodeEntry& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  });
  return entries;
}

Node converted(const toml::node& from, const std::string& file) {
  Node node;
  node.place = place_of(from.source().begin, file);
  if (const auto* table = from.as_table()) {
    node.kind = Node::Kind::table;
    node.entries = entries_of(*table, file);
  } else if (const auto* array = from.as_array()) {
    node.kind = Node::Kind::array;
    for (const toml::node& item : *array) node.items.push_back(converted(item, file));
  } else if (const auto* text = from.as_string()) {
    node.kind = Node::Kind::text;
    node.text = text->get();
  } else if (from.is_number()) {
    node.kind = Node::Kind::number;
    node.number = from.is_integer() ? static_cast<double>(from.as_integer()->get())
                                    : from.as_floating_point()->get();
  } else if (const auto* truth = from.as_boolean()) {
    node.kind = Node::Kind::boolean;
    node.number = truth->get() ? 1 : 0;
  } else {
    node.kind = Node::Kind::date;
  }
  return node;
}

std::string syntax_message(const toml::parse_error& error) {
  std::string what{error.description()};
  for (char& c : what)
    if (c == '\n' || c == '\r') c = ' ';
  const auto says = [&what](const char* words) { return what.find(words) != std::string::npos; };
  if (says("could not determine value type") || says("while parsing boolean"))
    what += "; text and formulas stand in quotes: \"2*L\"";
  else if (says("inline table") && says("\\n"))
    what += "; what stands in { } stays on one line";
  else if (says("parsing string") && says("control characters"))
    what += "; is the closing quote missing?";
  return "not valid TOML: " + what;
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  const auto has_key = [key](const NodeEntry& entry) { return entry.key == key; };
  const auto found = std::find_if(entries.begin(), entries.end(), has_key);
  return found == entries.end() ? nullptr : &found->value;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string described(const Node& node) {
  constexpr std::size_t longest = 80;
  switch (node.kind) {
    case Node::Kind::boolean:
      return node.number != 0 ? "true" : "false";
    case Node::Kind::number:
      return shortest(node.number);
    case Node::Kind::text:
      return "\"" + node.text.substr(0, longest) + (node.text.size() > longest ? "...\"" : "\"");
    case Node::Kind::date:
      return "a date or time";
    case Node::Kind::array:
      return "a list of " + std::to_string(node.items.size());
    case Node::Kind::table:
      return "a table";
  }
  return "something else";
}

std::optional<Node> read_toml(std::string_view bytes, const std::string& file, Problems& problems) {
  if (const int line = DepthMeter{bytes}.line_too_deep(); line > 0) {
    problems.add({file, line, 1}, "",
                 "nested too deep: at most " + std::to_string(deepest_nesting) +
                     " brackets within each other and " + std::to_string(longest_key) +
                     " parts of a dotted key");
    return std::nullopt;
  }
  try {
    return converted(toml::parse(bytes, std::string_view{file}), file);
  } catch (const toml::parse_error& error) {
    problems.add(place_of(error.source().begin, file), "", syntax_message(error));
    return std::nullopt;
  }
}

}  // namespace springfold::io
