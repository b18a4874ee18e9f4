#include "come_to_rest.hpp"

#include <cmath>
#include <optional>

#include "springfold/core/decompositions.hpp"

namespace springfold::statics {
namespace {

double potential(const System& system, const StartState& state) {
  return spring_energy(system, state.z, state.inputs.rho) +
         load_potential(system, state.z, state.inputs);
}

/// One implicit Euler step of the flow against the gradient; nothing where its equations are singular.
/// @param time  how long the flow goes on
std::optional<Vector> flow_step(StartEquations& equations, const StartState& state, double time) {
  Vector r;
  Matrix J;
  if (!equations.residual(state, r) || !equations.jacobian(state, J)) return std::nullopt;
  for (Index i = 0; i < J.cols(); ++i)
    if (!equations.is_wrench(i)) J(i, i) += 1 / time;
  const Vector step = -Lu(J).solve(r);
  return step.allFinite() ? std::optional(step) : std::nullopt;
}

/// The largest change of what moves.
double length_of(const StartEquations& equations, const Vector& step) {
  double length = 0;
  for (Index i = 0; i < step.size(); ++i)
    if (!equations.is_wrench(i)) length = std::max(length, std::abs(step[i]));
  return length;
}

}  // namespace

bool come_to_rest(const System& system, StartEquations& equations, const CloseChains& close,
                  StartState& state) {
  constexpr int most_steps = 200;
  constexpr double longest = 0.3, at_rest = 1e-9, longer = 4;
  Vector r;
  if (!equations.residual(state, r)) return false;
  const double small = at_rest * r.lpNorm<Eigen::Infinity>();
  double time = 1, height = potential(system, state);
  for (int i = 0; i < most_steps && std::isfinite(height) && time > 0; ++i) {
    const auto step = flow_step(equations, state, time);
    StartState next = state;
    double lower = std::nan("");
    if (step && length_of(equations, *step) <= longest) {
      equations.unpack(equations.pack(state) + *step, next);
      if (equations.residual(next, r) && r.lpNorm<Eigen::Infinity>() <= small) {
        state = next;
        return true;
      }
      if (close(next)) lower = potential(system, next);
    }
    const bool falls = lower < height;
    time = falls ? longer * time : time / (longer * longer);
    if (!falls) continue;
    state = next;
    height = lower;
  }
  return false;
}

}  // namespace springfold::statics
