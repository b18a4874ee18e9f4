// Special points of the engine that say one thing together. Private to analysis.
#pragma once

#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

class Evaluator;

/// The curve with special points that belong to others put together with them:
///  - an extremum of the force at a branch point, where the curve turns, is said by the branch point;
///  - an extremum of the force at a switching beyond which the force stands still is none;
///  - remarks on a special point are words of it;
///  - a place where only the count of negative eigenvalues in the engine's own piece changes, beside springs
///    at rest, is none: nothing switches there, and stability is decided on all pieces together;
///  - nor is a breakpoint between segments of one stiffness, where the law goes straight on.
continuation::Curve with_hits_merged(continuation::Curve curve, const Evaluator& evaluator);

}  // namespace springfold::analysis
