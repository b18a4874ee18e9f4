// JSON text as plain data with source positions, for formats of others.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "toml_reader.hpp"

namespace springfold::io {

/// Reads JSON; null becomes the text "null". A syntax error, a key that stands twice and values that
/// are nested more than 32 deep become one problem with their position; then there is no result.
std::optional<Node> read_json(std::string_view bytes, const std::string& file, Problems& problems);

}  // namespace springfold::io
