// The formula of a spring law: text to steps that can be differentiated.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "springfold/model/formula.hpp"

namespace springfold::io {

struct LawFormula {
  model::Formula formula{};
  /// Steps that are numbers, and the text of each: a formula without the variable.
  std::vector<std::pair<std::size_t, std::string>> numbers{};
  std::string problem{};  ///< why the text cannot be used; empty when it can
};

/// Reads a formula in the language of case files (formula.hpp) with one more name, the deformation. Parts without it
/// are left as text: they are numbers of the case. The formula must be smooth: functions and operators with
/// jumps or kinks may only stand in these parts.
LawFormula read_law_formula(const std::string& text, const std::string& variable);

}  // namespace springfold::io
