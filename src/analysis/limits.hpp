// Limits and marks of a study on a path. Private to analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quantities.hpp"
#include "springfold/continuation/ray.hpp"

namespace springfold::analysis {

/// How the point is called at which a column of `extrema` is stationary.
inline std::string extremum_name(const std::string& column) { return "extremum of " + column; }

/// Limits and marks as events of the engine; under displacement control also the extrema of the
/// force. The evaluator must outlive them.
std::vector<continuation::Event> events_of(const Study& study, const Evaluator& evaluator,
                                           const std::vector<QuantityDefinition>& quantities);

/// The curve in a direction in which a limit ends it already at the start, because the start is
/// outside of the range or on its edge and the direction leads out; otherwise nothing.
std::optional<continuation::Curve> ended_at_start(const Study& study, const Evaluator& evaluator,
                                                  const std::vector<QuantityDefinition>& quantities,
                                                  const continuation::CurvePoint& start,
                                                  const continuation::Ray& ray);

/// Which limit the point is beyond, "lambda reaches its upper limit"; nothing within the range. A
/// limit itself is within.
std::optional<std::string> limit_passed(const Study& study, const Evaluator& evaluator,
                                        const std::vector<QuantityDefinition>& quantities,
                                        const continuation::CurvePoint& point);

/// Does the point lie on a limit, to rounding? A curve from there may leave the range without crossing it.
bool is_on_limit(const Study& study, const Evaluator& evaluator,
                 const std::vector<QuantityDefinition>& quantities,
                 const continuation::CurvePoint& point);

/// What to do about a start outside of the limits.
inline constexpr const char* outside_advice = "try limits that include the start, or another start";

/// A limit that a start violates: "lambda = 0 at the start, outside of its limits 1 to 2"; nothing within
/// the range. `quantity` names the limit.
struct OutsideStart {
  std::string quantity{}, text{};
};
std::optional<OutsideStart> outside_start(const Study& study, const Evaluator& evaluator,
                                          const std::vector<QuantityDefinition>& quantities,
                                          const continuation::CurvePoint& start);

}  // namespace springfold::analysis
