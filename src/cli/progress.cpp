#include "progress.hpp"

#include "springfold/io/shown_text.hpp"

namespace springfold::cli {

void Progress::begin(const std::string& what) {
  what_ = io::shown(what);
  began_ = std::chrono::steady_clock::now();
  shown_ = {};
  write(what_ + ": looking for the start point");
}

void Progress::points(int count) {
  constexpr int every = 20;  // a terminal is slower than a step
  if (count % every == 0) write(what_ + ": " + std::to_string(count) + " points");
}

void Progress::part(double done) {
  const auto now = std::chrono::steady_clock::now();
  if (now - shown_ < std::chrono::milliseconds{200}) return;
  shown_ = now;
  constexpr int width = 30;
  const int filled = static_cast<int>(done * width);
  std::string bar = "[" + std::string(static_cast<std::size_t>(filled), '#') +
                    std::string(static_cast<std::size_t>(width - filled), '.') + "] " +
                    std::to_string(static_cast<int>(100 * done)) + " %";
  if (done > 0) {
    const double seconds = std::chrono::duration<double>(now - began_).count() * (1 - done) / done;
    const auto left = static_cast<long>(seconds + 0.5);
    bar += left < 100 ? ", " + std::to_string(left) + " s left"
                      : ", " + std::to_string((left + 30) / 60) + " min left";
  }
  write(what_ + ": " + bar);
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
