#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/undefined.hpp"
#include "closure_rank.hpp"
#include "point_quantities.hpp"
#include "quantities.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

}  // namespace

Evaluator::Evaluator(const PathProblem& problem, const Study& study, const Scales& scales)
    : problem_{problem} {
  renew(study, scales);
}

void Evaluator::renew(const Study& study, const Scales& scales) {
  control_ = study.control;
  scales_ = scales;
  force_rate_ = column_rate_ = {};
  rated_column_.clear();
  scratch_.platform = {};
  scratch_.tangent.clear();
  scratch_.determinant = 0;
  scratch_.stability = {};
  assembled_.lambda = undefined;
  const auto body = static_cast<std::size_t>(study.body - 1);
  const statics::System& system = problem_.layout();
  first_pose_ = system.first_pose;
  t_ = system.body_slices[body].t;
  d_ = system.body_slices[body].count;
  stages_.reset();
  if (problem_.structured() && problem_.symmetric()) stages_.emplace(system);
  measured_ = measured_direction(study, system.mechanism.bodies[body].task_space);
  conjugate_ = problem_.rule().t_rate;
  if (!conjugate_.isZero(0)) {
    // t_rate carries lambda's scale; the force goes with a unit displacement.
    conjugate_ /= measured_.dot(conjugate_);
  }
}

double Evaluator::load_rate() const {
  if (measured_.size() == 0) return 0;
  return measured_.dot(problem_.rule().W_rate.segment(t_ - first_pose_, d_));
}

/// What the drive adds to the constant load, along the direction.
double Evaluator::force(const continuation::CurvePoint& point) const {
  if (control_ == ControlMode::load) return point.lambda * load_rate();
  problem_.put_inputs(point.lambda, trial_.inputs);
  equilibrium_residual(problem_.turned(point.x, point.lambda), point.piece,
                       problem_.local(point.x, point.lambda), trial_.inputs, trial_.work, trial_.r);
  return conjugate_.dot(trial_.r.segment(t_, d_));
}

void Evaluator::put_state(const continuation::CurvePoint& point, const Turns* turns,
                          State& state) const {
  problem_.put_expanded(point.x, point.lambda, turns, state.z);
  problem_.put_inputs(point.lambda, state.inputs);
}

/// Under dead load index_force is what the curve itself counts, which also knows its neighbourhood: beside a branch
/// point rounding decides what the matrix of one point shows.
bool Evaluator::is_index_of_curve(Kind kind, const continuation::CurvePoint& point) const {
  return kind == Kind::index_force && control_ == ControlMode::load && point.negative;
}

double Evaluator::value(const QuantityDefinition& q, const continuation::CurvePoint& point,
                        const Turns* turns) const {
  switch (q.kind) {
    case Kind::stiffness:
    case Kind::eigenvalue:
    case Kind::tangent_eigenvalue:
    case Kind::tangent_imaginary:
    case Kind::tangent_determinant:
    case Kind::index_pose:
    case Kind::index_force: {
      if (is_index_of_curve(q.kind, point)) return value_at(q, point, {});
      const Assembled* at = assemble(point);
      return at ? from_matrix(q, point, *at, {}) : undefined;
    }
    case Kind::arc_length:
    case Kind::lambda:
    case Kind::index:
    case Kind::force:
      return value_at(q, point, {});
    case Kind::unknown:
      if (q.entry < first_pose_) return q.scale * point.x[q.entry];
      break;
    default:
      break;
  }
  put_state(point, turns, state_);
  return value_at(q, point, state_);
}

