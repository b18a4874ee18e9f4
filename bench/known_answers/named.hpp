// Draws that are kept because the engine once got them wrong: files of lines
//
//     seed draw family   # what it showed
//
// "wide" before the family: a draw of a campaign with --wide.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report.hpp"

namespace springfold::known_answers {

struct NamedDraw {
  unsigned long long seed = 1;
  long number = 0;
  bool wide = false;
  std::string family{};
};

/// @throws std::runtime_error with the line that cannot be read
std::vector<NamedDraw> read_named(const std::string& path);

/// Lines of such a file for what failed, to be kept; no file if nothing did.
/// @throws std::runtime_error if it cannot be written
void write_failures(const std::string& path, unsigned long long seed, bool wide,
                    const std::map<long, Failure>& failures);

}  // namespace springfold::known_answers
