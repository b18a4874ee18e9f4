// Why a curve took as many points as allowed. Private to the engine.
#pragma once

#include <string>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// In words: how far the curve went, what its last steps were like, and which options let it go on or end it.
std::string why_so_many(const Walker& walker, const Curve& curve);

}  // namespace springfold::continuation