double Evaluator::value_at(const QuantityDefinition& q, const continuation::CurvePoint& point,
                           const State& state) const {
  const auto system = [&]() -> const statics::System& { return problem_.system(point.lambda); };
  // On the piece of the point: what is differenced must not change segments on the way.
  const Piece* const piece =
      point.piece.size() == system().switches.size() ? &point.piece : nullptr;
  switch (q.kind) {
    case Kind::arc_length:
      return point.s;
    case Kind::lambda:
      return q.scale * point.lambda;
    case Kind::deflection:
      return q.scale * measured_.dot(state.z.segment(t_, d_) - start_pose_of(problem_.rule()));
    case Kind::force:
      return q.scale * force(point);
    case Kind::unknown:
      return q.scale * state.z[q.entry];
    case Kind::command:
      return q.scale * state.inputs.rho[q.entry];
    case Kind::energy:
      return q.scale * (piece != nullptr
                            ? spring_energy(system(), *piece, state.z, state.inputs.rho)
                            : spring_energy(system(), state.z, state.inputs.rho));
    case Kind::point:
    case Kind::spring_length:
    case Kind::spring_force:
    case Kind::shape_value:
    case Kind::shape_own:
    case Kind::shape_force:
      return point_quantity(system(), q, state.z, state.inputs, piece).value_or(undefined);
    case Kind::index:
    case Kind::index_force:
      return point.negative ? static_cast<double>(*point.negative - problem_.closures())
                            : undefined;
    default:
      return undefined;
  }
}

const Evaluator::Assembled* Evaluator::assemble(const continuation::CurvePoint& point) const {
  if (stages_) return assemble_in_stages(point);
  const bool known = assembled_.lambda == point.lambda && assembled_.x == point.x &&
                     assembled_.piece == point.piece;
  return known ? &scratch_ : assemble_densely(point);
}

const Evaluator::Assembled* Evaluator::assemble_densely(
    const continuation::CurvePoint& point) const {
  Assembled& at = scratch_;
  assembled_.lambda = undefined;
  const statics::System& system = problem_.turned_to_pose(point.x, point.lambda, at.z);
  at.is_plain = &system == &problem_.system(point.lambda);
  problem_.put_inputs(point.lambda, at.inputs);
  if (!equilibrium_matrix(system, point.piece, at.z, at.inputs, at.work, at.r, at.A))
    return nullptr;
  if (problem_.symmetric()) {
    auto condensed = statics::condense(system, at.A, at.work);
    at.platform = std::move(condensed.platform);
    at.stability = condensed.stability;
  } else {
    at.platform = statics::platform_stiffness(system, at.A, false);
    at.tangent = statics::eigenvalues_of(statics::tangent_stiffness(system, at.A, at.work));
    at.determinant = statics::tangent_determinant(system, at.A);
  }
  at.body = statics::body_stiffness(system, at.A, at.platform, problem_.rule().body,
                                    problem_.symmetric());
  assembled_.x = point.x;
  assembled_.lambda = point.lambda;
  assembled_.piece = point.piece;
  return &at;
}

const Matrix* Evaluator::known_matrix(const Vector& x, double lambda, const Piece& piece) const {
  const bool known = !stages_ && problem_.is_whole() && scratch_.is_plain &&
                     assembled_.lambda == lambda && assembled_.x == x && assembled_.piece == piece;
  return known ? &scratch_.A : nullptr;
}

double Evaluator::from_matrix(const QuantityDefinition& q, const continuation::CurvePoint& point,
                              const Assembled& at, const State& state) const {
  const auto count = [](const std::optional<Index>& n) {
    return n ? static_cast<double>(*n) : undefined;
  };
  switch (q.kind) {
    case Kind::stiffness: {
      if (at.body.size() == 0) return q.scale * guided_stiffness(point, at);
      return q.scale * measured_.dot(at.body * measured_);
    }
    case Kind::tangent_eigenvalue:
    case Kind::tangent_imaginary: {
      const auto i = static_cast<std::size_t>(q.entry);
      if (i >= at.tangent.size()) return undefined;
      const auto& [real, imaginary] = at.tangent[i];
      return q.scale * (q.kind == Kind::tangent_eigenvalue ? real : imaginary);
    }
    case Kind::tangent_determinant:
      return q.scale * at.determinant;
    case Kind::eigenvalue:
      return q.entry < at.platform.eigenvalues.size() &&
                     std::isfinite(at.platform.eigenvalues[q.entry])
                 ? q.scale * at.platform.eigenvalues[q.entry]
                 : undefined;
    case Kind::index_pose:
      return count(at.stability.pose_controlled);
    case Kind::index_force:
      return is_index_of_curve(q.kind, point) ? value_at(q, point, state)
                                              : count(at.stability.force_controlled);
    case Kind::force:  // the residual at hand is that of force()
      if (at.is_plain && control_ != ControlMode::load)
        return q.scale * conjugate_.dot(at.r.segment(t_, d_));
      return value_at(q, point, state);
    default:
      return value_at(q, point, state);
  }
}

