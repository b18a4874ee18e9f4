// Kinds of characters, independent of locale. Private to io.
#pragma once

namespace springfold::io {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// With what a name may begin.
inline bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace springfold::io
