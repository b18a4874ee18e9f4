#include "setup.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "quantities.hpp"
#include "spring_origins.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/scaling.hpp"
#include "springfold/model/axis_of_turn.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "units.hpp"

namespace springfold::analysis {
namespace {

/// Orthonormal basis of what is orthogonal to a direction, smooth in it: unknowns of neighbouring members of a family
/// belong to each other. In the plane all around; in more dimensions, where there is none such, the reflection that
/// takes the first axis to the direction's opposite, but for directions that all but are that opposite.
Matrix smooth_basis_across(const Vector& direction) {
  constexpr double all_but = -0.9;  // cosine
  const Vector d = direction.normalized();
  if (d.size() == 2) return Vector{{-d[1], d[0]}};
  const Vector v = d + (d[0] > all_but ? 1 : -1) * Vector::Unit(d.size(), 0);
  const Matrix reflection =
      Matrix::Identity(d.size(), d.size()) - 2 / v.squaredNorm() * v * v.transpose();
  return reflection.rightCols(d.size() - 1);
}

/// Orthonormal basis of the pose coordinates that stay free beside `direction`.
Matrix free_directions(ControlMode control, const Vector& direction,
                       const std::vector<Index>& prescribed, Index d) {
  if (control == ControlMode::pose) return Matrix(d, 0);
  if (control != ControlMode::mixed) return Matrix::Identity(d, d);
  if (!prescribed.empty()) {
    Matrix N(d, d - static_cast<Index>(prescribed.size()));
    Index column = 0;
    for (Index i = 0; i < d; ++i)
      if (std::find(prescribed.begin(), prescribed.end(), i) == prescribed.end())
        N.col(column++) = Vector::Unit(d, i);
    return N;
  }
  return smooth_basis_across(direction);
}

/// Largest rate in units of the scales sets the scale of lambda, again a power of two.
double lambda_scale_for(const Vector& rate, const Vector& units) {
  return 1 / power_of_two_near(rate.cwiseQuotient(units).lpNorm<Eigen::Infinity>());
}

/// Loads that grow with lambda, each in units of the scales: the largest entry of any.
double largest_load_rate(const model::Mechanism& dimensionless) {
  double largest = 0;
  for (const model::Load& load : dimensionless.loads)
    if (load.with_lambda) largest = std::max(largest, load.vector.lpNorm<Eigen::Infinity>());
  return largest;
}

/// Factors of the mechanism's loads, constant part and rate.
void set_load_factors(Setup& setup) {
  const auto& loads = setup.system.mechanism.loads;
  const auto n = static_cast<Index>(loads.size());
  setup.rule.load_start = Vector::Ones(n);
  setup.rule.load_rate = Vector::Zero(n);
  for (Index i = 0; i < n; ++i)
    if (loads[static_cast<std::size_t>(i)].with_lambda) {
      setup.rule.load_start[i] = 0;
      setup.rule.load_rate[i] = setup.lambda_scale;
    }
}

Vector body_load(const statics::System& system, const Study& study, const Vector& load,
                 const Scales& scales) {
  Vector W = Vector::Zero(system.load_size);
  if (load.size() == 0) return W;
  const auto b = static_cast<std::size_t>(study.body - 1);
  W.segment(system.body_slices[b].W, system.body_slices[b].count) =
      load.cwiseQuotient(wrench_scales(system.mechanism.bodies[b].task_space, scales));
  return W;
}

/// Natural size of a parameter: its start value, or the range it is to run through.
double parameter_scale(const Study& study, double start) {
  double size = std::abs(start);
  for (const Limit& limit : study.until)
    if (limit.quantity == "lambda")
      for (const double end : {limit.low, limit.high})
        if (std::isfinite(end) && size == 0) size = std::abs(end);
  return power_of_two_near(size);
}

void set_control(const Study& study, const ParameterFamily* family, const Origins& origins,
                 const Units& wanted, Setup& setup) {
  const auto unit_of_lambda = [&wanted](double natural) { return wanted.lambda.value_or(natural); };
  const auto b = static_cast<std::size_t>(study.body - 1);
  const model::TaskSpace space = setup.system.mechanism.bodies[b].task_space;
  const Index d = dimension(space);
  PathRule& rule = setup.rule;
  rule.t_rate = Vector::Zero(d);
  rule.rho_rate = Vector::Zero(setup.system.commands.size());
  rule.W_rate = Vector::Zero(setup.system.load_size);
  switch (study.control) {
    case ControlMode::load: {
      const Vector units = wrench_scales(space, setup.scales);
      double largest = largest_load_rate(setup.system.mechanism);
      if (study.direction.size() > 0)
        largest = std::max(largest, study.direction.cwiseQuotient(units).lpNorm<Eigen::Infinity>());
      setup.lambda_scale = unit_of_lambda(1 / power_of_two_near(largest));
      if (study.direction.size() == 0) break;
      rule.W_rate.segment(setup.system.body_slices[b].W, d) =
          study.direction.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::pose:
    case ControlMode::mixed: {
      const Vector units = pose_scales(space, setup.scales);
      setup.lambda_scale = unit_of_lambda(lambda_scale_for(study.direction, units));
      rule.t_rate = study.direction.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::actuator: {
      Vector rate = Vector::Zero(setup.system.commands.size()), units = Vector::Ones(rate.size());
      for (Index i = 0; i < rate.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (setup.system.command_is_length[k]) units[i] = setup.scales.length;
        for (const ActuatorRate& r : study.actuators)
          if (r.actuator == setup.system.command_names[k]) rate[i] = r.rate;
      }
      setup.lambda_scale = unit_of_lambda(lambda_scale_for(rate, units));
      rule.rho_rate = rate.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::parameter: {
      assert(family != nullptr);
      const double natural = parameter_scale(study, family->value);
      setup.lambda_scale = unit_of_lambda(natural);
      rule.family_step *= natural / setup.lambda_scale;
      setup.lambda_start = family->value / setup.lambda_scale;
      const Scales scales = setup.scales;
      const double unit = setup.lambda_scale;
      const Index redundant = setup.system.redundant;
      // A copy: the rule outlives what it was made from.
      rule.family = [at = family->at, study, scales, unit, redundant, origins](double lambda) {
        const Situation now = at(unit * lambda);
        statics::System system =
            statics::prepare(with_origins(dimensionless(now.mechanism, scales), origins));
        system.redundant = redundant;
        Vector W = body_load(system, study, now.constant_load, scales);
        return std::pair{std::move(system), std::move(W)};
      };
      break;
    }
  }
}

}  // namespace

std::vector<std::string> non_conservative_loads(const model::Mechanism& mechanism,
                                                const Study& study) {
  std::vector<std::string> list;
  // A parameter may tilt an axis, and what turned about one direction turns about two.
  const model::AxesOfTurn turns = study.control == ControlMode::parameter
                                      ? model::AxesOfTurn(mechanism.bodies.size())
                                      : axes_of_turn(mechanism);
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    model::Load load = mechanism.loads[i];
    // A parameter may make a load of what is zero at the start.
    if (study.control == ControlMode::parameter && load.vector.isZero(0)) load.vector.setOnes();
    if (is_conservative(mechanism, turns, load)) continue;
    const std::string kind = load.kind == model::LoadKind::force ? "force" : "moment";
    list.push_back((load.follows ? "follower " : "fixed-axis ") + kind + " " +
                   (load.name.empty() ? std::to_string(i + 1) : load.name));
  }
  const auto body = static_cast<std::size_t>(study.body - 1);
  if (mechanism.bodies[body].task_space != model::TaskSpace::spatial) return list;
  const bool drives = study.kind == StudyKind::force_deflection &&
                      study.control == ControlMode::load && study.direction.size() > 0 &&
                      !study.direction.tail(3).isZero(0);
  const bool loads = study.constant_load.size() > 0 && !study.constant_load.tail(3).isZero(0);
  if ((drives || loads) && !turns[body])
    list.push_back("fixed-axis moment on " + mechanism.bodies[body].name);
  return list;
}

namespace {

Setup set_up_in(const Scales& scales, const model::Mechanism& mechanism, const Study& study,
                const ParameterFamily* family, const Units& units, const Setup* like,
                statics::System* spare) {
  Setup setup;
  setup.scales = scales;
  model::Mechanism own = dimensionless(mechanism, setup.scales);
  setup.system = spare != nullptr ? statics::prepare(std::move(own), std::move(*spare))
                                  : statics::prepare(own);
  const auto b = static_cast<std::size_t>(study.body - 1);
  const model::TaskSpace space = setup.system.mechanism.bodies[b].task_space;
  Vector z = statics::guess(setup.system);
  if (study.start.pose.size() > 0)
    z.segment(setup.system.body_slices[b].t, dimension(space)) =
        study.start.pose.cwiseQuotient(pose_scales(space, setup.scales));
  auto origins = spring_origins(setup.system.mechanism, study, setup.system, z);
  setup.origins_found = origins.has_value();
  if (!origins) origins = Origins{};
  if (!origins->empty())
    setup.system = statics::prepare(with_origins(setup.system.mechanism, *origins));
  setup.redundancy = like != nullptr
                         ? like->redundancy
                         : statics::redundant_closures(setup.system, z, setup.system.commands);
  setup.system.redundant = setup.redundancy.count;
  setup.rule.body = study.body;
  setup.rule.length = setup.scales.length;
  setup.rule.W_start = body_load(setup.system, study, study.constant_load, setup.scales);
  if (study.kind == StudyKind::force_deflection) {
    set_control(study, family, *origins, units, setup);
  } else {
    setup.rule.t_rate = Vector::Zero(dimension(space));
    setup.rule.rho_rate = Vector::Zero(setup.system.commands.size());
    setup.rule.W_rate = Vector::Zero(setup.system.load_size);
  }
  const bool traces = study.kind == StudyKind::force_deflection;
  const ControlMode free = traces ? study.control : ControlMode::load;
  setup.rule.N = free_directions(free, study.direction, prescribed_coordinates(study, space),
                                 dimension(space));
  set_load_factors(setup);
  setup.rule.symmetric = non_conservative_loads(mechanism, study).empty();
  return setup;
}

}  // namespace

Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family,
             const Setup* like, statics::System* spare) {
  const Scales own = like != nullptr ? like->scales : scales_for(mechanism, study.constant_load);
  Units units{own.force, {}};
  if (like != nullptr) units.lambda = like->lambda_scale;
  return set_up_in(own, mechanism, study, family, units, like, spare);
}

Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family,
             const Units& units) {
  Scales scales = scales_for(mechanism, study.constant_load);
  scales.force = units.force;
  return set_up_in(scales, mechanism, study, family, units, nullptr, nullptr);
}

}  // namespace springfold::analysis
