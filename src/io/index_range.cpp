#include "index_range.hpp"

#include <algorithm>
#include <cmath>

#include "formula.hpp"
#include "pattern.hpp"

namespace springfold::io {
namespace {

const std::string repeat_need = "a table such as { i = [0, 5] }: the first and the last index";

class RangeReader {
 public:
  RangeReader(const std::set<std::string>& parameters, const Bindings* outer, Problems& problems)
      : parameters_{parameters}, outer_{outer}, problems_{problems} {}

  std::optional<std::vector<IndexRange>> ranges_of(const Node& item, const std::string& key) {
    const Node* repeat = item.kind == Node::Kind::table ? item.find("repeat") : nullptr;
    const Node* pattern = item.kind == Node::Kind::table ? item.find("pattern") : nullptr;
    if (pattern) return range_of_pattern(*pattern, repeat, key);
    std::vector<IndexRange> ranges;
    if (!repeat) return ranges;
    if (repeat->kind != Node::Kind::table || repeat->entries.empty()) {
      problems_.add(repeat->place, key + ".repeat",
                    "got " + described(*repeat) + ", need " + repeat_need);
      return std::nullopt;
    }
    for (const NodeEntry& entry : repeat->entries) {
      const auto range = range_of(entry, key + ".repeat." + entry.key);
      if (!range) return std::nullopt;
      ranges.push_back(*range);
    }
    return ranges;
  }

 private:
  std::optional<std::vector<IndexRange>> range_of_pattern(const Node& pattern, const Node* repeat,
                                                          const std::string& key) {
    const std::string own = key + ".pattern";
    const auto refuse = [&](const Place& place, const std::string& what) {
      problems_.add(place, own, what);
      return std::nullopt;
    };
    if (key.find(".elements[") != std::string::npos)
      return refuse(pattern.place, "elements of chains cannot be turned, need repeat");
    if (repeat) return refuse(pattern.place, "stands instead of repeat, need one of them");
    std::vector<std::string> indices;
    for (const NodeEntry& entry : pattern.entries)
      if (!is_pattern_key(entry.key)) indices.push_back(entry.key);
    if (pattern.kind != Node::Kind::table || indices.size() != 1) {
      std::string got = pattern.kind != Node::Kind::table ? described(pattern) : "no index";
      if (indices.size() > 1) got = "the indices " + indices[0] + " and " + indices[1];
      return refuse(pattern.place,
                    "got " + got +
                        ", need a table with one index such as { i = [0, 5], "
                        "angle = \"60*deg\" }, and no other keys but axis and about");
    }
    for (const NodeEntry& entry : pattern.entries) {
      if (is_pattern_key(entry.key)) continue;
      if (const auto range = range_of(entry, own + "." + entry.key))
        return std::vector<IndexRange>{*range};
    }
    return std::nullopt;
  }

  std::optional<IndexRange> range_of(const NodeEntry& entry, const std::string& key) {
    const auto refuse = [&](const Place& place, const std::string& what) {
      problems_.add(place, key, what);
      return std::nullopt;
    };
    if (!is_identifier(entry.key) || is_formula_word(entry.key))
      return refuse(entry.place,
                    "need a name of letters, digits and '_' that formulas do not keep for "
                    "themselves");
    if (parameters_.contains(entry.key) || (outer_ && outer_->find(entry.key)))
      return refuse(entry.place, "is the name of a parameter or of an index already, need another");
    const Node& value = entry.value;
    const bool fits =
        value.kind == Node::Kind::array && (value.items.size() == 2 || value.items.size() == 3) &&
        std::all_of(value.items.begin(), value.items.end(), [](const Node& end) {
          return end.kind == Node::Kind::number && std::floor(end.number) == end.number &&
                 std::abs(end.number) <= largest_index;
        });
    if (!fits)
      return refuse(value.place, "got " + described(value) +
                                     ", need [first, last] or [first, last, step], whole numbers "
                                     "from -1000000 to 1000000");
    IndexRange range{.name = entry.key,
                     .first = static_cast<long>(value.items[0].number),
                     .last = static_cast<long>(value.items[1].number)};
    if (value.items.size() == 3) range.step = static_cast<long>(value.items[2].number);
    if (range.step < 1) return refuse(value.place, "need a step of at least 1");
    if (range.last < range.first)
      return refuse(value.place, "got [" + std::to_string(range.first) + ", " +
                                     std::to_string(range.last) + "], need first <= last");
    return range;
  }

  const std::set<std::string>& parameters_;
  const Bindings* outer_;
  Problems& problems_;
};

}  // namespace

std::optional<std::vector<IndexRange>> ranges_of(const Node& item, const std::string& key,
                                                 const std::set<std::string>& parameters,
                                                 const Bindings* outer, Problems& problems) {
  return RangeReader(parameters, outer, problems).ranges_of(item, key);
}

std::string index_of(const Node& pattern) {
  for (const NodeEntry& entry : pattern.entries)
    if (!is_pattern_key(entry.key)) return entry.key;
  return {};
}

}  // namespace springfold::io
