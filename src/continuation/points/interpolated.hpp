// The curve as a polynomial of the step length, for places at which no point of it can be computed. Private to the engine.
#pragma once

#include <optional>

#include "continuation/points/chebyshev.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::continuation {

/// The unknowns (x, lambda) between step lengths a and b.
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

}  // namespace springfold::continuation
