#include "text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "springfold/io/shown_text.hpp"

namespace springfold::io {

namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

std::string lower(std::string_view text) {
  std::string result{text};
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string padded(std::string_view cell, std::size_t width, Align align) {
  const std::size_t used = width_of(cell);
  const std::string blanks(width > used ? width - used : 0, ' ');
  return align == Align::left ? std::string{cell} + blanks : blanks + std::string{cell};
}

}  // namespace

std::string decimal(double value) {
  std::array<char, 400> buffer{};  // the largest double has 309 digits, the least one 324 zeros
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  if (error != std::errc{}) return shortest(value);
  std::string text(buffer.data(), end);
  constexpr double large_integer = 9007199254740992.0;  // 2^53
  if (std::abs(value) >= large_integer) text += ".0";
  return text;
}

std::string shortest(double value) {
  if (std::isnan(value)) return "nan";  // to_chars would print the sign of a NaN
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string rounded(double value, int digits) {
  if (std::isnan(value)) return "nan";
  std::array<char, 64> text{};
  const double without_minus_zero = value + 0.0;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), without_minus_zero,
                                 std::chars_format::general, digits)
                       .ptr;
  return {text.data(), end};
}

std::string csv_number(double value) { return std::isnan(value) ? std::string{} : shortest(value); }

void append_csv_number(std::string& text, double value) {
  if (std::isnan(value)) return;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

void append_csv_text(std::string& line, std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

std::string csv_text(std::string_view text) {
  std::string quoted;
  append_csv_text(quoted, text);
  return quoted;
}

std::string safe_file_name(std::string_view name) {
  constexpr std::size_t longest = 80;
  std::string safe;
  for (const char c : name) {
    const bool stays = is_letter_or_digit(c) || c == '-' || (c == '.' && !safe.empty());
    if (stays)
      safe += c;
    else if (!safe.empty() && safe.back() != '_')
      safe += '_';
  }
  safe.resize(std::min(safe.size(), longest));
  while (!safe.empty() && (safe.back() == '_' || safe.back() == '.')) safe.pop_back();
  return safe.empty() ? "unnamed" : safe;
}

std::string UniqueNames::make(std::string_view wanted) {
  std::string name{wanted};
  const auto is_taken = [&] {
    return std::find(taken_.begin(), taken_.end(), lower(name)) != taken_.end();
  };
  for (int number = 2; is_taken(); ++number)
    name = std::string{wanted} + "_" + std::to_string(number);
  taken_.push_back(lower(name));
  return name;
}

std::size_t width_of(std::string_view text) {
  const auto starts_character = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<std::string> lines;
  for (std::size_t at = 0; (at = text.find_first_not_of(blanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const bool fits = !lines.empty() && width_of(lines.back()) + 1 + width_of(word) <= width;
    if (fits)
      lines.back().append(" ").append(word);
    else
      lines.emplace_back(word);
    at = end;
  }
  return lines;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows,
                    const std::vector<Align>& align, std::size_t indent) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], width_of(shown(row[c])));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line(indent, ' ');
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) line += "  ";
      line += padded(shown(row[c]), widths[c], c < align.size() ? align[c] : Align::left);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace springfold::io
