// The [parameters] of a case: named numbers that may depend on each other in any order.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formula.hpp"
#include "problems.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

/// A formula of the file of which a number is made.
struct DefinitionPart {
  FormulaId formula = 0;
  std::string shown{};
  Place place{};
  std::string key{};
  std::string need{};
  bool is_angle = false;
};

/// The right-hand side of a number: a constant or a formula.
struct Definition {
  std::optional<FormulaId> formula{};
  double constant = 0;  ///< used when there is no formula
  bool usable = true;   ///< false: a mistake in it is already reported
  std::string shown{};  ///< as written
  Place place{};
  std::string key{};
  std::vector<DefinitionPart> parts{};  ///< of a formula that was made of others
};

struct Parameter {
  std::string name{};
  Definition definition{};
};

/// Values of all parameters or of all numbers of a table. Unusable ones are NaN: the mistake behind
/// them is already reported.
struct Values {
  std::vector<double> values{};
  std::vector<bool> usable{};
  /// Of numbers without a finite value that are made of other formulas: which of these has none.
  std::map<std::size_t, std::size_t> part_at_fault{};
};

/// Other right-hand sides, by number of the parameter.
using Redefinitions = std::map<std::size_t, Definition>;

/// Reads `node` as a number or a formula. @param need  as in "a number >= 0 [N/m]"
Definition read_definition(const Node& node, const std::string& key, const std::string& need,
                           FormulaBook& book, Problems& problems);

/// Evaluates all parameters in the order in which they depend on each other. Cycles and values
/// that are not finite are problems.
/// @param when  said after each problem, " in study \"Q2\", run 3"; may be empty
Values evaluate(const std::vector<Parameter>& parameters, const Redefinitions& changes,
                const FormulaBook& book, const std::string& when, Problems& problems);

/// One formula to be evaluated anew.
struct Update {
  std::size_t target = 0;
  FormulaId formula = 0;
};

/// What has to be evaluated, in this order, when parameter `changed` gets another value.
std::vector<Update> dependents_of(std::size_t changed, const std::vector<Parameter>& parameters,
                                  const Redefinitions& changes, const FormulaBook& book);

}  // namespace springfold::io
