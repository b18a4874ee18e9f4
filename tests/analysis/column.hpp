// Columns of results by name.
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

}  // namespace springfold::analysis
