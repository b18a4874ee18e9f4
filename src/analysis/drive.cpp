#include "drive.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/row_qr.hpp"

namespace springfold::analysis {
namespace {

/// A mode without stiffness, or of negative one, relative to the stiffest mode.
constexpr double softest_follower = 1e-6;
/// A direction along which the closures let less than this part move is no way.
constexpr double least_part = 0.1;

/// One step of a drive, with what it costs.
struct Reached {
  double amplitude = 0, force = 0, energy = 0;
  Vector x{};
};

}  // namespace

std::optional<Pushed> pushed(const Landscape& landscape, const Vector& from, const Vector& along,
                             Vector start, const PushOptions& options) {
  constexpr int rounds = 20;
  constexpr double longest = 0.05;
  Vector x = std::move(start);
  const auto off = [&] { return options.amplitude - along.dot((x - from)(landscape.moving())); };
  x(landscape.moving()) += off() * along;
  if (!landscape.close(x)) return std::nullopt;
  for (int k = 0; k < rounds; ++k) {
    const auto at = landscape.ground(x);
    if (!at || at->hessian.size() == 0) return std::nullopt;
    const Vector c = at->motions.transpose() * along;
    const double norm = c.norm();
    if (!(norm > least_part)) return std::nullopt;
    const Matrix W = RowQr(c.transpose()).kernel();
    Vector step = c * (off() / (norm * norm));
    if (W.cols() > 0) {
      const SymmetricEigen modes = symmetric_eigen(W.transpose() * at->hessian * W);
      Vector y = -modes.vectors.transpose() * (W.transpose() * (at->slope + at->hessian * step));
      const double floor = softest_follower * at->hessian.norm();
      for (Index i = 0; i < y.size(); ++i) y[i] /= std::max(floor, std::abs(modes.values[i]));
      step += W * (modes.vectors * y);
    }
    const double size = step.norm();
    if (size < options.arrived) return Pushed{x, -at->slope.dot(c) / norm};
    if (size > longest) step *= longest / size;
    const auto next = landscape.moved(*at, step);
    if (!next) return std::nullopt;
    x = *next;
  }
  const auto at = landscape.ground(x);
  if (!at || options.is_resting) return std::nullopt;
  const Vector c = at->motions.transpose() * along;
  return Pushed{x, -at->slope.dot(c) / c.norm()};
}

Driven drive(const Landscape& landscape, const RestState& from, const Vector& along,
             const DriveLimits& limits) {
  constexpr double first = 1e-3, shortest = 1e-4, longest = 0.1;
  constexpr double arrived = 1e-2;  // of a step: what follows is at rest to second order of that
  /// The work of the force between two states is the change of the energy, by the trapezoidal rule to this part.
  constexpr double poor = 0.1, good = 0.02;
  constexpr int most = 400;
  Driven result;
  Reached here{.energy = from.energy, .x = from.x}, last = here;
  double length = first;
  for (int k = 0; k < most && here.amplitude < limits.farthest; ++k) {
    const double amplitude = here.amplitude + length;
    const double ahead = here.amplitude > 0 ? length / (here.amplitude - last.amplitude) : 0;
    const auto next =
        pushed(landscape, from.x, along, here.x + ahead * (here.x - last.x),
               {.amplitude = amplitude, .arrived = arrived * length, .is_resting = true});
    const double energy =
        next ? landscape.energy(next->x) : std::numeric_limits<double>::quiet_NaN();
    const double work = -(here.force + (next ? next->force : 0)) / 2 * length;
    const double error = std::abs(energy - here.energy - work);
    const double size = length * (std::abs(here.force) + (next ? std::abs(next->force) : 0)) / 2;
    if (!(error <= poor * size) && length > shortest) {
      length /= 2;
      continue;
    }
    if (!next || !std::isfinite(energy)) return result;
    // Up to where the force turns the energy has risen all along.
    if (std::max(energy, here.energy) > limits.highest) return result;
    if (next->force > 0) {
      const double part = here.force / (here.force - next->force);
      auto saddle = rest_near(landscape, here.x + part * (next->x - here.x));
      if (saddle && saddle->index == 1) result.saddle = std::move(saddle);
      result.beyond = next->x;
      return result;
    }
    if (error <= good * size) length = std::min(2 * length, longest);
    last = here;
    here = {amplitude, next->force, energy, next->x};
  }
  return result;
}

}  // namespace springfold::analysis
