// Dimensionless numbers of few parts of a mechanism (scales.cpp). Private to analysis.
#pragma once

#include "scales.hpp"
#include "springfold/model/moved_parts.hpp"

namespace springfold::analysis {

/// What dimensionless() gives of these parts, into what it gave for other numbers of them.
void put_dimensionless(const model::Mechanism& mechanism, const model::MovedParts& parts,
                       const Scales& scales, model::Mechanism& result);

}  // namespace springfold::analysis
