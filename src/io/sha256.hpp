// Fingerprint of file contents (FIPS 180-4), so that `sha256sum` can check a manifest.
#pragma once

#include <string>
#include <string_view>

namespace springfold::io {

/// SHA-256 of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace springfold::io
