// How far a run is, on one line that is written over and over; only for terminals.
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <utility>

namespace springfold::cli {

class Progress {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param now  the clock
  Progress(std::ostream& out, bool is_shown,
           std::function<Time()> now = std::chrono::steady_clock::now)
      : out_{out}, is_shown_{is_shown}, now_{std::move(now)} {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  void begin(const std::string& what);
  /// Points of a curve. How long it is nobody knows before: the time that is left follows from the runs of its study
  /// that are done, or is bounded by the points that it may have.
  /// @param most  points; 0: no bound is known
  void points(int count, int most = 0);
  /// Of the runs of a study so many are done. `begin_runs` before the first.
  void begin_runs(std::size_t count);
  void end_run();
  /// The part of a known amount of work that is done: a bar, and the time that is left.
  void part(double done);
  void clear();

 private:
  void write(const std::string& line);
  double seconds_since(Time begin) const;
  std::string time_left(int count, int most) const;

  std::ostream& out_;
  bool is_shown_;
  std::function<Time()> now_;
  bool is_on_screen_ = false;
  std::string what_{};
  Time began_{};
  Time shown_{};
  Time runs_began_{};
  std::size_t runs_ = 0, runs_done_ = 0;
};

}  // namespace springfold::cli
