// Spring laws in a few words.
#pragma once

#include <string>

#include "springfold/model/spring_law.hpp"

namespace springfold::cli {

/// "polynomial law, free 1.2": which law, and where it is without force or begins to act.
std::string law_text(const model::SpringLaw& law);

}  // namespace springfold::cli
