// Processes that execute mutants, and what is remembered of them.
#pragma once

#include <optional>
#include <ostream>

#include "execution.hpp"

namespace springfold::fuzz {

struct Settings {
  Mode mode = Mode::check;
  std::filesystem::path corpus = "cases", work = "build/fuzz";
  std::uint64_t seed = 1, count = 1000;
  double seconds = 1e9;
  int jobs = 2;
  std::optional<std::uint64_t> only{};
};

/// @returns the program's exit code
int run_all(const Settings& settings, std::ostream& out);
int run_one(const Settings& settings, std::ostream& out);

}  // namespace springfold::fuzz
