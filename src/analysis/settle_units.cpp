#include "settle_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/response.hpp"
#include "springfold/core/scaling.hpp"
#include "start.hpp"
#include "units.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

/// What a few operations leave of terms that cancel, relative to these.
constexpr double unit_rounding = 64 * std::numeric_limits<double>::epsilon();

/// Largest wrench of a chain and load of the study at the start; zero where they are nothing but rounding.
double largest_force(const PathProblem& problem, const statics::FirstEquilibrium& first,
                     const CurvePoint& start) {
  const statics::System& system = problem.layout();
  double largest = 0;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)])
      largest = std::max(largest, std::abs(first.z[i]));
  if (first.inputs.W.size() > 0)
    largest = std::max(largest, first.inputs.W.lpNorm<Eigen::Infinity>());
  continuation::Linearisation at;
  if (!continuation::linearise(problem, start.x, start.lambda, start.piece, at)) return 0;
  const Vector sizes = magnitudes(at, start.x);
  return largest > unit_rounding * sizes.lpNorm<Eigen::Infinity>() ? largest : 0;
}

/// A unit of lambda in that of the setup, no longer than the range that is asked for.
double within_range(const Study& study, const Setup& setup, double unit) {
  const double range = range_of_lambda(study, setup);
  return power_of_two_near(range > 0 ? std::min(unit, range) : unit);
}

/// The unit of lambda that the response asks for, in that of the setup: of moderate size where a parameter stands at a
/// large value, and no longer than the range that is asked for.
double lambda_unit(const Study& study, const Setup& setup, const CurvePoint& start, double unit) {
  constexpr double largest_lambda = 64;
  return within_range(study, setup, std::max(unit, std::abs(start.lambda) / largest_lambda));
}

/// Does what is driven answer to rounding alone, a parameter or a load beside the stiffest spring? So does a link whose
/// end is pressed by a force that follows it. Without springs, as under weights alone, loads have nothing to be small
/// beside.
bool answers_by_rounding(const Study& study, double unit, double stiffest) {
  if (study.control != ControlMode::load) return unit * unit_rounding >= 1;
  return stiffest > 0 && unit * unit_rounding >= stiffest;
}

/// Does the response say nothing of lambda, which then keeps its natural unit? Where a body without chains is driven,
/// lambda is the only way that there need be, as along an axis of symmetry.
bool is_only_way(const PathProblem& problem, const Study& study) {
  const bool driven = study.control == ControlMode::pose || study.control == ControlMode::mixed;
  return driven && problem.layout().first_pose == 0;
}

/// What a study is made of.
struct Given {
  const model::Mechanism& mechanism;
  const Study& study;
  const ParameterFamily* family;
};

/// @returns whether anything has changed
bool change_units(const Given& given, const Units& units, statics::FirstEquilibrium& first,
                  Setup& setup) {
  const double factor = units.force / setup.scales.force;
  const bool same = factor == 1 && units.lambda.value_or(setup.lambda_scale) == setup.lambda_scale;
  if (same || !std::isfinite(factor) || !(factor > 0)) return false;
  setup = set_up(given.mechanism, given.study, given.family, units);
  change_force_unit(setup.system, factor, first);
  return true;
}

/// @returns false where there is no response in the units at hand
bool settle(const Given& given, statics::FirstEquilibrium& first, Setup& setup) {
  // Once more where the first units were so far off that rounding may have spoilt the response.
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    Setup begun = setup;
    begin_at(given.study, first, begun);
    const PathProblem problem(begun.system, begun.rule);
    const CurvePoint start = start_point(problem, begun, first);
    const auto response = continuation::response_at(problem, start.x, start.lambda, start.piece);
    if (!response) return i > 0;
    const double stiffest =
        range_of_springs(given.mechanism, setup.scales.length).stiffest / setup.scales.force;
    const bool is_rounding =
        response->lambda && answers_by_rounding(given.study, *response->lambda, stiffest);
    // Where nothing is loaded no force shows its size: that of the least stiffness against loads, as far as springs are
    // as stiff.
    const double stiffness = std::min(response->stiffness, stiffest);
    const double multiplier = is_rounding ? 0 : response->multiplier;
    const double force = std::max({largest_force(problem, first, start), multiplier, stiffness});
    Units units{setup.scales.force * power_of_two_near(force), {}};
    if (response->lambda && !is_rounding && !is_only_way(problem, given.study))
      units.lambda = setup.lambda_scale * lambda_unit(given.study, setup, start, *response->lambda);
    if (!change_units(given, units, first, setup)) return true;
  }
  return true;
}

}  // namespace

double range_of_lambda(const Study& study, const Setup& setup) {
  double range = std::numeric_limits<double>::infinity();
  for (const Limit& limit : study.until)
    if (limit.quantity == "lambda")
      range = std::min(range, (limit.high - limit.low) / setup.lambda_scale);
  return range;
}

