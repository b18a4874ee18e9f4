#include "springfold/continuation/options.hpp"

namespace springfold::continuation {

std::vector<std::string> problems_in(const TraceOptions& options) {
  std::vector<std::string> problems;
  const StepOptions& step = options.step;
  if (!(0 < step.minimum && step.minimum <= step.initial && step.initial <= step.maximum))
    problems.push_back("step: need 0 < minimum <= initial <= maximum");
  if (!(step.contraction > 0 && step.turn > 0 && step.deviation > 0 && step.aim > 0))
    problems.push_back("step: contraction, turn, deviation and aim must be positive");
  if (!(step.growth > 1)) problems.push_back("step.growth: must be greater than 1");
  if (!(options.newton.residual_tolerance > 0))
    problems.push_back("newton.residual_tolerance: must be positive");
  if (options.newton.maximum_iterations < 1)
    problems.push_back("newton.maximum_iterations: must be at least 1");
  if (options.maximum_points < 2)
    problems.push_back("maximum_points: a curve needs at least 2 points");
  return problems;
}

}  // namespace springfold::continuation
