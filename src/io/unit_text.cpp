#include "unit_text.hpp"

#include <algorithm>

#include "characters.hpp"

namespace springfold::io {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::string_view degree_sign = "\xC2\xB0";

/// Also every byte of a character outside of ASCII, such as those of ° and µ.
bool is_of_a_unit(char c) {
  return is_letter(c) || is_digit(c) || static_cast<unsigned char>(c) >= 0x80 || c == '/' ||
         c == '*' || c == '^' || c == '.' || c == '-';
}

std::string_view bare(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// Length of the number at the beginning: "-2", "0.5", ".5e-3"; 0 if there is none.
std::size_t numeral_length(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t first = at;
  bool has_digits = false;
  for (; at < text.size() && (is_digit(text[at]) || text[at] == '.'); ++at)
    has_digits |= is_digit(text[at]);
  if (!has_digits || at == first) return 0;
  std::size_t power = at;
  if (power < text.size() && (text[power] == 'e' || text[power] == 'E')) {
    ++power;
    if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
    if (power < text.size() && is_digit(text[power])) {
      while (power < text.size() && is_digit(text[power])) ++power;
      at = power;
    }
  }
  return at;
}

}  // namespace

std::string unit_problem(std::string_view text, const std::vector<std::string>& known) {
  const std::string_view all = bare(text);
  const std::size_t length = numeral_length(all);
  if (length == 0 || length == all.size()) return {};
  const std::string number{all.substr(0, length)};
  const std::string_view unit = bare(all.substr(length));
  if (unit == degree_sign || unit == "deg" || unit == "degree" || unit == "degrees")
    return "angles are in radians; of degrees write \"" + number + "*deg\"";
  const bool begins_a_unit =
      is_letter(unit.front()) || static_cast<unsigned char>(unit.front()) >= 0x80;
  if (!begins_a_unit || !std::all_of(unit.begin(), unit.end(), is_of_a_unit)) return {};
  const auto end = std::find_if_not(unit.begin(), unit.end(),
                                    [](char c) { return is_letter(c) || is_digit(c); });
  const std::string word{unit.begin(), end};
  if (std::find(known.begin(), known.end(), word) != known.end()) return {};
  return "units do not belong into numbers: write " + number +
         " alone, in the units of the case (nothing is converted)";
}

}  // namespace springfold::io
