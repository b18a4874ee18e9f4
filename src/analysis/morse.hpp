// How many equilibria there must be, from the shape of the set of all configurations. Private to
// analysis.
#pragma once

#include <vector>

#include "path_problem.hpp"
#include "springfold/analysis/result.hpp"

namespace springfold::analysis {

/// An equilibrium as the count needs it.
struct CountedEquilibrium {
  Vector z{};
  std::optional<Index> index{};  ///< number of unstable modes under dead load
  bool is_locked = false;        ///< see locked_chains.hpp
};

/// Is the chain a bar: joints that turn freely about one foot, then one spring along the line from the foot to the end?
bool is_bar(const statics::System& system, std::size_t chain);

/// Where the potential energy grows without bound on a set of configurations of known Euler
/// characteristic, the sum of (-1)^index over all equilibria is that number (Morse). It is known for
///
///   - one open chain: 1 if every joint has a spring, 0 if some turn freely;
///   - a point held by bars and line springs, each a spring from a foot to the point: in the plane 1 - m, in space
///     1 + m, where m feet are peaks of the energy (the pressed bar there outweighs all other
///     forces). Bars of negative length do not count, nor states in which a foot's joint is
///     locked;
///   - joints that turn, one freedom, springs between points of any law: 0, where the configurations are smooth
///     closed curves (one_freedom.hpp).
///
/// Otherwise `why` says what is missing. Docs: theory.md, "Counting equilibria".
/// @param raw  equilibria in joint coordinates, modulo turns @param distinct  each pose once
MorseCount morse_count(const PathProblem& problem, const std::vector<CountedEquilibrium>& raw,
                       const std::vector<CountedEquilibrium>& distinct);

}  // namespace springfold::analysis
