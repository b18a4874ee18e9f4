// Chains whose joints are locked: what they show of forces is not what the mechanism feels. Private to analysis.
#pragma once

#include <string>
#include <vector>

#include "equilibrium_search.hpp"
#include "quantities.hpp"

namespace springfold::analysis {

/// The rank that the closure of every chain has anywhere: among what was found, and beside it.
std::vector<Index> full_ranks(const Evaluator& evaluator,
                              const std::vector<FoundEquilibrium>& found);

/// Names of the chains whose joints cannot move their end in all directions in which they can elsewhere, and can turn
/// themselves, without any energy, while the end stays where it is: a bar along the first axis of its universal joint,
/// a bar of no length. Their coordinates are singular there, as polar ones are at their pole, and seem to balance what
/// nothing holds.
///
/// With J the chain's closure in its coordinates x, K the kernel of J and w the directions that the end has lost, w^T J
/// = 0: such a motion is a k in the span of K with K^T A_xx k = 0, whatever multiples of w are added to the chain's
/// wrench. Where there are more of them than the chain has anywhere, it is locked. An arm stretched out is not: moved
/// along any k its end falls back, w^T x_kk is not zero. Nor is any chain where the energy is lowest, which makes K^T
/// A_xx K positive definite.
///
/// The joints of a mechanism of one chain that is no bar are all that moves: they are not locked, whatever they do.
/// @param full  full_ranks()
/// @returns "left, right"; empty where there is none
std::string locked_chains(const PathProblem& problem, const Evaluator& evaluator,
                          const FoundEquilibrium& found, const std::vector<Index>& full);

}  // namespace springfold::analysis
