// Curves that end where a spring comes to a place at which its force has no direction. Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// A spring or bar of length 0, two neighbouring points of a path or an angle that meet, a fold with a point on its
/// edge: there a force or moment turns at once, and no curve leads on. Is `end`, where `curve` could not go on, about
/// to meet such a place: has a length fallen below a hundredth of what it was along the curve, and does it still fall?
/// @returns so in words, with the spring's name and that length; nothing where there is none
std::optional<std::string> vanishing_length(const PathProblem& problem,
                                            const continuation::Curve& curve,
                                            const continuation::CurvePoint& end);

}  // namespace springfold::analysis
