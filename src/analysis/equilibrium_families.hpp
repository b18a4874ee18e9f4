// Equilibria that a search met on one line of them. Private to analysis.
#pragma once

#include <functional>
#include <vector>

#include "equilibrium_search.hpp"
#include "path_problem.hpp"

namespace springfold::analysis {

/// Equilibria that fill a line: a joint that nothing turns, a dead band.
struct EquilibriumFamily {
  std::size_t shown = 0;              ///< the equilibrium that stands for it
  std::vector<std::size_t> others{};  ///< further ones that lie on the same line
};

/// From every singular equilibrium the line along its null vector is walked, both ways: where each point of it
/// satisfies all equations to the tolerance, it is a family, and the equilibria that it meets are members. At a limit
/// point or branch point no point beside satisfies them.
/// @param singular  numbers of those to look at, in the order in which they may stand for a family
/// @param goes_on   asked at every step: is the rest still wanted?
std::vector<EquilibriumFamily> equilibrium_families(const PathProblem& problem,
                                                    const std::vector<FoundEquilibrium>& found,
                                                    const std::vector<std::size_t>& singular,
                                                    const std::function<bool()>& goes_on);

}  // namespace springfold::analysis
