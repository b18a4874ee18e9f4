// The path of one design: values at its special points, each with its rates by the design's parameters. Private to
// analysis.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base_path.hpp"
#include "path_slope.hpp"

namespace springfold::analysis {

/// A value and its rates by the parameters of the design [units of the case]; NaN where they are not known.
struct Measure {
  double value = 0;
  Vector rates{};
};

/// Why a path is not known to its end; empty: it is.
std::string doubt_of(const BasePath& path);

/// The case as a function of its parameters, those of the design having other values.
struct DesignCase {
  Study study{};                       ///< marks are those that the requirements need
  std::vector<std::size_t> numbers{};  ///< of the design's parameters among those of the case
  std::vector<double> sizes{};         ///< on which the case varies with each of them
  SlopeUnits slope_units{};            ///< of the case itself
};

/// Where all parameters of the design move from the case to these values together: the part of the way, in (0, 1], at
/// which the start jumps, as one under a load that the mechanism bears no more. Nothing: it does not, or that is not
/// known, as where the start is the end of another study.
/// @param at  the case with these values, as it begins
std::optional<double> jump_of_start(const DesignCase& of, const Vector& values, const Member& at);

/// The curves of one design, one family for every parameter. The case must outlive it.
class DesignPath {
 public:
  /// Solves the start. @param pose  in place of start.pose; empty: the study's own
  DesignPath(const DesignCase& of, const Vector& values, const Vector& pose = {});
  /// Traces the path towards growing lambda, in a unit of lambda that serves all of it.
  void trace(const Observer& observer);

  bool has_start() const { return families_.front()->base().report.found; }
  const Member& base() const { return families_.front()->base(); }
  const BasePath& path() const { return path_; }

  std::optional<Measure> at_start(const std::string& column) const;
  /// At the first passage of `along` through `value`, which is a mark of the case, or the start.
  std::optional<Measure> at_value(const std::string& column, const std::string& along,
                                  double value) const;
  std::optional<Measure> at_point(const SpecialPoint& point, const std::string& column) const;

  /// The least slope of the path before `quantity` passes `end`: d(lambda)/ds or d(force)/ds, in the units of the case.
  /// What climbs turns back where it is negative.
  /// @param path  of the base, or that of the load
  std::optional<Measure> least_slope(const BasePath& path, const std::string& quantity, double end,
                                     Climb climb) const;

 private:
  void begin(double lambda_unit);
  std::size_t column(const std::string& name) const;
  Measure with_rates(double value,
                     const std::function<std::optional<Vector>(const CaseCurves&)>& of) const;

  const DesignCase& of_;
  Study study_;  ///< of the neighbours
  std::vector<std::unique_ptr<CaseCurves>> families_{};
  BasePath path_{};
};

}  // namespace springfold::analysis
