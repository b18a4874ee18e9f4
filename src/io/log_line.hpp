// Curves on logarithmic axes.
#pragma once

#include <functional>

#include "figure.hpp"

namespace springfold::io {

/// How a figure shows its values.
struct AxisScales {
  bool x_log = false, y_log = false;
  double width = 1,
         height = 1;  ///< what the axes show, about: in decades where they are logarithmic
  PlotPoint least{};  ///< below it nothing is looked for on a logarithmic axis
  bool any_log() const { return x_log || y_log; }
};

/// A piece of a curve, from t = 0 to t = 1.
using PieceOfCurve = std::function<PlotPoint(double)>;

/// Adds points of the piece strictly between `from` and `to`, so many that straight lines between them cannot
/// be told from the curve on these axes. What runs to where a logarithmic axis has no place is followed to
/// `least`. Nothing is added on axes that are not logarithmic.
void add_points_between(const PieceOfCurve& curve, double from, double to, const AxisScales& scales,
                        Polyline& points);

}  // namespace springfold::io
