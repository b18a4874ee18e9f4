#include "load_error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "frozen.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::analysis {
namespace {

/// |dlambda/ds| along the branch, the larger of both sides; 0 where it is not known.
double rate_of_lambda(const Tracing& t, const Event& event) {
  const std::size_t lambda = column_of(QuantityDefinition::Kind::lambda, t.quantities);
  double rate = 0;
  for (const std::vector<double>* rates : {&event.rates_before, &event.rates_after})
    if (lambda < rates->size() && std::isfinite((*rates)[lambda]))
      rate = std::max(rate, std::abs((*rates)[lambda]) / t.lambda_scale);
  return rate;
}

}  // namespace

LoadError error_of_load(const Tracing& t, const Event& event, const Landscape& landscape,
                        double lambda) {
  // The unknowns of a frozen problem, but with what lambda does.
  PathRule rule = t.problem.rule();
  rule.quaternions = false;
  const auto loaded = std::make_shared<PathProblem>(t.problem.system(lambda), rule);
  return {continuation::promised_place * rate_of_lambda(t, event),
          [loaded, lambda, &landscape](const Vector& x, const Piece& piece) -> Vector {
            Matrix dF_dx;
            Vector dF_dlambda;
            if (!loaded->derivatives(x, lambda, piece, dF_dx, dF_dlambda)) return {};
            return dF_dlambda(landscape.moving());
          }};
}

}  // namespace springfold::analysis
