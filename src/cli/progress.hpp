// How far a run is, on one line that is written over and over; only for terminals.
#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace springfold::cli {

class Progress {
 public:
  Progress(std::ostream& out, bool is_shown) : out_{out}, is_shown_{is_shown} {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  void begin(const std::string& what);
  void points(int count);
  /// The part of a known amount of work that is done: a bar, and the time that is left.
  void part(double done);
  void clear();

 private:
  void write(const std::string& line);

  std::ostream& out_;
  bool is_shown_;
  bool is_on_screen_ = false;
  std::string what_{};
  std::chrono::steady_clock::time_point began_{};
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace springfold::cli
