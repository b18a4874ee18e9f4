// Special points too close together to be told apart: how many there are; is a touch of det Sigma one of Sigma itself?
// Private to the engine.
#pragma once

#include <optional>

#include "continuation/locating/tested_step.hpp"

namespace springfold::continuation {

/// All special points of a step as one unresolved hit with their total multiplicity. lambda's rate and
/// det Sigma are interpolated over the whole step, where rounding matters little; their complex zeros
/// beside the step are counted, however much rounding scatters them. They must lie close together
/// compared with the step, far from any other, and explain the change of the number of negative
/// eigenvalues.
/// @param samples  the step's ends and its middle, in order; all on one piece
std::optional<Hit> cluster_on_step(const Walker& walker, Samples samples);

/// Where two eigenvalues come close to zero together and turn back, their product is lost in its rounding long
/// before they are. Sigma's entries are fitted around the place, and their own scatter shows what can be told.
/// @returns whether Sigma may be singular at the touch
bool sigma_may_vanish(const TestedStep& arc, const Borders& borders, const ZeroOf& touch);

/// Shares to which the modes of one Sigma have shrunk in another: |eigenvalues| of from^-1 to, ascending. They do not
/// depend on the units of the unknowns.
Vector shrunk(const Matrix& from, const Matrix& to);

/// How many of the m smallest modes come to zero at this zero of det Sigma?
Index vanishing_modes(const TestedStep& arc, Index m, const ZeroOf& zero);

}  // namespace springfold::continuation
