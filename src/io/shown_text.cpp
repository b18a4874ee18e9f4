#include "springfold/io/shown_text.hpp"

#include <array>
#include <charconv>
#include <cstdint>

namespace springfold::io {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: no UTF-8
};

/// Shortest forms only, no surrogates, up to U+10FFFF (RFC 3629).
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least[length] || code > 0x10FFFF || is_surrogate) return {};
  return {code, length};
}

bool is_visible(std::uint32_t c) {
  const bool is_control = c < 0x20 || (c >= 0x7F && c <= 0x9F);
  const bool is_separator = c == 0x2028 || c == 0x2029;
  const bool is_direction = c == 0x061C || c == 0x200E || c == 0x200F ||
                            (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
  const bool is_none = c == 0xFEFF || (c & 0xFFFFU) >= 0xFFFE;
  return !is_control && !is_separator && !is_direction && !is_none;
}

void append_escape(std::uint32_t c, std::string& all) {
  if (c == '\n') return void(all += "\\n");
  if (c == '\r') return void(all += "\\r");
  if (c == '\t') return void(all += "\\t");
  std::array<char, 8> digits{};
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), c, 16).ptr;
  const std::string hex(digits.data(), static_cast<std::size_t>(end - digits.data()));
  if (c <= 0xFF)
    all += (c < 0x10 ? "\\x0" : "\\x") + hex;
  else
    all += "\\u{" + hex + "}";
}

}  // namespace

std::string shown(std::string_view text) {
  std::string all;
  all.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_character(text);
    if (c.length == 0)
      append_escape(static_cast<unsigned char>(text.front()), all);
    else if (is_visible(c.code))
      all += text.substr(0, c.length);
    else
      append_escape(c.code, all);
    text.remove_prefix(c.length == 0 ? 1 : c.length);
  }
  return all;
}

std::string shown_in_line(std::string_view text) {
  std::string one_line{text};
  for (char& c : one_line)
    if (c == '\n') c = ' ';
  return shown(one_line);
}

}  // namespace springfold::io
