#include "inertia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

/// A motion whose mass is below this part of the largest has none: rounding of the points' derivatives.
constexpr double no_mass = 1e-9;

/// The moving unknown that moves most in the motion that has least mass; empty: all have some.
std::string massless(const Frozen& frozen, const Ground& at, const Matrix& M) {
  if (M.cols() == 0) return "";
  const SymmetricEigen eigen = symmetric_eigen(M);
  if (eigen.values[0] > no_mass * eigen.values.maxCoeff()) return "";
  const Vector along = at.motions * eigen.vectors.col(0);
  const auto& moving = frozen.landscape().moving();
  Vector step = Vector::Zero(frozen.problem().size());
  step(moving) = along;
  const Vector z = frozen.unknowns(step) - frozen.unknowns(Vector::Zero(step.size()));
  const auto& names = frozen.problem().layout().coordinate_names;
  Index most = 0;
  for (Index i = 0; i < z.size(); ++i)
    if (std::abs(z[i]) > std::abs(z[most]) * (1 + no_mass)) most = i;
  return names[static_cast<std::size_t>(most)];
}

/// Twice the frequency over the damping of the softest mode: what the dampers are multiplied by for a
/// damping ratio of one.
double critical_factor(const Matrix& K, const Matrix& M, const Matrix& D) {
  const SymmetricEigen mass = symmetric_eigen(M);
  const Matrix root =
      mass.vectors * mass.values.cwiseSqrt().cwiseInverse().asDiagonal() * mass.vectors.transpose();
  const SymmetricEigen modes = symmetric_eigen(Matrix(root * K * root));
  const Vector v = root * modes.vectors.col(0);
  return 2 * std::sqrt(modes.values[0]) / v.dot(D * v);
}

/// Steps that the integration may take: what a motion near the landing needs until its slowest mode has faded, while
/// the fastest one swings on. Stiffness, masses and dampers along all motions.
int steps_until_rest(const Matrix& K, const Matrix& M, const Matrix& D) {
  constexpr double steps_of_a_period = 400;  // backward differentiation at 1e-8 takes half of it
  constexpr double faded = 14;               // logarithm of the amplitude over that of near rest
  constexpr double least = 20000, most = 2e5;
  const SymmetricEigen mass = symmetric_eigen(M);
  const Matrix root =
      mass.vectors * mass.values.cwiseSqrt().cwiseInverse().asDiagonal() * mass.vectors.transpose();
  const SymmetricEigen modes = symmetric_eigen(Matrix(root * K * root));
  double slowest = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < modes.values.size(); ++i) {
    const Vector v = root * modes.vectors.col(i);
    const double damping = v.dot(D * v);
    slowest = std::min(slowest, std::min(damping / 2, modes.values[i] / damping));
  }
  const double fastest = std::sqrt(std::max(0.0, modes.values.maxCoeff()));
  const double periods = faded / slowest * fastest / (2 * std::numbers::pi);
  return static_cast<int>(periods > 0 ? std::clamp(steps_of_a_period * periods, least, most)
                                      : most);
}

/// The dampers that are named, and no others, of the moving unknowns.
Matrix named_dampers(const Frozen& frozen, const Scales& scales, double time,
                     const std::vector<JointDamping>& damping) {
  const statics::System& system = frozen.problem().layout();
  const auto& moving = frozen.landscape().moving();
  Vector entries = Vector::Zero(static_cast<Index>(moving.size()));
  for (std::size_t k = 0; k < moving.size(); ++k) {
    if (moving[k] >= system.first_pose) continue;
    const auto i = static_cast<std::size_t>(moving[k]);
    const double unit =
        (system.is_length[i] ? scales.force / scales.length : scales.moment()) * time;
    for (const JointDamping& d : damping)
      if (d.joint == system.coordinate_names[i]) entries[static_cast<Index>(k)] += d.value / unit;
  }
  return entries.asDiagonal();
}

/// The largest component of the chains' wrenches that is a force, or a moment.
void put_peak(const Frozen& frozen, const Vector& peaks, bool is_force, double unit, double& value,
              std::string& name) {
  const statics::System& system = frozen.problem().layout();
  const auto& multipliers = frozen.landscape().multipliers();
  for (std::size_t k = 0; k < multipliers.size() && static_cast<Index>(k) < peaks.size(); ++k) {
    const auto i = static_cast<std::size_t>(multipliers[k]);
    const double size = unit * peaks[static_cast<Index>(k)];
    if (system.is_length[i] != is_force || (!std::isnan(value) && size <= value * (1 + no_mass)))
      continue;
    value = size;
    name = system.coordinate_names[i];
  }
}

