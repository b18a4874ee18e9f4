// A study made dimensionless and turned into a path rule. Private to analysis.
#pragma once

#include "path_problem.hpp"
#include "scales.hpp"
#include "springfold/analysis/study.hpp"
#include "springfold/statics/redundancy.hpp"

namespace springfold::analysis {

/// A study made dimensionless.
struct Setup {
  Scales scales{};
  double lambda_scale = 1;   ///< physical lambda = lambda_scale * dimensionless lambda
  double lambda_start = 0;   ///< dimensionless
  statics::System system{};  ///< knows its redundant closures
  statics::Redundancy redundancy{};
  bool origins_found = true;  ///< false: the chains cannot be closed in the start pose, from which
                              ///< some springs are counted
  PathRule rule{};
};

/// The loads of a study that have no potential, in words: "a follower force (load tip)".
/// @param mechanism  with the loads that act in this study
std::vector<std::string> non_conservative_loads(const model::Mechanism& mechanism,
                                                const Study& study);

/// @param family needed for control mode `parameter` only, otherwise nullptr
/// @param like  the set-up for another value of a parameter, whose scales, unit of lambda and redundant closures are
///              kept; nullptr: from the mechanism
/// @param spare  a system for another value that is not needed any more; its contents are used
Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family,
             const Setup* like = nullptr, statics::System* spare = nullptr);

}  // namespace springfold::analysis