double Evaluator::guided_stiffness(const continuation::CurvePoint& point,
                                   const Assembled& at) const {
  constexpr double rigid = 1e-12;  // of the largest compliance: rounding
  if (measured_.size() == 0) return undefined;
  const statics::System& system = problem_.system(point.lambda);
  const auto C =
      stages_ ? std::optional<Matrix>(at.staged.compliance)
              : statics::body_compliance(system, at.A, problem_.rule().body, problem_.symmetric());
  if (!C || C->size() == 0) return undefined;
  const double along = measured_.dot(*C * measured_);
  return std::abs(along) > rigid * C->cwiseAbs().maxCoeff() ? 1 / along : undefined;
}

std::vector<double> Evaluator::values(const std::vector<QuantityDefinition>& quantities,
                                      const continuation::CurvePoint& point, const Turns* turns,
                                      const KnownSwitches& known) const {
  const Assembled* at = assemble(point);
  put_state(point, turns, state_);
  std::vector<double> values;
  values.reserve(quantities.size());
  for (const QuantityDefinition& q : quantities)
    values.push_back(at ? from_matrix(q, point, *at, state_) : undefined);
  decide_indices(quantities, point, known, values);
  double index = undefined;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (quantities[i].kind == Kind::index) index = values[i];
    if (quantities[i].kind == Kind::index_driven) values[i] = driven_index(point, index, known);
  }
  // Under dead load both are one count; where the curve knows none, as along a family, one matrix tells rounding.
  const auto is_index = [](const QuantityDefinition& q) { return q.kind == Kind::index; };
  if (control_ == ControlMode::load && std::ranges::any_of(quantities, is_index))
    for (std::size_t i = 0; i < quantities.size(); ++i)
      if (quantities[i].kind == Kind::index_force) values[i] = index;
  return values;
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
    if (q.kind == Kind::force) rate = force_rate(point).told();

    rates.push_back(q.scale * rate);
  }
  return rates;
}

RoundedRate Evaluator::force_rate(const continuation::CurvePoint& point) const {
  if (!is_same(force_rate_.point, point)) {
    force_rate_.rate = computed_force_rate(point);
    force_rate_.point = point;
  }
  return force_rate_.rate;
}

RoundedRate Evaluator::computed_force_rate(const continuation::CurvePoint& point) const {
  const double dlambda = point.tangent.dlambda;
  if (control_ == ControlMode::load) return {dlambda * load_rate(), 0};
  double rate = 0, size = 0;
  if (stages_) {
    rate = force_rate_in_stages(point, size);
  } else {
    const Matrix* A = problem_.known_matrix(point.x, point.lambda, point.piece);
    if (A == nullptr) {
      A = &trial_.A;
      problem_.put_inputs(point.lambda, trial_.inputs);
      if (!equilibrium_matrix(problem_.turned(point.x, point.lambda), point.piece,
                              problem_.local(point.x, point.lambda), trial_.inputs, trial_.work,
                              trial_.r, trial_.A))
        return {undefined, 0};
    }
    const auto rows = A->middleRows(t_, d_);
    rate = conjugate_.dot(rows * problem_.local_rate(point.x, point.tangent.dx, dlambda));
    size = rows.norm();
  }
  if (!problem_.rule().load_rate.isZero(0))  // loads that grow with lambda
    rate += dlambda * conjugate_.dot(statics::load_rate(problem_.turned(point.x, point.lambda),
                                                        problem_.local(point.x, point.lambda),
                                                        problem_.inputs(point.lambda).rho,
                                                        problem_.rule().load_rate)
                                         .segment(t_, d_));
  return {rate, tangent_rounding * size + off_curve_rate};
}

