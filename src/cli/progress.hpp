// How far a run is, on one line that is written over and over; only for terminals.
#pragma once

#include <ostream>
#include <string>

namespace springfold::cli {

class Progress {
 public:
  Progress(std::ostream& out, bool is_shown) : out_{out}, is_shown_{is_shown} {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  void begin(std::string what);
  void points(int count);
  void clear();

 private:
  void write(const std::string& line);

  std::ostream& out_;
  bool is_shown_;
  bool is_on_screen_ = false;
  std::string what_{};
};

}  // namespace springfold::cli
