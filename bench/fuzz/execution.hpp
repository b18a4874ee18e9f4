// One execution of the program within this process, and what must hold of it.
#pragma once

#include <string>
#include <vector>

#include "mutate.hpp"

namespace springfold::fuzz {

enum class Mode {
  check,  ///< `check` of wild mutants
  run,    ///< `run` of gentle ones, which a signal stops after a fifth of a second
  uncapped,  ///< `run` of gentle ones to their end, some with figures; those that last are stopped late
};

/// CPU seconds after which a run to its end is a long one: it is sent SIGINT, and must end at once with what it has.
inline constexpr double long_run = 240;
/// The same of a check, whose starts are looked for.
inline constexpr double long_check = 20;

/// Exit code of a program that a signal has ended. Where it comes in the middle of a long step the process ends at
/// once.
inline constexpr int ended_by_signal = 130;

struct Outcome {
  int code = 0;                       ///< exit code
  bool accepted = false;              ///< `check` has nothing to object to
  std::vector<std::string> broken{};  ///< rules that do not hold
};

/// Writes the mutant beside the file that it comes from.
/// @param folder  holds a copy of the corpus
void put(const Mutant& mutant, const std::filesystem::path& folder);
std::filesystem::path place_of(const Mutant& mutant, const std::filesystem::path& folder);

/// @pre put(); `out` does not exist, and does not afterwards
Outcome execute(Mode mode, const std::filesystem::path& case_file, const std::filesystem::path& out,
                bool draws);

}  // namespace springfold::fuzz
