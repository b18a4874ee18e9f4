#include "toml_text.hpp"

#include <nlohmann/json.hpp>

namespace springfold::io {

std::string toml_text(const std::string& text) {
  std::string quoted =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (std::size_t at = 0; (at = quoted.find('\x7f', at)) != std::string::npos;)
    quoted.replace(at, 1, "\\u007f");
  return quoted;
}

}  // namespace springfold::io
