// Words of messages: numbers with few digits, independent of the locale, and names of switches. Private to the engine.
#pragma once

#include <charconv>
#include <string>
#include <system_error>
#include <vector>

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

inline std::string rounded(double value, int digits = 3) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  return error == std::errc{} ? std::string(buffer, end) : "?";
}

/// Names of switches, with commas between them.
inline std::string names_of(ProblemView problem, const std::vector<Index>& switches) {
  std::string names;
  for (const Index j : switches) names += (names.empty() ? "" : ", ") + problem.switch_name(j);
  return names;
}

}  // namespace springfold::continuation
