#include "plot_look_reader.hpp"

#include <algorithm>
#include <tuple>

#include "text.hpp"

namespace springfold::io {
namespace {

/// [low, high]; reports anything else. Empty if the key is missing or wrong.
std::vector<NumberId> read_pair(const TableReader& table, const std::string& name,
                                const std::string& need, const Rule& rule, NumberTable& numbers,
                                Reading& reading) {
  const Node* node = table.find(name);
  if (!node) return {};
  const std::vector<Item> items = table.list(name, need);
  if (items.size() == 2) return read_numbers(items, rule, numbers, reading);
  if (node->kind == Node::Kind::array)
    reading.problems.add(node->place, table.key_of(name),
                         "got " + described(*node) + ", need " + need);
  return {};
}

/// @param rule  of a logarithmic axis: positive
std::vector<NumberId> read_range(const TableReader& table, const std::string& name,
                                 const Rule& rule, NumberTable& numbers, Reading& reading) {
  auto range = read_pair(table, name, "[low, high]", rule, numbers, reading);
  if (!range.empty()) numbers.require_less(range[0], range[1], "low < high");
  return range;
}

// Beyond these bounds gnuplot draws nothing that can be read, or takes all memory there is.
constexpr double smallest_side = 200, largest_side = 10000;  // [pixel]
constexpr double smallest_font = 4, largest_font = 100;      // [pt]

void require_between(const TableReader& table, const std::string& name,
                     const std::vector<NumberId>& ids, double low, double high,
                     const std::string& unit, NumberTable& numbers) {
  numbers.require(ids, table.find(name)->place, table.key_of(name),
                  [=](const std::vector<double>& values) -> std::string {
                    for (const double value : values)
                      if (value < low || value > high)
                        return "got " + shortest(value) + ", need " + shortest(low) + " to " +
                               shortest(high) + " [" + unit + "]";
                    return {};
                  });
}

/// Names of fonts stand unquoted in SVG files.
void check_font(const TableReader& table, const std::string& font, Reading& reading) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ||
           c == '-';
  };
  if (!font.empty() && std::all_of(font.begin(), font.end(), fits)) return;
  reading.problems.add(
      table.find("font")->place, table.key_of("font"),
      "got \"" + font + "\", need the name of a font: letters, digits, blanks, '-'");
}

/// The keys that all figures have.
template <typename Look, typename Draft>
void read_size_and_font(const TableReader& table, Look& look, Draft& draft, NumberTable& numbers,
                        Reading& reading) {
  draft.size = read_pair(table, "size", "[width, height] in pixels", {}, numbers, reading);
  draft.font_size = table.number("font_size", {}, numbers, look.font_size);
  if (!draft.size.empty())
    require_between(table, "size", draft.size, smallest_side, largest_side, "pixels", numbers);
  if (table.has("font_size"))
    require_between(table, "font_size", {draft.font_size}, smallest_font, largest_font, "points",
                    numbers);
  look.font = table.text("font").value_or(look.font);
  if (table.has("font")) check_font(table, look.font, reading);
  look.formats = read_formats(table, {"png", "svg", "pdf", "tikz"}, look.formats, reading);
}

void read_insets(const TableReader& table, PlotLook& look, PlotLookDraft& draft,
                 NumberTable& numbers, Reading& reading) {
  static const std::vector<std::string> corners{"top right", "top left", "bottom right",
                                                "bottom left"};
  const Rule x_rule{.range = look.x_log ? Range::positive : Range::finite};
  const Rule y_rule{.range = look.y_log ? Range::positive : Range::finite};
  for (const Item& item :
       table.tables("insets", "insets = [{ x_range = [0, 1], y_range = [0, 1] }]")) {
    const TableReader inset{*item.node, item.key, {"x_range", "y_range", "corner"}, reading};
    inset.require("x_range", "[low, high]");
    inset.require("y_range", "[low, high]");
    draft.insets.push_back({read_range(inset, "x_range", x_rule, numbers, reading),
                            read_range(inset, "y_range", y_rule, numbers, reading)});
    look.insets.push_back({.corner = corners[inset.choice("corner", corners, 0)]});
  }
}

}  // namespace

