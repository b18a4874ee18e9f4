// Parallel branches, close together.
#include <cmath>
#include <numbers>

#include "families.hpp"
#include "one_unknown.hpp"

namespace springfold::known_answers {

Draw strands(Random& random) {
  using std::numbers::pi;
  Draw draw{.family = "strands", .size = 2};
  draw.gap = closeness(random);
  const double d = draw.gap * draw.size, H = uniform(random, -1, 1);
  const double w = log_uniform(random, 0.05, 1);
  const double strand = (choice(random, 7) - 3) * d;
  draw.base = one_unknown([=](double x, double lambda, double& F, double& F_x, double& F_l) {
    const double t = std::tanh(lambda / w), angle = pi * (x - H * t) / d;
    F = d / pi * std::sin(angle);
    F_x = std::cos(angle);
    F_l = -std::cos(angle) * H * (1 - t * t) / w;
  });
  draw.lambda_start = uniform(random, -0.9, -0.5);
  draw.z_start = scalar(H * std::tanh(draw.lambda_start / w) + strand);
  limit_lambda(draw, -1, 1);
  draw.on_curve = [=](const Vector& z, double lambda) {
    return std::abs(z[0] - H * std::tanh(lambda / w) - strand) < 0.5 * d;
  };
  draw.parameter = [](const Vector&, double lambda) { return lambda; };
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
