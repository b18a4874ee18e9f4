// Interpolation at Chebyshev points: of functions along a step, of the step's points themselves.
// Private to the engine.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "springfold/core/types.hpp"

namespace springfold::continuation {

/// Polynomial of degree 9 through ten Chebyshev-Lobatto points of [a, b], in barycentric form
/// (Berrut and Trefethen 2004). No point lies in the middle, where a singular point is expected.
struct Interpolant {
  static constexpr int samples = 10;
  double a = 0, b = 1;
  std::array<double, samples> at{};           ///< places of the samples, from b down to a
  std::array<double, samples> barycentric{};  ///< weights
  Matrix values{};                            ///< one column per sample

  Vector operator()(double t) const;
  Vector slope(double t) const;
  /// Two places half-way between neighbouring samples, where the polynomial is farthest off: one on each side of the
  /// middle and not opposite to each other.
  std::array<double, 2> checks() const;
  /// The same for functions with one value, without memory from the heap.
  double first(double t) const;
  double first_slope(double t) const;
};

/// f may fail (nothing) where its point cannot be computed; then there is no interpolant.
std::optional<Interpolant> interpolate(const std::function<std::optional<Vector>(double)>& f,
                                       double a, double b);

/// The curve as a polynomial of the step length, for places at which no point of it can be computed: the unknowns
/// (x, lambda) between step lengths a and b.
/// @param point_at  an optional point at a step length
/// @returns nothing where one of the points cannot be computed
template <class PointAt>
std::optional<Interpolant> interpolated_curve(const PointAt& point_at, double a, double b) {
  return interpolate(
      [&](double t) -> std::optional<Vector> {
        const auto& p = point_at(t);
        if (!p) return std::nullopt;
        Vector u(p->x.size() + 1);
        u << p->x, p->lambda;
        return u;
      },
      a, b);
}

/// The same of a function with one value.
std::optional<Interpolant> interpolate_value(const std::function<std::optional<double>(double)>& f,
                                             double a, double b);

/// A window of the given length around t, inside [a, b].
std::pair<double, double> window_around(double t, double length, double a, double b);

}  // namespace springfold::continuation
