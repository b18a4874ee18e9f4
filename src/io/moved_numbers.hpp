// Numbers of parts of a mechanism that is there already (mechanism_draft.cpp). Private to io.
#pragma once

#include <vector>

#include "mechanism_draft.hpp"

namespace springfold::io {

/// Stiffness and free values of a spring that couples joints.
void put_numbers(const CoupledDraft& draft, const std::vector<double>& numbers,
                 model::CoupledSpring& spring);

/// Of a force or moment; of a pressure its first entry counts.
model::Vec3<double> load_vector_of(const LoadDraft& draft, const std::vector<double>& numbers);

}  // namespace springfold::io
