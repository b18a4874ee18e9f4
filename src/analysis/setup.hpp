// A study made dimensionless and turned into a path rule. Private to analysis.
#pragma once

#include "path_problem.hpp"
#include "scales.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// A study made dimensionless.
struct Setup {
  Scales scales{};
  double lambda_scale = 1;  ///< physical lambda = lambda_scale * dimensionless lambda
  double lambda_start = 0;  ///< dimensionless
  statics::System system{};
  PathRule rule{};
};

/// @param family needed for control mode `parameter` only, otherwise nullptr
Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family);

}  // namespace springfold::analysis
