// The step of derivatives by complex numbers: no subtraction, so no cancellation.
#pragma once

namespace springfold::model {

inline constexpr double tiny = 1e-30;

}  // namespace springfold::model
