#include "parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace springfold::cli {

int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(count);
  const auto loop = [&] {
    for (std::size_t i = next++; i < count; i = next++) try {
        work(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> others;
    const auto wanted = static_cast<std::size_t>(std::max(threads, 1));
    for (std::size_t t = 1; t < std::min(wanted, count); ++t) try {
        others.emplace_back(loop);
      } catch (const std::system_error&) {  // as many as the system gives
        break;
      }
    loop();
  }
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace springfold::cli