void begin_at(const Study& study, const statics::FirstEquilibrium& first, Setup& setup) {
  const auto b = static_cast<std::size_t>(study.body - 1);
  const auto& body = setup.system.body_slices[b];
  PathRule& rule = setup.rule;
  rule.rho_start = first.inputs.rho;
  if (study.kind == StudyKind::equilibria)
    rule.t_start = Vector::Zero(rule.t_rate.size());
  else
    rule.t_start = first.z.segment(body.t, body.count);
  hold_free_part(study, first, setup);
}

CurvePoint start_point(const PathProblem& problem, const Setup& setup,
                       const statics::FirstEquilibrium& first) {
  CurvePoint start;
  start.x = problem.reduce(first.z);
  start.lambda = setup.lambda_start;
  start.piece = first.piece;
  const continuation::NewtonOptions options;
  Vector F;
  const double scale = std::max(1.0, start.x.lpNorm<Eigen::Infinity>());
  if (!problem.residual(start.x, start.lambda, start.piece, F) || F.size() == 0 ||
      F.lpNorm<Eigen::Infinity>() <= options.residual_tolerance * scale)
    return start;
  constexpr double far = 1e-6;
  const continuation::Direction across{Vector::Zero(start.x.size()), 1};
  const auto solved = continuation::correct(problem, problem.metric(), start.x, start.lambda,
                                            start.piece, across, options);
  double moved = 0;
  for (const double step : solved.corrections) moved += step;
  if (continuation::converged(solved) && moved < far) start.x = solved.x;
  return start;
}

void settle_units(const model::Mechanism& mechanism, const Study& study,
                  const ParameterFamily* family, statics::FirstEquilibrium& first, Setup& setup) {
  const Given given{mechanism, study, family};
  if (settle(given, first, setup)) return;
  // Units that are off by the whole range of numbers hide what is regular: those of its ends may not. A spring hides
  // below `poor`.
  const auto [softest, stiffest] = range_of_springs(mechanism, setup.scales.length);
  const Units before{setup.scales.force, {}};
  const auto settles_in = [&](double force) {
    const Units units{power_of_two_near(force), {}};
    return change_units(given, units, first, setup) && settle(given, first, setup);
  };
  if (softest < continuation::poor * before.force && settles_in(softest)) return;
  if (settles_in(stiffest)) return;
  change_units(given, before, first, setup);
  // A start that is singular in any unit may be a critical point under the loads that act there: these are its size.
  Setup begun = setup;
  begin_at(study, first, begun);
  const PathProblem problem(begun.system, begun.rule);
  const double force = largest_force(problem, first, start_point(problem, begun, first));
  if (force > 0)
    change_units(given, {setup.scales.force * power_of_two_near(force), {}}, first, setup);
}

void enlarge_lambda_unit(const model::Mechanism& mechanism, const Study& study,
                         const ParameterFamily* family, double factor,
                         statics::FirstEquilibrium& first, Setup& setup) {
  const double unit = std::max(1.0, within_range(study, setup, factor));
  change_units({mechanism, study, family}, {setup.scales.force, unit * setup.lambda_scale}, first,
               setup);
}

bool is_of_many_sizes(double range) {
  return std::isfinite(range) && range >= long_beside_first_load * longest_straight_way;
}

void measure_lambda_in_parts(Setup& setup) { setup.rule.lambda_measure = {setup.lambda_start, 1}; }

void reach_range(const model::Mechanism& mechanism, const Study& study,
                 const ParameterFamily* family, statics::FirstEquilibrium& first, Setup& setup) {
  constexpr double rounding = 1e-12;
  const double longer = range_of_lambda(study, setup) / longest_straight_way;
  if (!(longer > 1) || !std::isfinite(longer)) return;
  Setup begun = setup;
  begin_at(study, first, begun);
  const PathProblem problem(begun.system, begun.rule);
  const CurvePoint start = start_point(problem, begun, first);
  continuation::Linearisation at;
  if (!continuation::linearise(problem, start.x, start.lambda, start.piece, at)) return;
  const continuation::Direction along{Vector::Zero(start.x.size()), 1};
  const auto tangent = continuation::tangent_at(at, problem.metric(), along);
  if (!tangent) return;
  const double dx = std::sqrt(tangent->dx.cwiseAbs2().dot(problem.metric()));
  if (!(dx <= rounding * std::abs(tangent->dlambda))) return;
  if (is_of_many_sizes(range_of_lambda(study, setup)))
    measure_lambda_in_parts(setup);
  else
    enlarge_lambda_unit(mechanism, study, family, power_of_two_near(longer), first, setup);
}

}  // namespace springfold::analysis
