#include "quantities.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "resting.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

bool along_translation(const Vector& direction, Index lengths) {
  return direction.size() > 0 && !direction.head(lengths).isZero(0);
}

bool has_force(ControlMode control) {
  return control == ControlMode::load || control == ControlMode::pose ||
         control == ControlMode::mixed;
}

}  // namespace

bool is_continuous(const QuantityDefinition& q) {
  switch (q.kind) {
    case Kind::lambda:
    case Kind::deflection:
    case Kind::force:
    case Kind::unknown:
    case Kind::command:
    case Kind::energy:
      return true;
    case Kind::arc_length:
    case Kind::stiffness:
    case Kind::eigenvalue:
    case Kind::index_pose:
    case Kind::index_force:
    case Kind::index:
      return false;
  }
  return false;
}

Vector measured_direction(const Study& study, model::TaskSpace space) {
  Vector direction = study.direction;
  if (direction.size() == 0) return direction;
  const Index lengths = translations(space);
  if (along_translation(direction, lengths)) direction.tail(direction.size() - lengths).setZero();
  return direction / direction.norm();
}

std::vector<Index> prescribed_coordinates(const Study& study, model::TaskSpace space) {
  const std::vector<std::string> names = statics::pose_names(space);
  std::vector<Index> list;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(study.prescribed.begin(), study.prescribed.end(), names[i]) !=
        study.prescribed.end())
      list.push_back(static_cast<Index>(i));
  return list;
}

Unit lambda_unit_of(const Study& study, const statics::System& system) {
  const auto body = static_cast<std::size_t>(study.body - 1);
  const Index lengths = translations(system.mechanism.bodies[body].task_space);
  const bool moves = along_translation(study.direction, lengths);
  switch (study.control) {
    case ControlMode::load:
      return moves ? Unit::force : Unit::moment;
    case ControlMode::pose:
    case ControlMode::mixed:
      return moves ? Unit::length : Unit::angle;
    case ControlMode::actuator: {
      bool slides = false, turns = false;
      for (std::size_t i = 0; i < system.command_names.size(); ++i)
        for (const ActuatorRate& rate : study.actuators)
          if (rate.actuator == system.command_names[i])
            (system.command_is_length[i] ? slides : turns) = true;
      return slides == turns ? Unit::none : slides ? Unit::length : Unit::angle;
    }
    case ControlMode::parameter:
      return Unit::none;
  }
  return Unit::none;
}

