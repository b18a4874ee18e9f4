// Options of the engine. Lengths are arc lengths in the problem's metric [-].
#pragma once

#include <string>
#include <vector>

namespace springfold::continuation {

struct NewtonOptions {
  double residual_tolerance = 1e-12;  ///< max |F| relative to max(1, max |x|) [-]
  int maximum_iterations = 8;         ///< more means: the step was too long
};

/// A step is accepted only if all three measures of nonlinearity stay below their limits; the next
/// step length aims at the fraction `aim` of them.
struct StepOptions {
  double initial = 1e-2;
  double minimum = 1e-8;  ///< the trace stops when a smaller step would be needed
  double maximum = 5e-2;
  double contraction = 0.25;  ///< largest ratio of neighbouring Newton corrections
  double turn = 0.2;          ///< largest angle between neighbouring tangents [rad]
  double deviation = 0.1;     ///< largest distance from tangent to corrected point, over step
  double aim = 0.4;
  double growth = 1.6;  ///< largest factor from one step to the next
};

struct TraceOptions {
  StepOptions step{};
  NewtonOptions newton{};
  int maximum_points = 5000;
  bool verify = true;  ///< look inside every accepted step (evidence.hpp)
  bool limit_points = true;
  bool branch_points = true;
  bool verify_arcs = false;           ///< test every arc of the finished curve (verification.hpp)
  double location_tolerance = 1e-13;  ///< of kinks, relative to the step they lie in
  /// Switches this close to zero at a kink act together, unless the curve surely meets them in rows that differ.
  double simultaneous = 1e-10;
};

/// Every rule the options break, as sentences a user can act on; empty when usable.
std::vector<std::string> problems_in(const TraceOptions& options);

}  // namespace springfold::continuation
