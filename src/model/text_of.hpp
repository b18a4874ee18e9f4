// Numbers in messages. Private to model.
#pragma once

#include <charconv>
#include <string>

namespace springfold::model {

/// Six digits, independent of locale.
inline std::string text_of(double number) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
  return {digits, end.ptr};
}

}  // namespace springfold::model
