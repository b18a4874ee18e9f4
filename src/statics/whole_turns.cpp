#include "whole_turns.hpp"

#include <cmath>
#include <numbers>

#include "springfold/core/rounding.hpp"

namespace springfold::statics {
namespace {

constexpr double turn = 2 * std::numbers::pi;

}  // namespace

bool shorten_turns(const System& system, Vector& z) {
  constexpr double near_whole_turn = 345 * std::numbers::pi / 180;
  bool changed = false;
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    auto phi = z.segment(system.body_slices[b].t + 3, 3);
    const double angle = phi.norm();
    if (!(angle > near_whole_turn) || !std::isfinite(angle)) continue;
    phi *= std::remainder(angle, turn) / angle;
    changed = true;
  }
  return changed;
}

void take_back_turns(const SquareSystem& system, const Vector& guess, Vector& y) {
  Vector here, without, allowed;
  for (const Index i : system.angles) {
    const double whole = turn * std::round((y[i] - guess[i]) / turn);
    if (whole == 0) continue;
    if (allowed.size() == 0) {
      Matrix J;
      if (!system.residual(y, here) || !system.jacobian(y, J)) return;
      // What rounding makes of the terms of each row: that of large angles is large.
      allowed = few_roundings * J.cwiseAbs() * y.cwiseAbs().cwiseMax(1.0);
    }
    Vector nearer = y;
    nearer[i] -= whole;
    if (!system.residual(nearer, without)) continue;
    if (((without - here).cwiseAbs().array() <= allowed.array()).all()) y = std::move(nearer);
  }
}

}  // namespace springfold::statics
