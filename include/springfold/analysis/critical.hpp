// Special points in a second parameter: what the study kinds `critical_curve`, `threshold`,
// `sensitivity` and `critical_load` are asked. Units of the case.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "springfold/analysis/moving_case.hpp"

namespace springfold::analysis {

struct Variant;

/// The case as a function of its named parameters.
struct CaseFamily {
  std::vector<std::string> names{};
  std::vector<double> values{};  ///< as the run has them
  /// Mechanism and study where the parameters with these numbers have other values; parameters that
  /// are formulas of them follow. Several threads may call it.
  std::function<Variant(const std::vector<std::pair<std::size_t, double>>&)> at{};
  MovingCase moving{};  ///< the same, of one parameter, where it moves few numbers
};

/// What a threshold rules out on the path from the start.
enum class Unwanted {
  limit_point,        ///< the load turns back, smoothly or in a corner
  loss_of_stability,  ///< these, branch points, and activations behind which a mode is unstable
};

/// Whose loss of stability counts.
enum class StabilityOf {
  control,    ///< under the study's own control
  dead_load,  ///< under displacement control: an extremum of the force too
};

/// Kind critical_curve: the special point `point` of the study's curve is followed in (lambda, parameter).
/// Kind threshold: the smallest or largest value of the parameter for which `unwanted` does not happen.
/// Kind sensitivity: how all special points move with `parameters`.
/// Kind critical_load: the first `unwanted` point of the path from the start over the whole range.
struct CriticalPointSettings {
  std::string point{};      ///< label on the study's curve: "LP1"; "STUDY/UZ1": with a History
  std::string parameter{};  ///< its name
  std::vector<std::string>
      parameters{};  ///< kind sensitivity; empty: all. critical_curve: those held
  double low = -std::numeric_limits<double>::infinity();  ///< range of the parameter
  double high = std::numeric_limits<double>::infinity();
  /// true: the start is solved anew for every value, so that commands found for a pose follow the parameter;
  /// false: commands stay as they are in the study's own start.
  bool tied = true;
  Unwanted unwanted = Unwanted::limit_point;
  StabilityOf stability = StabilityOf::control;
  bool smallest = true;  ///< false: the largest value is wanted
  int values = 0;  ///< kind critical_load: at so many values over the range the path is traced
  std::shared_ptr<const CaseFamily> cases{};
};

}  // namespace springfold::analysis
