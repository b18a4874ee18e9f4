#include "springfold/continuation/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "words.hpp"

namespace springfold::continuation {
namespace {

/// Angle between two unit directions; accurate for small ones.
double angle_between(const Vector& weights, const Direction& a, const Direction& b) {
  const double dlambda = a.dlambda - b.dlambda;
  const double half_chord =
      0.5 * std::sqrt((weights.array() * (a.dx - b.dx).array().square()).sum() + dlambda * dlambda);
  return 2 * std::asin(std::min(1.0, half_chord));
}

StepResult refused(std::string why, const StepMeasures& measures = {}) {
  return {.measures = measures, .refusal = std::move(why)};
}

std::string judge(const StepMeasures& m, const StepOptions& options) {
  if (m.turn > options.turn)
    return "tangent turned by " + rounded(m.turn * 180 / std::numbers::pi) + " deg";
  if (m.contraction > options.contraction) return "corrector contraction " + rounded(m.contraction);
  if (m.deviation > options.deviation)
    return "corrected point is " + rounded(m.deviation) + " steps from the predicted one";
  return {};
}

}  // namespace

StepResult point_on_curve(const Walker& walker, Vector x, double lambda, const Piece& piece,
                          const Direction& reference) {
  NewtonResult newton = correct(walker.problem, walker.weights, std::move(x), lambda, piece,
                                reference, walker.options.newton, walker.storage);
  StepResult result;
  result.measures.contraction = newton.contraction;
  result.measures.deviation = newton.corrections.empty() ? 0 : newton.corrections.front();
  if (!converged(newton)) {
    result.refusal = std::string(to_string(newton.status));
    if (newton.status == NewtonStatus::diverges)
      result.refusal += ", contraction " + rounded(newton.contraction);
    return result;
  }
  Linearisation& at = walker.storage.at;
  if (!linearise(walker.problem, newton.x, newton.lambda, piece, at))
    return refused(std::string(to_string(NewtonStatus::outside_domain)), result.measures);
  auto tangent = tangent_at(at, walker.weights, reference);
  if (!tangent) return refused("no unique tangent", result.measures);
  CurvePoint point{.x = std::move(newton.x),
                   .lambda = newton.lambda,
                   .tangent = std::move(*tangent),
                   .piece = piece};
  if (walker.problem.symmetric()) point.negative = negative_eigenvalues(at);
  result.measures.turn = angle_between(walker.weights, point.tangent, reference);
  result.point = std::move(point);
  return result;
}

StepResult try_step(const Walker& walker, const CurvePoint& from, double ds) {
  StepResult result =
      point_on_curve(walker, from.x + ds * from.tangent.dx, from.lambda + ds * from.tangent.dlambda,
                     from.piece, from.tangent);
  result.measures.deviation /= ds;
  if (!result.point) return result;
  std::string why = judge(result.measures, walker.options.step);
  if (!why.empty()) return refused(std::move(why), result.measures);
  result.point->s = from.s + ds;
  return result;
}

double next_step_length(double ds, const StepMeasures& m, const StepOptions& options) {
  // turn and deviation grow like ds, the contraction like its square
  const auto room = [&](double limit, double measured) {
    return measured > 0 ? options.aim * limit / measured : std::numeric_limits<double>::infinity();
  };
  const double factor =
      std::min({options.growth, room(options.turn, m.turn), room(options.deviation, m.deviation),
                std::sqrt(room(options.contraction, m.contraction))});
  return std::clamp(ds * std::max(factor, 0.3), options.minimum, options.maximum);
}

}  // namespace springfold::continuation
