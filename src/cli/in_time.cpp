#include "in_time.hpp"

namespace springfold::cli {
namespace {

/// With what is written then it makes less than a second.
constexpr std::chrono::milliseconds longest_wait{700};

}  // namespace

bool Patience::is_over() {
  if (!stop_requested_ || !stop_requested_()) return false;
  const auto now = std::chrono::steady_clock::now();
  if (!since_) since_ = now;
  return now - *since_ > longest_wait;
}

}  // namespace springfold::cli