Matrix Evaluator::platform_stiffness(const continuation::CurvePoint& point) const {
  const Assembled* at = assemble(point);
  if (!at || at->body.size() == 0) return {};
  const statics::System& system = problem_.system(point.lambda);
  const Index body = problem_.rule().body;
  const model::TaskSpace space =
      system.mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space;
  return wrench_scales(space, scales_).asDiagonal() * in_world_axes(system, at->z, at->body, body) *
         pose_scales(space, scales_).cwiseInverse().asDiagonal();
}

Matrix Evaluator::rigid_compliance(const continuation::CurvePoint& point) const {
  const Assembled* at = assemble(point);
  if (!at || at->body.size() > 0) return {};
  const statics::System& system = problem_.system(point.lambda);
  const Index body = problem_.rule().body;
  const auto C = stages_ ? std::optional<Matrix>(at->staged.compliance)
                         : statics::body_compliance(system, at->A, body, problem_.symmetric());
  if (!C || C->size() == 0) return {};
  const model::TaskSpace space =
      system.mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space;
  return pose_scales(space, scales_).asDiagonal() *
         compliance_in_world_axes(system, at->z, *C, body) *
         wrench_scales(space, scales_).cwiseInverse().asDiagonal();
}

std::vector<std::pair<double, double>> Evaluator::tangent_eigenvalues(
    const continuation::CurvePoint& point) const {
  constexpr Index most = 300;
  if (stages_ && problem_.size() > most) return {};
  const Assembled* at = assemble_densely(point);
  if (!at) return {};
  const statics::System& system = problem_.system(point.lambda);
  auto values = statics::eigenvalues_of(statics::tangent_stiffness(system, at->A, at->work));
  for (auto& [real, imaginary] : values) {
    real *= scales_.force / scales_.length;
    imaginary *= scales_.force / scales_.length;
  }
  return values;
}

Index Evaluator::zero_modes(const continuation::CurvePoint& point) const {
  const Assembled* at = assemble(point);
  if (at && stages_) return at->staged.zero_modes;
  return at ? statics::zero_modes(problem_.system(point.lambda), at->A) : 0;
}

std::vector<Index> Evaluator::closure_ranks(const continuation::CurvePoint& point) const {
  const Assembled* at = assemble(point);
  if (!at) return {};
  if (stages_) return closure_ranks_in_stages();
  const Matrix plain = statics::without_gauge(at->A, at->work);
  std::vector<Index> ranks;
  for (const statics::ChainSlice& slice : problem_.system(point.lambda).chain_slices) {
    const Matrix J = plain.block(slice.F, slice.x, slice.F_count, slice.x_count);
    ranks.push_back(rank_of(J, same_rank));
  }
  return ranks;
}

std::vector<Matrix> Evaluator::chain_stiffnesses(const continuation::CurvePoint& point) const {
  const Assembled* at = assemble(point);
  if (!at) return {};
  const statics::System& system = problem_.system(point.lambda);
  std::vector<Matrix> list;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const model::CompiledChain& chain = system.chains[i];
    const model::TaskSpace space = chain.to_moves ? chain.to_space : chain.from_space;
    const auto K = !stages_ ? statics::chain_stiffness(system, i, at->A, at->work)
                   : i < at->staged.chains.size() ? std::optional<Matrix>(at->staged.chains[i])
                                                  : std::nullopt;
    list.push_back(K ? Matrix(wrench_scales(space, scales_).asDiagonal() * *K *
                              pose_scales(space, scales_).cwiseInverse().asDiagonal())
                     : Matrix());
  }
  return list;
}

}  // namespace springfold::analysis
