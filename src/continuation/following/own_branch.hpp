// Does a step end on the branch that it began on? Private to the engine.
#pragma once

#include <string>

#include "continuation/points/arc.hpp"

namespace springfold::continuation {

/// Newton's method is drawn to the branch that is nearest. Where the matrix hardly changes within the length of its first
/// correction, that is where it came from; elsewhere nothing says which branch a step along the tangent has found.
/// To be asked right after the correction, whose lengths the working memory holds.
/// @param ds       length of the step
/// @param refusal  why, if so
bool may_be_another(const Walker& walker, const CurvePoint& to, double ds, std::string& refusal);

/// The curve through the step's middle as well, which was found by itself, must lead nearer to the step's end than the one from
/// behind the step alone: on a smooth curve its error is smaller by an order of magnitude, while another branch is as far
/// from the one as from the other. In a cluster, where rounding moves points by more than places are wide, nothing is asked.
/// @param behind  the model of the curve up to the step
/// @param before  the last point before `here` that it knows
bool leads_on(const Walker& walker, const ArcModel& behind, const CurvePoint& before,
              const CurvePoint& here, const CurvePoint& middle, const CurvePoint& to);

}  // namespace springfold::continuation
