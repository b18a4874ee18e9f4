// One step along the flow of davidenko.hpp: its points, and what lies on it. Private to the engine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// From one point of the curve along the flow, arc lengths t = 0 to h from there.
struct FlowArc {
  CurvePoint from{};
  double h = 0;
  std::function<Vector(double t)> dense{};  ///< (x, lambda), near the curve; n + 1 entries
};

/// Unit tangent at u = (x, lambda), on or beside the curve, oriented like that of `from`.
std::optional<Direction> flow_at(const Walker& walker, const Vector& u, const CurvePoint& from);

/// Point of the curve at arc length t, brought back from the dense output.
/// @returns nothing where that is too far away
std::optional<CurvePoint> point_on_arc(const Walker& walker, const FlowArc& arc, double t);

struct ArcZero {
  CurvePoint point{};
  double before = 0, after = 0;  ///< arc lengths from arc.from that bracket it
};

/// Zero of a function between the arc lengths a and b (TOMS 748); every trial is a corrected point.
/// @returns nothing when there is no change of sign, or a trial point cannot be corrected
std::optional<ArcZero> zero_on_arc(const Walker& walker, const FlowArc& arc, double a, double b,
                                   const std::function<double(const CurvePoint&)>& value);

/// Where the arc meets its first switching surface.
struct ArcSurface {
  std::optional<ArcZero> met{};
  std::string doubt{};  ///< set: a shorter step is needed; why
};

/// @param samples  points of the arc in order, the first is arc.from
/// @param left  switches that are zero at arc.from because the curve leaves them there
ArcSurface first_surface(const Walker& walker, const FlowArc& arc,
                         const std::vector<CurvePoint>& samples, const std::vector<Index>& left);

}  // namespace springfold::continuation
