// Integrals of smooth functions. Private to model.
#pragma once

#include <functional>

namespace springfold::model {

/// Integral of f from a to b, adaptively to about 1e-15 of the integral of |f|.
/// Not finite where f is not.
double integral(const std::function<double(double)>& f, double a, double b);

}  // namespace springfold::model