std::vector<QuantityDefinition> quantities_of(const Study& study, const statics::System& system,
                                              const Scales& scales, double lambda_scale,
                                              Unit lambda_unit) {
  std::vector<QuantityDefinition> list;
  const auto body = static_cast<std::size_t>(study.body - 1);
  const Index lengths = translations(system.mechanism.bodies[body].task_space);
  const bool moves = along_translation(study.direction, lengths);
  list.push_back({Kind::arc_length, 0, "s", Unit::none, 1});
  list.push_back({Kind::lambda, 0, "lambda", lambda_unit, lambda_scale});
  if (study.direction.size() > 0)
    list.push_back({Kind::deflection, 0, "deflection", moves ? Unit::length : Unit::angle,
                    moves ? scales.length : 1});
  if (study.direction.size() > 0 && has_force(study.control))
    list.push_back({Kind::force, 0, "force", moves ? Unit::force : Unit::moment,
                    moves ? scales.force : scales.moment()});
  if (study.direction.size() > 0)
    list.push_back({Kind::stiffness, 0, "stiffness",
                    moves ? Unit::stiffness : Unit::rotational_stiffness,
                    moves ? scales.force / scales.length : scales.moment()});

  const Vector factors = unknown_scales(system, scales);
  const auto add_unknown = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const Unit unit = system.is_wrench[k] ? (system.is_length[k] ? Unit::force : Unit::moment)
                                          : (system.is_length[k] ? Unit::length : Unit::angle);
    list.push_back({Kind::unknown, i, system.coordinate_names[k], unit, factors[i]});
  };
  for (Index i = system.first_pose; i < system.size; ++i) add_unknown(i);
  for (Index i = 0; i < system.first_pose; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  for (std::size_t i = 0; i < system.command_names.size(); ++i) {
    const bool length = system.command_is_length[i];
    list.push_back({Kind::command, static_cast<Index>(i), system.command_names[i] + ".rho",
                    length ? Unit::length : Unit::angle, length ? scales.length : 1});
  }
  for (Index i = 0; i < system.first_pose; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  for (Index i = 0; i < std::min<Index>(3, system.load_size); ++i)
    list.push_back({Kind::eigenvalue, i, "K_eig" + std::to_string(i + 1), Unit::stiffness,
                    scales.force / scales.length});
  list.push_back({Kind::index_pose, 0, "index_pose", Unit::none, 1});
  list.push_back({Kind::index_force, 0, "index_force", Unit::none, 1});
  list.push_back({Kind::index, 0, "index", Unit::none, 1});
  list.push_back({Kind::energy, 0, "energy", Unit::energy, scales.moment()});
  return list;
}

Evaluator::Evaluator(const PathProblem& problem, const Study& study, const Scales& scales)
    : problem_{problem}, control_{study.control}, scales_{scales} {
  const auto body = static_cast<std::size_t>(study.body - 1);
  const statics::System& system = problem.layout();
  first_pose_ = system.first_pose;
  t_ = system.body_slices[body].t;
  d_ = system.body_slices[body].count;
  measured_ = measured_direction(study, system.mechanism.bodies[body].task_space);
  conjugate_ = problem.rule().t_rate;
  if (!conjugate_.isZero(0)) {
    // t_rate carries lambda's scale; the force goes with a unit displacement.
    conjugate_ /= measured_.dot(conjugate_);
  }
}

/// What the drive adds to the constant load, along the direction.
double Evaluator::force(const continuation::CurvePoint& point) const {
  if (control_ == ControlMode::load) {
    const double unit = measured_.dot(problem_.rule().W_rate);
    return point.lambda * unit;
  }
  statics::Workspace work;
  Vector r;
  equilibrium_residual(problem_.turned(point.x, point.lambda), point.piece,
                       problem_.local(point.x, point.lambda), problem_.inputs(point.lambda), work,
                       r);
  return conjugate_.dot(r.segment(t_, d_));
}

double Evaluator::value(const QuantityDefinition& q, const continuation::CurvePoint& point,
                        const Turns* turns) const {
  switch (q.kind) {
    case Kind::arc_length:
      return point.s;
    case Kind::lambda:
      return q.scale * point.lambda;
    case Kind::deflection:
      return q.scale * measured_.dot(problem_.expand(point.x, point.lambda, turns).segment(t_, d_) -
                                     problem_.rule().t_start);
    case Kind::force:
      return q.scale * force(point);
    case Kind::unknown:
      if (q.entry < first_pose_) return q.scale * point.x[q.entry];
      return q.scale * problem_.expand(point.x, point.lambda, turns)[q.entry];
    case Kind::command:
      return q.scale * problem_.inputs(point.lambda).rho[q.entry];
    case Kind::energy:
      return q.scale *
             spring_energy(problem_.system(point.lambda), problem_.expand(point.x, point.lambda));
    case Kind::index:
      return point.negative ? static_cast<double>(*point.negative - problem_.closures())
                            : undefined;
    case Kind::stiffness:
    case Kind::eigenvalue:
    case Kind::index_pose:
    case Kind::index_force: {
      const auto at = assemble(point);
      return at ? from_matrix(q, point, *at, turns) : undefined;
    }
  }
  return undefined;
}

std::optional<Evaluator::Assembled> Evaluator::assemble(
    const continuation::CurvePoint& point) const {
  Assembled at;
  const statics::System& system = problem_.turned_to_pose(point.x, point.lambda, at.z);
  Vector r;
  if (!equilibrium_matrix(system, point.piece, at.z, problem_.inputs(point.lambda), at.work, r,
                          at.A))
    return std::nullopt;
  at.platform = statics::platform_stiffness(system, at.A);
  if (problem_.symmetric())
    at.stability = statics::stability(system, at.A);
  else
    at.platform.eigenvalues.resize(0);  // counts and signs mean nothing without a potential
  return at;
}

double Evaluator::from_matrix(const QuantityDefinition& q, const continuation::CurvePoint& point,
                              const Assembled& at, const Turns* turns) const {
  const auto count = [](const std::optional<Index>& n) {
    return n ? static_cast<double>(*n) : undefined;
  };
  switch (q.kind) {
    case Kind::stiffness: {
      if (at.platform.K.size() == 0) return undefined;
      const Index first = t_ - problem_.system(point.lambda).first_pose;
      return q.scale * measured_.dot(at.platform.K.block(first, first, d_, d_) * measured_);
    }
    case Kind::eigenvalue:
      return q.entry < at.platform.eigenvalues.size() &&
                     std::isfinite(at.platform.eigenvalues[q.entry])
                 ? q.scale * at.platform.eigenvalues[q.entry]
                 : undefined;
    case Kind::index_pose:
      return count(at.stability.pose_controlled);
    case Kind::index_force:
      return count(at.stability.force_controlled);
    default:
      return value(q, point, turns);
  }
}

std::vector<double> Evaluator::values(const std::vector<QuantityDefinition>& quantities,
                                      const continuation::CurvePoint& point,
                                      const Turns* turns) const {
  const auto at = assemble(point);
  std::vector<double> values;
  values.reserve(quantities.size());
  for (const QuantityDefinition& q : quantities)
    values.push_back(at ? from_matrix(q, point, *at, turns) : undefined);
  raise_indices(quantities, point, values);
  return values;
}

void Evaluator::raise_indices(const std::vector<QuantityDefinition>& quantities,
                              const continuation::CurvePoint& point,
                              std::vector<double>& values) const {
  for (Piece& piece : pieces_around(problem_, point)) {
    if (piece == point.piece) continue;
    continuation::CurvePoint beside = point;
    beside.piece = std::move(piece);
    beside.negative.reset();
    count_negative(problem_, beside);
    const auto at = assemble(beside);
    for (std::size_t i = 0; at && i < quantities.size(); ++i) {
      const Kind kind = quantities[i].kind;
      if (kind == Kind::index || kind == Kind::index_pose || kind == Kind::index_force)
        values[i] = std::max(values[i], from_matrix(quantities[i], beside, *at, nullptr));
    }
  }
}

std::vector<double> Evaluator::rates(const std::vector<QuantityDefinition>& quantities,
                                     const continuation::CurvePoint& point,
                                     const Turns* turns) const {
  const double dlambda = point.tangent.dlambda;
  const Vector dz = problem_.expand_rate(point.x, point.tangent.dx, dlambda, turns);
  std::vector<double> rates;
  for (const QuantityDefinition& q : quantities) {
    double rate = undefined;
    if (q.kind == Kind::arc_length) rate = 1;
    if (q.kind == Kind::lambda) rate = dlambda;
    if (q.kind == Kind::deflection) rate = measured_.dot(dz.segment(t_, d_));
    if (q.kind == Kind::unknown) rate = dz[q.entry];
    if (q.kind == Kind::command && !problem_.rule().family)
      rate = dlambda * problem_.rule().rho_rate[q.entry];
    if (q.kind == Kind::force) rate = force_rate(point);

    rates.push_back(q.scale * rate);
  }
  return rates;
}

double Evaluator::force_rate(const continuation::CurvePoint& point) const {
  const double dlambda = point.tangent.dlambda;
  if (control_ == ControlMode::load) return dlambda * measured_.dot(problem_.rule().W_rate);
  statics::Workspace work;
  Vector r;
  Matrix A;
  if (!equilibrium_matrix(problem_.turned(point.x, point.lambda), point.piece,
                          problem_.local(point.x, point.lambda), problem_.inputs(point.lambda),
                          work, r, A))
    return undefined;
  const Matrix rows = A.middleRows(t_, d_);
  const Vector dz = problem_.local_rate(point.x, point.tangent.dx, dlambda);
  const double rate = conjugate_.dot(rows * dz);
  return std::abs(rate) > 1e-14 * rows.norm() ? rate : 0;
}

Matrix Evaluator::platform_stiffness(const continuation::CurvePoint& point) const {
  const auto at = assemble(point);
  if (!at || at->platform.K.size() == 0) return {};
  const statics::System& system = problem_.system(point.lambda);
  Vector pose(system.load_size), wrench(system.load_size);
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    const model::TaskSpace space = system.mechanism.bodies[b].task_space;
    pose.segment(system.body_slices[b].W, system.body_slices[b].count) =
        pose_scales(space, scales_);
    wrench.segment(system.body_slices[b].W, system.body_slices[b].count) =
        wrench_scales(space, scales_);
  }
  return wrench.asDiagonal() * in_world_axes(system, at->z, at->platform.K) *
         pose.cwiseInverse().asDiagonal();
}

std::vector<Index> Evaluator::closure_ranks(const continuation::CurvePoint& point) const {
  const auto at = assemble(point);
  if (!at) return {};
  std::vector<Index> ranks;
  for (const statics::ChainSlice& slice : problem_.system(point.lambda).chain_slices) {
    const Matrix J = at->A.block(slice.F, slice.x, slice.F_count, slice.x_count);
    const Vector values = J.jacobiSvd().singularValues();
    ranks.push_back((values.array() > 1e-7 * std::max(1.0, J.norm())).count());
  }
  return ranks;
}

std::vector<Matrix> Evaluator::chain_stiffnesses(const continuation::CurvePoint& point) const {
  const auto at = assemble(point);
  if (!at) return {};
  const statics::System& system = problem_.system(point.lambda);
  std::vector<Matrix> list;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const model::TaskSpace space = system.chains[i].space;
    const auto K = statics::chain_stiffness(system, i, at->A, at->work);
    list.push_back(K ? Matrix(wrench_scales(space, scales_).asDiagonal() * *K *
                              pose_scales(space, scales_).cwiseInverse().asDiagonal())
                     : Matrix());
  }
  return list;
}

}  // namespace springfold::analysis
