// Work that is given up when a signal comes and it does not end by itself.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "heap.hpp"
#include "session.hpp"

namespace springfold::cli {

/// How long work may go on after a signal: most of it looks for signals itself and keeps what it has.
class Patience {
 public:
  explicit Patience(std::function<bool()> stop_requested)
      : stop_requested_{std::move(stop_requested)} {}

  /// Is there a signal, and has the work had its time since?
  bool is_over();
  /// When the signal was seen first; nothing if none was.
  std::optional<std::chrono::steady_clock::time_point> since() const { return since_; }

 private:
  std::function<bool()> stop_requested_;
  std::optional<std::chrono::steady_clock::time_point>
      since_{};  ///< when the signal was seen first
};

/// Does the work on a thread of its own, so that a signal is answered within a second whatever the work is
/// about: one factorisation of a large matrix may take longer.
/// @returns its result; nothing if it was given up. Then the thread goes on: what the work uses must be its
/// own or shared, and the program must end by session.leave_at_once. Throws what the work throws
template <class Result>
std::optional<Result> done_in_time(std::function<Result()> work, const Session& session,
                                   Patience& patience) {
  if (!session.leave_at_once) return work();
  const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(work));
  std::future<Result> result = task->get_future();
  std::thread thread;
  try {
    thread = std::thread{[task] {
      fill_first_pages();
      (*task)();
    }};
  } catch (const std::system_error&) {  // no more threads: then here
    (*task)();
    return result.get();
  }
  constexpr std::chrono::milliseconds look_every{20};
  while (result.wait_for(look_every) != std::future_status::ready)
    if (patience.is_over()) {
      thread.detach();
      return std::nullopt;
    }
  thread.join();
  return result.get();
}

template <class Result>
std::optional<Result> done_in_time(std::function<Result()> work, const Session& session) {
  Patience patience{stop_request_of(session)};
  return done_in_time<Result>(std::move(work), session, patience);
}

}  // namespace springfold::cli
