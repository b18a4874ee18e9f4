// Texts for files in TOML. Private to io.
#pragma once

#include <string>

namespace springfold::io {

/// A text in TOML: the escapes of JSON are among those of TOML, but for surrogates, so that other characters stay.
std::string toml_text(const std::string& text);

}  // namespace springfold::io
