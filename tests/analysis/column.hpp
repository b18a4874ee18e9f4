// Columns and values of results by name.
#pragma once

#include <stdexcept>
#include <string>

#include "springfold/analysis/result.hpp"

namespace springfold::analysis {

/// Throws std::out_of_range where the result has no such quantity.
inline std::size_t column(const StudyResult& result, const std::string& name) {
  for (std::size_t i = 0; i < result.quantities.size(); ++i)
    if (result.quantities[i].name == name) return i;
  throw std::out_of_range("no quantity " + name);
}

inline double value(const StudyResult& result, const Branch& branch, std::size_t row,
                    const std::string& name) {
  return branch.samples[row].values[column(result, name)];
}

/// On the first branch.
inline double value(const StudyResult& result, std::size_t row, const std::string& name) {
  return value(result, result.branches.front(), row, name);
}

}  // namespace springfold::analysis
