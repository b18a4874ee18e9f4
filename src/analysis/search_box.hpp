// Where to search for other equilibria. Private to analysis.
#pragma once

#include "path_problem.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::analysis {

struct SearchBox {
  Vector low{}, high{};
};

/// The extent of the start and the traced branches in every unknown, enlarged by half of it on both sides and to a
/// width of at least 1 (one size of the mechanism, or its force unit); angles to at least a whole turn.
SearchBox search_box(const PathProblem& problem, const continuation::Diagram& diagram,
                     const Vector& start);

/// The points of the traced branches at this lambda, each corrected there.
std::vector<Vector> known_at(const PathProblem& problem, const continuation::Diagram& diagram,
                             double lambda);

}  // namespace springfold::analysis
