// Which mechanisms differ in numbers alone. Private to statics.
#pragma once

#include "springfold/model/mechanism.hpp"

namespace springfold::statics {

/// Do chains and bodies of both take the same places in z, with the same names? What acts on them may differ.
bool has_form_of(const model::Mechanism& a, const model::Mechanism& b);

}  // namespace springfold::statics
