// Why a start was not found, in terms of chains, poses and coordinates. Private to analysis.
#pragma once

#include "setup.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {

/// Fills message, where and advice of a report whose start was not found: which chain is short by how
/// much, which motion nothing resists, which forces are left.
void explain_failure(const Setup& setup, const Study& study, const statics::StartProblem& problem,
                     const statics::FirstEquilibrium& first, StartReport& report);

/// The same where the chains cannot be closed in the start pose, from which springs with origin = "start" are counted.
void explain_origins(const Setup& setup, const Study& study, statics::StartProblem problem,
                     StartReport& report);

/// The motions without stiffness at a state, by the coordinates that move most: "tool.x, leg.knee";
/// several of them separated by ";". Empty where there are none.
/// @param z  closed state with its wrenches
std::string free_motions(const statics::System& system, const Vector& z,
                         const statics::Inputs& inputs);

}  // namespace springfold::analysis
