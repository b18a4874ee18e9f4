// Is a touch of det Sigma one of Sigma itself? Private to the engine.
#pragma once

#include "continuation/locating/watched_step.hpp"

namespace springfold::continuation {

/// Where two eigenvalues come close to zero together and turn back, their product is lost in its rounding long
/// before they are. Sigma's entries are fitted around the place, and their own scatter shows what can be told.
/// @returns whether Sigma may be singular at the touch
bool sigma_may_vanish(const WatchedStep& arc, const Borders& borders, const ZeroOf& touch);

/// Shares to which the modes of one Sigma have shrunk in another: |eigenvalues| of from^-1 to, ascending. They do not
/// depend on the units of the unknowns.
Vector shrunk(const Matrix& from, const Matrix& to);

/// How many of the m smallest modes come to zero at this zero of det Sigma?
Index vanishing_modes(const WatchedStep& arc, Index m, const ZeroOf& zero);

}  // namespace springfold::continuation
