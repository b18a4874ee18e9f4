// Is a mechanism still one that may be given, all along a moved parameter? Private to analysis.
#pragma once

#include "quantities.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// The rows of a study that moves a parameter are looked at, up to 256 of them evenly: where a spring law falls that
/// may not, or a number is out of its range, the result has a doubt that names the value nearest to the start.
void doubt_broken_rules(const Study& study, const ParameterFamily& family,
                        const std::vector<QuantityDefinition>& quantities, StudyResult& result);

}  // namespace springfold::analysis
