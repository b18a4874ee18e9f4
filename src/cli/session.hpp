// What a command needs from the world around it, so that tests can put other things there.
#pragma once

#include <functional>
#include <ostream>

#include "messages.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::cli {

class Ranks;

using RunStudy =
    std::function<analysis::StudyResult(const io::PlannedRun&, const analysis::Observer&)>;

using RunMap = std::function<analysis::StudyResult(const io::PlannedRun&, const analysis::Observer&,
                                                   const analysis::RunOptions&)>;

struct Session {
  std::ostream& out;  ///< tables
  std::ostream& err;  ///< messages
  bool shows_progress = false;
  std::function<int()> signal{};  ///< the signal that asks to stop, 0 if none
  RunStudy run_study{};
  RunMap run_map{};  ///< maps, which have options; empty: run_study runs them too
  /// Ends the program while a thread is at work that was given up; empty: no work is ever given up.
  std::function<void(int code)> leave_at_once{};
  Ranks* ranks = nullptr;  ///< processes among which sweeps are divided; none: this one alone
};

/// For what runs long: is there a signal?
inline std::function<bool()> stop_request_of(const Session& session) {
  if (!session.signal) return {};
  return [signal = session.signal] { return signal() != 0; };
}

inline void say(const Session& session, const std::string& message) { say(session.err, message); }

}  // namespace springfold::cli
