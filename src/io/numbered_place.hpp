// Sentences of problems_in() begin with the number of the part that they are about.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace springfold::io {

/// The number in "name[3]rest" and the length of "name[3]"; nothing if `text` is not of that form.
struct Numbered {
  std::size_t number = 0;
  std::size_t length = 0;
};
inline std::optional<Numbered> numbered(std::string_view text, std::string_view name) {
  if (!text.starts_with(name) || text.substr(name.size(), 1) != "[") return std::nullopt;
  const char* begin = text.data() + name.size() + 1;
  const char* end = text.data() + text.size();
  std::size_t number = 0;
  const auto [at, error] = std::from_chars(begin, end, number);
  if (error != std::errc{} || at == end || *at != ']' || number == 0) return std::nullopt;
  return Numbered{number, static_cast<std::size_t>(at + 1 - text.data())};
}

/// The rest of "chain[2].elements[3].spring: ..." behind what is known by its place.
inline std::string rest_of(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(".: ");
  return begin == std::string_view::npos ? "" : std::string{text.substr(begin)};
}

}  // namespace springfold::io
