#include "continuation/points/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "continuation/points/coincide.hpp"
#include "continuation/points/words.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Angle between two unit directions; accurate for small ones.
double angle_between(const Vector& weights, const Direction& a, const Direction& b) {
  const double dlambda = a.dlambda - b.dlambda;
  const double half_chord =
      0.5 * std::sqrt((weights.array() * (a.dx - b.dx).array().square()).sum() + dlambda * dlambda);
  return 2 * std::asin(std::min(1.0, half_chord));
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

bool find_point(const Walker& walker, const Piece& piece, const Direction& reference,
                CurvePoint& point, StepReport* report) {
  StepReport unasked;
  auto& [measures, refusal] = report ? *report : unasked;
  Workspace& memory = *walker.memory;
  NewtonResult& newton = memory.newton;
  newton.x.swap(point.x);
  newton.lambda = point.lambda;
  correct(walker.problem, walker.weights, piece, reference, walker.options.newton, memory);
  measures = {.contraction = newton.contraction,
              .deviation = newton.corrections.empty() ? 0 : newton.corrections.front()};
  if (!converged(newton)) {
    refusal = to_string(newton.status);
    if (newton.status == NewtonStatus::diverges)
      refusal += ", contraction " + rounded(newton.contraction);
    return false;
  }
  point.x.swap(newton.x);
  point.lambda = newton.lambda;
  LinearisedPoint* const place =
      linearised_at(walker.problem, memory, point.x, point.lambda, piece);
  if (!place) {
    refusal = to_string(NewtonStatus::outside_domain);
    return false;
  }
  if (!tangent_at(memory, *place, walker.weights, reference, point.tangent)) {
    refusal = "no unique tangent";
    return false;
  }
  point.piece = piece;
  point.negative.reset();
  if (walker.problem.symmetric()) point.negative = place->factors.negative();
  measures.turn = angle_between(walker.weights, point.tangent, reference);
  return true;
}

Vector rounding_of_rows(const Linearisation& at, const Vector& weights, const Vector& x,
                        double lambda) {
  Vector sizes = x.cwiseAbs();
  for (Index i = 0; i < sizes.size(); ++i)
    if (weights[i] > 0) sizes[i] = std::max(1.0, sizes[i]);
  return few_roundings * (magnitudes(at, sizes) + std::abs(lambda) * at.dF_dlambda.cwiseAbs());
}

bool rounding_of_rows(const Walker& walker, const Piece& piece, const CurvePoint& point,
                      Vector& rounding) {
  const LinearisedPoint* const place =
      linearised_at(walker.problem, *walker.memory, point.x, point.lambda, piece);
  if (!place) return false;
  rounding = rounding_of_rows(place->at, walker.weights, point.x, point.lambda);
  return true;
}

namespace {

/// Puts point - from - ahead tangent into storage. @returns its length
double off_straight(const Walker& walker, const CurvePoint& from, double ahead,
                    const CurvePoint& point) {
  Direction& d = walker.memory->direction;
  d.dx = point.x - from.x - ahead * from.tangent.dx;
  d.dlambda = point.lambda - from.lambda - ahead * from.tangent.dlambda;
  return length_of(walker, d);
}

}  // namespace

bool expect(const Walker& walker, const ArcModel* model, const CurvePoint& origin, double ahead,
            CurvePoint& point) {
  // Twice as far as the model is long it shows the curve no more.
  if (model == nullptr || model->empty() || ahead > 2 * (model->end() - model->begin()))
    return false;
  model->point(walker.weights, origin, ahead, point);
  return off_straight(walker, origin, ahead, point) <= small_share * ahead;
}

bool try_step(const Walker& walker, const CurvePoint& from, double ds, const ArcModel* model,
              CurvePoint& to, StepReport& report) {
  auto& [measures, refusal] = report;
  const bool expected = expect(walker, model, from, ds, to);
  if (!expected) {
    to.x = from.x + ds * from.tangent.dx;
    to.lambda = from.lambda + ds * from.tangent.dlambda;
  }
  to.s = from.s + ds;
  const bool found = find_point(walker, from.piece, from.tangent, to, &report);
  if (found && expected) measures.deviation = off_straight(walker, from, ds, to);
  measures.deviation /= ds;
  if (!found) return false;
  refusal = judge(measures, walker.options.step);
  return refusal.empty();
}

StepResult try_step(const Walker& walker, const CurvePoint& from, double ds) {
  StepResult result;
  CurvePoint to;
  if (try_step(walker, from, ds, nullptr, to, result)) result.point = std::move(to);
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
