#include "json_reader.hpp"

#include <nlohmann/json.hpp>

namespace springfold::io {
namespace {

constexpr std::size_t deepest_json = 32;

/// How far the parser has read, and where the value begins that it reads. It reads one character
/// beyond a number, so that places are taken where values begin.
class Cursor {
 public:
  void take(char c) {
    if (c == '\n') {
      ++line_;
      column_ = 0;
      return;
    }
    const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // within a character
    if (!continues) ++column_;
    const bool is_between = c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ':';
    if (!waits_ || is_between) return;
    waits_ = false;
    begin_line_ = line_;
    begin_column_ = column_;
  }

  /// Where the value that has just been read begins; the next one begins behind it.
  Place begin(const std::string& file) {
    waits_ = true;
    return {file, begin_line_, begin_column_};
  }
  Place here(const std::string& file) const { return {file, line_, std::max(column_, 1)}; }

 private:
  int line_ = 1, column_ = 0, begin_line_ = 1, begin_column_ = 1;
  bool waits_ = true;
};

/// Characters that tell the cursor when they are passed.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Cursor& cursor) : at_{at}, cursor_{&cursor} {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    cursor_->take(*at_++);
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) {
    return a.at_ == b.at_;
  }
  friend bool operator!=(const CountingIterator& a, const CountingIterator& b) { return !(a == b); }

 private:
  const char* at_;
  Cursor* cursor_;
};

/// Puts the values together as the parser tells of them.
class JsonNodes {
 public:
  JsonNodes(Cursor& cursor, const std::string& file, Problems& problems)
      : cursor_{cursor}, file_{file}, problems_{problems} {}

  Node root{};

  // The names are those that nlohmann::json_sax asks for.
  bool null() { return add(Node::Kind::text, 0, "null"); }
  bool boolean(bool value) { return add(Node::Kind::boolean, value ? 1.0 : 0.0); }
  bool number_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) { return number(value); }
  bool string(const std::string& value) { return add(Node::Kind::text, 0, value); }
  bool binary(const std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return open(Node::Kind::table); }
  bool start_array(std::size_t) { return open(Node::Kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(const std::string& name) {
    const Place place = cursor_.begin(file_);
    for (const NodeEntry& other : open_.back().entries)
      if (other.key == name) return refuse(place, name, "stands twice, need it once");
    open_.back().entries.push_back({name, place, {}});
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const std::exception& error) {
    std::string what = error.what();
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    if (const auto start = what.find("] "); start != std::string::npos) what.erase(0, start + 2);
    if (const auto start = what.find(": "); start != std::string::npos) what.erase(0, start + 2);
    return refuse(cursor_.here(file_), "", "no JSON: " + what);
  }

 private:
  bool refuse(const Place& place, const std::string& key, const std::string& what) {
    problems_.add(place, key, what);
    return false;
  }

  bool number(double value) { return add(Node::Kind::number, value); }

  bool add(Node::Kind kind, double number, std::string text = {}) {
    return put(plain_node(kind, cursor_.begin(file_), number, std::move(text)));
  }

  bool put(Node node) {
    if (open_.empty())
      root = std::move(node);
    else if (open_.back().kind == Node::Kind::array)
      open_.back().items.push_back(std::move(node));
    else
      open_.back().entries.back().value = std::move(node);
    return true;
  }

  bool open(Node::Kind kind) {
    const Place place = cursor_.begin(file_);
    if (open_.size() == deepest_json)
      return refuse(place, "",
                    "nested more than " + std::to_string(deepest_json) + " deep, need less");
    open_.push_back(plain_node(kind, place));
    return true;
  }

  bool close() {
    cursor_.begin(file_);
    Node node = std::move(open_.back());
    open_.pop_back();
    return put(std::move(node));
  }

  Cursor& cursor_;
  const std::string& file_;
  Problems& problems_;
  std::vector<Node> open_{};  ///< outermost first
};

}  // namespace

std::optional<Node> read_json(std::string_view bytes, const std::string& file, Problems& problems) {
  Cursor cursor;
  JsonNodes nodes{cursor, file, problems};
  const char* const first = bytes.data();
  const bool good = nlohmann::json::sax_parse(
      CountingIterator{first, cursor}, CountingIterator{first + bytes.size(), cursor}, &nodes);
  if (!good) return std::nullopt;
  return std::move(nodes.root);
}

}  // namespace springfold::io
