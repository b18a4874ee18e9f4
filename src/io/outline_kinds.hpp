// What happened in runs that trace no single curve, in words. Private to io.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// A sentence about a search for equilibria, commands along a path, a map, a region, a critical curve, a threshold, a
/// sensitivity, a design or a graph of states; none for other kinds, and where nothing was found.
std::vector<std::string> outline_of_kind(const Case& the_case, const PlannedRun& planned,
                                         const analysis::StudyResult& result);

/// How stable a single equilibrium is: "an equilibrium, stable under dead load".
std::string equilibrium_words(const analysis::StudyResult& result, const analysis::Sample& sample);

/// Jumps and loops of a study that looks for them; empty if there are none.
std::string jump_words(const Case& the_case, const analysis::StudyResult& result);

/// "2 LP, 1 BP": special points of the branch by code, without ends and marked values; empty if there are none.
std::string counted_points(const analysis::Branch& branch);
/// The same of several branches together, each kind once.
std::string counted_points(std::span<const analysis::Branch> branches);

}  // namespace springfold::io
