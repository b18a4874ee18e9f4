#include "memory_shortage.hpp"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "exit_code.hpp"
#include "messages.hpp"

namespace springfold::cli {
namespace {

/// Enough for messages, a manifest and the results of ordinary runs [byte].
constexpr std::size_t reserved = 8U << 20U;

// Handlers can reach nothing but globals.
std::atomic<void*> reserve{nullptr};
std::terminate_handler ordinary_end = nullptr;

/// Called by operator new where it finds nothing: it tries again if this returns.
void give_way() {
  void* const room = reserve.exchange(nullptr);
  if (room == nullptr) throw std::bad_alloc{};
  std::free(room);
}

bool is_for_want_of_memory() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
  }
  return false;
}

[[noreturn]] void end() {
  if (is_for_want_of_memory()) {
    const std::string_view text{out_of_memory_text};
    const auto ignored = ::write(STDERR_FILENO, text.data(), text.size());
    static_cast<void>(ignored);
    std::_Exit(out_of_memory);
  }
  if (ordinary_end != nullptr) ordinary_end();
  std::abort();
}

}  // namespace

void prepare_for_memory_shortage() {
  reserve = std::malloc(reserved);
  std::set_new_handler(give_way);
  ordinary_end = std::set_terminate(end);
}

}  // namespace springfold::cli
