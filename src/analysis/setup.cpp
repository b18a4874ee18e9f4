#include "setup.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "quantities.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold::analysis {
namespace {

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
  const Eigen::HouseholderQR<Matrix> qr(direction);
  const Matrix Q = qr.householderQ() * Matrix::Identity(d, d);
  return Q.rightCols(d - 1);
}

/// Largest rate in units of the scales sets the scale of lambda, again a power of two.
double lambda_scale_for(const Vector& rate, const Vector& units) {
  return 1 / power_of_two_near(rate.cwiseQuotient(units).lpNorm<Eigen::Infinity>());
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

void set_control(const Study& study, const ParameterFamily* family, Setup& setup) {
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
      setup.lambda_scale = lambda_scale_for(study.direction, units);
      rule.W_rate.segment(setup.system.body_slices[b].W, d) =
          study.direction.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::pose:
    case ControlMode::mixed: {
      const Vector units = pose_scales(space, setup.scales);
      setup.lambda_scale = lambda_scale_for(study.direction, units);
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
      setup.lambda_scale = lambda_scale_for(rate, units);
      rule.rho_rate = rate.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::parameter: {
      assert(family != nullptr);
      setup.lambda_scale = parameter_scale(study, family->value);
      setup.lambda_start = family->value / setup.lambda_scale;
      const Scales scales = setup.scales;
      const double unit = setup.lambda_scale;
      rule.family = [family, study, scales, unit](double lambda) {
        const Situation now = family->at(unit * lambda);
        statics::System system = statics::prepare(dimensionless(now.mechanism, scales));
        Vector W = body_load(system, study, now.constant_load, scales);
        return std::pair{std::move(system), std::move(W)};
      };
      break;
    }
  }
}

}  // namespace

Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family) {
  Setup setup;
  setup.scales = scales_for(mechanism, study.constant_load);
  setup.system = statics::prepare(dimensionless(mechanism, setup.scales));
  const auto b = static_cast<std::size_t>(study.body - 1);
  const model::TaskSpace space = setup.system.mechanism.bodies[b].task_space;
  setup.rule.body = study.body;
  setup.rule.length = setup.scales.length;
  setup.rule.W_start = body_load(setup.system, study, study.constant_load, setup.scales);
  if (study.kind == StudyKind::force_deflection) {
    set_control(study, family, setup);
  } else {
    setup.rule.t_rate = Vector::Zero(dimension(space));
    setup.rule.rho_rate = Vector::Zero(setup.system.commands.size());
    setup.rule.W_rate = Vector::Zero(setup.system.load_size);
  }
  const bool traces = study.kind == StudyKind::force_deflection;
  const ControlMode free = traces ? study.control : ControlMode::load;
  setup.rule.N = free_directions(free, study.direction, prescribed_coordinates(study, space),
                                 dimension(space));
  if (space == model::TaskSpace::spatial)
    for (const Vector* load : {&setup.rule.W_start, &setup.rule.W_rate})
      if (!load->segment(setup.system.body_slices[b].W + 3, 3).isZero(0))
        setup.rule.symmetric = false;
  return setup;
}

}  // namespace springfold::analysis
