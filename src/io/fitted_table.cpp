#include "fitted_table.hpp"

#include <algorithm>

#include "springfold/io/shown_text.hpp"

namespace springfold::io {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t column_gap = 2;        // between columns, as aligned() has it
constexpr std::size_t narrowest_words = 24;  // of a column of sentences

std::vector<std::size_t> widths_of(const Rows& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], width_of(shown(row[c])));
  }
  return widths;
}

/// The last cells in lines of this width; the first cells of further lines are empty.
Rows with_broken_words(const Rows& rows, std::size_t column, std::size_t width) {
  Rows broken;
  for (const auto& row : rows) {
    broken.push_back(row);
    if (column >= row.size() || width_of(shown(row[column])) <= width) continue;
    const std::vector<std::string> lines = wrapped(shown(row[column]), width);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (i > 0) broken.emplace_back(column + 1);
      broken.back()[column] = lines[i];
    }
  }
  return broken;
}

/// The first column and those from `begin` to `end`.
Rows some_columns(const Rows& rows, std::size_t begin, std::size_t end) {
  Rows some;
  for (const auto& row : rows) {
    auto& cells = some.emplace_back();
    if (!row.empty()) cells.push_back(row.front());
    for (std::size_t c = begin; c < std::min(end, row.size()); ++c) cells.push_back(row[c]);
  }
  return some;
}

}  // namespace

std::string fitted(const Rows& rows, const std::vector<Align>& align, std::size_t indent) {
  const auto widths = widths_of(rows);
  const std::size_t columns = widths.size();
  std::string text;
  for (std::size_t begin = 1; begin < columns;) {
    std::size_t used = indent + widths[0], end = begin;
    while (end < columns && (end == begin || used + column_gap + widths[end] <= table_width))
      used += column_gap + widths[end++];
    const bool has_words =
        columns > 1 && (columns > align.size() || align[columns - 1] == Align::left);
    std::vector<Align> some_align{align.empty() ? Align::left : align[0]};
    // Words that do not fit are broken, if they have some room behind the numbers.
    std::size_t room = 0;
    if (has_words && end + 1 == columns && used + column_gap + narrowest_words <= table_width)
      room = table_width - used - column_gap, ++end;
    else if (has_words && end == columns && begin + 1 == columns && used > table_width)
      room = table_width - std::min(table_width - narrowest_words, indent + widths[0] + column_gap);
    for (std::size_t c = begin; c < end; ++c)
      some_align.push_back(c < align.size() ? align[c] : Align::left);
    const Rows some = some_columns(rows, begin, end);
    text +=
        aligned(room > 0 ? with_broken_words(some, end - begin, room) : some, some_align, indent);
    begin = end;
  }
  return columns > 1 ? text : aligned(rows, align, indent);
}

}  // namespace springfold::io
