// The processes of `mpirun`, of which each does a part of the runs of a sweep.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace springfold::cli {

struct MpiCalls;

/// All processes that mpirun started together; without mpirun, or without MPI in this build, this one alone. One of
/// them at a time; calls come from one thread at a time. Every function but number() and count() is called by all
/// processes, in the same order, unless it says otherwise.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int number() const { return number_; }  ///< 0: the one that writes
  int count() const { return count_; }
  bool are_several() const { return count_ > 1; }
  static bool are_built_in();
  /// mpirun started several processes, and this build knows nothing of MPI, or its module is not beside the program.
  bool are_missed() const;

  bool all(bool mine) const;                   ///< is it true in every process?
  void share(std::vector<char>& flags) const;  ///< all get those of process 0
  void send(const std::string& text) const;    ///< to process 0, by another one alone
  void send_end() const;                       ///< the last message of a process; another one alone
  /// Takes what has arrived; process 0 alone. @returns how many processes sent their end
  int receive(const std::function<void(const std::string&)>& take) const;
  void give_up() { gave_up_ = true; }  ///< others may be gone: do not wait for them at the end

 private:
  int number_ = 0, count_ = 1;
  const MpiCalls* calls_ = nullptr;  ///< where MPI has begun
  bool gave_up_ = false;
};

}  // namespace springfold::cli
