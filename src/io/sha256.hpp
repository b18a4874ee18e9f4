// Fingerprint of file contents (FIPS 180-4), so that `sha256sum` can check a manifest.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace springfold::io {

/// SHA-256 of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// The same, unless it takes too long.
/// @param is_over  asked after every part; may be empty
/// @returns nothing if it was asked to end
std::optional<std::string> sha256(std::string_view bytes, const std::function<bool()>& is_over);

}  // namespace springfold::io
