// The start point of a study. Private to analysis.
#pragma once

#include "setup.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {

/// Finds the first equilibrium as the study says and reports how it went. One that lies farther from
/// its guess than the study allows counts as not found.
statics::FirstEquilibrium find_start(const Setup& setup, const Study& study, StartReport& report);

/// The first state, what is given and what is looked for.
statics::StartProblem start_problem(const Setup& setup, const Study& study);
/// @param body  of the study
statics::StartProblem start_problem(const Setup& setup, Index body, const StartOptions& options);

/// A start that was held by a wrench stays held in the directions that the study leaves free.
void hold_free_part(const Study& study, const statics::FirstEquilibrium& first, Setup& setup);

/// The state from which the search for the start begins.
Vector start_guess(const Setup& setup, const Study& study);

/// Number of negative eigenvalues at a point, where the problem is symmetric and none is zero.
void count_negative(const PathProblem& problem, continuation::CurvePoint& point);

}  // namespace springfold::analysis
