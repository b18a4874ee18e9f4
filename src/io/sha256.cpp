#include "sha256.hpp"

#include <nettle/sha2.h>

#include <array>
#include <cstdint>

namespace springfold::io {

std::string sha256(std::string_view bytes) { return *sha256(bytes, {}); }

std::optional<std::string> sha256(std::string_view bytes, const std::function<bool()>& is_over) {
  constexpr std::size_t most = std::size_t{1} << 22;  // [byte], a hundredth of a second
  sha256_ctx context;
  sha256_init(&context);
  while (!bytes.empty()) {
    if (is_over && is_over()) return std::nullopt;
    const std::string_view part = bytes.substr(0, most);
    sha256_update(&context, part.size(), reinterpret_cast<const std::uint8_t*>(part.data()));
    bytes.remove_prefix(part.size());
  }
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());

  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += digits[byte >> 4];
    text += digits[byte & 0xf];
  }
  return text;
}

}  // namespace springfold::io
