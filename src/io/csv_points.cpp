#include "csv_points.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace springfold::io {
namespace {

std::string_view without_blanks(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A finite number that is the whole field.
std::optional<double> number_in(std::string_view field) {
  double value = 0;
  if (field.starts_with('+')) field.remove_prefix(1);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// A line with something on it, without what follows a `#`.
struct ContentLine {
  std::string_view whole{}, content{};
  int number = 0;
};

std::vector<ContentLine> content_lines(std::string_view text) {
  std::vector<ContentLine> lines;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    const std::string_view content = without_blanks(line.substr(0, line.find('#')));
    if (!content.empty()) lines.push_back({line, content, number});
  }
  return lines;
}

}  // namespace

std::vector<CsvPoint> read_csv_points(const TextFile& file, Problems& problems) {
  std::vector<CsvPoint> points;
  bool first = true;
  for (const auto& [line, content, number] : content_lines(file.text)) {
    const bool may_be_words = first;
    first = false;
    const std::size_t comma = content.find(',');
    const bool pair =
        comma != std::string_view::npos && content.find(',', comma + 1) == std::string_view::npos;
    const auto x = pair ? number_in(without_blanks(content.substr(0, comma))) : std::nullopt;
    const auto y = pair ? number_in(without_blanks(content.substr(comma + 1))) : std::nullopt;
    if (x && y) {
      points.push_back({*x, *y, number, static_cast<int>(line.find(',')) + 2});
    } else if (!(may_be_words && pair && !x && !y)) {
      problems.add({file.shown_name, number, 1}, "",
                   "need two numbers with a comma between them: deformation, torque");
    }
  }
  return points;
}

std::vector<CsvNumber> read_csv_numbers(const TextFile& file, const std::string& what,
                                        Problems& problems) {
  std::vector<CsvNumber> numbers;
  bool first = true;
  for (const auto& [line, content, number] : content_lines(file.text)) {
    const bool may_be_words = first && content.find(',') == std::string_view::npos;
    first = false;
    if (const auto value = number_in(content))
      numbers.push_back({*value, number});
    else if (!may_be_words)
      problems.add({file.shown_name, number, 1}, "", "need one number: " + what);
  }
  return numbers;
}

}  // namespace springfold::io
