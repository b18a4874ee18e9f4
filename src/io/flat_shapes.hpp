// Folds that lie flat in a mechanism of the plane. Private to io.
#pragma once

#include <string>

#include "mechanism_draft.hpp"
#include "problems.hpp"

namespace springfold::io {

/// Folds whose points stay in the one plane in which a plane mechanism moves: their angle never changes, or jumps.
void check_flat_folds(const MechanismDraft& draft, const model::Mechanism& mechanism,
                      const std::string& when, Problems& problems);

}  // namespace springfold::io
