#include "progress.hpp"

#include "springfold/io/shown_text.hpp"

namespace springfold::cli {
namespace {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 100 ? std::to_string(whole) + " s" : std::to_string((whole + 30) / 60) + " min";
}

}  // namespace

double Progress::seconds_since(Time begin) const {
  return std::chrono::duration<double>(now_() - begin).count();
}

void Progress::begin_runs(std::size_t count) {
  runs_ = count;
  runs_done_ = 0;
  runs_began_ = now_();
}

void Progress::end_run() { ++runs_done_; }

std::string Progress::time_left(int count, int most) const {
  constexpr double soon = 2;  // seconds: what is done by then needs no estimate
  if (runs_done_ > 0 && runs_done_ < runs_) {
    const auto done = static_cast<double>(runs_done_);
    const double all = seconds_since(runs_began_) / done * static_cast<double>(runs_ - runs_done_);
    return all < soon ? "" : ", about " + duration_text(all) + " left";
  }
  const double spent = seconds_since(began_);
  if (spent < soon || count <= 0) return "";
  if (most <= count || runs_ > 1) return ", " + duration_text(spent);
  return ", at most " + duration_text(spent * (most - count) / count) + " left";
}

void Progress::begin(const std::string& what) {
  what_ = io::shown(what);
  began_ = now_();
  shown_ = {};
  write(what_ + ": looking for the start point");
}

void Progress::points(int count, int most) {
  constexpr int every = 20;  // a terminal is slower than a step
  if (count % every == 0)
    write(what_ + ": " + std::to_string(count) + " points" + time_left(count, most));
}

void Progress::part(double done) {
  const auto now = now_();
  if (now - shown_ < std::chrono::milliseconds{200}) return;
  shown_ = now;
  constexpr int width = 30;
  const int filled = static_cast<int>(done * width);
  std::string bar = "[" + std::string(static_cast<std::size_t>(filled), '#') +
                    std::string(static_cast<std::size_t>(width - filled), '.') + "] " +
                    std::to_string(static_cast<int>(100 * done)) + " %";
  if (done > 0) bar += ", " + duration_text(seconds_since(began_) * (1 - done) / done) + " left";
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
