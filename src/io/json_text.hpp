// One way of writing JSON, for all files.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace springfold::io {

/// Indented by two blanks, ending with a line end; inf and NaN become null, bytes that are not
/// UTF-8 are replaced.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace springfold::io
