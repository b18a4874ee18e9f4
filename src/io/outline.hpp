// What happened in a run, in words: at most three lines.
#pragma once

#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// At most three lines about a run, each made of facts of the result alone: along which part of the first branch
/// it is stable, stable only as it is driven, or unstable, and at which special points that changes, with
/// the force there (lambda, where there is none); how many other branches there are, which look
/// alike, and how many jumps; of other kinds what was found. Empty where nothing was found.
std::vector<std::string> outline_of(const Case& the_case, const analysis::StudyResult& result);

/// The same without values, such as forces at special points: runs of which the same is to be told have the same words.
/// @param most  stretches of one stability that are told, on each side of a start
std::vector<std::string> story_of(const Case& the_case, const analysis::StudyResult& result,
                                  std::size_t most);

/// At most three lines about all runs of a study: those with the same story share its words; where there are more
/// stories than room, those of its first and its last runs stand.
/// @param runs  in their order, 2 or more
std::vector<std::string> study_outline(const Case& the_case,
                                       const std::vector<const analysis::StudyResult*>& runs);

/// Branches whose special points and ends agree in lambda, deflection, force and energy, such as mirror images,
/// whatever ends them: lists of numbers from 1, in order; each branch is in one list.
std::vector<std::vector<std::size_t>> alike_branches(const analysis::StudyResult& result);

/// "1", "2 and 3", "4, 5 and 6".
std::string numbers_text(const std::vector<std::size_t>& numbers);

}  // namespace springfold::io
