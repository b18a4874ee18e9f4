// A second, independent way along a curve: the flow of its tangent field.
#pragma once

#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

/// Follows the curve from (x, lambda) along `start` by integrating the Davidenko equation
///
///     d(x, lambda)/ds = tau(x, lambda),   | dF/dx  dF/dlambda | tau = 0,   |tau| = 1,
///
/// tau oriented by continuity (Davidenko 1953), with the Dormand-Prince pair 5(4) and its dense
/// output (Boost.Odeint). The end of every step is brought back onto the curve, so that no error
/// accumulates; a step that has to be brought back from afar is refused. Special points are found
/// by their change of sign at four places within each step, and located on the dense output,
/// every trial point corrected.
///
/// The result reads like that of trace(), with these differences:
///
///  - s is the arc length itself, to the tolerance of the integration;
///  - branch points, touches and unresolved places between kinks are not looked for and never
///    reported, also where the number of negative eigenvalues changes. lambda turning back is
///    reported as a limit point, also where it does so at a branch point (the vertex of a pitchfork);
///  - a closed curve is not recognised: it is followed on, lap after lap;
///  - kinks are passed, as in trace(), where there is exactly one way out;
///  - of `options` these count: step.initial, .minimum, .maximum, .turn and .growth, newton,
///    maximum_points, limit_points, location_tolerance and simultaneous.
///
/// Something that changes sign twice within a quarter of a step is missed, but for switches, which
/// are tested by their slopes as well.
/// @pre (x, lambda) satisfies F = 0 to the residual tolerance
/// @throws std::invalid_argument where sizes do not fit together, or problems_in(options) is not empty
Curve davidenko(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                const std::vector<Event>& events, const TraceOptions& options,
                const StepObserver& observer = {});

}  // namespace springfold::continuation
