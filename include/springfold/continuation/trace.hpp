// The path follower.
#pragma once

#include <functional>
#include <vector>

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/problem.hpp"
#include "springfold/continuation/ray.hpp"

namespace springfold::continuation {

/// Called after every accepted step; returning false stops the trace there. Points among special points that could not
/// be resolved may be taken back afterwards: the curve that is returned says which ones stand.
using StepObserver = std::function<bool(const CurvePoint&)>;

/// Called for every special point of a smooth piece before the curve goes on; returning false ends it there (joined).
/// Kinks, corners and what stays unresolved are not told: they stand in the curve's hits.
using HitObserver = std::function<bool(const Hit&)>;

/// Follows the curve from (x, lambda) along `start`. Special points (limit points, branch points,
/// switching surfaces, the caller's events) are located by re-solving on the curve; at a switching
/// surface the step is cut exactly there and the curve goes on in the piece that it enters. A
/// refused step changes nothing but the step length and the log. A curve that comes back to its
/// start in its first direction is closed there: its last point is the start once more.
/// @pre (x, lambda) satisfies F = 0 to the residual tolerance
/// @throws std::invalid_argument where sizes do not fit together, or problems_in(options) is not empty
Curve trace(ProblemView problem, const Vector& x, double lambda, const Ray& start,
            const std::vector<Event>& events, const TraceOptions& options,
            const StepObserver& observer = {}, const HitObserver& at_hit = {});

/// All directions in which a curve leaves the point (x, lambda); piece: where no switch is active.
/// @throws std::invalid_argument as trace() does
Rays rays_from(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
               const TraceOptions& options);

}  // namespace springfold::continuation