InertialMotion::End end_of(Flow::End end) {
  switch (end) {
    case Flow::End::rest:
      return InertialMotion::End::rest;
    case Flow::End::swings_on:
      return InertialMotion::End::swings_on;
    case Flow::End::runs_away:
      return InertialMotion::End::runs_away;
    case Flow::End::refused:
      return InertialMotion::End::no_mass;
    case Flow::End::failed:
      break;
  }
  return InertialMotion::End::no_end;
}

}  // namespace

Inertial inertial_motion(const Frozen& frozen, const Scales& scales,
                         const InertialSettings& settings, const Vector& from,
                         const RestState* overdamped, const InertialWatch& watch) {
  Inertial result;
  const Masses masses(frozen);
  const auto at = frozen.landscape().ground(from);
  if (!at) return result;
  const Matrix M = masses.largest() > 0
                       ? masses.along_motions(*at)
                       : Matrix(Matrix::Zero(at->hessian.rows(), at->hessian.cols()));
  result.motion.massless = massless(frozen, *at, M);
  if (!result.motion.massless.empty()) {
    result.motion.end = InertialMotion::End::no_mass;
    return result;
  }
  const double time = std::sqrt(masses.largest() * scales.length / scales.force);
  Terrain terrain = frozen.landscape().terrain();
  const auto there = overdamped == nullptr
                         ? std::nullopt
                         : frozen.landscape().ground_on(overdamped->x, overdamped->piece);
  const bool is_massive = there && massless(frozen, *there, masses.along_motions(*there)).empty();
  if (!settings.damping.empty()) {
    terrain.damping = named_dampers(frozen, scales, time, settings.damping);
  } else {
    if (!is_massive) return result;
    terrain.damping *=
        settings.damping_ratio * critical_factor(there->hessian, masses.along_motions(*there),
                                                 frozen.landscape().damping(*there));
  }
  const Landscape landscape(std::move(terrain));
  // Errors of the energy add up over many swings.
  FlowOptions options{
      .relative = 1e-9, .absolute = 1e-12, .goes_on = watch.goes_on, .caught_by = watch.caught_by};
  if (is_massive)
    options.most_steps =
        steps_until_rest(there->hessian, masses.along_motions(*there), landscape.damping(*there));
  Motion moving{landscape};
  moving.masses = [&masses](const Vector& x) { return masses.at(x); };
  moving.curvatures = [&masses](const Vector& x) { return masses.curvatures_at(x); };
  const Flow flow = flow_by_cvode(moving, from, options);
  InertialMotion& motion = result.motion;
  motion.end = end_of(flow.end);
  const bool swings_on = flow.end == Flow::End::swings_on;
  if (flow.end == Flow::End::rest || swings_on) result.landing = flow.state;
  motion.peak_speed = flow.peak_speed * scales.length / time;
  put_peak(frozen, flow.peak_multipliers, true, scales.force, motion.peak_force,
           motion.peak_force_of);
  put_peak(frozen, flow.peak_multipliers, false, scales.moment(), motion.peak_moment,
           motion.peak_moment_of);
  motion.followed = flow.time * time;
  if (swings_on) {
    motion.left = flow.left * scales.moment();
    motion.would_last = flow.would_settle * time;
  } else {
    motion.duration = flow.settled * time;
  }
  motion.dissipated = flow.dissipated * scales.moment();
  motion.closure = flow.closure;
  return result;
}

std::string doubt_of(const InertialMotion& motion) {
  const std::string helps = ": more damping (snap.inertia: damping_ratio, or damping) helps";
  if (motion.end == InertialMotion::End::swings_on)
    return "the motion with masses still swings " + rounded(motion.followed) +
           " after the push, with an energy of " + rounded(motion.left) +
           " that cannot take it out of where it lands; it would settle after about " +
           rounded(motion.would_last) + helps;
  if (motion.end == InertialMotion::End::no_end && motion.followed > 0)
    return "the motion with masses had not come to rest " + rounded(motion.followed) +
           " after the push, where its integration ended" + helps;
  if (motion.end == InertialMotion::End::no_end)
    return "the motion with masses was not integrated to a state of rest";
  return "";
}

}  // namespace springfold::analysis
