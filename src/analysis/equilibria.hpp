// All equilibria at a given load. Private to analysis.
#pragma once

#include "setup.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {

/// Searches from the start point, from random states of the box whose chains are closed first, and
/// from states beside known equilibria; what is known is deflated (continuation/search.hpp). The
/// same equilibrium in other joint coordinates counts once. Fills result.equilibria and, if only the
/// search found something, result.start.
/// Where the observer wants no more, what was found until then is the result.
/// @pre study.kind is `equilibria`
void find_equilibria(const Setup& setup, const Study& study, const statics::FirstEquilibrium& first,
                     const Observer& observer, StudyResult& result);

}  // namespace springfold::analysis
