#include "springfold/core/differences.hpp"

#include <array>

namespace springfold {

std::optional<Vector> six_point_derivative(const std::function<std::optional<Vector>(double)>& f,
                                           double p, double h) {
  constexpr std::array<double, 3> weights{45, -9, 1};
  Vector sum;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double offset = static_cast<double>(k + 1) * h;
    const auto above = f(p + offset), below = f(p - offset);
    if (!above || !below) return std::nullopt;
    const Vector term = weights[k] * (*above - *below);
    sum = k == 0 ? term : Vector(sum + term);
  }
  return sum / (60 * h);
}

}  // namespace springfold
