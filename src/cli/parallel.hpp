// Work on all cores whose parts have nothing to do with each other.
#pragma once

#include <functional>

namespace springfold::cli {

/// Threads to use: `wanted`, or all cores if it is 0.
int thread_count(int wanted);

/// Calls work(0), ..., work(count - 1), each once, by so many threads, the calling one among them.
/// An exception of `work` is thrown on when all have ended; the first by number counts.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace springfold::cli