const std::vector<std::string>& look_keys() {
  static const std::vector<std::string> keys{"x_range",   "y_range", "x_log", "y_log",
                                             "equal",     "smooth",  "size",  "font",
                                             "font_size", "formats", "insets"};
  return keys;
}

std::vector<std::string> read_formats(const TableReader& table,
                                      const std::vector<std::string>& known,
                                      std::vector<std::string> otherwise, Reading& reading) {
  const Node* node = table.find("formats");
  if (!node) return otherwise;
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  const std::vector<Item> items = table.list("formats", "a list of " + list);
  std::vector<std::string> formats;
  for (const Item& item : items) {
    const bool fits = item.node->kind == Node::Kind::text &&
                      std::find(known.begin(), known.end(), item.node->text) != known.end();
    if (!fits)
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) + ", need one of " + list);
    else if (std::find(formats.begin(), formats.end(), item.node->text) == formats.end())
      formats.push_back(item.node->text);
  }
  if (items.empty() && node->kind == Node::Kind::array)
    reading.problems.add(node->place, table.key_of("formats"),
                         "got an empty list, need at least one of " + list);
  return formats;
}

PlotLookDraft read_look(const TableReader& table, PlotLook& look, NumberTable& numbers,
                        Reading& reading) {
  PlotLookDraft draft;
  look.x_log = table.flag("x_log", look.x_log);
  look.y_log = table.flag("y_log", look.y_log);
  look.equal = table.flag("equal", look.equal);
  look.smooth = table.flag("smooth", look.smooth);
  if (look.equal && (look.x_log || look.y_log))
    reading.problems.add(table.find("equal")->place, table.key_of("equal"),
                         "got true, need false: scales of a logarithmic axis cannot be equal");
  const Rule x_rule{.range = look.x_log ? Range::positive : Range::finite};
  const Rule y_rule{.range = look.y_log ? Range::positive : Range::finite};
  draft.x_range = read_range(table, "x_range", x_rule, numbers, reading);
  draft.y_range = read_range(table, "y_range", y_rule, numbers, reading);
  read_size_and_font(table, look, draft, numbers, reading);
  read_insets(table, look, draft, numbers, reading);
  return draft;
}

void set_numbers(const PlotLookDraft& draft, const std::vector<double>& values, PlotLook& look) {
  const auto pair = [&values](const std::vector<NumberId>& ids) {
    return PlotRange{values[ids[0]], values[ids[1]]};
  };
  if (!draft.x_range.empty()) look.x_range = pair(draft.x_range);
  if (!draft.y_range.empty()) look.y_range = pair(draft.y_range);
  if (!draft.size.empty()) std::tie(look.width, look.height) = pair(draft.size);
  look.font_size = values[draft.font_size];
  for (std::size_t i = 0; i < draft.insets.size(); ++i)
    if (!draft.insets[i].x.empty() && !draft.insets[i].y.empty()) {
      look.insets[i].x = pair(draft.insets[i].x);
      look.insets[i].y = pair(draft.insets[i].y);
    }
}

std::vector<std::string> with_sheet_keys(std::vector<std::string> others) {
  for (const char* key : {"size", "font", "font_size", "formats"}) others.emplace_back(key);
  return others;
}

SheetLookDraft read_sheet_look(const TableReader& table, SheetLook& look, NumberTable& numbers,
                               Reading& reading) {
  SheetLookDraft draft;
  read_size_and_font(table, look, draft, numbers, reading);
  return draft;
}

void set_numbers(const SheetLookDraft& draft, const std::vector<double>& values, SheetLook& look) {
  if (!draft.size.empty()) look.width = values[draft.size[0]], look.height = values[draft.size[1]];
  look.font_size = values[draft.font_size];
}

}  // namespace springfold::io
