#include "progress.hpp"

namespace springfold::cli {

void Progress::begin(std::string what) {
  what_ = std::move(what);
  write(what_ + ": looking for the start point");
}

void Progress::points(int count) {
  constexpr int every = 20;  // a terminal is slower than a step
  if (count % every == 0) write(what_ + ": " + std::to_string(count) + " points");
}

void Progress::clear() {
  if (!is_on_screen_) return;
  out_ << "\r\033[K" << std::flush;
  is_on_screen_ = false;
}

void Progress::write(const std::string& line) {
  if (!is_shown_) return;
  out_ << "\r\033[K" << line << std::flush;
  is_on_screen_ = true;
}

}  // namespace springfold::cli
