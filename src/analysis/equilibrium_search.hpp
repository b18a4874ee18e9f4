// Multi-start for equilibria at one load. Private to analysis; everything here is dimensionless.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "quantities.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

/// One solution in joint coordinates, before it is written in words and columns.
struct FoundEquilibrium {
  Vector z{};
  Piece piece{};
  std::string note{};
};

struct EquilibriumSearch {
  std::vector<FoundEquilibrium> found{};  ///< different modulo turns of joints without springs
  int starts = 0;
  bool limit_reached = false;
  bool interrupted = false;  ///< the observer wanted no more
};

/// The study's start: an equilibrium, or only a guess.
struct EquilibriumStart {
  Vector z{};
  Piece piece{};
  bool is_equilibrium = false;
};

/// Is this state within the study's limits?
using InRange = std::function<bool(const Vector& z)>;

/// From the start, from random states of the box (some led downhill or to a saddle first), and from
/// states beside what is known: Newton's method as it is, then with deflation until it leads
/// nowhere (continuation/search.hpp). @pre unknowns of the problem are those of the statics
/// @param observer  called before every start with the number of starts so far; may be empty
EquilibriumSearch search_equilibria(const PathProblem& problem, const Study& study,
                                    const std::vector<QuantityDefinition>& quantities,
                                    const EquilibriumStart& start, const InRange& in_range,
                                    const Observer& observer);

}  // namespace springfold::analysis
